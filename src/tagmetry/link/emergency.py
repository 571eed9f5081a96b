"""The emergency stop as the host repeats it: latched until it is released."""

from tagmetry.link.messages import EmergencyStop

STOP, RELEASE = 1, 2
_RELEASES = 20


class Emergency:
    """What is to be repeated to every robot, if anything."""

    def __init__(self) -> None:
        self._edition = 0
        self._order = 0
        self._repeats_left = 0

    @property
    def is_latched(self) -> bool:
        """Whether robots must stand still."""
        return self._order == STOP

    def stop(self) -> None:
        """Latch."""
        self._edition += 1
        self._order = STOP

    def release(self) -> None:
        """Let robots move again; also those that an earlier host had stopped."""
        self._edition += 1
        self._order, self._repeats_left = RELEASE, _RELEASES

    def message(self) -> EmergencyStop | None:
        """Return what is to be repeated now."""
        return EmergencyStop(self._edition, self._order) if self._order else None

    def count_down(self) -> None:
        """Count one round of repeating a release."""
        if self._order == RELEASE:
            self._repeats_left -= 1
            self._order = RELEASE if self._repeats_left > 0 else 0
