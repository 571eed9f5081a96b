"""What a simulated two-wheeled robot is made of.

Reference: seed 001, section 2: 160 mm across, two driven wheels, two ball casters. It gives no
masses, torques or radii: these are of small geared motors of that size, and are said here.
"""

from dataclasses import dataclass, field

from tagmetry.arena.drive import Drive
from tagmetry.errors import InputError


def _seed_drive() -> Drive:
    return Drive(wheel_radius_m=0.033, track_m=0.130, top_wheel_speed_radps=15.0)


@dataclass(frozen=True)
class RobotDesign:
    """A robot's body, motors and encoders.

    Attributes:
        drive: Its wheels.
        diameter_m: Of its round body.
        roof_height_m: Of the marker on its roof above the floor.
        mass_kg: Of all but the wheels.
        wheel_mass_kg: Of each wheel.
        stall_torque_nm: What each motor gives at rest; it falls to 0 at the drive's top speed.
        rotor_inertia_kgm2: Of each motor as its wheel feels it through the gears.
        gear_drag_nm: What each wheel needs to turn at all.
        servo_time_s: How soon a wheel follows its wanted speed while torque suffices.
        wheel_friction: Of the wheels on clean floor.
        caster_friction: Of the balls on any floor.
        encoder_steps: Of a wheel's full turn.
    """

    drive: Drive = field(default_factory=_seed_drive)
    diameter_m: float = 0.160
    roof_height_m: float = 0.093
    mass_kg: float = 0.80
    wheel_mass_kg: float = 0.05
    stall_torque_nm: float = 0.08
    rotor_inertia_kgm2: float = 5e-5
    gear_drag_nm: float = 0.003
    servo_time_s: float = 0.05
    wheel_friction: float = 0.8
    caster_friction: float = 0.02
    encoder_steps: int = 1440

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if name != "drive" and not 0 < value < float("inf"):
                raise InputError(f"{name} of a robot must be positive and finite, got {value}")
        if self.drive.track_m >= self.diameter_m:
            raise InputError(
                f"the wheels must lie within the body: track {self.drive.track_m} m, "
                f"diameter {self.diameter_m} m"
            )

    @property
    def wheel_inertia_kgm2(self) -> float:
        """Of one wheel about its axle, a ball's, 2/5 m r^2, with its motor's."""
        return 0.4 * self.wheel_mass_kg * self.drive.wheel_radius_m**2 + self.rotor_inertia_kgm2

    @property
    def moved_mass_kg(self) -> float:
        """What resists its motors when it goes straight on: all mass, and the wheels' turning."""
        turning_kg = 2 * self.wheel_inertia_kgm2 / self.drive.wheel_radius_m**2
        return self.mass_kg + 2 * self.wheel_mass_kg + turning_kg

    @property
    def servo_hold_s(self) -> float:
        """Time constant of its servos' integral, which holds the wheels against drag."""
        return 4 * self.servo_time_s

    @property
    def servo_gain_nms(self) -> float:
        """Torque of a wheel's servo per missing speed: each wheel moves half of the robot."""
        inertia_kgm2 = self.moved_mass_kg / 2 * self.drive.wheel_radius_m**2
        return inertia_kgm2 / self.servo_time_s
