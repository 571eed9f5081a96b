"""Other computers in an arena's file: where they meet it, and with which keys."""

from dataclasses import dataclass

from tagmetry.errors import InputError
from tagmetry.files.arena.robots import key_of
from tagmetry.files.arena.tables import ZenohTable
from tagmetry.files.text import named_errors


@dataclass(frozen=True)
class ZenohSetup:
    """How other computers reach an arena over Zenoh.

    Attributes:
        listen: The arena's own endpoint, such as tcp/192.168.1.5:7447; None where it has none.
        connect: A router's; None where there is none.
        view_key: Of those who look on; None where all may, and none can tell a forgery.
        command_key: Of those who command robots; None where nobody does.
    """

    listen: str | None = None
    connect: str | None = None
    view_key: bytes | None = None
    command_key: bytes | None = None


def zenoh_of(table: ZenohTable | None) -> ZenohSetup | None:
    """Return what the file says of other computers; None where it says nothing."""
    if table is None:
        return None
    if table.listen is None and table.connect is None:
        raise InputError("zenoh: expected listen: tcp/192.168.1.5:7447, or connect: with a router")
    with named_errors("zenoh.view_key"):
        view_key = key_of(table.view_key)
    with named_errors("zenoh.command_key"):
        command_key = key_of(table.command_key)
    if command_key is not None and command_key == view_key:
        raise InputError("zenoh: view_key and command_key are the same; make two with arena key")
    return ZenohSetup(table.listen, table.connect, view_key, command_key)
