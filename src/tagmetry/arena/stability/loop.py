"""A follower's loop as a linear system from image to image, and how far it is from swinging up.

    s' = A s + b u + B w,    c = C s + D w

s is the state at an image, u the command that its wheels get, c the command that its controller
gives, w what comes from outside. Driven by its own commands, u = c, the state decays while all
eigenvalues of A + b C lie within the unit circle.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from tagmetry.geometry import Array


class Step(Protocol):
    """What happens from one image to the next, linear in all that it is given.

    Attributes:
        size: Length of the state.
        outside: How many values come from outside.
    """

    @property
    def size(self) -> int: ...  # noqa: D102
    @property
    def outside(self) -> int: ...  # noqa: D102

    def __call__(self, state: Array, command: Array, outside: Array) -> tuple[Array, Array]:
        """Return the next state, shape (size, m), and the controller's command, shape (m,)."""


@dataclass(frozen=True, eq=False)
class Loop:
    """The system's matrices.

    Attributes:
        own: A, shape (n, n).
        push: b, of the wheels' command, shape (n,).
        outer: B, shape (n, k).
        answer: C, the controller's command, shape (n,).
        direct: D, shape (k,).
    """

    own: Array
    push: Array
    outer: Array
    answer: Array
    direct: Array

    @classmethod
    def of(cls, step: Step) -> "Loop":
        """Return the matrices of a step: what it makes of one unit at a time."""
        size = step.size
        units = np.eye(size + 1 + step.outside)
        after, command = step(units[:size], units[size], units[size + 1 :])
        return cls(
            after[:, :size],
            after[:, size],
            after[:, size + 1 :],
            command[:size],
            command[size + 1 :],
        )

    def closed(self, factor: complex = 1.0) -> "Array":
        """Return A + f b C: the wheels get f times the controller's command."""
        return np.asarray(self.own + factor * np.outer(self.push, self.answer))

    def driven(self) -> Array:
        """Return B + b D: what comes from outside, in the closed loop."""
        return np.asarray(self.outer + np.outer(self.push, self.direct))

    def swing(self, factor: complex = 1.0) -> float:
        """Return by how much the slowest motion grows from image to image; below 1 it decays."""
        return float(np.abs(np.linalg.eigvals(self.closed(factor))).max())


@dataclass(frozen=True)
class Margins:
    """How far a loop is from swinging up.

    Attributes:
        gain: By what factor its wheels may answer too strongly.
        phase_rad: By how much a motion may be shifted, either way.
        delay_s: How much later than told its commands may act.
    """

    gain: float
    phase_rad: float
    delay_s: float

    @property
    def is_stable(self) -> bool:
        """Whether it decays as it is."""
        return self.gain > 1


UNSTABLE = Margins(1.0, 0.0, 0.0)
_GAINS = tuple(np.geomspace(1.0, 100.0, 60).tolist())
_PHASES_RAD = tuple(np.linspace(0.0, np.pi, 61).tolist())
_DELAYS_S = tuple(np.linspace(0.0, 1.0, 101).tolist())


def margins(loop_at: Callable[[float], Loop]) -> Margins:
    """Return the margins of a loop, which is given for any delay beyond the told one, s."""
    loop = loop_at(0.0)
    if loop.swing() >= 1:
        return UNSTABLE
    return Margins(
        edge(loop.swing, _GAINS),
        edge(lambda phase_rad: loop.swing(np.exp(-1j * phase_rad)), _PHASES_RAD),
        edge(lambda untold_s: loop_at(untold_s).swing(), _DELAYS_S),
    )


def edge(swing: Callable[[float], float], tried: tuple[float, ...]) -> float:
    """Return the first value at which a loop swings up: between two tried ones, halved 20 times.

    Infinite where none of the tried ones lets it swing up.
    """
    above = next((n for n, value in enumerate(tried) if swing(value) >= 1), None)
    if above is None:
        return float("inf")
    calm, wild = tried[max(above - 1, 0)], tried[above]
    for _ in range(20):
        middle = (calm + wild) / 2
        calm, wild = (calm, middle) if swing(middle) >= 1 else (middle, wild)
    return calm
