"""The follower's loop along the line to its leader, linear while both go straight.

From image to image, with everything along that line and as seen from the follower's own place when
its command acts (`controllers.leader_follower`, `controllers.leader_motion`):

    own motion    m' = c + exp(-h / T) (m - c)         its last command, after the motors' lag
    sighting      g - (what it drives in the delay)    g is the leader's place less its own
    leader        place z and speed u by alpha and beta, then z + delay u
    spring        dV = h (w^2 (z + delay u - length) + 2 z w (u - V))
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.arena.stability.period import Period
from tagmetry.arena.stability.wheels import driven
from tagmetry.geometry import Array

PLACE = 0  # of the state: the follower's own
LEADER, LENGTH = 0, 1  # of what comes from outside: the leader's place, the spring's length


@dataclass(frozen=True)
class Along(Period):
    """One image period; the state is the robot's, commands sent, own motions, z, u and V."""

    def __call__(self, state: Array, command: Array, outside: Array) -> tuple[Array, Array]:
        """Return the next state, and the controller's command."""
        robot, sent, motions, (place, speed, wish) = np.split(state, self._ends)
        motions = self._own(motions, wish)
        seen = outside[LEADER] - robot[PLACE] - self._driven_since(motions)
        place, speed = self._leader(place, speed, motions[0], seen)
        wish = self._pulled(place, speed, wish, outside[LENGTH])
        robot, sent = driven(self._wheels, robot, sent, command, self._acting)
        return np.concatenate([robot, sent, motions, [place, speed, wish]]), wish

    @property
    def _known(self) -> int:
        return 3

    @property
    def _moved(self) -> Array:
        return np.array([[0.0, 1.0]])

    def _driven_since(self, motions: Array) -> Array:
        """Return what it drives between an image and the command, as it believes."""
        late = self._told
        whole = late.image_s * motions[: late.whole].sum(axis=0)
        return np.asarray(whole + late.rest_s * motions[late.whole])

    def _leader(self, place: Array, speed: Array, own: Array, seen: Array) -> tuple[Array, Array]:
        setting = self.setting
        expected = place + setting.image_s * (speed - own)
        off = seen - expected
        speed = speed + setting.motion_share * off / setting.image_s
        return expected + setting.place_share * off, speed

    def _pulled(self, place: Array, speed: Array, wish: Array, length: Array) -> Array:
        setting, spring = self.setting, self.setting.spring
        stretch = place + setting.delay_s * speed - length
        drag = 2 * spring.damping * spring.stiffness_per_s * (speed - wish)
        return wish + setting.image_s * (spring.stiffness_per_s**2 * stretch + drag)
