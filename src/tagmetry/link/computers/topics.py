"""Where an arena's packets stand among those of all computers.

tagmetry/ARENA/hello                    HELLO of a computer that looks on
tagmetry/ARENA/assign                   ASSIGN, the answer to it, and BEAT
tagmetry/ARENA/state                    ARENA, after the poses of one image
tagmetry/ARENA/robots/NAME/pose         STATE
tagmetry/ARENA/robots/NAME/neighbours   NEIGHBOURS that the robot is told
tagmetry/ARENA/robots/NAME/commanded    COMMAND that the robot is sent
tagmetry/ARENA/robots/NAME/command      all that a computer says that commands the robot
tagmetry/ARENA/robots/NAME/answer       all that it is answered
"""

from dataclasses import dataclass

from tagmetry.errors import InputError
from tagmetry.link.layout import Kind

ANY = "*"
_FORBIDDEN = set("/*$?#")
_LONGEST = 100
_ABOUT = {Kind.STATE: "pose", Kind.NEIGHBOURS: "neighbours", Kind.COMMAND: "commanded"}


@dataclass(frozen=True)
class Topics:
    """The topics of one arena.

    Attributes:
        arena: Its name.
    """

    arena: str

    def __post_init__(self) -> None:
        checked_name(self.arena, "arena")

    @property
    def hello(self) -> str:
        """Where computers that look on begin."""
        return f"tagmetry/{self.arena}/hello"

    @property
    def assign(self) -> str:
        """Where they are answered."""
        return f"tagmetry/{self.arena}/assign"

    @property
    def state(self) -> str:
        """Where the end of every image is told."""
        return f"tagmetry/{self.arena}/state"

    def of(self, kind: Kind, robot: str = ANY) -> str:
        """Return where a robot's packets of a kind are told to all."""
        return self._robot(robot, _ABOUT[kind])

    def command(self, robot: str = ANY) -> str:
        """Return where a robot is commanded."""
        return self._robot(robot, "command")

    def answer(self, robot: str = ANY) -> str:
        """Return where those are answered that command it."""
        return self._robot(robot, "answer")

    @property
    def everything(self) -> str:
        """All topics of the arena."""
        return f"tagmetry/{self.arena}/**"

    def _robot(self, robot: str, about: str) -> str:
        return f"tagmetry/{self.arena}/robots/{robot}/{about}"


def is_told(topic: str) -> bool:
    """Say whether a topic tells all of a robot."""
    return topic.rpartition("/")[2] in _ABOUT.values()


def robot_of(topic: str) -> str:
    """Return the robot's name in its topic; empty where it is about no robot."""
    chunks = topic.split("/")
    return chunks[3] if len(chunks) == 5 else ""


def checked_name(name: str, of: str) -> str:
    """Return the name of an arena or a robot.

    Raises:
        InputError: It cannot be a part of a topic.
    """
    is_fine = name.isprintable() and not _FORBIDDEN & set(name) and not name.startswith("@")
    if not 0 < len(name) <= _LONGEST or not is_fine:
        raise InputError(
            f"the {of}'s name {name[:40]!r} cannot be told to other computers: expected 1 to "
            f"{_LONGEST} characters, none of / * $ ? #, and no @ first"
        )
    return name
