"""A controller: wander, turn away from whoever is near, and stay inside the fence."""

from tagmetry.arena import Fence
from tagmetry.arena.controllers import Shielded, ShieldRules, View
from tagmetry.arena.drive import Twist

FENCE = Fence(((-1.5, -0.8), (1.5, -0.8), (1.5, 0.8), (-1.5, 0.8)))


def wander(view: View) -> Twist:
    """Drive a wide curve, and turn away from the nearest neighbour ahead."""
    ahead = [one for one in view.neighbours if abs(one.bearing_rad) < 1.2]
    if not ahead or min(one.range_m for one in ahead) > 0.5:
        return Twist(0.15, 0.2)
    nearest = min(ahead, key=lambda one: one.range_m)
    return Twist(0.08, -1.5 if nearest.bearing_rad > 0 else 1.5)


control = Shielded(wander, ShieldRules(fence=FENCE))
