"""The tracks' covariance is right (Monte Carlo), and odd sightings are handled."""

from dataclasses import replace

import numpy as np
import pytest
from overhead import robot

from tagmetry.arena import Motion, RobotState, Roster, Sightings, TrackRules, Tracks
from tagmetry.errors import InputError
from tagmetry.geometry import Array, mahalanobis_squared, wrap_angle_rad

SD = np.array([1e-3, 1e-3, 5e-3])
ROSTER = Roster((robot(1), robot(2), robot(7)))
MOTION = Motion(0.4, 3.0, 0.004)


def sighting(places: dict[int, Array], sd: Array = SD, common_m: float = 0.0) -> Sightings:
    """Return sightings by row."""
    count = len(places)
    common = np.diag([common_m**2, common_m**2, 0.0])
    return Sightings(
        np.array(list(places), dtype=np.int64),
        np.array(list(places.values()), dtype=np.float64).reshape(-1, 3),
        np.broadcast_to(np.diag(sd**2), (count, 3, 3)),
        np.broadcast_to(common, (count, 3, 3)),
        np.full(count, 5.0),
    )


def numbers(state: RobotState) -> Array:
    return np.array(
        [state.x_m, state.y_m, state.heading_rad, state.speed_mps, state.turn_rate_radps]
    )


def drive(state: Array, step_s: float, rng: np.random.Generator) -> Array:
    """Return the state after a step of the stochastic equations, in many small steps (Euler)."""
    x, y, heading, speed, rate = state
    parts = 40
    dt = step_s / parts
    for a, b, s in rng.standard_normal((parts, 3)) * np.sqrt(dt):
        side = MOTION.slip_m * s
        x += speed * np.cos(heading) * dt - side * np.sin(heading)
        y += speed * np.sin(heading) * dt + side * np.cos(heading)
        heading += rate * dt
        speed += MOTION.acceleration_mps2 * a
        rate += MOTION.turning_radps2 * b
    return np.array([x, y, heading, speed, rate])


def error(state: RobotState, truth: Array) -> Array:
    off = numbers(state) - truth
    off[2] = wrap_angle_rad(off[2])
    return off


def followed(
    rng: np.random.Generator, *, steps: int = 40, ahead_s: float = 0.05
) -> tuple[list[tuple[Array, Array]], list[tuple[Array, Array]]]:
    """Return errors with covariances at the images' times and at later ones, of one drive.

    Some images do not show the robot, and the time between images varies.
    """
    tracks = Tracks(ROSTER, MOTION)
    truth = np.array([0.0, 0.0, rng.uniform(-3, 3), 0.3 * rng.standard_normal(), 0.0])
    time_s, now, later = 0.0, [], []
    for k in range(steps):
        step_s = rng.uniform(0.01, 0.05)
        truth, time_s = drive(truth, step_s, rng), time_s + step_s
        is_shown = k < 5 or rng.random() < 0.8
        measured = truth[:3] + SD * rng.standard_normal(3)
        tracks.take(sighting({0: measured} if is_shown else {}), time_s)
        if k > 10:
            state = tracks.world().robots[0]
            now.append((error(state, truth), state.covariance))
    after = tracks.world(time_s + ahead_s).robots[0]
    later.append((error(after, drive(truth, ahead_s, rng)), after.covariance))
    return now, later


def mean_distance2(pairs: list[tuple[Array, Array]]) -> float:
    errors, covariances = (np.array(values) for values in zip(*pairs, strict=True))
    return float(mahalanobis_squared(errors, covariances).mean())


def test_the_stated_covariance_is_that_of_many_drives() -> None:
    rng = np.random.default_rng(0)
    drives = [followed(rng) for _ in range(60)]
    now = [pair for found, _ in drives for pair in found]
    later = [pair for _, found in drives for pair in found]
    assert mean_distance2(now) == pytest.approx(5.0, abs=0.5)
    assert mean_distance2(later) == pytest.approx(5.0, abs=1.6)  # 3 deviations of 60 drives


def test_speed_and_turn_rate_are_those_of_a_circle() -> None:
    tracks = Tracks(ROSTER)
    for k in range(120):
        f = 0.8 * k / 120
        place = np.array([0.25 * np.sin(f), 0.25 * (1 - np.cos(f)), f])
        tracks.take(sighting({0: place}), k / 120)
    state = tracks.world().robots[0]
    assert state.speed_mps == pytest.approx(0.2, abs=2e-3)
    assert state.turn_rate_radps == pytest.approx(0.8, abs=1e-2)
    ahead = tracks.world(119 / 120 + 0.5).robots[0]
    f = 0.8 * (119 / 120 + 0.5)
    assert (ahead.x_m, ahead.y_m) == pytest.approx(
        (0.25 * np.sin(f), 0.25 * (1 - np.cos(f))), abs=2e-3
    )


def test_driving_backwards_is_a_negative_speed() -> None:
    tracks = Tracks(ROSTER)
    for k in range(60):
        tracks.take(sighting({0: np.array([-0.3 * k / 60, 0.0, 0.0])}), k / 60)
    assert tracks.world().robots[0].speed_mps == pytest.approx(-0.3, abs=5e-3)


def test_a_robot_that_is_not_seen_is_carried_on_with_age_and_growing_doubt() -> None:
    tracks = Tracks(ROSTER, rules=TrackRules(forget_s=1.0))
    for k in range(31):
        tracks.take(sighting({1: np.array([0.2 * k / 30, 0.0, 0.0])}), k / 30)
    before = tracks.world().robots[0]
    assert (before.seen, before.age_s) == (True, 0.0)
    tracks.take(sighting({}), 1.5)
    coasting = tracks.world().robots[0]
    assert coasting.seen is False
    assert coasting.age_s == pytest.approx(0.5)
    assert coasting.x_m == pytest.approx(0.3, abs=5e-3)
    assert np.trace(coasting.covariance) > 5 * np.trace(before.covariance)
    events = tracks.take(sighting({}), 2.1)
    assert [(one.kind, one.robot_id) for one in events] == [("lost", 2)]
    assert tracks.world().robots == ()


def test_a_single_wrong_sighting_is_passed_over() -> None:
    tracks = Tracks(ROSTER)
    for k in range(20):
        wrong = k == 10
        tracks.take(sighting({0: np.array([0.5 if wrong else 0.0, 0.0, 0.0])}), k / 30)
        assert abs(tracks.world().robots[0].x_m) < 0.01
        assert tracks.world().robots[0].seen is not wrong


def test_a_robot_that_was_carried_is_believed_after_some_images() -> None:
    tracks = Tracks(ROSTER)
    for k in range(10):
        tracks.take(sighting({0: np.array([0.0, 0.0, 0.0])}), k / 30)
    kinds = []
    for k in range(10, 13):
        events = tracks.take(sighting({0: np.array([0.8, 0.3, 1.0])}), k / 30)
        kinds.append([one.kind for one in events])
    assert kinds == [[], [], ["jumped"]]
    assert tracks.world().robots[0].x_m == pytest.approx(0.8, abs=1e-2)


def test_wrong_sightings_that_do_not_agree_are_never_believed() -> None:
    tracks, rng = Tracks(ROSTER), np.random.default_rng(4)
    for k in range(30):
        place = np.zeros(3) if k < 10 else np.array([*rng.uniform(1, 9, 2), 0.0])
        assert not [e for e in tracks.take(sighting({0: place}), k / 30) if e.kind != "found"]


def test_swapped_robots_are_told() -> None:
    tracks = Tracks(ROSTER)
    a, b = np.array([0.0, 0.0, 0.0]), np.array([0.6, 0.0, 1.0])
    for k in range(10):
        tracks.take(sighting({0: a, 1: b}), k / 30)
    events = [e for k in range(10, 13) for e in tracks.take(sighting({0: b, 1: a}), k / 30)]
    assert [(one.kind, one.robot_id) for one in events] == [("swapped", 1), ("swapped", 2)]
    assert "where robot 2 was" in events[0].told


def test_of_a_marker_that_is_seen_twice_the_one_that_fits_counts() -> None:
    tracks = Tracks(ROSTER)
    for k in range(5):
        tracks.take(sighting({0: np.zeros(3)}), k / 30)
    both = sighting({0: np.zeros(3)})
    away = sighting({0: np.array([1.0, 1.0, 0.0])})
    twice = Sightings(
        *(
            np.concatenate([getattr(one, name) for one in (away, both)])
            for name in ("rows", "places", "noise", "common", "chi2")
        )
    )
    tracks.take(twice, 1.0)
    assert tracks.world().robots[0].seen
    assert abs(tracks.world().robots[0].x_m) < 0.01
    fresh = Tracks(ROSTER)
    fresh.take(twice, 0.0)
    assert fresh.world().robots == ()


def test_what_is_common_to_all_images_is_not_averaged_away() -> None:
    tracks = Tracks(ROSTER)
    for k in range(500):
        tracks.take(sighting({0: np.zeros(3)}, common_m=2e-3), k / 120)
    assert np.sqrt(tracks.world().robots[0].covariance[0, 0]) > 2e-3


def test_robots_do_not_influence_each_other() -> None:
    alone, together = Tracks(ROSTER), Tracks(ROSTER)
    for k in range(20):
        place = np.array([0.01 * k, 0.0, 0.1 * k])
        alone.take(sighting({2: place}), k / 30)
        together.take(sighting({2: place, 0: place + 0.3, 1: place - 0.2}), k / 30)
    (one,), three = alone.world().robots, together.world().robots
    assert [state.id for state in three] == [1, 2, 7]
    np.testing.assert_allclose(numbers(three[2]), numbers(one), atol=1e-12)


def test_heading_goes_round_without_a_jump() -> None:
    tracks = Tracks(ROSTER)
    for k in range(90):
        heading = float(wrap_angle_rad(3.0 + 0.02 * k))
        tracks.take(sighting({0: np.array([0.0, 0.0, heading])}), k / 30)
        assert tracks.world().robots[0].seen
    assert tracks.world().robots[0].turn_rate_radps == pytest.approx(0.6, abs=0.02)


def test_a_long_gap_is_no_trouble() -> None:
    tracks = Tracks(ROSTER)
    tracks.take(sighting({0: np.zeros(3)}), 0.0)
    tracks.take(sighting({0: np.ones(3)}), 1e6)
    assert [state.id for state in tracks.world().robots] == [1]


@pytest.mark.parametrize("time_s", [1.0, 0.5, float("nan")])
def test_refuses_time_that_does_not_rise(time_s: float) -> None:
    tracks = Tracks(ROSTER)
    tracks.take(sighting({}), 1.0)
    with pytest.raises(InputError, match="time_s must"):
        tracks.take(sighting({}), time_s)


def test_refuses_to_tell_the_past() -> None:
    tracks = Tracks(ROSTER)
    tracks.take(sighting({}), 1.0)
    with pytest.raises(InputError, match=r"1\.0 s, the last image, or later, not for 0\.5"):
        tracks.world(0.5)


@pytest.mark.parametrize("name", ["acceleration_mps2", "turning_radps2", "slip_m"])
def test_refuses_motion_without_noise(name: str) -> None:
    with pytest.raises(InputError, match=f"{name} must be positive"):
        replace(MOTION, **{name: 0.0})


def test_refuses_rules_that_believe_nothing() -> None:
    with pytest.raises(InputError, match="must be positive"):
        TrackRules(forget_s=0.0)


def test_covariance_is_carried_as_the_mean_is() -> None:
    """Against finite differences of the mean, for robots that turn quickly."""
    quiet = Motion(1e-9, 1e-9, 1e-9)
    mean = np.array([[0.1, 0.2, 0.5, 0.6, 3.0], [0.0, 0.0, -2.0, -0.4, -1.0]])
    step_s, small = 0.08, 1e-6
    F = np.empty((2, 5, 5))
    for axis in range(5):
        change = small * np.eye(5)[axis]
        ends = [
            quiet.moved(mean + sign * change, np.zeros((2, 5, 5)), step_s)[0] for sign in (1, -1)
        ]
        F[:, :, axis] = (ends[0] - ends[1]) / (2 * small)
    root = np.random.default_rng(5).standard_normal((2, 5, 5))
    before = root @ root.mT
    _, after = quiet.moved(mean, before, step_s)
    np.testing.assert_allclose(after, F @ before @ F.mT, rtol=2e-4, atol=3e-4)


def test_a_robot_that_is_pushed_to_the_side_is_followed() -> None:
    """It moves across its heading, and turns, as no wheels do; at 30 and at 6 images per second."""
    for rate in (30.0, 6.0):
        tracks = Tracks(ROSTER)
        for k in range(int(3 * rate)):
            t = k / rate
            place = np.array([0.0, 0.4 * np.sin(t), float(wrap_angle_rad(2.0 * t))])
            events = tracks.take(sighting({0: place}), t)
            state = tracks.world().robots[0]
            assert k == 0 or not events
            assert state.seen
            assert np.hypot(state.x_m - place[0], state.y_m - place[1]) < 5e-3
            assert abs(float(wrap_angle_rad(state.heading_rad - place[2]))) < 0.02


def test_refuses_a_push_backwards_in_time() -> None:
    with pytest.raises(InputError, match="pushed_mps"):
        TrackRules(pushed_mps=-1.0)
