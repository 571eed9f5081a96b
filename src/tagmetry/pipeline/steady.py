"""Long runs without long pauses.

A look for garbage through all that a program holds takes 100 to 150 ms beside these libraries, and
comes at any time. What is there when a run begins is therefore left out of it until the run ends.
"""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def steady() -> Iterator[None]:
    """Keep looks for garbage short until the block ends."""
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()
