"""Looks for garbage in a long run: what was there before is left out, what is new is not."""

import gc
import weakref

import pytest

from tagmetry.pipeline.steady import steady


class Ring:
    """Holds itself."""

    def __init__(self) -> None:
        self.me = self


def test_what_was_there_before_is_left_out_until_the_end() -> None:
    old = Ring()
    gone = weakref.ref(old)
    with steady():
        assert gc.get_freeze_count() > 10_000
        del old
        gc.collect()
        assert gone() is not None
    assert gc.get_freeze_count() == 0
    gc.collect()
    assert gone() is None


def test_garbage_of_the_run_itself_is_found() -> None:
    with steady():
        gone = weakref.ref(Ring())
        gc.collect()
        assert gone() is None


def test_it_ends_with_an_error_too() -> None:
    with pytest.raises(KeyboardInterrupt), steady():
        raise KeyboardInterrupt
    assert gc.get_freeze_count() == 0
