"""A setting of a camera as it is typed: `focus=35,zoom=200,size=1920x1080`."""

from dataclasses import dataclass

from tagmetry.cli.pixels import whole_numbers
from tagmetry.errors import InputError

EXAMPLE = "focus=35,zoom=200,size=1920x1080"


@dataclass(frozen=True)
class Setting:
    """Focus, and zoom and image size where they were given."""

    focus: float
    zoom: float | None = None
    size_px: tuple[int, int] | None = None


def parse_setting(text: str) -> Setting:
    """Return the setting of a text; all but the focus may be missing."""
    found: dict[str, str] = {}
    for part in text.split(","):
        key, _, value = part.strip().partition("=")
        if key not in ("focus", "zoom", "size") or key in found:
            raise InputError(f"expected a setting like {EXAMPLE}, found {text[:40]!r}")
        found[key] = value
    if "focus" not in found:
        raise InputError(f"expected a setting with its focus, like {EXAMPLE}, found {text[:40]!r}")
    zoom = _number("zoom", found["zoom"]) if "zoom" in found else None
    return Setting(_number("focus", found["focus"]), zoom, _size_px(found.get("size")))


def _number(key: str, text: str) -> float:
    try:
        return float(text)
    except ValueError as error:
        raise InputError(f"{key}: expected a number, found {text[:40]!r}") from error


def _size_px(text: str | None) -> tuple[int, int] | None:
    if text is None:
        return None
    width_px, height_px = whole_numbers(text, "1920x1080", r"(\d+)x(\d+)")
    return width_px, height_px
