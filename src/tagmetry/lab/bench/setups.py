"""The rendered cases that there are."""

from dataclasses import replace

from tagmetry.lab.bench.setup import Setup

_EXACT_IMAGES = 8  # of 24 markers: the mean squared distance of 8 is then known to 0.3


def _exact(side_px: float, decibels: int, exponent: float) -> Setup:
    """Return what corners and their covariances are judged on.

    Args:
        side_px: Of the markers.
        decibels: Contrast by noise, both in grey values.
        exponent: Of the response.
    """
    name = f"exact-{side_px:g}-{decibels}dB" + ("-gamma" if exponent != 1.0 else "")
    setup = Setup(name, side_px=side_px, exponent=exponent, images=_EXACT_IMAGES)
    black, white = setup.levels_grey
    return replace(setup, noise=(white - black) / 10 ** (decibels / 20))


EXACT = tuple(
    _exact(side_px, decibels, exponent)
    for exponent in (1.0, 2.2)
    for decibels in (20, 40)
    for side_px in (30.0, 60.0, 100.0)
)
SETUPS = (
    Setup("count-24", extent="quick", all_threads=True),
    Setup("noise-8", noise=8.0, extent="default"),
    Setup("gamma-60", exponent=2.2, extent="default"),
    Setup("film-24", images=12, is_film=True, extent="quick", all_threads=True),
    Setup("none", count=0, extent="default"),
    Setup("plain", cluttered=False, extent="default"),
    Setup("side-12", side_px=12.0, extent="full"),
    Setup("side-16", side_px=16.0, extent="default"),
    Setup("side-20", side_px=20.0, extent="default"),
    Setup("side-30", side_px=30.0, extent="default"),
    Setup("side-100", side_px=100.0, extent="default"),
    Setup("side-200", count=12, side_px=200.0),
    Setup("count-1", count=1, extent="default"),
    Setup("count-6", count=6),
    Setup("count-96", count=96, side_px=36.0, extent="default"),
    Setup("count-360", count=360, side_px=36.0, extent="default", all_threads=True),
    Setup("noise-0", noise=0.0),
    Setup("noise-16", noise=16.0, extent="default"),
    Setup("noise-8-30", side_px=30.0, noise=8.0),
    Setup("noise-8-100", side_px=100.0, noise=8.0),
    Setup("gamma-30", side_px=30.0, exponent=2.2, extent="default"),
    Setup("gamma-100", side_px=100.0, exponent=2.2),
    Setup("blur-0.3", blur_px=0.3),
    Setup("blur-1.5", blur_px=1.5, extent="default"),
    Setup("size-480p", count=6, size_px=(640, 480), extent="default"),
    Setup("size-720p", count=6, size_px=(1280, 720)),
    Setup("size-4k", size_px=(3840, 2160), all_threads=True),
    Setup("film-96", count=96, side_px=36.0, images=12, is_film=True),
    Setup("film-360", count=360, side_px=36.0, images=12, is_film=True, all_threads=True),
    *EXACT,
)
