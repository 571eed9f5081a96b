"""Which numbers of a camera are solved for, by the name of its lens and what is held fixed."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from tagmetry.calibrate.bundle import Bundle
from tagmetry.calibrate.choice import LensName
from tagmetry.geometry import Array

_COEFFICIENTS: dict[LensName, tuple[int, int]] = {  # how many are free, and how many there are
    "none": (0, 0),
    "brown1": (1, 4),
    "brown2": (2, 4),
    "brown4": (4, 4),
    "brown5": (5, 5),
    "brown8": (8, 8),
    "brown12": (12, 12),
    "brown14": (14, 14),
    "fisheye": (4, 4),
}


@dataclass(frozen=True)
class Wanted:
    """What kind of camera is looked for.

    Attributes:
        lens: Its lens.
        fix_aspect: fx = fy, square pixels.
        fix_center: The principal point is the image's centre.
    """

    lens: LensName
    fix_aspect: bool = False
    fix_center: bool = False

    @property
    def kind(self) -> Literal["brown", "fisheye"]:
        """Brown or fisheye."""
        return "fisheye" if self.lens == "fisheye" else "brown"

    @property
    def coefficients(self) -> int:
        """How many coefficients the lens holds, free or zero."""
        return _COEFFICIENTS[self.lens][1]

    def basis(self) -> Array:
        """Return how the free numbers move (fx, fy, cx, cy, coefficients), (4 + c, free)."""
        whole = np.eye(4 + self.coefficients)
        focal = whole[:, :1] + whole[:, 1:2] if self.fix_aspect else whole[:, :2]
        center = whole[:, 4:4] if self.fix_center else whole[:, 2:4]
        free = _COEFFICIENTS[self.lens][0]
        return np.hstack([focal, center, whole[:, 4 : 4 + free]])

    def conform(self, bundle: Bundle, size_px: tuple[int, int]) -> Bundle:
        """Return a bundle with this lens, what is held fixed at its value."""
        intrinsics = np.zeros(4 + self.coefficients)
        free = min(_COEFFICIENTS[self.lens][0], len(bundle.intrinsics) - 4)
        intrinsics[: 4 + free] = bundle.intrinsics[: 4 + free]
        if self.fix_aspect:
            intrinsics[:2] = np.sqrt(intrinsics[0] * intrinsics[1])
        if self.fix_center:
            intrinsics[2:4] = (np.array(size_px) - 1) / 2
        return replace(bundle, intrinsics=intrinsics)
