"""How late a camera's controls are: which setting was in effect when an image was taken.

An image that was taken before a command took effect is stale, and so is one that was taken while
the focus motor moved. How many images that takes is a property of the camera, kept with its lens;
the images themselves contradict one that is too short (`pipeline.lens.evidence`).
"""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.errors import InputError
from tagmetry.lens.setting import LensSetting


@dataclass(frozen=True)
class Lag:
    """The lateness of zoom and focus.

    Attributes:
        images: How many images after a command are as if it had not been given.
        focus_per_image: How far the focus motor moves from one image to the next.
    """

    images: int = 1
    focus_per_image: float = 30.0

    def __post_init__(self) -> None:
        if self.images < 0 or not self.focus_per_image > 0:
            raise InputError(
                f"a lag is 0 images or more and a positive speed, got {self.images} and "
                f"{self.focus_per_image}"
            )


@dataclass(frozen=True)
class Effect:
    """What is in effect while commands are under way.

    Attributes:
        lag: The camera's.
        setting: In effect for the newest image.
        heading: What it moves to.
        waiting: Commands that show nothing yet, each with the images until it does.
    """

    lag: Lag
    setting: LensSetting
    heading: LensSetting
    waiting: tuple[tuple[int, LensSetting], ...] = ()

    @classmethod
    def settled(cls, lag: Lag, setting: LensSetting) -> "Effect":
        """Return a camera at rest."""
        return cls(lag, setting, setting)

    @property
    def commanded(self) -> LensSetting:
        """What it was told last."""
        return self.waiting[-1][1] if self.waiting else self.heading

    @property
    def is_settled(self) -> bool:
        """Whether the newest image was taken at the commanded setting."""
        return self.setting == self.commanded

    def command(self, setting: LensSetting) -> "Effect":
        """Return what is in effect after a command: nothing new yet."""
        if setting == self.commanded:
            return self
        return replace(self, waiting=(*self.waiting, (self.lag.images, setting)))

    def next_image(self) -> "Effect":
        """Return what is in effect for the next image.

        A motor that has just begun gets half as far: it started between two images.
        """
        due = [one for left, one in self.waiting if left == 0]
        heading = due[-1] if due else self.heading
        most = self.lag.focus_per_image / (2 if due else 1)
        step = float(np.clip(heading.focus - self.setting.focus, -most, most))
        now = LensSetting(heading.zoom_percent, self.setting.focus + step)
        waiting = tuple((left - 1, one) for left, one in self.waiting if left > 0)
        return Effect(self.lag, now, heading, waiting)
