"""Wheels that follow commands, exactly, while a command is held.

    dx/dt = F x + g u

Their servo is a lag, T dv/dt = u - v + H, and may have an integral against drag, K dH/dt = u - v,
with which a speed overshoots before it is right. A command that an image led to acts `delay` after
it: of one image period the first part belongs to an older command, the rest to the next one.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from tagmetry.geometry import Array


@dataclass(frozen=True, eq=False)
class Held:
    """What a command does that is held for a time.

    Attributes:
        kept: What is left of the state, shape (n, n).
        gained: What the command adds, shape (n,).
    """

    kept: Array
    gained: Array

    def after(self, state: Array, command: Array) -> Array:
        """Return the state at the end, shape (n, m), of m cases at once; command (m,)."""
        return np.asarray(self.kept @ state + np.outer(self.gained, command))


@dataclass(frozen=True, eq=False)
class Wheels:
    """How a robot moves.

    Attributes:
        drift: F, shape (n, n).
        push: g, shape (n,).
    """

    drift: Array
    push: Array

    @classmethod
    def of(cls, moved: Array, motor_s: float, hold_s: float | None) -> "Wheels":
        """Return wheels with a servo.

        Args:
            moved: How places change with the places and, last, with the wheels' speed, shape
                (n, n + 1).
            motor_s: T.
            hold_s: K; None where there is no integral.
        """
        places = len(moved)
        count = places + (1 if hold_s is None else 2)
        drift, push = np.zeros((count, count)), np.zeros(count)
        drift[:places, : places + 1] = moved
        drift[places, places:] = [-1 / motor_s, 1 / motor_s][: count - places]
        push[places] = 1 / motor_s
        if hold_s is not None:
            drift[-1, places], push[-1] = -1 / hold_s, 1 / hold_s
        return cls(drift, push)

    def held(self, duration_s: float) -> Held:
        """Return what a command does that is held so long."""
        count = len(self.push)
        whole = np.zeros((count + 1, count + 1))
        whole[:count, :count], whole[:count, count] = self.drift, self.push
        grown = expm(whole * duration_s)
        return Held(grown[:count, :count], grown[:count, count])


@dataclass(frozen=True)
class Lateness:
    """A delay in image periods.

    Attributes:
        whole: So many of them.
        rest_s: And so much more.
        image_s: One of them.
    """

    whole: int
    rest_s: float
    image_s: float

    @classmethod
    def of(cls, delay_s: float, image_s: float) -> "Lateness":
        """Return a delay in image periods."""
        whole = int(delay_s / image_s + 1e-9)
        return cls(whole, max(delay_s - whole * image_s, 0.0), image_s)


def driven(
    wheels: Wheels, state: Array, sent: Array, command: Array, late: Lateness
) -> tuple[Array, Array]:
    """Return the state at the next image, and what is sent by then.

    Args:
        wheels: What moves.
        state: At this image, shape (n, m).
        sent: The commands of the images before, newest first, shape (whole + 1, m).
        command: That this image leads to, shape (m,).
        late: When it acts.
    """
    known = np.concatenate([command[None], sent])
    state = wheels.held(late.rest_s).after(state, known[late.whole + 1])
    state = wheels.held(late.image_s - late.rest_s).after(state, known[late.whole])
    return state, known[:-1]
