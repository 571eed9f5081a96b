"""What can be chosen on the page: scenarios, and files of users, checked before anything runs."""

from pathlib import Path

import pytest

from tagmetry.arena.controllers import View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.errors import InputError
from tagmetry.live.show.repertoire import Repertoire

CONTROLLER = """
from tagmetry.arena.drive import Twist

def control(view):
    return Twist(0.0, {turn})
"""


def test_a_users_file_can_be_chosen_and_is_read_anew(tmp_path: Path) -> None:
    file = tmp_path / "spin.py"
    file.write_text(CONTROLLER.format(turn=1.0))
    repertoire = Repertoire([file])
    assert repertoire.names[-1] == "spin.py"
    for turn in (1.0, 2.0):
        file.write_text(CONTROLLER.format(turn=turn))
        make = repertoire.scenario("spin.py", 3).robots[2].controller
        assert make is not None
        assert make()(View(2, 0.0, STILL)) == Twist(0.0, turn)


def test_a_users_file_is_checked_before_anything_runs(tmp_path: Path) -> None:
    broken, empty = tmp_path / "broken.py", tmp_path / "empty.py"
    broken.write_text("1 / 0")
    empty.write_text("")
    with pytest.raises(InputError, match="raised ZeroDivisionError"):
        Repertoire([broken])
    with pytest.raises(InputError, match="neither a function"):
        Repertoire([empty])
    with pytest.raises(InputError, match="expected a Python file"):
        Repertoire([tmp_path / "none.py"])


def test_two_files_have_two_names(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    files = [tmp_path / "spin.py", tmp_path / "a" / "spin.py"]
    with pytest.raises(InputError, match="the same name"):
        Repertoire(files)


@pytest.mark.parametrize("name", ["../spin.py", "/etc/passwd", "spin.py", ""])
def test_a_page_names_no_other_file(name: str) -> None:
    with pytest.raises(InputError, match="there is no scenario"):
        Repertoire().scenario(name, 2)
