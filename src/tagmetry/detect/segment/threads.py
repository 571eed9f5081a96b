"""Several kernels at once: they let go of the interpreter."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Given = TypeVar("Given")
Result = TypeVar("Result")


def all_of(
    function: Callable[[Given], Result], arguments: Sequence[Given], threads: int
) -> list[Result]:
    """Return what a function gives for each argument, in order.

    Args:
        function: What may run in several threads at once.
        arguments: Of each call; the first is made by the calling thread.
        threads: How many to use at most, the calling one among them.
    """
    if min(threads, len(arguments)) < 2:
        return [function(one) for one in arguments]
    with ThreadPoolExecutor(min(threads, len(arguments)) - 1) as pool:
        others = [pool.submit(function, one) for one in arguments[1:]]
        return [function(arguments[0]), *(other.result() for other in others)]
