"""The parcels that there are, made and read in one place.

arena -> server: BEGIN once, then NEWS (a message for all pages) and REFUSAL (for one page)
server -> arena: ASKED and LEFT of a page, VIEWERS when their number changed
"""

from dataclasses import asdict, dataclass
from pathlib import Path

from tagmetry.live.beside.parcels import Parcel
from tagmetry.live.messages import Told
from tagmetry.live.messages.wire import packed
from tagmetry.live.rooms.every import Furniture

BEGIN, NEWS, REFUSAL = "begin", "news", "refusal"
ASKED, LEFT, VIEWERS = "asked", "left", "viewers"


@dataclass(frozen=True)
class Begin:
    """What the server's program is told first.

    Attributes:
        address: To listen at.
        port: To listen at.
        token: That makes an operator of a viewer; a secret.
        scenarios: That can be chosen.
        recordings: Folder for what is recorded.
        furniture: What the rooms work with.
    """

    address: str
    port: int
    token: str
    scenarios: tuple[str, ...]
    recordings: Path
    furniture: Furniture


def begin_parcel(begin: Begin) -> Parcel:
    """Return what says it."""
    return Parcel(BEGIN, asdict(begin))


def begin_of(parcel: Parcel) -> Begin:
    """Return what a parcel says."""
    values = dict(parcel.values)
    furniture = {name: kind(values["furniture"][name]) for name, kind in _FURNITURE.items()}
    values["furniture"] = Furniture(**furniture)
    values["scenarios"] = tuple(values["scenarios"])
    values["recordings"] = Path(values["recordings"])
    return Begin(**values)


def news_parcel(message: Told, recording: str | None) -> Parcel:
    """Return a message for all pages.

    Args:
        message: For all pages.
        recording: Name of the file that is being written.
    """
    frame = packed(message)
    is_text = isinstance(frame, str)
    load = frame.encode() if isinstance(frame, str) else frame
    values = {"name": type(message).__name__, "is_text": is_text, "recording": recording}
    return Parcel(NEWS, values, load)


_FURNITURE = {"camera": str, "cameras": Path, "maps": Path}
