"""Images know their size, and sources are recognised by their shape."""

from collections.abc import Iterator
from types import TracebackType
from typing import Self

import numpy as np
import pytest

from tagmetry.camera import Image, Source


@pytest.mark.parametrize("shape", [(480, 640), (480, 640, 3)])
def test_width_counts_columns_and_height_rows(shape: tuple[int, ...]) -> None:
    image = Image(np.zeros(shape, np.uint8))
    assert (image.width_px, image.height_px) == (640, 480)


def test_a_still_picture_has_no_time() -> None:
    image = Image(np.zeros((2, 2), np.uint8))
    assert (image.time_s, image.time_kind, image.sequence, image.camera) == (0.0, "none", 0, None)


class OnePicture:
    name, is_live, length = "one", False, 1

    def __iter__(self) -> Iterator[Image]:
        yield Image(np.zeros((2, 2), np.uint8))

    def close(self) -> None:
        pass

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def test_a_source_is_whatever_gives_images() -> None:
    assert isinstance(OnePicture(), Source)
    assert not isinstance([Image(np.zeros((2, 2), np.uint8))], Source)
