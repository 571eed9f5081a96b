"""Cases of real pictures: sets of the data folder, and the user's own."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tagmetry.detect.grey import grey_8bit
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.bench.case import Case, nothing
from tagmetry.markers import family as family_of
from tagmetry.sources import read_picture
from tagmetry.sources.paths import expand

STRONG_FAMILIES = ("tag36h11", "aruco_mip_36h12")
SMALL_FAMILIES = (
    *("4x4_50", "4x4_100", "4x4_250", "4x4_1000"),
    *("5x5_50", "5x5_1000", "aruco_original", "tag16h5"),
)
FREE_OF = STRONG_FAMILIES + SMALL_FAMILIES  # what is looked for in pictures without markers
MOST_PICTURES = 24  # of a set or a pattern, evenly taken, so that a run ends


@dataclass(frozen=True)
class Pictures:
    """Pictures on disk as a case.

    Attributes:
        name: What the case is called.
        family: What to look for.
        paths: The pictures.
        shows_none: It is known that no picture shows a marker.
        all_threads: It is measured with all threads as well.
    """

    name: str
    family: str
    paths: tuple[Path, ...]
    shows_none: bool = False
    all_threads: bool = False

    def case(self) -> Case:
        """Return the case with its images."""
        images = tuple(_grey(path) for path in self.paths)
        truths = nothing(len(images)) if self.shows_none else None
        return Case(self.name, self.family, images, truths, once=self.shows_none)


def real_sets(folder: Path) -> list[Pictures]:
    """Return the sets of the data folder that are there.

    Raises:
        InputError: None is.
    """
    sets = [
        _set(folder, "tiny_tags", "tag36h11"),
        _set(folder, "yaw_sweep", "tag36h11"),
        _set(folder, "house_tour/mapping_feb_2014", "tag36h11"),
        _set(folder, "planar_map", "aruco_original"),
        _set(folder, "grid_board", "6x6_250"),
        *(_marker_free(folder, family) for family in FREE_OF),
    ]
    there = [one for one in sets if one.paths]
    if not there:
        names = ", ".join(one.name.removeprefix("real-") for one in sets)
        raise InputError(f"{folder} has none of the sets {names}; TAGMETRY_DATA names the folder")
    return there


def own_pictures(patterns: Sequence[str], family: str) -> Pictures:
    """Return pictures of one's own as a case.

    Raises:
        InputError: There are none, or no such family.
    """
    family = family_of(family).name
    paths = [path for pattern in patterns for path in expand(pattern)]
    some = _some(paths)
    name = "own" if len(some) == len(paths) else f"own-{len(some)}-of-{len(paths)}"
    return Pictures(name, family, some)


def _set(folder: Path, name: str, family: str) -> Pictures:
    found = sorted(p for p in (folder / name).glob("*") if p.suffix.lower() in {".jpg", ".png"})
    return Pictures(f"real-{name.partition('/')[0]}", family, _some(found))


def _marker_free(folder: Path, family: str) -> Pictures:
    """Return all pictures without markers as a case of one family."""
    paths = tuple(sorted((folder / "marker_free").glob("*.jpg")))
    return Pictures(f"free-{family}", family, paths, shows_none=True)


def _some(paths: Sequence[Path]) -> tuple[Path, ...]:
    if len(paths) <= MOST_PICTURES:
        return tuple(paths)
    numbers = np.linspace(0, len(paths) - 1, MOST_PICTURES).round().astype(int)
    return tuple(paths[number] for number in numbers)


def _grey(path: Path) -> GreyPixels:
    pixels = read_picture(path, grey=True)
    try:
        return grey_8bit(pixels)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
