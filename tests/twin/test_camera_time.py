"""When the simulated camera's images come, and when its controls act."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from plain_camera import FACING, PLAIN, camera, step_edges_px

from tagmetry.camera import (
    ControlledSource,
    Controls,
    Source,
)
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.twin.scenes import Scene, Steady, surface


def test_it_is_a_source_and_has_controls() -> None:
    twin = camera()
    assert isinstance(twin, Source)
    assert isinstance(twin, ControlledSource)
    assert isinstance(twin.controls, Controls)
    assert twin.is_live
    assert twin.length is None
    assert twin.name == "twin plain"


def test_images_come_at_the_image_rate_with_the_middle_of_their_exposure() -> None:
    images = list(itertools.islice(camera(), 5))
    assert [image.sequence for image in images] == [0, 1, 2, 3, 4]
    np.testing.assert_allclose([i.time_s for i in images], np.arange(5) * 0.02 + 0.0025, atol=1e-12)
    assert {image.time_kind for image in images} == {"capture"}
    assert {image.source for image in images} == {"twin plain"}


def test_an_image_arrives_when_its_exposure_and_transfer_are_over() -> None:
    twin = camera(device=replace(PLAIN, latency_s=0.007))
    twin.take()
    assert twin.now_s == pytest.approx(0.005 + 0.007)
    twin.take()
    assert twin.now_s == pytest.approx(0.02 + 0.005 + 0.007)


@pytest.mark.parametrize(
    ("busy_s", "then"), [(0.0, 1), (0.0199, 1), (0.0201, 1), (0.0401, 2), (0.0599, 2), (1.0, 50)]
)
def test_who_is_busy_gets_the_newest_image_that_has_arrived(busy_s: float, then: int) -> None:
    twin = camera()
    twin.take()  # at 5 ms, the next arrive at 25 ms, 45 ms, ...
    twin.advance(busy_s)
    assert twin.take().sequence == then
    assert twin.now_s == pytest.approx(max(0.005 + busy_s, then * 0.02 + 0.005))


def test_no_image_is_given_twice() -> None:
    twin = camera()
    numbers = []
    for busy_s in np.random.default_rng(1).uniform(0, 0.05, 60):
        numbers.append(twin.take().sequence)
        twin.advance(float(busy_s))
    assert (np.diff(numbers) >= 1).all()
    assert max(np.diff(numbers)) == 3


def test_time_does_not_go_back() -> None:
    with pytest.raises(InputError, match="time only goes on"):
        camera().advance(-0.1)
    with pytest.raises(InputError, match="time only goes on"):
        camera().advance(float("nan"))


def test_closed_it_gives_no_more() -> None:
    with camera() as twin:
        taken = [next(iter(twin)).sequence for _ in range(2)]
    assert taken == [0, 1]
    assert list(twin) == []
    twin.close()
    with pytest.raises(InputError, match="twin plain is closed"):
        twin.take()


def test_a_moving_square_is_where_it_is_in_the_middle_of_the_exposure() -> None:
    start = RigidTransform.from_components([-0.02, 0.0, 0.5], FACING)
    moving = Steady(start, np.array([0.4, 0.0, 0.0]), np.zeros(3))
    scene = Scene((surface("square", 0.01, 0.01, moving, brightness=0.9),), background=0.1)
    twin = camera(scene)
    for _ in range(3):
        image = twin.take()
        found_px = np.mean(step_edges_px(image.pixels / 65535))
        x_m = -0.02 + 0.4 * image.time_s
        focal_px = twin.true_camera().focal_px[0]
        assert found_px == pytest.approx(
            twin.true_camera().center_px[0] + focal_px * x_m / 0.5, abs=0.02
        )


@pytest.mark.parametrize("delay", [0, 1, 3])
@pytest.mark.parametrize("busy_s", [0.0, 0.004, 0.0155])
def test_a_change_shows_after_exactly_the_delay(delay: int, busy_s: float) -> None:
    """With 0 in the next image that begins; a command during an exposure is too late for it."""
    twin = camera(device=replace(PLAIN, delay_images={"gain": delay}))
    before = twin.take().pixels.mean()
    twin.advance(busy_s)
    begins_next = int(np.ceil(twin.now_s / 0.02 - 1e-9))
    twin.controls.write("gain", 1.5)
    brighter = (i.sequence for i in twin if i.pixels.mean() > 1.2 * before)
    assert next(brighter) == begins_next + delay


def test_a_command_does_not_change_an_image_that_began_before_it() -> None:
    twin = camera()
    before = twin.take().pixels.mean()
    twin.advance(0.012)  # 17 ms: image 1 begins at 20 ms
    twin.advance(0.005)  # 22 ms: it has begun
    twin.controls.write("gain", 1.5)
    assert twin.take().pixels.mean() == pytest.approx(before, rel=1e-3)
    assert twin.take().pixels.mean() == pytest.approx(1.5 * before, rel=1e-3)


def test_the_focus_motor_takes_its_time() -> None:
    twin = camera(device=replace(PLAIN, speed_per_s={"focus": 100.0}))
    twin.take()
    twin.controls.write("focus", 10.0)  # from 2, at 5 ms; image k begins at 20 k ms
    reached = [twin.take() and twin.setting().focus for _ in range(6)]
    np.testing.assert_allclose(reached, [3.5, 5.5, 7.5, 9.5, 10.0, 10.0], atol=1e-9)
    assert twin.controls.read("focus") == 10.0


def test_a_motor_that_is_called_back_turns_where_it_is() -> None:
    twin = camera(device=replace(PLAIN, speed_per_s={"focus": 100.0}))
    twin.take()
    twin.controls.write("focus", 10.0)
    twin.take()  # at 25 ms it is at 4
    twin.controls.write("focus", 2.0)
    reached = [twin.take() and twin.setting().focus for _ in range(3)]
    np.testing.assert_allclose(reached, [2.5, 2.0, 2.0], atol=1e-9)
