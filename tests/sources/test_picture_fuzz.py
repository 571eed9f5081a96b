"""Whatever is done to a picture's bytes, it is read or refused: nothing else."""

import cv2
import numpy as np
import pytest
from encoded_pictures import encode, png, smooth, tiff

from tagmetry.errors import InputError
from tagmetry.sources import decode_picture

SEEDS = (
    *(encode(suffix, smooth()) for suffix in (".png", ".jpg", ".bmp", ".tif", ".webp", ".ppm")),
    cv2.imencode(".jpg", smooth(), [cv2.IMWRITE_JPEG_PROGRESSIVE, 1])[1].tobytes(),
    cv2.imencode(".webp", smooth(), [cv2.IMWRITE_WEBP_QUALITY, 101])[1].tobytes(),
    tiff(smooth(1)),
    tiff(smooth(1), 6, big=True),
    png(3, 2, b"\0\1\2\3\0\4\5\6"),
    b"P2\n# text\n3 2\n255\n1 2 3 4 5 6\n",
)


def mutated(rng):
    """Flip bytes (mostly of the header), cut, repeat or splice."""
    content = bytearray(SEEDS[rng.integers(len(SEEDS))])
    reach = min(len(content), 64) if rng.random() < 0.7 else len(content)
    for place in rng.integers(0, reach, rng.integers(1, 6)):
        content[place] = rng.choice([0, 1, 0x7F, 0x80, 0xFF, rng.integers(256)])
    if rng.random() < 0.3:
        content = content[: rng.integers(len(content) + 1)]
    if rng.random() < 0.1:
        content += SEEDS[rng.integers(len(SEEDS))]
    return bytes(content)


def read_or_refuse(cases, seed):
    rng, refused = np.random.default_rng(seed), 0
    for _ in range(cases):
        try:
            pixels = decode_picture(mutated(rng))
        except InputError:
            refused += 1
        else:
            assert pixels.size
            assert pixels.dtype in (np.uint8, np.uint16)
    return refused


def test_mutated_pictures_are_read_or_refused():
    refused = read_or_refuse(600, seed=1)
    assert 200 < refused < 600  # the mutations reach both ends


@pytest.mark.slow
def test_many_mutated_pictures_are_read_or_refused():
    read_or_refuse(20_000, seed=2)


def test_random_bytes_behind_every_signature():
    rng = np.random.default_rng(3)
    for signature in (b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"II*\0", b"MM\0+", b"P6 ", b"BM"):
        for _ in range(30):
            with pytest.raises(InputError):
                decode_picture(signature + rng.bytes(rng.integers(200)))
