"""The room where markers, boards and sheets are printed."""

from tagmetry.live.rooms.printing.room import printing_room

__all__ = ["printing_room"]
