"""Late commands and motion, image by image."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.lens import Effect, Lag, LensSetting, Motion

START = LensSetting(100.0, 0.0)


def test_nothing_is_new_until_the_lag_has_passed() -> None:
    effect = Effect.settled(Lag(2, 30.0), START).command(LensSetting(300.0, 10.0))
    zooms = []
    for _ in range(3):
        effect = effect.next_image()
        zooms.append(effect.setting.zoom_percent)
    assert zooms == [100, 100, 300]
    assert effect.is_settled


def test_the_motor_takes_its_time() -> None:
    effect = Effect.settled(Lag(1, 30.0), START).command(LensSetting(100.0, 70.0))
    places = []
    while not effect.is_settled:
        effect = effect.next_image()
        places.append(effect.setting.focus)
    assert places == [0, 15, 45, 70]


def test_a_command_on_the_way_turns_the_motor_where_it_is() -> None:
    effect = Effect.settled(Lag(0, 30.0), START).command(LensSetting(100.0, 90.0))
    effect = effect.next_image().next_image().command(LensSetting(100.0, 0.0))
    assert not effect.is_settled
    assert effect.next_image().setting.focus == 30


def test_a_lag_that_is_none_is_refused() -> None:
    with pytest.raises(InputError, match="0 images or more"):
        Lag(-1)
    with pytest.raises(InputError, match="zoom_percent must be positive"):
        LensSetting(0.0, 1.0)


def test_motion_goes_on_straight() -> None:
    speed = np.array([0.01, -0.02, 0.2])
    motion = Motion.at_rest(1.0, np.array([0.0, 0.0, 0.5]))
    assert motion.at(2.0) == pytest.approx([0, 0, 0.5])
    for n in range(1, 9):
        motion = motion.seen(1.0 + n / 30, np.array([0.0, 0.0, 0.5]) + speed * n / 30)
    np.testing.assert_allclose(motion.speed_m_s, speed, atol=1e-9)
    np.testing.assert_allclose(motion.at(1.5), np.array([0, 0, 0.5]) + 0.5 * speed, atol=1e-9)


def test_an_old_place_and_an_image_twice_do_not_count() -> None:
    motion = Motion.at_rest(0.0, np.zeros(3)).seen(0.0, np.ones(3))
    assert len(motion.times_s) == 1
    motion = motion.seen(5.0, np.ones(3))
    assert motion.at(6.0) == pytest.approx([1, 1, 1])
