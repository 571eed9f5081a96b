"""What pages were told at a moment of a recording, message by message as it was.

A page asks for the moments that it wants to show and keeps its own clock: nothing runs here, and a
page that replays changes nothing for others.
"""

from collections import OrderedDict
from pathlib import Path

from tagmetry.live.messages.wire import joined_picture
from tagmetry.live.rooms.recordings.bare import picture_of_image, world_of_state
from tagmetry.live.show.recording import PICTURE, WORLD
from tagmetry.record.mcap import IMAGES, STATES, Entry, Timeline
from tagmetry.record.mcap.images import picture_of

_LEAD_S = 0.2  # a recording begins a little before what is told first
_KEPT = 3  # recordings whose pieces are known


class Replays:
    """Reads recordings; to be used from one thread at a time."""

    def __init__(self) -> None:
        self._kept: OrderedDict[tuple[Path, int, int], Timeline] = OrderedDict()

    def length_s(self, path: Path) -> float:
        """Return how long a recording is.

        Raises:
            InputError: It cannot be read, or nothing is in it.
        """
        return self._timeline(path).length_s

    def world(self, path: Path, at_s: float) -> bytes | None:
        """Return where all robots were, a `World` as it was told; None where nothing was.

        Raises:
            InputError: The recording cannot be read, or its state is none.
        """
        timeline = self._timeline(path)
        told = _newest(timeline, WORLD, at_s)
        if told is not None:
            return told.content
        state = _newest(timeline, STATES, at_s)
        return None if state is None else world_of_state(state.content)

    def picture(self, path: Path, at_s: float) -> bytes | None:
        """Return what the camera saw, a `Picture` as it was told; None where it saw nothing.

        Raises:
            InputError: The recording cannot be read, or its image is none.
        """
        timeline = self._timeline(path)
        if any(_newest(timeline, topic, at_s) for topic in (WORLD, PICTURE)):
            return _told_picture(timeline, at_s)
        image = _newest(timeline, IMAGES, at_s)
        return None if image is None else picture_of_image(image.content)

    def _timeline(self, path: Path) -> Timeline:
        status = path.stat()
        key = path, status.st_size, status.st_mtime_ns
        if key not in self._kept:
            self._kept[key] = Timeline(path)
            if len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        return self._kept[key]


def _newest(timeline: Timeline, topic: str, at_s: float) -> Entry | None:
    return timeline.newest(topic, at_s) or timeline.newest(topic, _LEAD_S)


def _told_picture(timeline: Timeline, at_s: float) -> bytes | None:
    """Return a picture with the markers that pages were told of; both were recorded apart."""
    head = timeline.newest(PICTURE, at_s)
    image = None if head is None else timeline.newest(IMAGES, timeline.seconds(head))
    if head is None or image is None or head.stamped_ns != image.stamped_ns:
        return None
    _, _, content = picture_of(image.content)
    return joined_picture(head.content, content)
