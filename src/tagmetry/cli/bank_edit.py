"""What `tagmetry camera bank` does to a bank, and the camera that it is asked for."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from tagmetry.camera import BankNode, Camera, CameraBank
from tagmetry.cli.setting import EXAMPLE, parse_setting
from tagmetry.errors import InputError
from tagmetry.files import load_bank, load_camera


def edited(
    file: Path,
    add: Sequence[Path],
    approach: str | None,
    drop: str | None,
    zoom_is_digital: bool | None,
    may_scale: bool | None,
) -> CameraBank:
    """Return the bank of a file with what was asked for changed; a new one where there is none."""
    if approach is not None and not add:
        raise InputError("--approach says how the calibrations of --add were focused; add some")
    nodes = tuple(_node(path, approach) for path in add)
    if file.exists():
        bank = load_bank(file)
    elif nodes:
        bank = CameraBank(nodes)
        nodes = ()
    else:
        raise InputError(f"{file}: there is no such bank; begin one with --add CAMERA")
    if drop is not None:
        asked = parse_setting(drop)
        bank = bank.drop(focus=asked.focus, zoom=asked.zoom)
    return replace(
        bank,
        nodes=(*bank.nodes, *nodes),
        zoom_is_digital=bank.zoom_is_digital if zoom_is_digital is None else zoom_is_digital,
        may_scale=bank.may_scale if may_scale is None else may_scale,
    )


def camera_at(bank: CameraBank, settings: str | None, out: Path | None) -> Camera | None:
    """Return the camera at a setting like `focus=35,zoom=200`, None where none was asked for."""
    if settings is None:
        if out is not None:
            raise InputError(f"say at which setting, as --at {EXAMPLE}")
        return None
    asked = parse_setting(settings)
    width_px, height_px = asked.size_px or (None, None)
    return bank.camera_at(
        focus=asked.focus, zoom=asked.zoom, width_px=width_px, height_px=height_px
    )


def _node(path: Path, approach: str | None) -> BankNode:
    try:
        return BankNode(load_camera(path), approach)  # type: ignore[arg-type]
    except InputError as error:
        named = str(error).startswith(str(path))
        raise InputError(str(error) if named else f"{path}: {error}") from error
