"""New marker families with a wanted size and distance.

Random codes are tried one after another and kept when they keep their distance from all that were
kept before, in every orientation, and from themselves turned. Codes with few changes between
neighbouring cells are passed over: they look like windows and tiles.

Reference: S. Garrido-Jurado et al., Automatic generation and detection of highly reliable fiducial
markers under occlusion, 2014 (there with a sampling that prefers many changes).
"""

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers.family import MarkerFamily
from tagmetry.markers.layout import Layout


def generate_family(
    name: str,
    data_cells: int,
    count: int,
    minimum_distance: int,
    rng: np.random.Generator,
    tries: int = 200_000,
) -> MarkerFamily:
    """Return a new family.

    Args:
        name: What the family is called.
        data_cells: Bits per side, 3 to 16.
        count: How many markers are wanted.
        minimum_distance: Least number of differing bits between any two, in any orientation.
        rng: Where the randomness comes from; the same seed gives the same family.
        tries: How many random codes are tried before giving up.

    Raises:
        InputError: No such family was found within the tries.
    """
    if not 3 <= data_cells <= 16 or count < 1 or minimum_distance < 1:
        raise InputError(
            "a family needs 3 to 16 cells per side, at least 1 marker and a distance of at least "
            f"1, got {data_cells}, {count} and {minimum_distance}"
        )
    layout = Layout.square(data_cells)
    kept = np.zeros((0, layout.bit_count), dtype=bool)
    for _ in range(tries):
        code = rng.random(layout.bit_count) < 0.5
        if _is_lively(code, data_cells) and _keeps_distance(code, kept, layout, minimum_distance):
            kept = np.vstack([kept, code])
            if len(kept) == count:
                return MarkerFamily(name, layout, kept, (minimum_distance - 1) // 2)
    raise InputError(
        f"found only {len(kept)} of {count} markers of {data_cells}x{data_cells} bits at distance "
        f"{minimum_distance} in {tries} tries; ask for fewer markers, more bits or less distance"
    )


def _keeps_distance(code: BoolArray, kept: BoolArray, layout: Layout, distance: int) -> bool:
    turned = code[layout.rotations]
    to_itself = (turned[1:] != code).sum(axis=1)
    to_others = (kept[:, None, :] != turned).sum(axis=2)
    return bool((to_itself >= distance).all() and (to_others >= distance).all())


def _is_lively(code: BoolArray, data_cells: int) -> bool:
    """Say whether at least a third of the neighbouring cells differ."""
    cells = code.reshape(data_cells, data_cells)
    changes = (cells[1:] != cells[:-1]).sum() + (cells[:, 1:] != cells[:, :-1]).sum()
    return bool(3 * changes >= 2 * data_cells * (data_cells - 1))
