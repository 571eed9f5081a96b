"""The camera model, its images, and what a source of images must be."""

from tagmetry.camera.bank import Approach, BankNode, CameraBank, Gap, LeftOut, Repeat
from tagmetry.camera.brown_lens import BrownLens
from tagmetry.camera.controls import (
    Control,
    ControlledSource,
    ControlMisreadError,
    ControlRefusedError,
    Controls,
    ControlStuckError,
)
from tagmetry.camera.fisheye_lens import FisheyeLens
from tagmetry.camera.image import Image
from tagmetry.camera.lens import Lens
from tagmetry.camera.model import Camera
from tagmetry.camera.monotonic import DistortionReach, distortion_reach
from tagmetry.camera.resize import cropped, rotated, scaled, zoomed
from tagmetry.camera.restored import restored
from tagmetry.camera.source import Source
from tagmetry.camera.verified import VerifiedControls

__all__ = [
    "Approach",
    "BankNode",
    "BrownLens",
    "Camera",
    "CameraBank",
    "Control",
    "ControlMisreadError",
    "ControlRefusedError",
    "ControlStuckError",
    "ControlledSource",
    "Controls",
    "DistortionReach",
    "FisheyeLens",
    "Gap",
    "Image",
    "LeftOut",
    "Lens",
    "Repeat",
    "Source",
    "VerifiedControls",
    "cropped",
    "distortion_reach",
    "restored",
    "rotated",
    "scaled",
    "zoomed",
]
