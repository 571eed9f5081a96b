"""Turn any camera into a measuring instrument with printed markers."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tagmetry.camera import Camera as Camera
    from tagmetry.camera import Image as Image
    from tagmetry.detect import Detection as Detection
    from tagmetry.detect import Detector as Detector
    from tagmetry.detect import Tracker as Tracker
    from tagmetry.errors import InputError as InputError
    from tagmetry.files import load_camera as load_camera
    from tagmetry.files import save_camera as save_camera
    from tagmetry.files.maps import load_map as load_map
    from tagmetry.localize import CameraPose as CameraPose
    from tagmetry.localize import Localizer as Localizer
    from tagmetry.localize import MarkerMap as MarkerMap
    from tagmetry.markers import MarkerFamily as MarkerFamily
    from tagmetry.markers import family as family
    from tagmetry.pose import MarkerPose as MarkerPose
    from tagmetry.pose import estimate_body_pose as estimate_body_pose
    from tagmetry.pose import estimate_pose as estimate_pose
    from tagmetry.sources import open_source as open_source

__version__ = "0.1.0"

_HOMES = {
    "Camera": "camera",
    "CameraPose": "localize",
    "Detection": "detect",
    "Detector": "detect",
    "Image": "camera",
    "InputError": "errors",
    "Localizer": "localize",
    "MarkerFamily": "markers",
    "MarkerMap": "localize",
    "MarkerPose": "pose",
    "Tracker": "detect",
    "estimate_body_pose": "pose",
    "estimate_pose": "pose",
    "family": "markers",
    "load_camera": "files",
    "load_map": "files.maps",
    "open_source": "sources",
    "save_camera": "files",
}

__all__ = [
    "Camera",
    "CameraPose",
    "Detection",
    "Detector",
    "Image",
    "InputError",
    "Localizer",
    "MarkerFamily",
    "MarkerMap",
    "MarkerPose",
    "Tracker",
    "__version__",
    "estimate_body_pose",
    "estimate_pose",
    "family",
    "load_camera",
    "load_map",
    "open_source",
    "save_camera",
]


def __getattr__(name: str) -> object:
    """Import on first use, so that `tagmetry --help` does not wait for OpenCV and SciPy."""
    if name not in _HOMES:
        raise AttributeError(f"module 'tagmetry' has no attribute {name!r}")
    return getattr(import_module(f"tagmetry.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
