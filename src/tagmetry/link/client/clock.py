"""The host's time as a robot knows it: never earlier than it is.

A reply says the host's time when it was sent, which is after the question left. So the host's time
is at most that, plus what has passed since the question. The tightest such bound is kept. The age
of a packet and the end of a command, reckoned with it, err to the safe side, whatever delays the
replies.
"""

_DRIFT = 2e-4  # of two crystals, at most


class HostClock:
    """Turns the robot's microseconds into the host's."""

    def __init__(self, robot_us: int, host_us: int, now_us: int) -> None:
        """Begin with one exchange, as `tighten` takes it."""
        self._offset_us = host_us - robot_us
        self._since_us = now_us

    def tighten(self, robot_us: int, host_us: int, now_us: int) -> None:
        """Use one more exchange.

        Args:
            robot_us: When the question left, in the robot's clock.
            host_us: When the host replied, in its own.
            now_us: Now, in the robot's.
        """
        self._offset_us = min(self._bound_us(now_us), host_us - robot_us)
        self._since_us = now_us

    def host_us(self, now_us: int) -> int:
        """Return the host's time at one of the robot's, an upper bound."""
        return now_us + self._bound_us(now_us)

    def _bound_us(self, now_us: int) -> int:
        return self._offset_us + int(_DRIFT * (now_us - self._since_us))
