"""Stale images told from fresh ones, with a camera whose true settings are known."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.camera import ControlStuckError, Image, scaled
from tagmetry.errors import InputError
from tagmetry.sources.controls import Settling, shows_scale, step_grey2
from tagmetry.twin.camera import (
    BeforeCamera,
    Faults,
    TwinCamera,
    facing_camera,
    markers_before_camera,
    webcam,
)
from tagmetry.twin.scenes import Along

BOUND = 8
SMALL = replace(  # the webcam with pixels three times larger
    webcam(),
    sensor=scaled(webcam().sensor, 1280, 720),
    size_px=(640, 360),
    lens=replace(webcam().lens, pixel_m=3 * webcam().lens.pixel_m),
)


def twin_of(z_m: float = 0.3, speed_m_s: float = 0.0, **faults: object) -> TwinCamera:
    """The webcam before a 10 mm marker, set by hand."""
    path = Along(lambda time_s: facing_camera(z_m + speed_m_s * time_s, 20.0, x_m=0.004))
    scene = markers_before_camera(BeforeCamera(path))
    twin = TwinCamera(scene, SMALL, quick=True, seed=3, faults=Faults(**faults))
    for name in ("auto_focus", "auto_exposure"):
        twin.controls.write(name, 0)
    twin.controls.write("zoom", 300)
    twin.controls.write("focus", 55)
    twin.advance(0.3)
    return twin


def warmed(twin: TwinCamera) -> Settling:
    settling = Settling(BOUND)
    assert not any(settling.is_stale(twin.take()) for _ in range(3))
    return settling


def stale_until_fresh(twin: TwinCamera, settling: Settling) -> int:
    """How many images are dropped after a command."""
    return next(dropped for dropped in range(100) if not settling.is_stale(twin.take()))


@pytest.mark.parametrize("late", [0, 1, 4])
@pytest.mark.parametrize(
    ("name", "value"),
    [("zoom", 420.0), ("zoom", 290.0), ("focus", 75.0), ("gain", 1.6), ("gain", 8.0)],
)
def test_the_first_image_that_is_taken_shows_the_change(name: str, value: float, late: int) -> None:
    twin = twin_of(late_images={name: late})
    settling = warmed(twin)
    twin.controls.write(name, value)
    settling.expect(name)
    dropped = stale_until_fresh(twin, settling)
    setting = twin.setting()
    reached = {"zoom": setting.zoom_percent, "focus": setting.focus, "gain": setting.gain}
    assert reached[name] == value
    delay = SMALL.delay_images[name] + late
    assert delay + 1 <= dropped <= delay + 2  # to see that it stands still, and with what noise


def test_a_motor_that_turns_is_waited_for() -> None:
    twin = twin_of(0.1)
    settling = warmed(twin)
    twin.controls.write("focus", 140)  # 85 steps at 1000 a second: two or three images
    settling.expect("focus")
    assert stale_until_fresh(twin, settling) >= 4
    assert twin.setting().focus == 140


def test_of_two_controls_the_slower_one_is_waited_for() -> None:
    twin = twin_of(late_images={"focus": 3})
    settling = warmed(twin)
    twin.controls.write("focus", 75)
    settling.expect("focus")
    stale_until_fresh(twin, settling)
    twin.controls.write("focus", 55)
    twin.controls.write("zoom", 400)
    settling.expect("focus", "zoom")
    stale_until_fresh(twin, settling)
    assert (twin.setting().focus, twin.setting().zoom_percent) == (55, 400)


def test_a_marker_that_moves_along_the_axis_is_no_change_of_the_camera() -> None:
    twin = twin_of(0.3, speed_m_s=0.2)
    settling = warmed(twin)
    twin.controls.write("zoom", 400)
    settling.expect("zoom")
    assert 2 <= stale_until_fresh(twin, settling) <= 4
    assert twin.setting().zoom_percent == 400


@pytest.mark.parametrize("faults", [{"stuck": frozenset({"zoom"})}, {"late_images": {"zoom": 40}}])
def test_a_control_that_sticks_or_is_too_late_is_named(faults: dict[str, object]) -> None:
    twin = twin_of(**faults)
    settling = warmed(twin)
    twin.controls.write("zoom", 400)
    settling.expect("zoom")
    with pytest.raises(ControlStuckError, match="zoom: no image showed the change in 8 images"):
        stale_until_fresh(twin, settling)
    assert not settling.is_stale(twin.take())  # it goes on


def test_where_much_moves_a_change_that_is_not_seen_is_no_fault() -> None:
    settling = Settling(BOUND)
    for sequence in range(4):
        settling.is_stale(still(40 * (sequence % 2), sequence))
    settling.expect("focus")
    stale = [settling.is_stale(still(40 * (k % 2), k)) for k in range(4, 16)]
    assert stale.index(False) == BOUND - 1


def test_a_change_that_cannot_be_seen_takes_as_long_as_one_that_could() -> None:
    twin = twin_of()
    settling = warmed(twin)
    twin.controls.write("focus", 75)
    settling.expect("focus")
    stale_until_fresh(twin, settling)
    longest = settling.took["focus"]
    settling.expect("focus", is_visible=False)  # nothing was written at all
    assert stale_until_fresh(twin, settling) == longest
    settling.expect("gain", is_visible=False)  # of which nothing is known
    assert stale_until_fresh(twin, settling) == BOUND - 1


def test_a_second_command_while_the_first_is_under_way_is_waited_for_too() -> None:
    twin = twin_of()
    settling = warmed(twin)
    twin.controls.write("zoom", 400)
    settling.expect("zoom")
    assert settling.is_stale(twin.take())
    twin.controls.write("focus", 75)
    settling.expect("focus")
    stale_until_fresh(twin, settling)
    assert (twin.setting().focus, twin.setting().zoom_percent) == (75, 400)


def still(value: int, sequence: int, shape: tuple[int, ...] = (48, 48)) -> Image:
    return Image(np.full(shape, value, np.uint8), sequence=sequence)


def greys_until_fresh(greys: list[int], settling: Settling) -> int:
    """The grey of the first image that is fresh."""
    first = settling._sequence + 1
    return next(g for k, g in enumerate(greys) if not settling.is_stale(still(g, first + k)))


def test_a_motor_that_slows_down_is_not_still() -> None:
    """A step of 10 greys is 1 % of one of 100, squared, and a hundred times what is usual."""
    settling = Settling(BOUND)
    assert not any(settling.is_stale(still(100, k)) for k in range(3))
    settling.expect("focus")
    assert greys_until_fresh([100, 200, 210, 213, 214, 99], settling) == 214


def test_with_more_noise_than_before_two_steps_alike_are_rest() -> None:
    rng = np.random.default_rng(2)
    settling = Settling(BOUND)

    def noisy(mean: float, deviation: float, sequence: int) -> Image:
        pixels = np.clip(rng.normal(mean, deviation, (240, 240)), 0, 255)
        return Image(pixels.astype(np.uint8), sequence=sequence)

    assert not any(settling.is_stale(noisy(60, 1, k)) for k in range(4))
    settling.expect("gain")
    stale = [
        settling.is_stale(noisy(60, 1, 4)),
        *(settling.is_stale(noisy(180, 8, k)) for k in (5, 6, 7)),
    ]
    assert stale == [True, True, True, False]


def test_a_second_command_does_not_make_the_first_one_forgotten() -> None:
    settling = Settling(BOUND)
    settling.is_stale(still(9, 0))
    settling.expect("zoom")
    assert settling.is_stale(still(9, 1))
    settling.expect("focus", is_visible=False)
    with pytest.raises(ControlStuckError, match="focus and zoom: no image showed the change"):
        greys_until_fresh([9] * 20, settling)


def test_images_that_were_missed_count() -> None:
    settling = Settling(BOUND)
    settling.is_stale(still(9, 0))
    settling.expect("zoom")
    assert settling.is_stale(still(9, 3))
    with pytest.raises(ControlStuckError):
        settling.is_stale(still(9, BOUND))


def test_images_that_never_are_still_again_are_given_all_the_same() -> None:
    settling = Settling(BOUND)
    for sequence in range(3):
        settling.is_stale(still(9, sequence))
    settling.expect("zoom")
    flicker = [settling.is_stale(still(200 * (k % 2), 3 + k)) for k in range(12)]
    assert flicker.index(False) == BOUND
    assert not any(flicker[BOUND:])


def test_without_a_change_nothing_is_stale() -> None:
    settling = Settling(BOUND)
    assert not any(settling.is_stale(still(40 * k, k)) for k in range(6))
    settling.expect()
    assert not settling.is_stale(still(7, 7))


def test_the_step_is_that_of_the_block_that_changes_most() -> None:
    before = np.full((240, 480), 100, np.uint8)
    after = before.copy()
    after[24:48, 48:72] = 130
    assert step_grey2(before, after) == pytest.approx(900)
    assert step_grey2(before, before) == 0
    wide = before.astype(np.uint16) * 256
    assert step_grey2(wide, after.astype(np.uint16) * 256) == pytest.approx(900)
    assert step_grey2(np.dstack([before] * 3), np.dstack([after] * 3)) == pytest.approx(900)


def test_an_image_of_another_size_is_another_image() -> None:
    assert step_grey2(still(1, 0).pixels, still(1, 1, (10, 10)).pixels) == np.inf
    assert step_grey2(np.zeros((1, 1), np.uint8), np.full((1, 1), 255, np.uint8)) == 255**2


@pytest.mark.parametrize(
    ("now_px", "factor", "shown"),
    [(50, 2.0, True), (26, 2.0, False), (13, 0.5, True), (25, 1.5, False)],
)
def test_a_marker_s_size_says_whether_the_zoom_shows(now_px, factor, shown) -> None:
    assert shows_scale(25.0, now_px, factor) is shown


def test_refuses_no_patience() -> None:
    with pytest.raises(InputError, match="most_images must be at least 1, got 0"):
        Settling(0)
