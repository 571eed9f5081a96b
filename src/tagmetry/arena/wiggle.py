"""The motion that shows a robot's delay best: to and fro at uneven intervals, back in the end."""

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array


def wiggle(
    rng: np.random.Generator, turn_rate_radps: float = 1.5, count: int = 10, shortest_s: float = 0.2
) -> tuple[Array, Array]:
    """Return turn rates and when each begins; the last one is 0.

    The robot turns one way and back by the same angle, `count` times. Uneven intervals leave no
    doubt by how many periods the answer is late.

    Args:
        rng: Draws the intervals, from `shortest_s` to three times that.
        turn_rate_radps: How fast.
        count: How often.
        shortest_s: The shortest interval.

    Returns:
        Times from 0, shape (2 count + 1,), seconds; rates, same shape, rad/s.

    Raises:
        InputError: A number is not positive.
    """
    if not (0 < turn_rate_radps < np.inf and count > 0 and 0 < shortest_s < np.inf):
        raise InputError(
            "expected a turn rate, a count and an interval above 0, got "
            f"{turn_rate_radps} rad/s, {count} and {shortest_s} s"
        )
    lengths_s = np.repeat(rng.uniform(shortest_s, 3 * shortest_s, count), 2)
    signs = np.tile([1.0, -1.0], count) * np.repeat(rng.choice([-1.0, 1.0], count), 2)
    times_s = np.concatenate([[0.0], np.cumsum(lengths_s)])
    return times_s, np.concatenate([turn_rate_radps * signs, [0.0]])
