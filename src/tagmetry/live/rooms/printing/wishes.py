"""What a page wishes to print: its text fields, each read and bounded in one place."""

from collections.abc import Mapping
from dataclasses import dataclass

from tagmetry.errors import InputError
from tagmetry.files.lengths import parse_length_m
from tagmetry.files.sheets import PageSetup, parse_orientation, parse_paper

MOST_PLACES = 1500  # markers or squares: a second or two of one processor
_LONGEST_TEXT, _MOST_COUNT, _MOST_CELLS = 200, 100, 20


@dataclass(frozen=True)
class Wishes:
    """The fields of a form, as text.

    Attributes:
        texts: By the fields' names.
    """

    texts: Mapping[str, str]

    def text(self, name: str) -> str:
        """Return a field.

        Raises:
            InputError: It is missing, or too long.
        """
        text = self.texts.get(name, "").strip()
        if not 0 < len(text) <= _LONGEST_TEXT:
            raise InputError(
                f"{_spoken(name)}: expected 1 to {_LONGEST_TEXT} characters, got {len(text)}"
            )
        return text

    def length_m(self, name: str) -> float:
        """Return a length: metres, or with a unit.

        Raises:
            InputError: It is none.
        """
        try:
            return parse_length_m(self.text(name))
        except InputError as error:
            raise InputError(f"{_spoken(name)}: {error}") from None

    def count(self, name: str, most: int = _MOST_COUNT, least: int = 1) -> int:
        """Return a whole number within its bounds.

        Raises:
            InputError: It is none, or beyond them.
        """
        text = self.text(name)
        number = int(text) if text.isascii() and text.isdigit() and len(text) < 10 else least - 1
        if not least <= number <= most:
            raise InputError(
                f"{_spoken(name)}: expected a whole number from {least} to {most}, "
                f"found {text[:20]!r}"
            )
        return number

    def setup(self) -> PageSetup:
        """Return paper, margins and so on.

        Raises:
            InputError: One of them cannot be used.
        """
        return PageSetup(
            parse_paper(self.text("paper")),
            parse_orientation(self.text("orientation")),
            self.length_m("margin"),
            self.count("quiet", _MOST_CELLS),
        )


def _spoken(name: str) -> str:
    return name.replace("_", " ")
