"""Rendered markers in any response, with first guesses of their corners half a pixel off."""

from dataclasses import dataclass

import cv2
import numpy as np
from rendered_markers import scene

from tagmetry.camera import Camera
from tagmetry.detect.photometric import Fitted, Picture, fit_pictures
from tagmetry.geometry import Array
from tagmetry.markers import family
from tagmetry.twin import Look

BLACK, WHITE = 40.0, 200.0


def encoded(light: np.ndarray, exponent: float) -> np.ndarray:
    """Return grey values of light, both 0 to 255; exponent 0 stands for sRGB."""
    share = np.asarray(light, dtype=float) / 255
    if exponent == 0:
        curve = 1.055 * np.maximum(share, 1e-9) ** (1 / 2.4) - 0.055
        return 255 * np.where(share <= 0.0031308, 12.92 * share, curve)
    return 255 * share ** (1 / exponent)


def picture_of(name: str, marker_id: int) -> Picture:
    own = family(name)
    return Picture(own.picture(marker_id), own.layout.margin_cells)


@dataclass(frozen=True, eq=False)
class Seen:
    """A picture of one marker, its truth, and where it is first thought to be."""

    grey: np.ndarray
    camera: Camera
    corners_px: Array
    first_px: Array
    picture: Picture

    def fitted(self, *, camera_known: bool = False) -> Fitted:
        camera = self.camera if camera_known else None
        return fit_pictures(self.grey, self.first_px[None], [self.picture], camera)


def seen(
    rng: np.random.Generator,
    side_px: float = 60.0,
    *,
    noise: float = 1.6,
    exponent: float = 1.0,
    blur_px: float = 0.6,
    jpeg: int | None = None,
    name: str = "tag36h11",
    marker_id: int = 7,
    **wanted: object,
) -> Seen:
    """Return a marker; `wanted` goes to `scene`."""
    look = Look(black=BLACK, white=WHITE, noise=0.0, blur_px=blur_px)
    shown = scene(rng, side_px, look=look, family=name, marker_id=marker_id, **wanted)
    values = encoded(shown.grey, exponent)
    noisy = np.clip(np.rint(values + rng.normal(0, noise, values.shape)), 0, 255).astype(np.uint8)
    if jpeg is not None:
        noisy = cv2.imdecode(cv2.imencode(".jpg", noisy, [1, jpeg])[1], 0)
    first = shown.corners_px + rng.normal(0, 0.4, (4, 2))
    return Seen(noisy, shown.camera, shown.corners_px, first, picture_of(name, marker_id))


def errors(count: int, seed: int, *, camera_known: bool = False, **wanted: object) -> np.ndarray:
    """Return errors and squared distances of the markers that were fitted, as (count, 9).

    One in ten may be given up, as a detector does that fits its sides alone then.
    """
    rng, rows = np.random.default_rng(seed), []
    for _ in range(count):
        one = seen(rng, tilt_deg=wanted.get("tilt_deg", rng.uniform(0, 40)), **_rest(wanted))
        found = one.fitted(camera_known=camera_known)
        if not found.sound.all():
            continue
        error = (found.corners_px[0] - one.corners_px).ravel()
        rows.append([*error, error @ np.linalg.solve(found.covariances_px2[0], error)])
    assert len(rows) >= 0.9 * count
    return np.array(rows)


def _rest(wanted: dict[str, object]) -> dict[str, object]:
    return {name: value for name, value in wanted.items() if name != "tilt_deg"}
