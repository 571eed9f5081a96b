"""The robots and their floor as MuJoCo's XML.

Each wheel is a ball that touches nothing but the floor, in the point below its axle, so that track
and radius are exact; bodies bump into bodies and blocks. A robot's own friction rules its contacts
(priority), so that a slippery place is one number of a wheel.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from tagmetry.arena.place import Place
from tagmetry.twin.robots.design import RobotDesign

TIME_STEP_S = 0.004
_CLEARANCE_M = 0.025  # below the body
_BODY_HEIGHT_M = 0.040
OVERTURNED_HEIGHT_M = _CLEARANCE_M + _BODY_HEIGHT_M + 0.005  # of its own floor, let fall a little
_CASTER_RADIUS_M = _CLEARANCE_M / 2
_CASTER_MASS_KG = 0.01
_CASTER_GAP_M = 0.0002  # above the floor while the body is level: the wheels carry it


@dataclass(frozen=True)
class Block:
    """A box on the floor that nothing moves.

    Attributes:
        x_m: Its middle.
        y_m: Its middle.
        length_m: Along its own x axis.
        width_m: Along its own y axis.
        heading_rad: Of its x axis.
    """

    x_m: float
    y_m: float
    length_m: float
    width_m: float
    heading_rad: float = 0.0


def arena_xml(robots: Sequence[tuple[RobotDesign, Place]], blocks: Sequence[Block] = ()) -> str:
    """Return the model of robots that stand at their places."""
    bodies = "".join(_robot(n, design, start) for n, (design, start) in enumerate(robots))
    boxes = "".join(_block(block) for block in blocks)
    servos = "".join(_servos(n, design) for n, (design, _) in enumerate(robots))
    return f"""
<mujoco>
  <compiler angle="radian"/>
  <option timestep="{TIME_STEP_S}" integrator="implicitfast" cone="elliptic" impratio="20"/>
  <worldbody><geom name="floor" type="plane" size="50 50 1"
    contype="1" conaffinity="3"/>{boxes}{bodies}</worldbody>
  <actuator>{servos}</actuator>
</mujoco>"""


def _robot(number: int, design: RobotDesign, start: Place) -> str:
    radius_m, half_m = design.diameter_m / 2, _BODY_HEIGHT_M / 2
    body_kg = design.mass_kg - 2 * _CASTER_MASS_KG
    caster_at_m = radius_m - _CASTER_RADIUS_M - 0.005
    return f"""
    <body name="robot{number}" pos="{start.x_m} {start.y_m} 0" euler="0 0 {start.heading_rad}">
      <freejoint/>
      <geom name="body{number}" type="cylinder" size="{radius_m} {half_m}" mass="{body_kg}"
        pos="0 0 {_CLEARANCE_M + half_m}" friction="0.3 0 0" priority="1"/>
      {_caster(caster_at_m, design)}{_caster(-caster_at_m, design)}
      {_wheel(f"left{number}", design.drive.track_m / 2, design)}
      {_wheel(f"right{number}", -design.drive.track_m / 2, design)}
    </body>"""


def _caster(x_m: float, design: RobotDesign) -> str:
    return f"""<geom type="sphere" size="{_CASTER_RADIUS_M}"
        pos="{x_m} 0 {_CASTER_RADIUS_M + _CASTER_GAP_M}"
        mass="{_CASTER_MASS_KG}" friction="{design.caster_friction} 0 0" priority="2"/>"""


def _wheel(name: str, y_m: float, design: RobotDesign) -> str:
    radius_m = design.drive.wheel_radius_m
    return f"""<body name="{name}" pos="0 {y_m} {radius_m}">
        <joint name="{name}" axis="0 1 0" armature="{design.rotor_inertia_kgm2}"
          frictionloss="{design.gear_drag_nm}"/>
        <geom name="{name}" type="sphere" size="{radius_m}" contype="2" conaffinity="0"
          mass="{design.wheel_mass_kg}" friction="{design.wheel_friction} 0 0" priority="2"/>
      </body>"""


def _servos(number: int, design: RobotDesign) -> str:
    return "".join(
        f"""
    <velocity joint="{side}{number}" kv="{design.servo_gain_nms}"
      forcerange="-{design.stall_torque_nm} {design.stall_torque_nm}"/>"""
        for side in ("left", "right")
    )


def _block(block: Block) -> str:
    return f"""<geom type="box" pos="{block.x_m} {block.y_m} 0.05" euler="0 0 {block.heading_rad}"
      size="{block.length_m / 2} {block.width_m / 2} 0.05"/>"""
