"""A place of the board in words, for a person who holds it."""

from tagmetry.calibrate.quality.places import Place

_ACROSS = ("left", "", "right")
_DOWN = ("upper", "", "lower")
_SIDES = ("right", "bottom", "left", "top")
_SAME_DISTANCE = 0.1


def describe(place: Place, size_px: tuple[int, int], last_distance_m: float | None = None) -> str:
    """Return what to do: where in the picture, which tilt, how far.

    Args:
        place: Where the board is to be.
        size_px: (width, height) of the picture.
        last_distance_m: Where it is now; None leaves out nearer or farther.
    """
    return (
        f"hold the board {where(place.pixel, size_px)} of the picture, "
        f"{tilted(place)}, {distance(place.distance_m, last_distance_m)}"
    )


def where(pixel: tuple[float, float], size_px: tuple[int, int]) -> str:
    """Return in which of the nine parts of a picture a pixel lies."""
    column = min(int(3 * (pixel[0] + 0.5) / size_px[0]), 2)
    row = min(int(3 * (pixel[1] + 0.5) / size_px[1]), 2)
    if (column, row) == (1, 1):
        return "in the middle"
    if column == 1:
        return f"at the {'top' if row == 0 else 'bottom'}"
    return f"at the {_DOWN[row]} {_ACROSS[column]}".replace("  ", " ")


def tilted(place: Place) -> str:
    """Return how a board is tilted."""
    if place.tilt_deg < 5:
        return "facing the camera"
    side = _SIDES[round(place.direction_deg / 90) % 4]
    return f"its face turned {place.tilt_deg:.0f} degrees to the {side}"


def distance(distance_m: float, last_m: float | None) -> str:
    """Return how far, and whether that is nearer than it is now."""
    text = f"{distance_m:.2f} m away"
    if last_m is None or abs(distance_m / last_m - 1) < _SAME_DISTANCE:
        return text
    return f"{'nearer' if distance_m < last_m else 'farther'}, {text}"
