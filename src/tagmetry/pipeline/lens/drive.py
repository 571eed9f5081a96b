"""A camera whose zoom and focus are driven: commands go out, images come in with their setting."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.camera import ControlledSource, Image, VerifiedControls
from tagmetry.camera.controls import ControlRefusedError, Controls, control_named
from tagmetry.errors import InputError
from tagmetry.lens import Effect, Lag, LensSetting


@dataclass(frozen=True, eq=False)
class Taken:
    """An image and what it was taken at.

    Attributes:
        image: The image.
        setting: In effect for it.
        is_settled: Nothing was under way any more.
    """

    image: Image
    setting: LensSetting
    is_settled: bool


class Drive:
    """Drives one camera.

    Controls are read back after every command. Which setting an image was taken at follows from
    the camera's lag.
    """

    def __init__(self, source: ControlledSource, lag: Lag | None = None) -> None:
        """Begin where the camera stands.

        Args:
            source: The camera; use `sources.controls.by_hand` around, so that its auto modes are
                off, and it is left as it was.
            lag: How late its controls are.

        Raises:
            InputError: It has no zoom or no focus.
        """
        self._controls: Controls = VerifiedControls(source.controls)
        for name in ("zoom", "focus"):
            control_named(self._controls.available, name)
        self._images: Iterator[Image] = iter(source)
        now = LensSetting(self._controls.read("zoom"), self._controls.read("focus"))
        self._effect = Effect.settled(lag or Lag(), now)
        self._last_sequence = -1
        focus = self._controls.available["focus"]
        whole_way = int(np.ceil((focus.most - focus.least) / self.lag.focus_per_image))
        self._held_back = self.lag.images + whole_way  # nobody knows where the motor came from
        self.zoom_is_proven = False  # whether a marker has been seen to grow with the zoom

    @property
    def controls(self) -> Controls:
        """The camera's controls, read back after every command."""
        return self._controls

    @property
    def commanded(self) -> LensSetting:
        """What the camera was told last."""
        return self._effect.commanded

    @property
    def lag(self) -> Lag:
        """How late the camera is."""
        return self._effect.lag

    @property
    def is_nearly_there(self) -> bool:
        """Whether a command now would not cut the present one short."""
        ahead = self._effect
        for _ in range(self.lag.images + 1):
            ahead = ahead.next_image()
        return ahead.is_settled

    def go(self, setting: LensSetting) -> None:
        """Command a setting; returns before images show it."""
        before = self._effect.commanded
        zoom, focus = before.zoom_percent, before.focus
        if setting.zoom_percent != zoom:
            zoom = self._controls.write("zoom", setting.zoom_percent)
        if setting.focus != focus:
            focus = self._controls.write("focus", setting.focus)
        self._effect = self._effect.command(LensSetting(zoom, focus))

    def later(self, images: int) -> None:
        """Learn that commands show so many images later than was thought."""
        lag = replace(self.lag, images=self.lag.images + images)
        self._effect = replace(self._effect, lag=lag)

    def wait(self, images: int) -> None:
        """Trust none of the next images, until older commands have come through."""
        self._held_back = max(self._held_back, images)

    def expose(self, exposure_s: float) -> None:
        """Set the exposure, where the camera lets it be set."""
        if "exposure" not in self._controls.available:
            return
        with suppress(ControlRefusedError):
            self._controls.write("exposure", exposure_s)
            self.wait(self.lag.images + 1)

    def take(self) -> Taken:
        """Return the next image.

        Raises:
            InputError: There are no more.
        """
        image = next(self._images, None)
        if image is None:
            raise InputError("the camera gives no more images")
        for _ in range(max(image.sequence - self._last_sequence, 1)):
            self._effect = self._effect.next_image()
        self._last_sequence = image.sequence
        self._held_back = max(self._held_back - 1, 0)
        settled = self._effect.is_settled and not self._held_back
        return Taken(image, self._effect.setting, settled)
