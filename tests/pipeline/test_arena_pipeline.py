"""Images of a rendered arena through the pipeline, and queues that never wait."""

import json
import threading
import time
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from tagmetry.camera import Camera, Image
from tagmetry.errors import InputError
from tagmetry.files.arena import ArenaSetup, load_arena
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker
from tagmetry.pipeline.arena import (
    ArenaMeasurement,
    ArenaResult,
    Latency,
    Posted,
    calibrate_arena,
    run_arena,
)
from tagmetry.pipeline.arena.lines import LineTaker, arena_line
from tagmetry.twin import Optics, Scene, Shot, photograph
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.scenes import Steady, Still, looking, marker_thing

CAMERA = Camera(640, 400, (500.0, 500.0), (318.0, 203.0))
ABOVE = looking(np.array([0.0, 0.0, 1.2]), np.zeros(3))
FLOOR = ((100, 0.0, 0.0, 0.0), (101, 0.6, 0.0, 1.0), (102, -0.6, 0.35, 2.0))
SPEED_MPS = 0.2
HEADING = 0.4
ARENA = """
tagmetry: arena
version: 1
marker_size_m: 0.08
diameter_m: 0.16
floor: {size_m: 0.1, toward: 101, markers: [{id: 100}, {id: 101}, {id: 102}]}
sensor: {range_m: 0.6}
fence_m: [[-0.8, -0.5], [0.8, -0.5], [0.8, 0.5], [-0.8, 0.5]]
robots:
  - {id: 1, name: ada, marker: {id: 1, height_m: 0.1}}
  - {id: 2, name: bob, marker: {id: 2, height_m: 0.15}}
  - {id: 3, name: never there, marker: {id: 3, height_m: 0.1}}
"""


def picture(time_s: float, *, robots: bool = True, shift_m: float = 0.0) -> Image:
    floor = [
        MountedMarker(
            "tag36h11",
            number,
            0.1,
            RigidTransform.from_components([x, y, 0], Rotation.from_euler("z", turn)),
        )
        for number, x, y, turn in FLOOR
    ]
    things = [marker_thing(floor), *(_driving() if robots else ())]
    moved = RigidTransform.from_translation([shift_m, 0, 0]) * ABOVE
    shot = Shot(
        CAMERA, Still(moved), time_s, optics=Optics(blur_px=0.6), sensor=Sensor(noise_grey=1.0)
    )
    pixels = photograph(Scene(tuple(things)), shot, np.random.default_rng(int(1000 * time_s)))
    return Image(pixels, time_s, "capture", round(30 * time_s), "arena")


def _driving() -> list:  # of things
    """Return two robots that drive side by side, 0.3 m apart."""
    made = []
    for number, y_m, height_m in ((1, -0.25, 0.1), (2, 0.05, 0.15)):
        turned = Rotation.from_euler("z", HEADING - np.pi / 2)
        start = RigidTransform.from_components([-0.3, y_m, height_m], turned)
        way = SPEED_MPS * np.array([np.cos(HEADING), np.sin(HEADING), 0])
        marker = MountedMarker("tag36h11", number, 0.08, RigidTransform.identity())
        made.append(marker_thing([marker], Steady(start, way, np.zeros(3))))
    return made


@pytest.fixture(scope="module")
def setup(tmp_path_factory: pytest.TempPathFactory) -> ArenaSetup:
    path = tmp_path_factory.mktemp("arena") / "arena.yaml"
    path.write_text(ARENA, "utf-8")
    return load_arena(path)


@pytest.fixture(scope="module")
def film() -> list[Image]:
    return [picture(k / 30) for k in range(1, 16)]


@pytest.fixture
def task(setup: ArenaSetup) -> ArenaMeasurement:
    world = calibrate_arena([picture(0.0, robots=False)], setup, CAMERA)
    return ArenaMeasurement.of(setup, world)


def test_robots_are_where_they_were_rendered(task: ArenaMeasurement, film: list[Image]) -> None:
    results = list(run_arena(film, task))
    last = results[-1]
    assert [state.id for state in last.world] == [1, 2]
    for state, y_m in zip(last.world, (-0.25, 0.05), strict=True):
        way_m = SPEED_MPS * film[-1].time_s
        assert state.x_m == pytest.approx(-0.3 + way_m * np.cos(HEADING), abs=3e-4)
        assert state.y_m == pytest.approx(y_m + way_m * np.sin(HEADING), abs=3e-4)
        assert state.heading_rad == pytest.approx(HEADING, abs=3e-3)
        assert state.speed_mps == pytest.approx(SPEED_MPS, abs=0.03)
    (near,) = last.told[0].neighbours
    assert (near.id, near.range_m) == (2, pytest.approx(0.3, abs=5e-4))
    assert near.bearing_rad == pytest.approx(np.pi / 2 - HEADING, abs=5e-3)
    assert [one.must_stop for one in last.decisions] == [False, False, True]
    assert last.step.strangers == ()


def test_the_same_images_give_the_same_lines(setup: ArenaSetup, film: list[Image]) -> None:
    world = calibrate_arena([picture(0.0, robots=False)], setup, CAMERA)
    once, again = (
        [arena_line(r) for r in run_arena(film[:5], ArenaMeasurement.of(setup, world))]
        for _ in range(2)
    )
    assert once == again
    told = json.loads(once[-1])
    assert [robot["name"] for robot in told["robots"]] == ["ada", "bob"]
    assert told["stopped"] == [{"id": 3, "reasons": ["never seen"]}]


def test_a_camera_that_is_moved_stops_all(task: ArenaMeasurement, film: list[Image]) -> None:
    moved = [picture(1.0 + k / 30, shift_m=0.02) for k in range(3)]
    *_, last = run_arena([*film[:2], *moved], task)
    assert last.step.is_bumped
    assert last.stop.is_pressed
    assert "camera was moved" in last.stop.why
    assert all(one.must_stop for one in last.decisions)


def test_a_live_image_is_predicted_to_the_time_of_sending(
    task: ArenaMeasurement, film: list[Image]
) -> None:
    late_s = 0.05
    ticks = iter(np.repeat([one.time_s + late_s for one in film], 3).tolist())
    live = replace(task, is_live=True, clock=lambda: next(ticks))
    results = [live.measure(one) for one in film]
    assert results[-1].world.time_s == pytest.approx(film[-1].time_s + late_s)
    assert results[-1].latency_s == pytest.approx(late_s)
    way_m = SPEED_MPS * (film[-1].time_s + late_s)
    x_m = results[-1].world.robots[0].x_m
    assert x_m == pytest.approx(-0.3 + way_m * np.cos(HEADING), abs=2e-3)


def test_refuses_an_image_of_another_size(task: ArenaMeasurement) -> None:
    with pytest.raises(InputError, match="intrinsics belong to 640x400"):
        task.measure(Image(np.zeros((10, 10), np.uint8), 0.1, "capture"))


def test_refuses_floor_markers_that_are_not_seen(setup: ArenaSetup) -> None:
    with pytest.raises(InputError, match="3 of 3 floor markers are not seen: tag36h11 id 100"):
        calibrate_arena([Image(np.zeros((400, 640), np.uint8))], setup, CAMERA)


def test_refuses_a_marker_above_the_camera(setup: ArenaSetup) -> None:
    world = calibrate_arena([picture(0.0, robots=False)], setup, CAMERA)
    view = replace(
        world.view,
        T_world_camera=RigidTransform.from_components(
            [0, 0, 0.12], world.view.T_world_camera.rotation
        ),
    )
    with pytest.raises(InputError, match=r"bob: its marker's height of 0\.15 m is above"):
        ArenaMeasurement.of(setup, replace(world, view=view))


class Slow:
    """Takes its time, and remembers what it got."""

    def __init__(self) -> None:
        self.got: list[int] = []
        self.may_go_on = threading.Event()
        self.is_closed = False

    def take(self, result: ArenaResult) -> None:
        self.may_go_on.wait(5)
        self.got.append(result.image.sequence)

    def close(self) -> None:
        self.is_closed = True


def results(count: int) -> Iterator[ArenaResult]:
    for number in range(count):
        image = Image(np.zeros((1, 1), np.uint8), sequence=number)
        yield ArenaResult(image, (), None, None, (), (), None, {}, 0.0, 0.0)  # type: ignore[arg-type]


def test_a_slow_taker_gets_the_newest_and_delays_nobody() -> None:
    slow = Slow()
    posted = Posted(slow)
    begin_s = time.monotonic()
    for result in results(50):
        posted.take(result)
    assert time.monotonic() - begin_s < 2.0  # far below 50 waits of 5 s
    slow.may_go_on.set()
    posted.close()
    assert slow.is_closed
    assert slow.got[-1] == 49
    assert len(slow.got) + posted.dropped == 50
    assert posted.dropped >= 48


def test_where_nothing_may_be_lost_nothing_is() -> None:
    slow = Slow()
    slow.may_go_on.set()
    posted = Posted(slow, longest=2, may_drop=False)
    for result in results(100):
        posted.take(result)
    posted.close()
    assert slow.got == list(range(100))
    assert posted.dropped == 0


class Broken(Slow):
    def take(self, result: ArenaResult) -> None:  # noqa: ARG002
        raise InputError("the disk is full")


def test_a_taker_that_fails_is_heard_of() -> None:
    posted = Posted(Broken(), longest=4, may_drop=False)
    with pytest.raises(InputError, match="disk is full"):
        hand_on(posted)


def hand_on(posted: Posted) -> None:
    for result in results(100):
        posted.take(result)
        time.sleep(0.001)
    posted.close()


def test_all_takers_are_closed_even_where_one_fails(task: ArenaMeasurement) -> None:
    broken, other = Broken(), Slow()
    with pytest.raises(InputError, match="disk is full"):
        list(run_arena([picture(0.1)], task, [broken, other]))
    assert broken.is_closed
    assert other.is_closed


def test_lines_and_latency_are_told(task: ArenaMeasurement, film: list[Image]) -> None:
    lines: list[str] = []
    latency = Latency()
    assert latency.told == "no image yet"
    list(run_arena(film[:3], task, [LineTaker(lines.append)], latency))
    assert len(lines) == len(latency) == 3
    assert 0 < latency.quantile_s(0.5) <= latency.quantile_s(0.99)
    assert "(99 %)" in latency.told
