"""The file of a lens: what must be known to drive a camera's zoom and focus, beside its bank.

tagmetry: zoom lens
version: 1
bank: bank.yaml            # next to this file
law: {kind: log, numbers: [42.11, 4.0]}     # or dioptre; or spline, with log_depths and values
aperture_m: 0.0016
nearest_m: 0.05
farthest_m: 1.1
native_percent: 200
lag: {images: 1, focus_per_image: 30}
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from pydantic import Field

from tagmetry.camera import CameraBank
from tagmetry.camera.controls import Control, control_named
from tagmetry.errors import InputError
from tagmetry.files.atomic import write_atomically
from tagmetry.files.bank import load_bank
from tagmetry.files.checked import OwnFileModel, checked
from tagmetry.files.tables import Table, load_table
from tagmetry.files.text import named_errors
from tagmetry.files.yaml_writer import yaml_of
from tagmetry.lens import DioptreLaw, Lag, LogLaw, SplineLaw, ZoomLens

_FORMAT, _VERSION = "zoom lens", 1


class _Law(OwnFileModel):
    kind: Literal["log", "dioptre", "spline"]
    numbers: list[float] = Field(default_factory=list)
    log_depths: list[float] = Field(default_factory=list)
    values: list[float] = Field(default_factory=list)


class _Lag(OwnFileModel):
    images: int = 1
    focus_per_image: float = 30.0


class _Lens(OwnFileModel):
    tagmetry: Literal["zoom lens"]
    version: Literal[1]
    bank: str
    law: _Law
    aperture_m: float
    nearest_m: float
    farthest_m: float
    native_percent: float = 100.0
    lag: _Lag = _Lag()


@dataclass(frozen=True, eq=False)
class LensFile:
    """What a lens file says.

    Attributes:
        bank: The calibrations that it names.
        bank_name: The file that they are in, as the lens file names it.
        law: Which depth is sharp at which focus value.
        aperture_m: Diameter of the entrance pupil.
        nearest_m: Depth from which on markers are looked for.
        farthest_m: Depth up to which.
        native_percent: Zoom at which a pixel of the image is one of the sensor.
        lag: How late the controls are.
    """

    bank: CameraBank
    bank_name: str
    law: LogLaw | DioptreLaw | SplineLaw
    aperture_m: float
    nearest_m: float
    farthest_m: float
    native_percent: float = 100.0
    lag: Lag = Lag()  # noqa: RUF009 (frozen)

    def lens(self, available: Mapping[str, Control]) -> ZoomLens:
        """Return the lens with a camera's own ranges of zoom and focus.

        Raises:
            InputError: The camera has no zoom or no focus.
        """
        return ZoomLens(
            control_named(available, "zoom"),
            control_named(available, "focus"),
            self.law,
            self.bank,
            self.aperture_m,
            self.nearest_m,
            self.farthest_m,
            self.native_percent,
        )


def load_lens(path: str | Path) -> LensFile:
    """Return what a lens file says, with the bank that it names.

    Raises:
        InputError: One of the files is missing or broken.
    """
    path = Path(path)
    table = load_table(path)
    with named_errors(path):
        found = checked(_Lens, table)
        law = _law(found.law)
        lag = Lag(found.lag.images, found.lag.focus_per_image)
    bank = load_bank(path.parent / found.bank)
    return LensFile(
        bank, found.bank, law, found.aperture_m, found.nearest_m, found.farthest_m,
        found.native_percent, lag,
    )  # fmt: skip


def save_lens(lens: LensFile, path: str | Path) -> None:
    """Write a lens file; its bank is a file of its own, see `save_bank`."""
    table: Table = {
        "tagmetry": _FORMAT,
        "version": _VERSION,
        "bank": lens.bank_name,
        "law": _law_table(lens.law),
        "aperture_m": float(lens.aperture_m),
        "nearest_m": float(lens.nearest_m),
        "farthest_m": float(lens.farthest_m),
        "native_percent": float(lens.native_percent),
        "lag": {
            "images": lens.lag.images,
            "focus_per_image": float(lens.lag.focus_per_image),
        },
    }
    write_atomically(Path(path), yaml_of(table))


def _law(found: _Law) -> LogLaw | DioptreLaw | SplineLaw:
    if found.kind == "spline":
        return SplineLaw(tuple(found.log_depths), tuple(found.values))
    if len(found.numbers) != 2:
        raise InputError(f"law.numbers: expected two, found {len(found.numbers)}")
    first, second = found.numbers
    return LogLaw(first, second) if found.kind == "log" else DioptreLaw(first, second)


def law_line(law: LogLaw | DioptreLaw | SplineLaw) -> str:
    """Return the line of a lens file that says a law."""
    return f"law: {{{', '.join(f'{key}: {_shown(one)}' for key, one in _law_table(law).items())}}}"


def _shown(value: object) -> str:
    """Return a word as it is, numbers with six digits."""
    return f"[{', '.join(f'{x:.6g}' for x in value)}]" if isinstance(value, list) else str(value)


def _law_table(law: LogLaw | DioptreLaw | SplineLaw) -> Table:
    if isinstance(law, LogLaw):
        return {"kind": "log", "numbers": [float(law.alpha), float(law.beta)]}
    if isinstance(law, DioptreLaw):
        return {"kind": "dioptre", "numbers": [float(law.per_dioptre), float(law.far)]}
    return {"kind": "spline", "log_depths": list(law.log_depths), "values": list(law.values)}
