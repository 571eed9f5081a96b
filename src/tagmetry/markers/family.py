"""A family of markers: the layout that they share and the code of each."""

from dataclasses import dataclass, replace
from functools import cached_property
from math import comb

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers.layout import Layout
from tagmetry.markers.packed import Words, packed

_BLOCK = 256  # ids that are compared with all others at once


@dataclass(frozen=True, eq=False)
class MarkerFamily:
    """What a detector must know to name a marker.

    Attributes:
        name: The field's name, for example `tag36h11`, `4x4_50`, `tagStandard41h12`.
        layout: Border and places of the bits.
        codes: One row of bits per id, True is white, shape (ids, bits).
        correction_bits: How many wrong bits the code can correct: (minimum distance - 1) // 2.
    """

    name: str
    layout: Layout
    codes: BoolArray
    correction_bits: int

    def __post_init__(self) -> None:
        if self.codes.ndim != 2 or self.codes.shape[1] != self.layout.bit_count:
            raise InputError(
                f"family {self.name}: expected codes of {self.layout.bit_count} bits, "
                f"got an array of shape {self.codes.shape}"
            )

    def __len__(self) -> int:
        """The number of ids."""
        return len(self.codes)

    def __repr__(self) -> str:
        return f"MarkerFamily({self.name!r}, {len(self)} ids)"

    def picture(self, marker_id: int) -> BoolArray:
        """Return a marker as square cells, True is white, upright, without its quiet zone."""
        return self.layout.picture(self.codes[self.checked_id(marker_id)])

    def checked_id(self, marker_id: int) -> int:
        """Return the id, or raise InputError when the family has no such marker."""
        if not 0 <= marker_id < len(self):
            raise InputError(
                f"family {self.name} has ids 0 to {len(self) - 1}, there is no id {marker_id}"
            )
        return marker_id

    def with_border(self, border_cells: int) -> "MarkerFamily":
        """Return the family with another width of border; Kalibr prints AprilTags with 2 cells."""
        if border_cells == self.layout.border_cells:
            return self
        if self.layout.white_border:
            raise InputError(f"{self.name} has bits around its border, which has one width only")
        data_cells = self.layout.side_cells - 2 * self.layout.border_cells
        layout = Layout.square(data_cells, border_cells)
        return replace(self, name=f"{self.name}_border{border_cells}", layout=layout)

    @cached_property
    def forgiven_bits(self) -> int:
        """How many wrong bits a detector forgives unless told otherwise.

        As many as the code corrects, as long as random bits would pass for a marker at most once
        in a thousand. A family that fails this with no wrong bit at all (4x4, 16h5) forgives none.
        """
        limit = self.correction_bits
        while limit > 0 and self.chance_of_random_match(limit) > 1e-3:
            limit -= 1
        return limit

    def chance_of_random_match(self, wrong_bits: int) -> float:
        """Return the probability (its union bound) that random bits read as some marker."""
        bits = self.layout.bit_count
        within = sum(comb(bits, k) for k in range(wrong_bits + 1))
        return min(1.0, 4.0 * len(self) * within / 2.0**bits)

    @property
    def turned_codes(self) -> BoolArray:
        """All codes, True is white, shape (4 * ids, bits): upright, then turned by 1, 2, 3."""
        turned = self.codes[:, self.layout.rotations]
        return np.swapaxes(turned, 0, 1).reshape(-1, self.layout.bit_count)

    @cached_property
    def packed_codes(self) -> Words:
        """The turned codes as bits in words, shape (4 * ids, words)."""
        return packed(self.turned_codes)

    def minimum_distance(self) -> int:
        """Return the least number of differing bits of two markers, or of one and itself turned."""
        signs = np.where(self.turned_codes, np.float32(1), np.float32(-1))
        most = -np.inf
        for first in range(0, len(self), _BLOCK):
            upright = signs[first : min(first + _BLOCK, len(self))]
            agreement = upright @ signs.T
            own = np.arange(len(upright))
            agreement[own, first + own] = -np.inf  # each upright marker against itself
            most = max(most, float(agreement.max()))
        return int((self.layout.bit_count - most) / 2)
