"""A block of pixels, laid out so that compilers make vector code of the loops over it.

Everything that is known of the pixels of a block stands in one flat array, the room: row after row,
one number of 32 bits per pixel. Rows begin at constants, `room[U + p]` is the u of pixel p. With
constant distances and no branch, eight pixels or more are computed at once.
"""

import numpy as np

from tagmetry.detect.photometric.kernel import Narrow, kernel

BLOCK = 64  # pixels
LANES = 4 * BLOCK  # equations that are summed at once: adding up lanes takes time, too
MOST_EDGES = 5  # of one direction, within reach of a pixel
_WINDOW = MOST_EDGES + 1
MOST_NUMBERS = 27  # that are fitted, and the residual; three by three


def _rows(first: int, *counts: int) -> tuple[int, ...]:
    """Return where rows begin, after `first`, each so many blocks long, and the end."""
    return tuple(BLOCK * (first // BLOCK + sum(counts[:k])) for k in range(len(counts) + 1))


# As read: place, grey value, whether it counts, first edge in sight, changes of ink around.
X, Y, SEEN, COUNTS, FIRST_U, FIRST_V, CHANGES, READ = _rows(0, *6 * [1], _WINDOW**2)

# Where it lies: place without bows, cells, their slopes, 1 / denominator, blur in cells, and how
# square that is.
BENT_X, BENT_Y, U, V, UX, UY, VX, VY, DOWN, _PLACED = _rows(READ, *9 * [1])
SHARP_U, SHARP_V, SQUARE_U, SQUARE_V, CORNER, MEETING, _SEEN = _rows(_PLACED, *6 * [1])

# Steps across the edges in sight, their slopes and bends; the first is no edge: 1, 0, 0.
STEP_U, BELL_U, BEND_U, STEP_V, BELL_V, BEND_V, _STEPS = _rows(_SEEN, *6 * [_WINDOW])

# Whiteness and its derivatives; the blurs' correlation stands beside what it is added up with.
CORRELATION, WHITE, BY_U, BY_V, BY_BLUR_U, BY_BLUR_V, BY_CORRELATION, _WHITE = _rows(
    _STEPS, *7 * [1]
)

# Sizes of residuals, derivatives by the whiteness.
SIZE, BY_WHITE, EQUATIONS = _rows(_WHITE, 1, 1)

# Equations of pixels: the residual and its derivatives by the numbers, times the weight's root.
# They follow in the same memory: to a processor, places whole pages apart look like the same, and
# a row that is written must not look as if it began just before one that is read.
RESIDUAL, J = 0, LANES
ROOM = EQUATIONS + MOST_NUMBERS * LANES


@kernel
def new_pixels(blocks: int) -> Narrow:
    """Return room for what is read of so many blocks, shape (blocks, READ)."""
    return np.empty((blocks, READ), dtype=np.float32)


@kernel
def new_room() -> Narrow:
    """Return room for one block, and for the equations of some."""
    room = np.zeros(ROOM, dtype=np.float32)
    room[STEP_U : STEP_U + BLOCK] = 1.0
    room[STEP_V : STEP_V + BLOCK] = 1.0
    return room
