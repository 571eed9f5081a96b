"""What the loop from a leader's motion to its follower's wheels is made of."""

from dataclasses import dataclass, field

from tagmetry.arena.controllers import Spring
from tagmetry.errors import InputError

_BOUNDS = {
    "delay_s": (0.0, 2.0),
    "untold_s": (0.0, 2.0),
    "image_s": (4e-3, 1.0),
    "motor_s": (1e-3, 1.0),
    "told_motor_s": (1e-3, 1.0),
    "place_share": (1e-3, 1.0),
    "motion_share": (1e-3, 1.0),
    "speed_mps": (1e-3, 10.0),
}


@dataclass(frozen=True)
class FollowingSetting:
    """A follower, its leader's speed, and how late everything is.

    Attributes:
        spring: What ties it to its leader.
        delay_s: From the middle of an exposure until the command acts that it led to, as the
            controller is told; so much it makes up for.
        untold_s: What the true delay is longer.
        image_s: From image to image.
        motor_s: Time constant of its wheels.
        hold_s: Of their servo's integral against drag; None where it has none.
        told_motor_s: What the controller takes it for.
        place_share: Of a sighting's surprise that goes to the leader's place, alpha.
        motion_share: That goes to the leader's speed and turn rate, beta.
        speed_mps: Of the leader.
    """

    spring: Spring = field(default_factory=Spring)
    delay_s: float = 0.05
    untold_s: float = 0.0
    image_s: float = 1 / 30
    motor_s: float = 0.05
    hold_s: float | None = None
    told_motor_s: float = 0.05
    place_share: float = 0.5
    motion_share: float = 0.25
    speed_mps: float = 0.2

    def __post_init__(self) -> None:
        for name, (least, most) in _BOUNDS.items():
            if not least <= getattr(self, name) <= most:
                raise InputError(f"{name} must be {least:g} to {most:g}, got {getattr(self, name)}")
        if self.hold_s is not None and not 1e-3 <= self.hold_s <= 100:
            raise InputError(f"hold_s must be 0.001 to 100, got {self.hold_s}")
        for name, value in vars(self.spring).items():
            if not 0 < value < 1000:
                raise InputError(f"a spring's {name} must be above 0 and below 1000, got {value}")
