"""Image sizes that a format writes as fractions."""

from tagmetry.errors import InputError


def whole_pixels(field: str, number: float) -> int:
    """Return a number of pixels; an error names its field."""
    if not float(number).is_integer():
        raise InputError(f"{field}: expected a whole number of pixels, found {number}")
    return int(number)
