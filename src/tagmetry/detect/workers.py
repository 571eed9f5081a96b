"""Threads that stand by: what compiled loops do, which let go of the interpreter, is shared out."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from itertools import pairwise
from typing import TypeVar

import cv2

A = TypeVar("A")
B = TypeVar("B")


def at_once(tasks: Sequence[Callable[[], A]]) -> list[A]:
    """Return the results of tasks, which are done at the same time as far as threads are free.

    The first is done in this thread, and so is any other that no thread has begun by then: nothing
    waits for work that is only queued, even where a fork left the threads behind.
    """
    others = [(task, _pool().submit(task)) for task in tasks[1:]]
    first = [task() for task in tasks[:1]]
    return first + [task() if its.cancel() else its.result() for task, its in others]


def shares(count: int, least: int, threads: int) -> list[slice]:
    """Return `count` things as equal shares, at least one.

    Args:
        count: How many things.
        least: None has fewer, unless there is only one.
        threads: How many at most.
    """
    parts = max(1, min(threads, count // least))
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
