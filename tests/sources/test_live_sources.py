"""A live source: the newest image wins, and it ends within a second."""

import itertools
import threading
import time

import pytest
from scripted_camera import FOREVER_S, FakeCamera, image, paced, states_of

from tagmetry.camera import Camera, Source
from tagmetry.errors import InputError
from tagmetry.sources import LiveSource
from tagmetry.sources.newest import Newest


def test_images_are_numbered_and_stamped_with_the_injected_clock():
    ticks = itertools.count(100.0, 0.001)
    camera = FakeCamera([[*paced([1, 2, 3], pause_s=0.05), FOREVER_S]])
    with LiveSource("fake", camera, clock=lambda: next(ticks)) as source:
        assert isinstance(source, Source)
        assert (source.name, source.is_live, source.length) == ("fake", True, None)
        images = list(itertools.islice(source, 3))
        assert source.state.kind == "running"
    camera.freed.set()
    assert [i.sequence for i in images] == [0, 1, 2]
    assert [i.pixels[0, 0, 0] for i in images] == [1, 2, 3]
    assert {(i.time_kind, i.source) for i in images} == {("arrival", "fake")}
    times_s = [i.time_s for i in images]
    assert times_s == sorted(times_s)
    assert times_s[0] > 100.0


def test_a_slow_taker_gets_the_newest_and_sees_the_gap():
    with LiveSource("fake", FakeCamera([paced(range(1, 250), 0.004)])) as source:
        images = iter(source)
        first = next(images)
        time.sleep(0.3)
        second = next(images)
        assert second.sequence - first.sequence > 5
        assert second.pixels[0, 0, 0] == (second.sequence + 1) % 256
        assert time.monotonic() - second.time_s < 0.2


def test_repeats_are_not_counted_and_a_frozen_picture_is_reported():
    frozen = paced([7] * 40)
    seen, _, _ = states_of(
        [[*paced([5]), *frozen, *paced([8]), FOREVER_S]], ["running", "frozen", "running"]
    )
    assert seen[1].reason == "the same image again and again"
    with LiveSource("fake", FakeCamera([[*paced([5, 7, 7, 7, 8], 0.04), FOREVER_S]])) as source:
        images = list(itertools.islice(source, 3))
    assert [(i.sequence, i.pixels[0, 0, 0]) for i in images] == [(0, 5), (1, 7), (2, 8)]


def test_an_image_that_differs_in_one_pixel_is_new():
    first = image(3, (40, 40))
    second = first.copy()
    second[13, 21, 1] += 1
    with LiveSource("fake", FakeCamera([[first, 0.05, second, FOREVER_S]])) as source:
        assert [i.sequence for i in itertools.islice(source, 2)] == [0, 1]


def test_a_new_size_is_passed_on_or_refused_where_it_does_not_fit_the_intrinsics():
    script = [*paced([1], 0.04), 0.05, image(2, (8, 8)), FOREVER_S]
    with LiveSource("fake", FakeCamera([script])) as source:
        assert [i.pixels.shape[:2] for i in itertools.islice(source, 2)] == [(4, 6), (8, 8)]
    fitting = Camera(6, 4, (5.0, 5.0), (2.0, 2.0))
    with LiveSource("fake", FakeCamera([script]), camera=fitting) as source:
        images = iter(source)
        assert next(images).camera is fitting
        with pytest.raises(InputError, match=r"fake: .*belong to 6x4 images, this one is 8x8"):
            next(images)


def test_closing_takes_less_than_a_second_while_a_read_hangs():
    camera = FakeCamera([[image(1), FOREVER_S]])
    source = LiveSource("fake", camera)
    images = iter(source)
    next(images)
    begin_s = time.perf_counter()
    source.close()
    source.close()
    assert time.perf_counter() - begin_s < 1.0
    assert list(images) == []
    assert source.state.kind == "closed"
    camera.freed.set()


def test_closing_wakes_who_waits_and_ends_the_threads():
    camera = FakeCamera([[image(1), 0.1, *paced(range(2, 250))]])
    source = LiveSource("waiting", camera)
    taken = []
    taker = threading.Thread(target=lambda: taken.extend(source))
    taker.start()
    time.sleep(0.2)
    source.close()
    taker.join(1.0)
    assert not taker.is_alive()
    assert taken
    time.sleep(0.1)
    assert not [t.name for t in threading.enumerate() if "waiting" in t.name]
    assert camera.closed == 1


def test_the_place_for_the_newest_gives_each_value_once():
    place = Newest()
    place.put(1)
    place.put(2)
    assert place.take() == 2
    place.put(3)
    place.close()
    assert place.take() is None
    failed = Newest()
    failed.close(InputError("broken"))
    failed.close()
    with pytest.raises(InputError, match="broken"):
        failed.take()
