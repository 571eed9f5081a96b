"""What the detector sees at each step of its way, as values that can be drawn.

Nothing here is used for detecting: the same image goes through the same steps once more, and what
the detector forgets is kept.
"""

from tagmetry.detect.stages.stages import Stages, look_through

__all__ = ["Stages", "look_through"]
