"""The engines that there are."""

from collections.abc import Sequence
from importlib.util import find_spec

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.lab.engines.engine import EngineKind
from tagmetry.markers.apriltag3 import APRILTAG3

OURS = "tagmetry"
TRACKER = "tagmetry-track"
_HERE = "tagmetry.lab.engines"
_ARUCO = frozenset(
    {f"{n}x{n}_{count}" for n in (4, 5, 6, 7) for count in (50, 100, 250, 1000)}
    | {"aruco_original", "aruco_mip_36h12", "tag16h5", "tag25h9", "tag36h10", "tag36h11"}
)
_APRILTAG = frozenset({"tag16h5", "tag25h9", "tag36h11", *APRILTAG3})
_LOCUS = frozenset({"tag16h5", "tag36h11", "4x4_50", "4x4_100", "6x6_250", "aruco_mip_36h12"})

KINDS = (
    EngineKind(OURS, f"{_HERE}.own:WholeImage", None, "tagmetry"),
    EngineKind(TRACKER, f"{_HERE}.tracker:Tracking", None, "tagmetry", tracks=True),
    EngineKind("opencv-none", f"{_HERE}.opencv:none", _ARUCO, "OpenCV"),
    EngineKind("opencv-subpix", f"{_HERE}.opencv:subpix", _ARUCO, "OpenCV"),
    EngineKind("opencv-contour", f"{_HERE}.opencv:contour", _ARUCO, "OpenCV"),
    EngineKind("opencv-apriltag", f"{_HERE}.opencv:apriltag", _ARUCO, "OpenCV"),
    EngineKind("apriltag", f"{_HERE}.apriltag:whole", _APRILTAG, "AprilTag", "pyapriltags"),
    EngineKind("apriltag-2", f"{_HERE}.apriltag:decimated", _APRILTAG, "AprilTag", "pyapriltags"),
    EngineKind("locus", f"{_HERE}.locus:Locus", _LOCUS, "locus", "locus"),
)


def engine_names() -> tuple[str, ...]:
    """Return the names of all engines."""
    return tuple(kind.name for kind in KINDS)


def installed() -> tuple[EngineKind, ...]:
    """Return the engines that can run here."""
    return tuple(kind for kind in KINDS if _is_here(kind))


def missing() -> tuple[str, ...]:
    """Return the names of the engines that cannot run here."""
    return tuple(kind.name for kind in KINDS if not _is_here(kind))


def chosen(names: Sequence[str]) -> tuple[EngineKind, ...]:
    """Return engines by name, ours among them, since all else is compared with it.

    Raises:
        InputError: There is no such engine.
        MissingExtraError: It is not installed.
    """
    by_name = {kind.name: kind for kind in KINDS}
    for name in names:
        if name not in by_name:
            raise InputError(f"unknown engine {name!r}; there are {', '.join(by_name)}")
        if name in missing():
            raise MissingExtraError(f"the engine {name}", "bench")
    return tuple(kind for kind in KINDS if kind.name in {OURS, *names})


def _is_here(kind: EngineKind) -> bool:
    return find_spec(kind.needs) is not None
