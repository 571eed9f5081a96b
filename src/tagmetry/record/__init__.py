"""Results out and in."""

from tagmetry.record.result import ImageResult, MarkerResult

__all__ = ["ImageResult", "MarkerResult"]
