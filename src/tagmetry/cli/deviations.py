"""Numbers with what they are sure of, as people read them: `-200.013 ± 0.082`."""

import math

_LEAST, _MOST = 1, 4  # decimals


def decimals_of(deviation: float) -> int:
    """Return how many decimals show two digits of a standard deviation, 1 to 4."""
    if not (math.isfinite(deviation) and deviation > 0):
        return _LEAST
    return min(max(1 - math.floor(math.log10(deviation)), _LEAST), _MOST)


def with_deviation(value: float, deviation: float, sign: str = "-") -> str:
    """Return a number and its standard deviation, both with the digits that the latter allows.

    Args:
        value: In any unit.
        deviation: In the same.
        sign: As in a format: `+` to show that of positive numbers too.
    """
    decimals = decimals_of(deviation)
    return f"{value:{sign}z.{decimals}f} ± {deviation:.{decimals}f}"
