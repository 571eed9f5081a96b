"""The file of a bank of calibrations: our own YAML, checked strictly, with full precision."""

import re
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field

from tagmetry.camera import Approach, BankNode, BrownLens, Camera, CameraBank, FisheyeLens
from tagmetry.errors import InputError
from tagmetry.files.atomic import write_atomically
from tagmetry.files.cameras.section import Section, completed
from tagmetry.files.checked import OwnFileModel, checked
from tagmetry.files.tables import Table, load_table, parse_table
from tagmetry.files.text import named_errors, read_text
from tagmetry.files.yaml_writer import yaml_of

_FORMAT, _VERSION = "camera bank", 1
_MARK = re.compile(rf"""^[{{\s]*["']?tagmetry["']?\s*:\s*["']?{_FORMAT}""", re.MULTILINE)


class _Node(OwnFileModel):
    width_px: int
    height_px: int
    zoom: float
    focus: float
    approach: Approach | None = None
    focal_px: list[float] = Field(min_length=2, max_length=2)
    center_px: list[float] = Field(min_length=2, max_length=2)
    coefficients: list[float]
    covariance: list[list[float]] | None = None
    provenance: str = ""


class _Bank(OwnFileModel):
    tagmetry: Literal["camera bank"]
    version: int
    name: str
    lens: Literal["brown", "fisheye"]
    zoom_is_digital: bool
    may_scale: bool
    nodes: list[_Node]


def is_bank(table: Table) -> bool:
    """Say whether a table is the file of a bank."""
    return table.get("tagmetry") == _FORMAT


def is_bank_file(path: str | Path) -> bool:
    """Say whether a file calls itself a bank, before it is parsed.

    Raises:
        InputError: It is missing or not text.
    """
    return _MARK.search(read_text(Path(path))) is not None


def load_bank(path: str | Path) -> CameraBank:
    """Return the bank of a file.

    Raises:
        InputError: The file is missing or broken, or of a later version.
    """
    table = load_table(path)
    with named_errors(Path(path)):
        return bank_from(table)


def save_bank(bank: CameraBank, path: str | Path) -> None:
    """Write a bank; it reads back exactly, covariances too.

    Raises:
        InputError: It holds what cannot be read again, or the file cannot be written.
    """
    path = Path(path)
    with named_errors(path):
        text = _text(bank)
        bank_from(parse_table(text))  # nothing is written that could not be read again
    write_atomically(path, text)


def bank_from(table: Table) -> CameraBank:
    """Return the bank of a table."""
    if not is_bank(table):
        raise InputError(f"expected a bank of calibrations (tagmetry: {_FORMAT}), found none")
    if table.get("version") != _VERSION:
        raise InputError(
            f"expected version {_VERSION} of a camera bank, found {table.get('version')}; a later "
            "tagmetry may read it"
        )
    found = checked(_Bank, table)
    nodes = []
    for index, node in enumerate(found.nodes):
        with named_errors(f"nodes.{index}"):
            nodes.append(BankNode(_camera(node, found), node.approach))
    return CameraBank(tuple(nodes), found.zoom_is_digital, found.may_scale)


def _text(bank: CameraBank) -> str:
    table: Table = {
        "tagmetry": _FORMAT,
        "version": _VERSION,
        "name": bank.name,
        "lens": bank.nodes[0].camera.lens.kind,
        "zoom_is_digital": bank.zoom_is_digital,
        "may_scale": bank.may_scale,
        "nodes": [_node_table(node) for node in bank.nodes],
    }
    return yaml_of(table)


def _node_table(node: BankNode) -> Table:
    camera = node.camera
    table: Table = {
        "width_px": camera.width_px,
        "height_px": camera.height_px,
        "zoom": float(camera.zoom),
        "focus": node.focus,
        "focal_px": [float(number) for number in camera.focal_px],
        "center_px": [float(number) for number in camera.center_px],
        "coefficients": [float(number) for number in camera.lens.coefficients],
    }
    if node.approach is not None:
        table["approach"] = node.approach
    if camera.provenance:
        table["provenance"] = camera.provenance
    if camera.covariance is not None:
        table["covariance"] = np.asarray(camera.covariance, dtype=np.float64).tolist()
    return table


def _camera(node: _Node, bank: _Bank) -> Camera:
    lens = (FisheyeLens if bank.lens == "fisheye" else BrownLens)(tuple(node.coefficients))
    (fx, fy), (cx, cy) = node.focal_px, node.center_px
    camera = Camera(node.width_px, node.height_px, (fx, fy), (cx, cy), lens)
    section = Section(
        name=bank.name,
        covariance=node.covariance,
        zoom=node.zoom,
        focus=node.focus,
        provenance=node.provenance,
    )
    return completed(camera, section)
