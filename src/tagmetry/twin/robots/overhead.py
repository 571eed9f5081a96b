"""What a ceiling camera sees of robots, made quickly: some milliseconds a robot.

The floor stands still, so its exact light is taken once (`twin.rendering.exposed`). Each robot is
a dark box with a marker on its roof: its outline is filled and its roof mapped on a grid of 6 x 6
points a pixel, by the homography of the roof's four corners, which are projected through the lens.
Light and cover are averaged over the pixels, spread by the lens, and laid over the floor; the
sensor is quick as well (`twin.optics.quick_sensor`). What is left out: the lens's bend within a
marker, shadows, the robots' motion during the exposure, and that the floor's own grain is spread
together with the robot's edge.
"""

from collections.abc import Sequence
from dataclasses import replace

import cv2
import numpy as np

from tagmetry.arena.robot import Robot
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import AnyPixels, FloatImage
from tagmetry.twin.optics.quick_sensor import quick_development
from tagmetry.twin.optics.vignetting import gain_map
from tagmetry.twin.rendering import Shot, exposed
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.robots.roof import BODY_REFLECTANCE, ROOF_CORNERS, Roof, roof_of
from tagmetry.twin.scenes import Scene

_FINE = 6
_REACH_PX = 5  # around a robot: its light is spread by the lens
_UP = np.array([0.0, 0.0, 1.0])
_SUBPIXEL_BITS = 8  # of the outline's points

_Painted = tuple[FloatImage, FloatImage]  # light and cover


class OverheadPictures:
    """Takes pictures of robots on a floor."""

    def __init__(self, floor: Scene, robots: Sequence[Robot], shot: Shot) -> None:
        """Take the empty floor.

        Args:
            floor: All that does not move.
            robots: What lies on their roofs, and where.
            shot: The camera at its place; its veil is left out.
        """
        self._shot = replace(shot, optics=replace(shot.optics, veil=0.0))
        self._light = floor.light
        self._roofs = [roof_of(robot) for robot in robots]
        self._p_robot = np.array([np.vstack([one.corners_m, one.body_m]) for one in self._roofs])
        self._empty = exposed(floor, self._shot) * np.float32(shot.brightness)
        self._gain = gain_map(shot.camera, shot.optics.vignetting)
        self._T_camera_world = shot.path.at(np.zeros(1))[0].inv()
        self._develop = quick_development(shot.sensor, shot.camera.size_px)

    def take(self, Ts_world_robot: RigidTransform, rng: np.random.Generator) -> AnyPixels:
        """Return a picture, shape (height, width), uint8.

        Args:
            Ts_world_robot: Where the robots are, shape (n,).
            rng: Where the noise comes from.
        """
        exposure = self._empty.copy()
        seen_px, lit = self._seen_px(Ts_world_robot), self._lit(Ts_world_robot)
        for roof, pixels, irradiance in zip(self._roofs, seen_px, lit, strict=True):
            window = self._window(pixels) if np.isfinite(pixels).all() else None
            if window:
                self._lay(exposure, window, _painted(roof, pixels, window), irradiance)
        return self._develop(exposure, rng)

    def _lay(self, exposure: FloatImage, window: Box, painted: _Painted, irradiance: float) -> None:
        """Lay a robot over what there is in its window."""
        radiance, cover = painted
        gain = self._gain[window.pixels] * np.float32(self._shot.brightness * irradiance)
        sigma_px = self._shot.optics.blur_px
        under = exposure[window.pixels] * (1 - _spread(cover, sigma_px))
        exposure[window.pixels] = under + gain * _spread(radiance, sigma_px)

    def _seen_px(self, Ts_world_robot: RigidTransform) -> Array:
        """Return pixels of the roofs' and bodies' corners, (n, m, 2); NaN behind the camera."""
        p_world = _placed(Ts_world_robot, self._p_robot)
        p_camera = np.asarray(self._T_camera_world.apply(p_world.reshape(-1, 3)))
        pixels = np.asarray(self._shot.camera.project(p_camera))
        before = np.where(p_camera[:, 2:] > 0, pixels, np.nan)
        return before.reshape(*p_world.shape[:2], 2)

    def _lit(self, Ts_world_robot: RigidTransform) -> list[float]:
        """Return the irradiance of the middles of the roofs."""
        middles_m = self._p_robot[:, :ROOF_CORNERS].mean(axis=1, keepdims=True)
        lit = self._light.on(_placed(Ts_world_robot, middles_m)[:, 0], _UP)
        return list(map(float, lit))

    def _window(self, pixels: Array) -> Box:
        left, top = np.floor(pixels.min(axis=0)).astype(int).tolist()
        right, bottom = np.ceil(pixels.max(axis=0)).astype(int).tolist()
        image = Box(0, 0, *self._shot.camera.size_px)
        return Box(left, top, right + 1, bottom + 1).grown(_REACH_PX) & image


def _placed(Ts_world_robot: RigidTransform, p_robot: Array) -> Array:
    """Return points of every robot in the world, shape (n, m, 3)."""
    R_world_robot = Ts_world_robot.rotation.as_matrix()
    turned = p_robot @ np.swapaxes(R_world_robot, 1, 2)
    return np.asarray(turned + np.asarray(Ts_world_robot.translation)[:, None])


def _painted(roof: Roof, seen_px: Array, window: Box) -> _Painted:
    """Return the light under an irradiance of 1, and the cover, of a window's pixels."""
    corners_px, body_px = seen_px[:ROOF_CORNERS], seen_px[ROOF_CORNERS:]
    width, height = window.right - window.left, window.bottom - window.top
    size = (_FINE * width, _FINE * height)
    cover = np.zeros((size[1], size[0]), np.float32)
    outline = cv2.convexHull(_fine(body_px, window).astype(np.float32))[:, 0]
    points = np.rint(outline * 2**_SUBPIXEL_BITS).astype(np.int32)
    cv2.fillConvexPoly(cover, points, 1.0, cv2.LINE_8, _SUBPIXEL_BITS)
    sheet_m = roof.sheet_m
    to_fine = cv2.getPerspectiveTransform(
        sheet_m.astype(np.float32), _fine(corners_px, window).astype(np.float32)
    )
    H = to_fine @ np.linalg.inv(roof.to_texel)
    paper = cv2.warpPerspective(
        roof.reflectance, H, size, flags=cv2.INTER_NEAREST, borderValue=-1.0
    )
    on_roof = paper >= 0
    radiance = np.where(on_roof, paper, BODY_REFLECTANCE * cover).astype(np.float32)
    cover[on_roof] = 1.0
    return _means(radiance, width, height), _means(cover, width, height)


def _means(fine: FloatImage, width: int, height: int) -> FloatImage:
    return np.asarray(cv2.resize(fine, (width, height), interpolation=cv2.INTER_AREA), np.float32)


def _spread(image: FloatImage, sigma_px: float) -> FloatImage:
    if sigma_px == 0:
        return image
    return np.asarray(cv2.GaussianBlur(image, (0, 0), sigma_px), np.float32)


def _fine(pixels: Array, window: Box) -> Array:
    """Return places on the fine grid, whose integers are its points."""
    return np.asarray((pixels - [window.left, window.top] + 0.5) * _FINE - 0.5)
