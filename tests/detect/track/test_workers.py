"""Work that is shared out among threads: order, errors, no waiting for what is only queued."""

import os
import threading
from collections.abc import Iterator
from functools import partial

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from moving_markers import STEP_S, Shown, image

from tagmetry.detect import Tracker
from tagmetry.detect.workers import _pool, at_once, both, shares


@pytest.fixture(params=[1, 2])
def threads(request: pytest.FixtureRequest) -> Iterator[int]:
    before = cv2.getNumThreads()
    cv2.setNumThreads(request.param)
    yield request.param
    cv2.setNumThreads(before)


def test_results_come_in_the_order_of_the_tasks() -> None:
    assert at_once([partial(pow, 2, k) for k in range(100)]) == [2**k for k in range(100)]
    assert at_once([]) == []


@given(st.integers(0, 200), st.integers(1, 30), st.integers(1, 8))
def test_shares_are_all_of_it_and_none_too_small(count: int, least: int, threads: int) -> None:
    parts = shares(count, least, threads)
    assert [k for part in parts for k in range(count)[part]] == list(range(count))
    assert len(parts) == 1 or min(part.stop - part.start for part in parts) >= least
    assert len(parts) <= 3 * threads
    assert len(parts) == 1 or len(parts) % threads == 0 or len(parts) < threads


def test_whoever_is_done_first_takes_what_nobody_has_begun() -> None:
    """With the pool held up, all but what it holds is done by the thread that asked."""
    held, done_by = threading.Event(), []
    asking = threading.get_ident()

    def task(own: int) -> int:
        done_by.append(threading.get_ident())
        return own

    blocked = [_pool().submit(held.wait, 5.0) for _ in range(cv2.getNumberOfCPUs())]
    assert at_once([partial(task, k) for k in range(6)]) == list(range(6))
    held.set()
    assert all(one.result() for one in blocked)
    assert set(done_by) == {asking}


def test_two_tasks_give_two_results(threads: int) -> None:
    assert both(lambda: "one", threading.get_ident) == ("one", threading.get_ident())


def test_an_error_reaches_whoever_asked(threads: int) -> None:
    with pytest.raises(ZeroDivisionError):
        both(lambda: 1 // 0, lambda: 1)


def test_work_within_work_does_not_wait_for_itself() -> None:
    """Every thread of the pool shares out again: none is left to do it, so it is done at once."""
    inner = partial(at_once, [partial(sum, range(k)) for k in range(8)])
    assert at_once([inner] * 64) == [inner()] * 64


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_after_a_fork_nothing_waits_for_threads_that_are_gone() -> None:
    tasks = [partial(pow, 2, k) for k in range(8)]
    wanted = at_once(tasks)
    child = os.fork()
    if child == 0:
        os._exit(0 if at_once(tasks) == wanted else 1)
    assert os.waitpid(child, 0)[1] == 0


def test_a_tracker_reports_the_same_with_any_number_of_threads() -> None:
    films = [
        [Shown(k, 60 + 60 * k + 2 * n, 80 + 30 * k, side_px=40) for k in range(4)] for n in range(6)
    ]
    before, told = cv2.getNumThreads(), []
    try:
        for count in (1, 2):
            cv2.setNumThreads(count)
            tracker = Tracker()
            found = [tracker.track(image(film, 1), n * STEP_S) for n, film in enumerate(films)]
            told.append([(one.id, one.corners_px) for some in found for one in some])
    finally:
        cv2.setNumThreads(before)
    assert [one for one, _ in told[0]] == [one for one, _ in told[1]]
    np.testing.assert_array_equal([at for _, at in told[0]], [at for _, at in told[1]])
