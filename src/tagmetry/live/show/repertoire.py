"""What can be chosen on the page: ready-made scenarios, and users' controllers by their files.

The files are those that the person who starts the server names; a page only chooses among them.
Each is read anew when it is begun, so that an edited one takes effect.
"""

from collections.abc import Sequence
from pathlib import Path

from tagmetry.errors import InputError
from tagmetry.pipeline.arena.controller_file import load_controllers
from tagmetry.pipeline.arena_twin import Scenario
from tagmetry.pipeline.arena_twin.ready import READY, driven_scenario, ready_scenario


class Repertoire:
    """Scenarios by name."""

    def __init__(self, controllers: Sequence[Path] = ()) -> None:
        """Take files with controllers.

        Raises:
            InputError: One has no controller, or two have the same name.
        """
        self._files = {path.name: path for path in controllers}
        if len(self._files) < len(controllers):
            raise InputError("two controllers' files have the same name; rename one of them")
        for path in controllers:
            load_controllers(path)

    @property
    def names(self) -> tuple[str, ...]:
        """What can be chosen: ready-made scenarios, then files."""
        return (*READY, *self._files)

    def scenario(self, name: str, robots: int) -> Scenario:
        """Return a scenario that can begin.

        Args:
            name: One of the names.
            robots: How many; with a user's controllers they stand all over the floor.

        Raises:
            InputError: There is no such scenario, not for so many robots, or its file is broken.
        """
        if name in self._files:
            return driven_scenario(load_controllers(self._files[name]), robots)
        if name not in READY:
            raise InputError(f"there is no scenario {name!r}; there are {', '.join(self.names)}")
        return ready_scenario(name, robots)
