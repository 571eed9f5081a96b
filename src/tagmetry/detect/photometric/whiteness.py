"""How white the blurred picture is at every pixel of a block, and the derivatives.

In units of cells the printed picture is a sum of steps at the corners of its cells,

    white(u, v) = sum over i, j of change[j, i] * Phi((u - i) / blur_u) * Phi((v - j) / blur_v),

of which a pixel sees the few within its window; what lies before the window stands in its first row
and column, where both Phi are 1. Where the view is oblique the blur is correlated between u and v;
this bends what happens where edges cross, and is followed to the second order (Mehler's series).
"""

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.elementary import step_and_bell
from tagmetry.detect.photometric.kernel import Narrow, f32, kernel

_BELL, _BEND = row.BELL_U - row.STEP_U, row.BEND_U - row.STEP_U  # the same for v
_SIGHT = f32(6.0)  # blurs; edges farther away are as good as infinitely far


@kernel
def write_whiteness(room: Narrow, edges: int) -> None:
    """Write how white pixels are, and its slopes per blur."""
    for k in range(edges):
        after = (k + 1) * row.BLOCK
        _write_steps(
            room[row.U :], room[row.FIRST_U :], k, room[row.SHARP_U :], room[row.STEP_U + after :]
        )
        _write_steps(
            room[row.V :], room[row.FIRST_V :], k, room[row.SHARP_V :], room[row.STEP_V + after :]
        )
    _clear(room)
    change = row.CHANGES
    for j in range(edges + 1):
        for i in range(edges + 1):
            steps_u, steps_v = (
                room[row.STEP_U + i * row.BLOCK :],
                room[row.STEP_V + j * row.BLOCK :],
            )
            _add_corner(room, room[change:], steps_u, steps_v)
            change += row.BLOCK


@kernel
def _write_steps(at: Narrow, first: Narrow, edge: int, sharp: Narrow, steps: Narrow) -> None:
    """Write the step across one edge, its slope and its bend."""
    for p in range(row.BLOCK):
        z = (at[p] - first[p] - f32(edge)) * sharp[p]
        z = min(max(z, -_SIGHT), _SIGHT)
        step, bell = step_and_bell(z)
        steps[p], steps[_BELL + p], steps[_BEND + p] = step, bell, z * bell


@kernel
def _clear(room: Narrow) -> None:
    for p in range(row.BLOCK):
        room[row.WHITE + p] = 0.0
        room[row.BY_U + p], room[row.BY_V + p] = 0.0, 0.0
        room[row.BY_BLUR_U + p], room[row.BY_BLUR_V + p] = 0.0, 0.0
        room[row.BY_CORRELATION + p] = 0.0


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
