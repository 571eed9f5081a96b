"""The running measurement: images in, results out."""

from tagmetry.pipeline.measurement import Measurement, Sizes

__all__ = ["Measurement", "Sizes"]
