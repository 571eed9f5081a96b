"""When new markers are searched for: as seldom as the time to acquire them allows.

An image is searched in n parts, one after the other. Whatever appears just after its part was
looked at waits for n searches more, so these are (acquire_s - since_s) / n apart, where since_s is
the time from image to image: a search waits for the next image at most that long.
"""

from dataclasses import dataclass
from typing import Self


@dataclass(frozen=True)
class Rota:
    """How far the search has come.

    Attributes:
        turn: How many parts were searched.
        due_s: When the next one is.
    """

    turn: int
    due_s: float

    @classmethod
    def begun(cls, time_s: float) -> Self:
        """Return that of an image that is looked at whole."""
        return cls(0, time_s)

    def after(self, time_s: float, since_s: float, acquire_s: float, parts: int) -> Self:
        """Return the rota after an image whose search was due.

        Args:
            time_s: Time of the image.
            since_s: Time since the one before.
            acquire_s: In what time all parts shall be searched.
            parts: How many there are.
        """
        apart_s = max(acquire_s - since_s, 0.0) / parts
        behind = self.due_s + apart_s <= time_s - since_s
        return type(self)(self.turn + 1, (time_s if behind else self.due_s) + apart_s)
