"""Topics name what they are about, and only names that can be topics are taken."""

import pytest

from tagmetry.errors import InputError
from tagmetry.link.computers.topics import Topics, checked_name, is_told, robot_of
from tagmetry.link.layout import Kind


def test_topics_are_those_of_the_page() -> None:
    lab = Topics("lab")
    assert lab.of(Kind.STATE, "ada") == "tagmetry/lab/robots/ada/pose"
    assert lab.command("ada") == "tagmetry/lab/robots/ada/command"
    assert robot_of(lab.answer("robot 3")) == "robot 3"
    assert robot_of(lab.assign) == robot_of(lab.state) == ""
    told = [lab.of(kind, "ada") for kind in (Kind.STATE, Kind.NEIGHBOURS, Kind.COMMAND)]
    assert [topic.rpartition("/")[2] for topic in told] == ["pose", "neighbours", "commanded"]
    assert all(map(is_told, told))
    others = (lab.assign, lab.state, lab.hello, lab.command("ada"), lab.answer("ada"))
    assert not any(map(is_told, others))


@pytest.mark.parametrize("name", ["", "a/b", "*", "a$b", "a?", "#1", "@a", "a\nb", 101 * "a"])
def test_names_that_are_no_part_of_a_topic_are_refused(name: str) -> None:
    with pytest.raises(InputError, match="cannot be told to other computers: expected 1 to 100"):
        checked_name(name, "robot")
    with pytest.raises(InputError, match="the arena's name"):
        Topics(name)


def test_other_names_are_taken() -> None:
    for name in ("ada", "robot 3", "Müller-Lüdenscheidt", "3"):
        assert checked_name(name, "robot") == name
