"""The running measurement: images in, results out."""

from tagmetry.pipeline.measurement import Measurement, Sizes
from tagmetry.pipeline.opening import open_images, tells_camera

__all__ = ["Measurement", "Sizes", "open_images", "tells_camera"]
