"""A series of pictures: a scene, who photographs it, and when."""

from collections.abc import Generator, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.twin.rendering.photograph import photograph
from tagmetry.twin.rendering.seen import seen_sheets
from tagmetry.twin.rendering.shot import Shot
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.truth import ImageTruth, image_truth

MOST_IMAGES = 100_000
MOST_PIXELS = 100_000_000
_LEAST_SIDE_PX = 8
_LOOKED_AT = 500


@dataclass(frozen=True, eq=False)
class Recipe:
    """What it takes to make a series of pictures, always the same ones.

    Attributes:
        scene: What there is to see.
        shot: Who sees it; its `time_s` is that of the first picture.
        count: How many pictures.
        rate_hz: How many in a second.
        seed: Of the noise.
    """

    scene: Scene
    shot: Shot
    count: int = 1
    rate_hz: float = 30.0
    seed: int = 0

    def __post_init__(self) -> None:
        if not 1 <= self.count <= MOST_IMAGES:
            raise InputError(f"expected 1 to {MOST_IMAGES} images, found {self.count}")
        if not (np.isfinite(self.rate_hz) and self.rate_hz > 0):
            raise InputError(f"rate_hz must be positive, found {self.rate_hz}")
        if self.seed < 0:
            raise InputError(f"a seed is 0 or more, found {self.seed}")
        width_px, height_px = self.shot.camera.size_px
        if min(width_px, height_px) < _LEAST_SIDE_PX or width_px * height_px > MOST_PIXELS:
            raise InputError(
                f"expected pictures of {_LEAST_SIDE_PX} pixels a side to {MOST_PIXELS // 10**6} "
                f"megapixels, found {width_px}x{height_px}"
            )

    def shot_of(self, number: int) -> Shot:
        """Return who takes a picture, counted from 0."""
        return replace(self.shot, time_s=self.shot.time_s + number / self.rate_hz)


@dataclass(frozen=True, eq=False)
class Picture:
    """One picture of a series with its truth.

    Attributes:
        number: From 0.
        pixels: Shape (height, width), uint8 or uint16.
        truth: What is exactly so in it.
    """

    number: int
    pixels: AnyPixels
    truth: ImageTruth


def pictures(recipe: Recipe, jobs: int = 1) -> Generator[Picture]:
    """Give the pictures of a series in order; each is the same for any number of jobs.

    Args:
        recipe: What to make.
        jobs: How many are made at the same time, in threads.
    """
    if jobs < 1:
        raise InputError(f"expected at least one job, found {jobs}")
    if jobs == 1:
        yield from (picture(recipe, number) for number in range(recipe.count))
        return
    pool = ThreadPoolExecutor(jobs)
    try:
        yield from _ahead(pool, recipe, 2 * jobs)
    finally:
        pool.shutdown(cancel_futures=True)


def picture(recipe: Recipe, number: int) -> Picture:
    """Return one picture of a series, with noise of its own."""
    shot = recipe.shot_of(number)
    rng = np.random.default_rng([recipe.seed, number])
    return Picture(number, photograph(recipe.scene, shot, rng), image_truth(recipe.scene, shot))


def check_something_is_seen(recipe: Recipe) -> None:
    """Raise InputError when no picture shows a marker or board, saying why the first does not.

    A scene without any may show whatever it has; of a long series, some pictures are looked at.
    """
    scene = recipe.scene
    wanted = [one for one in scene.things if one.markers or one.board is not None] or scene.things
    for number in np.unique(np.linspace(0, recipe.count - 1, _LOOKED_AT).astype(int)):
        view = recipe.shot_of(int(number)).view()
        if any(one.thing in wanted for one in seen_sheets(scene, view, margin_px=0)):
            return
    raise InputError(f"nothing is visible in any picture{_reason(recipe)}")


def _ahead(pool: ThreadPoolExecutor, recipe: Recipe, most: int) -> Iterator[Picture]:
    """Give pictures in order while some more are being made."""
    waiting: list[Future[Picture]] = []
    for number in range(recipe.count):
        waiting.append(pool.submit(picture, recipe, number))
        if len(waiting) == most:
            yield waiting.pop(0).result()
    while waiting:
        yield waiting.pop(0).result()


def _reason(recipe: Recipe) -> str:
    """Return what keeps the first marker of the first picture from being seen."""
    truth = image_truth(recipe.scene, recipe.shot)
    if not truth.markers:
        return "; turn the camera to what there is, or the things to the camera"
    first = truth.markers[0]
    if first.depth_m <= 0:
        why = f"is behind the camera, at a depth of {first.depth_m:.3g} m"
    elif first.tilt_deg >= 90:
        why = f"is turned away from the camera, by {first.tilt_deg:.0f} degrees"
    else:
        why = "lies outside the picture"
    return f": marker {first.family} {first.id} {why}"
