"""Pictures of the twin as files: a folder of pictures, one picture, or a video, with their truth.

Every picture and every line of truth appears whole; what was written before an interruption stays
valid, and the truth tells of no picture that is not there.
"""

import json
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np

from tagmetry.camera import Image
from tagmetry.errors import InputError
from tagmetry.files import save_camera, write_atomically
from tagmetry.files.atomic import refusing
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.record.pictures import PictureWriter
from tagmetry.record.video import VideoEncoder
from tagmetry.record.whole import WholeFileWriter, Writer
from tagmetry.twin.recipe import Picture, Recipe
from tagmetry.twin.truth import truth_line

PICTURE, VIDEO = ".png", ".mp4"


class RenderedWriter:
    """Takes the pictures of a recipe, for a with-block.

    A folder gets `000000.png` and so on, `truth.jsonl` and `camera.yaml`; a `.png` or `.mp4` has
    its truth and its camera beside it.
    """

    def __init__(self, out: str | Path, recipe: Recipe, truth: str | Path | None = None) -> None:
        self._out = Path(out)
        self._recipe = recipe
        suffix = self._out.suffix.lower()
        self._is_folder = suffix not in (PICTURE, VIDEO)
        self._is_video = suffix == VIDEO
        self._check()
        self._truth_path = Path(truth) if truth is not None else self._beside("truth.jsonl")
        self._truth = _TruthWriter(self._truth_path)
        self._stack = ExitStack()

    @property
    def files(self) -> tuple[Path, ...]:
        """What is written, the pictures' folder as one."""
        return self._out, self._truth_path, self._beside("camera.yaml")

    def __enter__(self) -> Self:
        if self._is_folder:
            with refusing(self._out):
                self._out.mkdir(parents=True, exist_ok=True)
        with ExitStack() as opening:
            opening.enter_context(self._truth)
            self._pictures: Writer[Image] = opening.enter_context(self._opened())
            save_camera(self._recipe.shot.picture_camera, self._beside("camera.yaml"))
            self._stack = opening.pop_all()
        return self

    def write(self, picture: Picture) -> None:
        """Write a picture, then its truth."""
        name = f"{picture.number:06d}{PICTURE}" if self._is_folder else self._out.name
        pixels = _bgr_8bit(picture.pixels, self._bits) if self._is_video else self._deep(picture)
        time_s = picture.truth.time_s
        self._pictures.write(Image(pixels, time_s, "capture", picture.number, str(self._out)))
        self._truth.write(truth_line(picture.truth, name, picture.number))

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.__exit__(kind, error, trace)

    @property
    def _bits(self) -> int:
        return self._recipe.shot.sensor.bits

    def _deep(self, picture: Picture) -> AnyPixels:
        """Return grey values that fill 16 bits where the sensor has more than 8."""
        return picture.pixels if self._bits == 8 else picture.pixels << (16 - self._bits)

    def _opened(self) -> Writer[Image]:
        if self._is_video:
            return WholeFileWriter(self._out, VideoEncoder())
        return PictureWriter(self._out / f"{{sequence}}{PICTURE}" if self._is_folder else self._out)

    def _beside(self, name: str) -> Path:
        """Return where what goes with the pictures is written."""
        return self._out / name if self._is_folder else self._out.with_suffix(f".{name}")

    def _check(self) -> None:
        suffix = self._out.suffix.lower()
        if self._is_folder and suffix and not self._out.is_dir():
            raise InputError(
                f"{self._out}: expected a folder, or a file ending in {PICTURE} or {VIDEO}, "
                f"found {suffix}"
            )
        if self._is_folder and self._out.is_file():
            raise InputError(f"{self._out}: expected a folder, this is a file")
        if suffix == PICTURE and self._recipe.count > 1:
            raise InputError(
                f"{self._out} holds one picture and the scene has {self._recipe.count}; name a "
                "folder, or ask for one with --images 1"
            )
        if stray := next(self._strays(), None):
            raise InputError(
                f"{self._out} holds {stray.name}, which is none of these "
                f"{self._recipe.count} pictures; name another folder, or empty it"
            )

    def _strays(self) -> Iterator[Path]:
        """Give the pictures in the folder that this run would not replace."""
        if not (self._is_folder and self._out.is_dir()):
            return
        own = {f"{number:06d}{PICTURE}" for number in range(self._recipe.count)}
        for path in sorted(self._out.iterdir()):
            if path.suffix.lower() in (PICTURE, ".jpg", ".jpeg") and path.name not in own:
                yield path


class _TruthWriter:
    """Writes lines of truth: to `.jsonl` at once, to `.json` as one list at the end."""

    def __init__(self, path: Path) -> None:
        if path.suffix.lower() not in (".json", ".jsonl"):
            found = path.suffix or "no suffix"
            raise InputError(f"{path}: expected a file ending in .json or .jsonl, found {found}")
        self._path = path
        self._lines: list[str] = []
        self._at_once = path.suffix.lower() == ".jsonl"

    def __enter__(self) -> Self:
        if self._at_once:
            with refusing(self._path):
                self._file = self._path.open("wb", buffering=0)
        elif not self._path.resolve().parent.is_dir():
            raise InputError(
                f"cannot write {self._path}: there is no folder {self._path.parent}; create it "
                "first"
            )
        return self

    def write(self, line: str) -> None:
        """Take one more line."""
        if not self._at_once:
            self._lines.append(line)
            return
        with refusing(self._path):
            self._file.write(line.encode() + b"\n")

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._at_once:
            self._file.close()
        elif kind in (None, KeyboardInterrupt):
            images = [json.loads(line) for line in self._lines]
            write_atomically(self._path, json.dumps({"images": images}, allow_nan=False) + "\n")


def _bgr_8bit(pixels: AnyPixels, bits: int) -> AnyPixels:
    """Return a picture as a video holds it."""
    grey = (pixels >> (bits - 8)).astype(np.uint8)
    return np.repeat(grey[:, :, None], 3, axis=2)
