"""Where it is worth to look at an image once more, and closely."""

from tagmetry.detect.again.where import NOWHERE, Box, again

__all__ = ["NOWHERE", "Box", "again"]
