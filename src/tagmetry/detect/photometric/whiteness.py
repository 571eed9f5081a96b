"""How white the blurred picture is at every pixel of a block, and the derivatives.

In units of cells the printed picture is a sum of steps at the corners of its cells,

    white(u, v) = sum over i, j of change[j, i] * step((u - i) / blur_u) * step((v - j) / blur_v),
    step(z) = Phi(z) + square * (z^3 - 3 z) * phi(z),

where the pixel's own square in the blur counts with its fourth moment too (square; 0 for a bell).
Of these a pixel sees the few within its window; what lies before the window stands in its first row
and column, where the step is 1: there an edge comes from afar, and passes all that is in sight.
Where the view is oblique the blur is correlated between u and v; this bends what happens where
edges cross, and is followed to the second order (Mehler's series).
"""

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.elementary import step_and_bell
from tagmetry.detect.photometric.kernel import Narrow, f32, kernel

_BELL, _BEND = row.BELL_U - row.STEP_U, row.BEND_U - row.STEP_U  # the same for v
_BY_BLUR = row.BY_BLUR_U - row.BY_U  # the same for v
_B = row.BLOCK
_SIGHT = f32(6.0)  # blurs; edges farther away are as good as infinitely far


@kernel
def write_whiteness(room: Narrow, edges: int) -> None:
    """Write how white pixels are, and its slopes per blur."""
    if edges == 1:
        _write_one_corner(room)
        return
    for k in range(edges):
        after = (k + 1) * row.BLOCK
        _write_steps(
            room[row.U :], room[row.FIRST_U :], k, room[row.SHARP_U :], room[row.STEP_U + after :]
        )
        _write_steps(
            room[row.V :], room[row.FIRST_V :], k, room[row.SHARP_V :], room[row.STEP_V + after :]
        )
    _begin(room)
    for j in range(edges + 1):
        for i in range(edges + 1):
            changes = room[row.CHANGES + (i + (edges + 1) * j) * row.BLOCK :]
            steps_u, steps_v = (
                room[row.STEP_U + i * row.BLOCK :],
                room[row.STEP_V + j * row.BLOCK :],
            )
            if i > 0 and j > 0:
                _add_corner(room, changes, steps_u, steps_v)
            elif i > 0:
                _add_edge(room[row.WHITE :], room[row.BY_U :], changes, steps_u)
            elif j > 0:
                _add_edge(room[row.WHITE :], room[row.BY_V :], changes, steps_v)


@kernel
def _write_one_corner(room: Narrow) -> None:
    """Write the same where each pixel sees a single corner, and the two edges through it."""
    for p in range(row.BLOCK):
        step_u, bell_u, bend_u = _step(
            room[row.U + p] - room[row.FIRST_U + p], room[row.SHARP_U + p], room[row.SQUARE_U + p]
        )
        step_v, bell_v, bend_v = _step(
            room[row.V + p] - room[row.FIRST_V + p], room[row.SHARP_V + p], room[row.SQUARE_V + p]
        )
        change_u, change_v = room[row.CHANGES + _B + p], room[row.CHANGES + 2 * _B + p]
        change, correlation = room[row.CHANGES + 3 * _B + p], room[row.CORRELATION + p]
        along_u, along_v = change_u + change * step_v, change_v + change * step_u
        meet, twist = change * bell_u * bell_v, change * correlation * bend_u * bend_v
        white = room[row.CHANGES + p] + change_v * step_v + along_u * step_u
        room[row.WHITE + p] = white + correlation * (meet + f32(0.5) * twist)
        room[row.BY_U + p], room[row.BY_V + p] = along_u * bell_u, along_v * bell_v
        room[row.BY_BLUR_U + p], room[row.BY_BLUR_V + p] = -along_u * bend_u, -along_v * bend_v
        room[row.BY_CORRELATION + p] = meet + twist


@kernel
def _step(past: f32, sharp: f32, square: f32) -> tuple[f32, f32, f32]:
    """Return the step across an edge so many cells ago, its slope and its bend, per blur.

    The step follows how square the blur is (Edgeworth's series); slope and bend, which only lead
    there, are those of a bell.
    """
    z = min(max(past * sharp, -_SIGHT), _SIGHT)
    step, bell = step_and_bell(z)
    bend = z * bell
    return step + square * (z * z - f32(3)) * bend, bell, bend


@kernel
def _write_steps(at: Narrow, first: Narrow, edge: int, sharp: Narrow, steps: Narrow) -> None:
    """Write the step across one edge, its slope and its bend."""
    square = sharp[row.SQUARE_U - row.SHARP_U :]  # the same for v
    for p in range(row.BLOCK):
        steps[p], steps[_BELL + p], steps[_BEND + p] = _step(
            at[p] - first[p] - f32(edge), sharp[p], square[p]
        )


@kernel
def _begin(room: Narrow) -> None:
    """Write the first cell in sight of every pixel: it is white or not all over."""
    for p in range(row.BLOCK):
        room[row.WHITE + p] = room[row.CHANGES + p]
        room[row.BY_U + p], room[row.BY_V + p] = 0.0, 0.0
        room[row.BY_BLUR_U + p], room[row.BY_BLUR_V + p] = 0.0, 0.0
        room[row.BY_CORRELATION + p] = 0.0


@kernel
def _add_edge(white: Narrow, by: Narrow, changes: Narrow, steps: Narrow) -> None:
    """Add what an edge that passes all that is in sight contributes."""
    for p in range(row.BLOCK):
        change = changes[p]
        white[p] += change * steps[p]
        by[p] += change * steps[_BELL + p]
        by[_BY_BLUR + p] -= change * steps[_BEND + p]


@kernel
def _add_corner(room: Narrow, changes: Narrow, steps_u: Narrow, steps_v: Narrow) -> None:
    """Add what one corner of cells contributes."""
    for p in range(row.BLOCK):
        correlation, change = room[row.CORRELATION + p], changes[p]
        step_u, bell_u, bend_u = steps_u[p], steps_u[_BELL + p], steps_u[_BEND + p]
        step_v, bell_v = change * steps_v[p], change * steps_v[_BELL + p]
        bend_v = change * steps_v[_BEND + p]
        twist = correlation * bend_u * bend_v
        room[row.WHITE + p] += step_u * step_v + correlation * (bell_u * bell_v + f32(0.5) * twist)
        room[row.BY_U + p] += bell_u * step_v
        room[row.BY_V + p] += step_u * bell_v
        room[row.BY_BLUR_U + p] -= bend_u * step_v
        room[row.BY_BLUR_V + p] -= step_u * bend_v
        room[row.BY_CORRELATION + p] += bell_u * bell_v + twist
