"""What seed 004 says of its figures in words; it prints no number of them."""

from functools import lru_cache
from importlib.resources import files

from tagmetry.files.checked import FileModel, checked
from tagmetry.files.tables import parse_table


class RobotStatement(FileModel):
    """What the text says of a figure.

    Attributes:
        figure: Which.
        words: The text.
    """

    figure: int
    words: str


class Seed004(FileModel):
    """All that is compared with.

    Attributes:
        source: The paper.
        statements: About figures 7 to 13.
        remarks: Where it slips or is silent, and what is taken here.
    """

    source: str
    statements: list[RobotStatement]
    remarks: list[str]

    def words(self, figure: int) -> list[str]:
        """Return what is said of a figure."""
        return [one.words for one in self.statements if one.figure == figure]


@lru_cache
def seed004() -> Seed004:
    """Return what the paper says."""
    text = (files("tagmetry.lab.published") / "seed004.yaml").read_text("utf-8")
    return checked(Seed004, parse_table(text))
