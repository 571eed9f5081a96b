"""The room where runs are recorded, fetched, deleted, and looked at once more."""

from tagmetry.live.rooms.recordings.room import recordings_room

__all__ = ["recordings_room"]
