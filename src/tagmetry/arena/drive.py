"""Two wheels on one axle: how their speeds move a robot, and which speeds move it as wanted.

The robot's frame has its origin midway between the wheels, x forward and y left. With wheel speeds
w_l and w_r, radius r and track b (between the wheels' points of contact):

    v = r (w_r + w_l) / 2          along x
    omega = r (w_r - w_l) / b      counter-clockwise

Reference: seed 001, its figure 1 (two driven wheels, two ball casters).
"""

from dataclasses import dataclass

from tagmetry.errors import InputError


@dataclass(frozen=True)
class Twist:
    """How a robot moves, or shall move.

    Attributes:
        speed_mps: Along its forward axis; negative backwards.
        turn_rate_radps: Counter-clockwise seen from above.
    """

    speed_mps: float
    turn_rate_radps: float


STILL = Twist(0.0, 0.0)


@dataclass(frozen=True)
class Drive:
    """The wheels of a robot.

    Attributes:
        wheel_radius_m: Of both wheels.
        track_m: From one wheel's point of contact to the other's.
        top_wheel_speed_radps: What its motors reach without load.
    """

    wheel_radius_m: float
    track_m: float
    top_wheel_speed_radps: float

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not 0 < value < float("inf"):
                raise InputError(f"{name} of a drive must be positive and finite, got {value}")

    def wheel_speeds_radps(self, twist: Twist) -> tuple[float, float]:
        """Return the speeds of the left and the right wheel that move the robot so."""
        aside_mps = twist.turn_rate_radps * self.track_m / 2
        left_mps, right_mps = twist.speed_mps - aside_mps, twist.speed_mps + aside_mps
        return left_mps / self.wheel_radius_m, right_mps / self.wheel_radius_m

    def twist(self, left_radps: float, right_radps: float) -> Twist:
        """Return how the robot moves when its wheels turn so, without slip."""
        return Twist(
            self.wheel_radius_m * (right_radps + left_radps) / 2,
            self.wheel_radius_m * (right_radps - left_radps) / self.track_m,
        )

    def within(self, twist: Twist) -> Twist:
        """Return the motion on the same curve that no wheel is too slow for."""
        fastest_radps = max(abs(speed) for speed in self.wheel_speeds_radps(twist))
        share = min(1.0, self.top_wheel_speed_radps / max(fastest_radps, 1e-12))
        return Twist(share * twist.speed_mps, share * twist.turn_rate_radps)
