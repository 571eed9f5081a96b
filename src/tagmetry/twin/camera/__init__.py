"""Simulated cameras with controls, behind the same interfaces as real ones."""

from tagmetry.twin.camera.camera import TwinCamera
from tagmetry.twin.camera.device import Breathing, Device
from tagmetry.twin.camera.dials import TwinControls
from tagmetry.twin.camera.faults import Faults
from tagmetry.twin.camera.focus_law import DioptreFocus, FixedFocus, FocusLaw, LogFocus
from tagmetry.twin.camera.models import mono_camera, overhead_camera, webcam
from tagmetry.twin.camera.ready import (
    READY_CAMERAS,
    BeforeCamera,
    facing_camera,
    marker_before_camera,
    markers_before_camera,
    ready_camera,
)
from tagmetry.twin.camera.setting import Setting

__all__ = [
    "READY_CAMERAS",
    "BeforeCamera",
    "Breathing",
    "Device",
    "DioptreFocus",
    "Faults",
    "FixedFocus",
    "FocusLaw",
    "LogFocus",
    "Setting",
    "TwinCamera",
    "TwinControls",
    "facing_camera",
    "marker_before_camera",
    "markers_before_camera",
    "mono_camera",
    "overhead_camera",
    "ready_camera",
    "webcam",
]
