"""Threads that stand by: what compiled loops do, which let go of the interpreter, is shared out."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from itertools import pairwise
from typing import TypeVar

import cv2

A = TypeVar("A")
B = TypeVar("B")
_SHARES_EACH = 3


def at_once(tasks: Sequence[Callable[[], A]]) -> list[A]:
    """Return the results of tasks, which are done at the same time as far as threads are free.

    The first is done in this thread, and then, from the last on, any other that no thread has begun
    by then: nothing waits for work that is only queued, even where a fork left the threads behind.
    """
    others = [_pool().submit(task) for task in tasks[1:]]
    own = [task() for task in tasks[:1]]
    taken = {k: tasks[k]() for k in range(len(others), 0, -1) if others[k - 1].cancel()}
    return own + [taken[k] if k in taken else its.result() for k, its in enumerate(others, 1)]


def shares(count: int, least: int, threads: int) -> list[slice]:
    """Return `count` things as equal shares, at least one.

    Of many things, each thread has several shares: whoever is done first takes one more.

    Args:
        count: How many things.
        least: None has fewer, unless there is only one.
        threads: How many at most.
    """
    parts = max(1, min(threads, count // least))
    if 1 < parts == threads:
        parts *= max(1, min(_SHARES_EACH, count // (2 * least * threads)))
    ends = [count * k // parts for k in range(parts + 1)]
    return [slice(first, last) for first, last in pairwise(ends)]


def both(one: Callable[[], A], other: Callable[[], B]) -> tuple[A, B]:
    """Return the results of two tasks, as above; in turn where OpenCV has one thread."""
    if cv2.getNumThreads() < 2:
        return one(), other()
    its = _pool().submit(one)
    result = other()
    return (one() if its.cancel() else its.result()), result


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(cv2.getNumberOfCPUs(), thread_name_prefix="detect")
