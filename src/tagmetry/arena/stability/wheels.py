"""Wheels that follow commands with a first-order lag, between two images; exact.

    dx/dt = F x + g u,  u held from command to command

A command that an image led to acts `delay` after it: of one image period the first part belongs to
an older command, the rest to the next one.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from tagmetry.geometry import Array


@dataclass(frozen=True, eq=False)
class Wheels:
    """How a robot moves.

    Attributes:
        drift: F, shape (n, n).
        push: g, shape (n,).
    """

    drift: Array
    push: Array

    def after(self, state: Array, command: Array, duration_s: float) -> Array:
        """Return the state after a time in which one command acts.

        Args:
            state: Shape (n, m): of m cases at once.
            command: Shape (m,).
            duration_s: At least 0.
        """
        count = len(self.push)
        whole = np.zeros((count + 1, count + 1))
        whole[:count, :count], whole[:count, count] = self.drift, self.push
        grown = expm(whole * duration_s)
        return np.asarray(grown[:count, :count] @ state + np.outer(grown[:count, count], command))


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
    state = wheels.after(state, known[late.whole + 1], late.rest_s)
    state = wheels.after(state, known[late.whole], late.image_s - late.rest_s)
    return state, known[:-1]
