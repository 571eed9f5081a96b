"""How long the steps of one image took: where the time from image to packet goes."""

from dataclasses import dataclass


@dataclass(frozen=True)
class StageTimes:
    """Durations of one image's steps, by the clock.

    Attributes:
        detect_s: Its markers were found and measured.
        follow_s: Robots were placed and their tracks updated, and the camera checked for bumps.
        tell_s: What every robot may know was worked out.
        drive_s: Who has to stop was decided, and controllers were asked.
    """

    detect_s: float = 0.0
    follow_s: float = 0.0
    tell_s: float = 0.0
    drive_s: float = 0.0

    @property
    def total_s(self) -> float:
        """All of them together."""
        return self.detect_s + self.follow_s + self.tell_s + self.drive_s


NOT_TIMED = StageTimes()
