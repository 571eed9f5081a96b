"""A fake camera with a script of faults: the newest image wins, what is lost is fetched back."""

import itertools
import threading
import time
from dataclasses import dataclass, field

import numpy as np
import pytest

from tagmetry.camera import Camera, Source
from tagmetry.errors import InputError
from tagmetry.sources import ConnectionLostError, LiveSource, LiveTiming
from tagmetry.sources.newest import Newest

TIMING = LiveTiming(hang_s=0.25, frozen_s=0.05, first_pause_s=0.02, longest_pause_s=0.08)
FOREVER_S = 30.0


def image(value, size=(4, 6)):
    return np.full((*size, 3), value % 256, np.uint8)


@dataclass
class FakeCamera:
    """Plays scripts, one per connection: images, seconds to sleep, or errors to raise."""

    scripts: list
    opened: int = 0
    closed: int = 0
    freed: threading.Event = field(default_factory=threading.Event)

    def __call__(self):
        script = self.scripts[min(self.opened, len(self.scripts) - 1)]
        self.opened += 1
        if isinstance(script, Exception):
            raise script
        return FakeConnection(self, iter(script))


@dataclass
class FakeConnection:
    camera: FakeCamera
    script: object

    def read(self):
        for step in self.script:
            if isinstance(step, Exception):
                raise step
            if not isinstance(step, float):
                return step
            self.camera.freed.wait(step)
        raise ConnectionLostError("unplugged")

    def close(self):
        self.camera.closed += 1


def paced(values, pause_s=0.01):
    return [step for value in values for step in (pause_s, image(value))]


def states_of(scripts, wanted, timing=TIMING, timeout_s=5.0):
    """Run until the wanted state was reported so often as it stands in `wanted`."""
    seen, done = [], threading.Event()

    def on_state(state):
        seen.append(state)
        if [each.kind for each in seen][: len(wanted)] == wanted:
            done.set()

    camera = FakeCamera(scripts)
    with LiveSource("fake", camera, on_state=on_state, timing=timing) as source:
        assert done.wait(timeout_s), [state.kind for state in seen]
        state = source.state
    camera.freed.set()
    return seen, state, camera


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
