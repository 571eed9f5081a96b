"""Simulated robots against closed forms: kinematics, motors, friction, momentum."""

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="robots' physics needs the extra `robots`")

from tagmetry.arena.drive import Twist
from tagmetry.arena.odometry import dead_reckoned
from tagmetry.arena.place import Place
from tagmetry.errors import InputError
from tagmetry.twin.robots import Block, RobotDesign, RobotsPhysics, SlipperyPatch

G_MPS2 = 9.81
DESIGN = RobotDesign()
HERE = Place(0.0, 0.0, 0.0)
WHOLE_FLOOR_M = 100.0


def alone(design=DESIGN, start=HERE, **floor):
    return RobotsPhysics([(design, start)], **floor)


@pytest.mark.parametrize("twist", [Twist(0.2, 0.8), Twist(-0.15, 1.0), Twist(0.25, -0.5)])
def test_a_driven_circle_has_the_radius_of_its_wheel_speeds(twist):
    physics = alone()
    physics.want(0, twist)
    physics.step(3.0)
    points = []
    for _ in range(60):
        physics.step(0.1)
        points.append([physics.places()[0].x_m, physics.places()[0].y_m])
    x_m, y_m = np.array(points).T
    design = np.column_stack([x_m, y_m, np.ones(60)])
    centre = np.linalg.lstsq(design, x_m**2 + y_m**2, rcond=None)[0]
    radius_m = np.sqrt(centre[2] + (centre[:2] ** 2).sum() / 4)
    assert radius_m == pytest.approx(abs(twist.speed_mps / twist.turn_rate_radps), rel=0.01)


def test_turning_on_the_spot_stays_on_the_spot():
    physics = alone(start=Place(0.3, -0.2, 0.5))
    physics.want(0, Twist(0.0, 2.0))
    physics.step(3.0)
    assert physics.places()[0].distance_m(Place(0.3, -0.2, 0)) < 0.001
    assert physics.twists()[0].turn_rate_radps == pytest.approx(2.0, rel=0.01)


def test_a_robot_starts_with_all_its_motors_torque():
    """a = 2 T / (r m), T falling with the wheels' speed; the casters' drag is 0.02 of a share."""
    physics = alone(RobotDesign(stall_torque_nm=0.02, caster_friction=1e-4, gear_drag_nm=1e-6))
    physics.want(0, Twist(0.45, 0.0))
    physics.step(0.2)
    speed_mps = physics.twists()[0].speed_mps
    drive, top_mps = DESIGN.drive, DESIGN.drive.top_wheel_speed_radps * DESIGN.drive.wheel_radius_m
    pull_mps2 = 2 * 0.02 / drive.wheel_radius_m / DESIGN.moved_mass_kg
    expected_mps = top_mps * (1 - np.exp(-pull_mps2 / top_mps * 0.2))
    assert speed_mps == pytest.approx(expected_mps, rel=0.03)


def test_its_top_speed_is_the_motors():
    physics = alone(RobotDesign(caster_friction=1e-4, gear_drag_nm=1e-6))
    physics.want(0, Twist(5.0, 0.0))
    physics.step(5.0)
    top_mps = DESIGN.drive.top_wheel_speed_radps * DESIGN.drive.wheel_radius_m
    assert physics.twists()[0].speed_mps == pytest.approx(top_mps, rel=0.02)


def grips(share):
    """Return a floor on which the wheels grip so."""
    return (SlipperyPatch(0.0, 0.0, WHOLE_FLOOR_M, share),)


@pytest.mark.parametrize("friction", [0.02, 0.05])
def test_on_a_slippery_floor_it_starts_as_friction_lets_it(friction):
    """By friction times the weight, nearly all of which the wheels carry at such a slow start."""
    design = RobotDesign(caster_friction=1e-4)
    physics = alone(design, patches=grips(friction))
    physics.want(0, Twist(1.5, 0.0))
    physics.step(0.5)
    speed_mps = physics.twists()[0].speed_mps
    assert speed_mps == pytest.approx(friction * G_MPS2 * 0.5, rel=0.1)
    assert physics.wheel_speeds_radps[0].min() * 0.033 > 1.5 * speed_mps  # the wheels spin


@pytest.mark.parametrize("friction", [0.05, 0.15])
def test_it_stops_in_the_length_that_friction_needs(friction):
    """v^2 / (2 mu g): its wheels brake as hard as they grip."""
    design = RobotDesign(caster_friction=1e-4, gear_drag_nm=1e-6)
    physics = alone(design)
    physics.want(0, Twist(0.4, 0.0))
    physics.step(2.0)
    speed_mps, start = physics.twists()[0].speed_mps, physics.places()[0]
    physics._patches = grips(friction)
    physics.want(0, Twist(0.0, 0.0))
    physics.step(2.0)
    stopped_m = start.distance_m(physics.places()[0])
    assert stopped_m == pytest.approx(speed_mps**2 / (2 * friction * G_MPS2), rel=0.15)


def test_it_brakes_with_all_its_motors_torque():
    """v^2 / (2 a) with a = 2 T / (r m): a motor that brakes gives its stall torque at any speed."""
    design = RobotDesign(stall_torque_nm=0.02, caster_friction=1e-4, gear_drag_nm=1e-6)
    physics = alone(design)
    physics.want(0, Twist(0.4, 0.0))
    physics.step(4.0)
    speed_mps, start = physics.twists()[0].speed_mps, physics.places()[0]
    physics.want(0, Twist(0.0, 0.0))
    physics.step(2.0)
    pull_mps2 = 2 * 0.02 / DESIGN.drive.wheel_radius_m / DESIGN.moved_mass_kg
    stopped_m = start.distance_m(physics.places()[0])
    assert stopped_m == pytest.approx(speed_mps**2 / (2 * pull_mps2), rel=0.04)


def test_it_starts_to_turn_as_its_inertia_lets_it():
    """Both motors' pull at half a track, by the inertia of body, casters, wheels and rotors."""
    design = RobotDesign(stall_torque_nm=0.01, caster_friction=1e-5, gear_drag_nm=1e-7)
    physics = alone(design)
    physics.want(0, Twist(0.0, 6.0))
    physics.step(0.1)
    radius_m, arm_m = DESIGN.drive.wheel_radius_m, DESIGN.drive.track_m / 2
    caster_m, ball_kgm2 = 0.08 - 0.0125 - 0.005, 0.4 * 0.05 * radius_m**2
    body = (0.8 - 0.02) * 0.08**2 / 2
    casters = 2 * 0.01 * caster_m**2
    wheels = 2 * (0.05 * arm_m**2 + ball_kgm2)
    rolling = 2 * DESIGN.wheel_inertia_kgm2 * (arm_m / radius_m) ** 2
    pull_nm = 2 * 0.01 / radius_m * arm_m
    top_radps = DESIGN.drive.top_wheel_speed_radps * radius_m / arm_m
    rate = pull_nm / (body + casters + wheels + rolling) / top_radps
    expected_radps = top_radps * (1 - np.exp(-rate * 0.1))
    assert physics.twists()[0].turn_rate_radps == pytest.approx(expected_radps, rel=0.03)


@pytest.mark.parametrize(("share", "slides"), [(0.7, False), (1.4, True)])
def test_a_bend_slides_where_friction_cannot_hold_it(share, slides):
    """v^2 / R = mu g is the fastest that friction holds; the casters hold nothing."""
    friction, radius_m = 0.05, 0.3
    speed_mps = float(np.sqrt(share * friction * G_MPS2 * radius_m))
    design = RobotDesign(caster_friction=1e-4)
    physics = alone(design)
    physics.want(0, Twist(speed_mps, speed_mps / radius_m))
    physics.step(2.0)
    physics._patches = grips(friction)
    start = physics.places()[0]
    quarter_s = np.pi / 2 * radius_m / speed_mps
    physics.step(quarter_s)
    end = physics.places()[0].seen_from(start)
    off_m = np.hypot(end.x_m - radius_m, end.y_m - radius_m)
    assert off_m > 0.05 if slides else off_m < 0.02


def test_two_coasting_robots_keep_their_momentum_when_they_meet():
    slick = RobotDesign(caster_friction=1e-5)
    physics = RobotsPhysics([(slick, HERE), (slick, Place(0.5, 0.0, 0.0))], patches=grips(1e-5))
    physics._state.qvel[:3] = [0.6, 0.0, 0.0]
    met = False
    for _ in range(300):
        physics.step(0.004)
        met = met or physics.touching() == {(0, 1)}
    first = physics._model.body_dofadr[physics._bodies]
    velocity = np.array([physics._state.qvel[n : n + 3] for n in first])
    assert met
    assert velocity[1, 0] > 0.2
    assert velocity[:, 0].sum() == pytest.approx(0.6, rel=0.01)
    assert abs(velocity[:, 1].sum()) < 0.005


def test_its_wheels_know_its_path_where_they_grip():
    physics = alone(start=Place(0.1, 0.2, 1.0))
    turns = [physics.wheel_turns_rad[0].copy()]
    for n in range(400):
        physics.want(0, Twist(0.2, np.sin(n / 40)))
        physics.step(0.02)
        turns.append(physics.wheel_turns_rad[0].copy())
    end = dead_reckoned(Place(0.1, 0.2, 1.0), np.diff(turns, axis=0), DESIGN.drive)[-1]
    assert end.distance_m(physics.places()[0]) < 0.02 * 1.6  # of the 1.6 m driven
    assert end.heading_rad == pytest.approx(physics.places()[0].heading_rad, abs=0.05)


def test_and_do_not_know_it_where_they_slip():
    physics = alone(patches=(SlipperyPatch(0.3, -0.065, 0.05, 0.001),))
    turns = [physics.wheel_turns_rad[0].copy()]
    for _ in range(150):
        physics.want(0, Twist(0.3, 0.0))
        physics.step(0.02)
        turns.append(physics.wheel_turns_rad[0].copy())
    end = dead_reckoned(HERE, np.diff(turns, axis=0), DESIGN.drive)[-1]
    assert abs(end.heading_rad - physics.places()[0].heading_rad) > 0.02


def test_encoders_count_whole_steps_of_the_wheels():
    physics = alone()
    physics.want(0, Twist(0.2, 0.5))
    physics.step(1.0)
    turned = physics.encoder_counts()[0] / DESIGN.encoder_steps * 2 * np.pi
    gap = physics.wheel_turns_rad[0] - turned
    assert ((gap >= 0) & (gap < 2 * np.pi / DESIGN.encoder_steps)).all()


@pytest.mark.parametrize("turn_rad", [0.0, np.pi / 2])
def test_two_robots_touch_where_their_bodies_do(turn_rad):
    physics = RobotsPhysics([(DESIGN, HERE), (DESIGN, Place(0.0, 0.165, turn_rad))])
    physics.step(0.1)
    assert not physics.touching()
    physics = RobotsPhysics([(DESIGN, HERE), (DESIGN, Place(0.0, 0.1595, turn_rad))])
    physics.step(0.004)
    assert physics.touching() == {(0, 1)}


def test_a_wall_stops_it():
    physics = alone(blocks=(Block(0.5, 0.0, 0.1, 1.0),))
    physics.want(0, Twist(0.3, 0.0))
    physics.step(4.0)
    assert physics.places()[0].x_m == pytest.approx(0.45 - 0.08, abs=0.01)


def test_a_dead_robot_rolls_out_and_one_with_one_motor_turns():
    physics = RobotsPhysics([(DESIGN, HERE), (DESIGN, Place(2.0, 0.0, 0.0))])
    for n in (0, 1):
        physics.want(n, Twist(0.3, 0.0))
    physics.step(1.0)
    physics.cut(0)
    physics.cut(1, side=0)
    physics.step(2.0)
    dead, lame = physics.twists()
    assert abs(dead.speed_mps) < 0.02
    assert abs(lame.turn_rate_radps) > 0.5


def test_it_stands_still_on_the_floor():
    physics = alone(start=Place(1.0, 2.0, -2.0))
    physics.step(2.0)
    place = physics.places()[0]
    assert (place.x_m, place.y_m, place.heading_rad) == pytest.approx((1.0, 2.0, -2.0), abs=1e-4)
    pose = physics.poses()[0]
    assert pose.translation[2] == pytest.approx(0.0, abs=5e-4)
    assert pose.rotation.magnitude() == pytest.approx(2.0, abs=1e-3)


def test_no_robots_and_impossible_ones_are_refused():
    with pytest.raises(InputError, match="at least one robot"):
        RobotsPhysics([])
    with pytest.raises(InputError, match="mass_kg of a robot must be positive"):
        RobotDesign(mass_kg=0.0)
    with pytest.raises(InputError, match="within the body"):
        RobotDesign(diameter_m=0.1)
