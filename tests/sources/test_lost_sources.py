"""A camera that is unplugged, hangs or gives rubbish: reported, and fetched back."""

import itertools
import threading
import time

import numpy as np
import pytest
from scripted_camera import FOREVER_S, TIMING, FakeCamera, image, paced, states_of

from tagmetry.errors import InputError
from tagmetry.sources import ConnectionLostError, LiveSource, LiveTiming


def test_an_unplugged_camera_is_reported_and_fetched_back():
    scripts = [paced([1, 2]), InputError("gone"), [*paced([3, 4]), FOREVER_S]]
    wanted = ["running", "lost", "reconnecting", "lost", "reconnecting", "running"]
    seen, state, camera = states_of(scripts, wanted)
    assert [each.reason for each in seen[1:5]] == ["unplugged", "unplugged", "gone", "gone"]
    assert state.kind == "running"
    assert camera.closed >= 1


def test_the_count_goes_on_after_a_reconnection():
    scripts = [paced([1, 2], 0.04), [*paced([3], 0.04), FOREVER_S]]
    with LiveSource("fake", FakeCamera(scripts), timing=TIMING) as source:
        images = list(itertools.islice(source, 3))
    assert [(i.sequence, i.pixels[0, 0, 0]) for i in images] == [(0, 1), (1, 2), (2, 3)]


def test_a_read_that_hangs_is_lost_and_what_it_brings_later_is_not_taken():
    stuck = FakeCamera([[image(1), FOREVER_S, image(99)]])
    sound = FakeCamera([[*paced([2, 3], 0.04), FOREVER_S]])
    cameras = iter([stuck, sound])

    def open_next():
        return next(cameras)()

    with LiveSource("fake", open_next, timing=TIMING) as source:
        images = iter(source)
        values = [next(images).pixels[0, 0, 0] for _ in range(3)]
        stuck.freed.set()
        time.sleep(0.1)
        assert values == [1, 2, 3]
        assert source._arrivals.count == 3
        assert stuck.closed == 1
    sound.freed.set()


def test_a_hang_is_reported_with_its_length():
    seen, _, _ = states_of([[image(1), FOREVER_S]], ["running", "lost"])
    assert seen[1].reason == "no answer for 0.25 s"


def test_readers_that_hang_are_not_piled_up():
    timing = LiveTiming(hang_s=0.02, first_pause_s=0.01, longest_pause_s=0.01)
    camera = FakeCamera([[image(1), FOREVER_S], [FOREVER_S]])
    with LiveSource("fake", camera, timing=timing):
        time.sleep(0.6)
        assert camera.opened == 3
        camera.freed.set()  # the driver lets go: reading goes on
        time.sleep(0.3)
        assert camera.opened > 3


def test_the_pauses_between_attempts_grow():
    pause_s, pauses_s = LiveTiming().first_pause_s, []
    for _ in range(6):
        pauses_s.append(pause_s)
        pause_s = LiveTiming().next_pause_s(pause_s)
    assert pauses_s == [0.5, 1.0, 2.0, 4.0, 5.0, 5.0]
    camera = FakeCamera([[image(1)], InputError("gone")])
    with LiveSource("fake", camera, timing=TIMING):
        time.sleep(0.6)
    assert 3 <= camera.opened <= 12  # 20, 40, then 80 ms each: without growing it were about 30


def test_the_pauses_begin_anew_after_an_image():
    timing = LiveTiming(first_pause_s=0.02, longest_pause_s=1.0)
    gone = InputError("gone")
    scripts = [paced([1]), gone, gone, gone, gone, paced([2]), [*paced([3]), FOREVER_S]]
    running_s, done = [], threading.Event()

    def on_state(state):
        if state.kind == "running":
            running_s.append(time.monotonic())
        if len(running_s) == 3:
            done.set()

    with LiveSource("fake", FakeCamera(scripts), on_state=on_state, timing=timing):
        assert done.wait(5.0)
    assert running_s[1] - running_s[0] > 0.5  # 20 + 40 + 80 + 160 + 320 ms
    assert running_s[2] - running_s[1] < 0.4  # 20 ms, and not 640


CORRUPT = [
    np.empty((0, 5), np.uint8),
    np.zeros((4, 5, 2), np.uint8),
    np.zeros(9, np.uint8),
    np.zeros((4, 5), np.float32),
]


def test_corrupt_images_are_left_out():
    script = [0.02, image(1), *CORRUPT, 0.05, image(2), FOREVER_S]
    with LiveSource("fake", FakeCamera([script])) as source:
        assert [i.sequence for i in itertools.islice(source, 2)] == [0, 1]


def test_corrupt_images_with_good_ones_between_are_no_loss():
    script = [image(1), *(CORRUPT * 7), image(2), *(CORRUPT * 7), 0.05, image(3), FOREVER_S]
    camera = FakeCamera([script])
    with LiveSource("fake", camera) as source:
        assert next(i for i in source if i.sequence == 2).pixels[0, 0, 0] == 3
    assert camera.opened == 1


def test_nothing_but_corrupt_images_is_a_loss():
    scripts = [[image(1), *(CORRUPT * 10)], [image(2), FOREVER_S]]
    seen, _, _ = states_of(scripts, ["running", "lost", "reconnecting", "running"])
    assert seen[1].reason == "30 corrupt images in a row"


@pytest.mark.parametrize(
    ("script", "words"),
    [
        (InputError("no such camera"), "fake: no such camera"),
        ([ConnectionLostError("silent")], "fake: silent"),
        ([FOREVER_S], r"fake: no answer for 0\.25 s"),
    ],
)
def test_a_source_that_never_gives_an_image_is_an_error(script, words):
    camera = FakeCamera([script])
    with LiveSource("fake", camera, timing=TIMING) as source:
        with pytest.raises(InputError, match=words):
            next(iter(source))
        time.sleep(0.1)
        assert camera.opened == 1  # it is not tried again behind the user's back
    camera.freed.set()
