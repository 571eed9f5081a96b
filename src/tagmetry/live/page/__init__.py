"""The page's files, as they lie in the package; nothing else is ever served."""

from dataclasses import dataclass
from importlib.resources import files


@dataclass(frozen=True)
class Part:
    """One file of the page.

    Attributes:
        content: As it is sent.
        kind: Its media type.
    """

    content: bytes
    kind: str


_KINDS = {".html": "text/html", ".js": "text/javascript", ".css": "text/css"}
_NAMES = (
    "app.js",
    "arena/camera.js",
    "arena/chart.js",
    "arena/ghosts.js",
    "arena/history.js",
    "arena/layers.js",
    "arena/map.js",
    "arena/parameters.js",
    "arena/path_plan.js",
    "arena/robot_charts.js",
    "arena/table.js",
    "calibrate/charts.js",
    "calibrate/view.js",
    "canvas.js",
    "door.js",
    "lens/charts.js",
    "link.js",
    "locate/map.js",
    "make.js",
    "news.js",
    "notice.js",
    "recordings/player.js",
    "rooms.js",
    "rooms/arena.js",
    "rooms/calibrate.js",
    "rooms/health.js",
    "rooms/lens.js",
    "rooms/locate.js",
    "rooms/print.js",
    "rooms/recordings.js",
    "spark.js",
    "stop.js",
    "style.css",
)


def _part(name: str) -> Part:
    kind = _KINDS[name[name.rindex(".") :]]
    return Part(files(__name__).joinpath(name).read_bytes(), kind)


PARTS: dict[str, Part] = {  # by path
    "/": _part("index.html"),
    **{f"/{name}": _part(name) for name in _NAMES},
}
