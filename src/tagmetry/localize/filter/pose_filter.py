"""The pose filter: images at their own times, ambiguous ones too, and late ones in their place.

Every hypothesis of an image meets every branch of the past. What fits grows, what does not fades,
and so both poses of an ambiguous marker live on until the motion or another marker decides. An
image that fits no branch is left out; when a second one says the same, the filter begins anew with
it, for then the past was wrong.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.special import chdtri

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform, pose_difference
from tagmetry.localize.filter.branch import Branch
from tagmetry.localize.filter.motion import Motion
from tagmetry.localize.filter.speeds import Speeds
from tagmetry.localize.result import CameraHypothesis, CameraPose

_GATE = float(chdtri(6, 1e-4))
_MOST = 6
_IMPROBABLE = np.log(1e-6)
_SAME = 0.5  # standard deviations between two branches that are one
_MEMORY_S = 2.0  # how late an image may come
_AGREEING = 2  # images in a row that fit no branch, after which the filter begins anew
_BY_POSE = np.eye(6, 12)


@dataclass(frozen=True, eq=False)
class FilteredPose:
    """Where the camera is at a time.

    Attributes:
        time_s: The time.
        T_world_camera: The most probable branch's pose.
        covariance: Its covariance, shape (6, 6), as `CameraHypothesis` has it.
        probability: Probability of that branch.
        age_s: Time since the last image that was heeded.
        surprise2: Squared innovation of that image by its covariance; 6 on average; NaN where the
            last image was not heeded or was the first.
    """

    time_s: float
    T_world_camera: RigidTransform
    covariance: Array
    probability: float
    age_s: float
    surprise2: float


@dataclass(frozen=True, eq=False)
class _State:
    time_s: float
    branches: tuple[Branch, ...]
    heeded_s: float
    unheeded: int = 0
    surprise2: float = float("nan")


@dataclass
class PoseFilter:
    """Takes what is measured, in any order within two seconds, and says where the camera is.

    Attributes:
        motion: How the camera moves.
    """

    motion: Motion = field(default_factory=Motion)
    _taken: list[tuple[float, CameraPose | Speeds]] = field(default_factory=list)
    _states: list[_State | None] = field(default_factory=list)

    def take(self, time_s: float, measured: CameraPose | Speeds) -> FilteredPose | None:
        """Heed an image's pose, or speeds, and return the pose at the latest time; None before any.

        Raises:
            InputError: The time is not finite, or earlier than the filter remembers.
        """
        if not np.isfinite(time_s):
            raise InputError(f"expected a finite time, got {time_s}")
        if self._taken and time_s < self._taken[0][0]:
            raise InputError(
                f"time runs backwards: {time_s:g} s comes after {self._taken[-1][0]:g} s, which is "
                f"more than the {_MEMORY_S:g} s that are remembered"
            )
        place = sum(one[0] <= time_s for one in self._taken)
        self._taken.insert(place, (time_s, measured))
        del self._states[place:]
        for moment, what in self._taken[place:]:
            before = self._states[-1] if self._states else None
            self._states.append(_taken(before, moment, what, self.motion))
        self._forget()
        return self.at(self._taken[-1][0])

    def at(self, time_s: float) -> FilteredPose | None:
        """Return the pose at a time from the latest measurement on; None before any pose."""
        state = self._states[-1] if self._states else None
        if state is None:
            return None
        if time_s < state.time_s:
            raise InputError(f"expected a time from {state.time_s:g} s on, got {time_s:g} s")
        later = _moved(state, time_s, self.motion)
        weights = np.exp([one.log_weight for one in later.branches])
        best = later.branches[int(np.argmax(weights))]
        return FilteredPose(
            time_s,
            best.T_world_camera,
            best.covariance[:6, :6],
            float(weights.max() / weights.sum()),
            time_s - later.heeded_s,
            later.surprise2,
        )

    def _forget(self) -> None:
        old = sum(one[0] < self._taken[-1][0] - _MEMORY_S for one in self._taken[:-1])
        del self._taken[:old], self._states[:old]


def _taken(
    state: _State | None, time_s: float, measured: CameraPose | Speeds, motion: Motion
) -> _State | None:
    """Return the state after a measurement."""
    if state is not None:
        state = _moved(state, time_s, motion)
    if isinstance(measured, CameraPose):
        return _with_image(state, time_s, measured)
    if state is None:
        return None
    branches = _normalised([measured.corrected(one) for one in state.branches])
    return replace(state, branches=branches)


def _moved(state: _State, time_s: float, motion: Motion) -> _State:
    step_s = time_s - state.time_s
    if step_s == 0:
        return state
    branches = tuple(motion.moved(one, step_s) for one in state.branches)
    return replace(state, time_s=time_s, branches=branches)


def _with_image(state: _State | None, time_s: float, pose: CameraPose) -> _State | None:
    if not pose.hypotheses:
        return state
    if state is None:
        return _begun(time_s, pose)
    pairs = [_met(branch, one) for branch in state.branches for one in pose.hypotheses]
    met = [(branch, surprise2) for branch, surprise2 in pairs if surprise2 <= _GATE]
    if met:
        surprise2 = max(met, key=lambda one: one[0].log_weight)[1]
        branches = _normalised([branch for branch, _ in met])
        return _State(time_s, branches, time_s, 0, surprise2)
    if state.unheeded + 1 >= _AGREEING:
        return _begun(time_s, pose)
    return replace(state, unheeded=state.unheeded + 1, surprise2=float("nan"))


def _begun(time_s: float, pose: CameraPose) -> _State:
    branches = [
        Branch.at_rest(one.T_world_camera, one.covariance, one.probability)
        for one in pose.hypotheses
    ]
    return _State(time_s, _normalised(branches), time_s)


def _met(branch: Branch, one: CameraHypothesis) -> tuple[Branch, float]:
    """Return a branch that heeds one hypothesis of an image, and how surprised it was."""
    innovation = pose_difference(one.T_world_camera, branch.T_world_camera)
    spread = branch.covariance[:6, :6] + one.covariance
    surprise2 = float(innovation @ np.linalg.solve(spread, innovation))
    corrected = branch.corrected(_BY_POSE, one.covariance, innovation)
    share = float(np.log(max(one.probability, 1e-300)))
    return replace(corrected, log_weight=corrected.log_weight + share), surprise2


def _normalised(branches: Sequence[Branch]) -> tuple[Branch, ...]:
    """Return the branches that differ and are not improbable, with weights that add up to one."""
    kept: list[Branch] = []
    for one in sorted(branches, key=lambda one: -one.log_weight):
        twin = next((n for n, other in enumerate(kept) if _deviations(one, other) < _SAME), None)
        if twin is not None:
            weight = float(np.logaddexp(kept[twin].log_weight, one.log_weight))
            kept[twin] = replace(kept[twin], log_weight=weight)
        elif not kept or (len(kept) < _MOST and one.log_weight > kept[0].log_weight + _IMPROBABLE):
            kept.append(one)
    total = float(np.logaddexp.reduce([one.log_weight for one in kept]))
    return tuple(replace(one, log_weight=one.log_weight - total) for one in kept)


def _deviations(one: Branch, other: Branch) -> float:
    apart = pose_difference(one.T_world_camera, other.T_world_camera)
    distance2 = float(apart @ np.linalg.solve(other.covariance[:6, :6], apart))
    return float(np.sqrt(max(distance2, 0.0)))
