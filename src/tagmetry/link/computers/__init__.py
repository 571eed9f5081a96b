"""Other computers: they see what an arena sees, and command its robots with a key; over Zenoh."""

from tagmetry.link.computers.bridge import ArenaBridge
from tagmetry.link.computers.commander import Commander
from tagmetry.link.computers.sight import ArenaSight, state_message
from tagmetry.link.computers.view import ArenaView

__all__ = ["ArenaBridge", "ArenaSight", "ArenaView", "Commander", "state_message"]
