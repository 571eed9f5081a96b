"""The camera model: where a point in front of the camera falls on the image, and back.

Frames: `camera` is x right, y down, z forward. An integer pixel is a pixel's centre.

    u = fx x'' + cx,  v = fy y'' + cy        with (x'', y'') the bent ray of `lens`
"""

from dataclasses import dataclass, field
from typing import Self

import numpy as np

from tagmetry.camera.brown_lens import BrownLens
from tagmetry.camera.lens import Lens
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array


@dataclass(frozen=True, eq=False)
class Camera:
    """Intrinsics of one camera at one resolution, zoom and focus.

    Attributes:
        width_px: Columns of the image that the intrinsics belong to.
        height_px: Rows.
        focal_px: (fx, fy).
        center_px: (cx, cy), the principal point.
        lens: The distortion.
        covariance: Of (fx, fy, cx, cy, coefficients), shape (4 + n, 4 + n), where it is known.
        zoom: Digital or optical zoom factor that they belong to.
        focus: Focus setting of the camera that they belong to, in the camera's own unit.
        name: What the camera is called.
        provenance: Where the numbers come from, for people.
    """

    width_px: int
    height_px: int
    focal_px: tuple[float, float]
    center_px: tuple[float, float]
    lens: Lens = field(default_factory=BrownLens)
    covariance: Array | None = None
    zoom: float = 1.0
    focus: float | None = None
    name: str = "camera"
    provenance: str = ""

    def __post_init__(self) -> None:
        if self.width_px < 1 or self.height_px < 1:
            raise InputError(f"image size must be positive, got {self.width_px}x{self.height_px}")
        if not (np.isfinite(self.focal_px).all() and min(self.focal_px) > 0):
            raise InputError(f"focal_px must be positive, got {self.focal_px}")
        if not np.isfinite(self.center_px).all():
            raise InputError(f"center_px must be finite, got {self.center_px}")
        if not (np.isfinite(self.zoom) and self.zoom > 0):
            raise InputError(f"zoom must be positive, got {self.zoom}")
        expected = (self.parameter_count,) * 2
        if self.covariance is not None and self.covariance.shape != expected:
            raise InputError(
                f"expected a covariance of shape {expected} over fx, fy, cx, cy and the "
                f"coefficients, got {self.covariance.shape}"
            )

    @classmethod
    def from_matrix(cls, width_px: int, height_px: int, K: Array, lens: Lens | None = None) -> Self:
        """Return the camera with intrinsics K = [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]."""
        K = np.asarray(K, dtype=np.float64)
        if K.shape != (3, 3):
            raise InputError(f"expected a 3x3 camera matrix, got shape {K.shape}")
        focal, center = (float(K[0, 0]), float(K[1, 1])), (float(K[0, 2]), float(K[1, 2]))
        return cls(width_px, height_px, focal, center, lens if lens is not None else BrownLens())

    @property
    def matrix(self) -> Array:
        """K, shape (3, 3)."""
        (fx, fy), (cx, cy) = self.focal_px, self.center_px
        return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])

    @property
    def size_px(self) -> tuple[int, int]:
        """(width, height)."""
        return self.width_px, self.height_px

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """What the numbers are called that describe the camera."""
        return ("fx", "fy", "cx", "cy", *self.lens.names)

    @property
    def parameter_count(self) -> int:
        """How many numbers describe the camera: fx, fy, cx, cy and the coefficients."""
        return 4 + len(self.lens.coefficients)

    def project(self, p_camera: Array) -> Array:
        """Return the pixels that show points.

        Args:
            p_camera: Shape (..., 3), metres, camera frame.

        Returns:
            Shape (..., 2); NaN for points that the lens does not show.
        """
        bent = self.lens.bend(np.asarray(p_camera, dtype=np.float64))
        return np.asarray(bent * self.focal_px + self.center_px)

    def project_with_jacobian(self, p_camera: Array) -> tuple[Array, Array]:
        """Return pixels, shape (..., 2), and d(pixel) / d(point), shape (..., 2, 3), in px / m."""
        p_camera = np.asarray(p_camera, dtype=np.float64)
        by_point, _ = self.lens.jacobians(p_camera)
        return self.project(p_camera), by_point * np.array(self.focal_px)[:, None]

    def parameter_jacobian(self, p_camera: Array) -> Array:
        """Return d(pixel) / d(fx, fy, cx, cy, coefficients), shape (..., 2, 4 + n)."""
        p_camera = np.asarray(p_camera, dtype=np.float64)
        bent = self.lens.bend(p_camera)
        _, by_coefficients = self.lens.jacobians(p_camera)
        by_focal = bent[..., :, None] * np.eye(2)
        by_center = np.broadcast_to(np.eye(2), by_focal.shape)
        by_coefficients = by_coefficients * np.array(self.focal_px)[:, None]
        return np.concatenate([by_focal, by_center, by_coefficients], axis=-1)

    def unproject(self, pixels: Array) -> Array:
        """Return the viewing rays of pixels.

        Args:
            pixels: Shape (..., 2), as the camera gives them (distorted).

        Returns:
            Unit vectors in the camera frame, shape (..., 3); NaN where the lens shows nothing.
        """
        pixels = np.asarray(pixels, dtype=np.float64)
        usable = np.isfinite(pixels).all(axis=-1, keepdims=True)
        pixels = np.where(usable, pixels, np.nan)
        return self.lens.straighten((pixels - self.center_px) / self.focal_px)

    def contains(self, pixels: Array) -> "np.ndarray[tuple[int, ...], np.dtype[np.bool_]]":
        """Say for pixels (..., 2) whether they lie on the image."""
        low, high = -0.5, np.array(self.size_px) - 0.5
        with np.errstate(invalid="ignore"):
            return np.asarray(((pixels >= low) & (pixels <= high)).all(axis=-1))

    def check_image(self, width_px: int, height_px: int) -> None:
        """Raise InputError when an image is not of the size that the intrinsics belong to."""
        if (width_px, height_px) != self.size_px:
            raise InputError(
                f"the camera's intrinsics belong to {self.width_px}x{self.height_px} images, this "
                f"one is {width_px}x{height_px}; calibrate at this size, or convert the file: "
                f"tagmetry camera convert CAMERA OUT --scale-to {width_px}x{height_px}"
            )
