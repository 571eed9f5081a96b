"""Which corners of a body agree on a pose, and the pose that they agree on.

Mostly all do: one least-squares fit explains every corner by its noise, and nothing is left to do.
Otherwise corners are weighted by Cauchy's rule, which hardly heeds those far off, and then the pose
is fitted to the corners within the gate until they stay the same.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag
from scipy.special import chdtri

from tagmetry.camera import Camera
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers.bodies import MarkerKey
from tagmetry.pose.refine import Fit, refine
from tagmetry.pose.stacks import Poses, Sightings
from tagmetry.pose.whitening import whitening

GATE = 16.3  # chi2 with 2 degrees of freedom: one good corner in 3500 is turned away
_MEDIAN = 1.386  # median of chi2 with 2 degrees of freedom
_CAUCHY = 5.7  # Cauchy's tuning constant squared: 95 % efficient on clean noise
_ROUNDS = 8
_STEADY = 0.01  # weights that change less than this are settled
_CHANCE = 0.01
_FAR = 1e12  # stands for an infinite squared distance


@dataclass(frozen=True)
class BodyCorners:
    """The corners of m markers of one body.

    Attributes:
        keys: The markers.
        p_body: Their corners in the body's frame, shape (m, 4, 3), metres.
        pixels: Where they were seen, shape (m, 4, 2).
        covariances_px2: Shape (m, 8, 8).
    """

    keys: tuple[MarkerKey, ...]
    p_body: Array
    pixels: Array
    covariances_px2: Array

    def sightings(self, widening: Array) -> Sightings:
        """Return all corners as one sighting, each one's noise widened by a factor (m, 4)."""
        factors = np.repeat(widening, 2, axis=1)
        W = whitening(factors[:, :, None] * self.covariances_px2 * factors[:, None, :])
        return Sightings(
            self.p_body.reshape(1, -1, 3), self.pixels.reshape(1, -1, 2), block_diag(*W)[None]
        )

    def agreeing(self, agrees: BoolArray) -> Sightings:
        """Return all corners as one sighting; those that do not agree (m, 4) add nothing."""
        return self.sightings(np.where(agrees, 1.0, 1e6))

    def distances2(self, poses: Poses, camera: Camera) -> Array:
        """Return the corners' squared residuals, each by its own covariance, shape (n, m, 4)."""
        projected = camera.project(poses.points(self.p_body.reshape(1, -1, 3)))
        error = projected.reshape(-1, *self.pixels.shape) - self.pixels
        corner = np.arange(4)
        blocks = self.covariances_px2.reshape(-1, 4, 2, 4, 2)[:, corner, :, corner]  # (4, m, 2, 2)
        information = np.linalg.inv(np.swapaxes(blocks, 0, 1))
        distances2 = np.einsum("nmci,mcij,nmcj->nmc", error, information, error)
        return np.where(distances2 < _FAR, distances2, _FAR)


@dataclass(frozen=True)
class Agreement:
    """A refined pose and the corners that agree with it.

    Attributes:
        fit: One pose, fitted to the agreeing corners.
        agrees: Shape (m, 4).
        spread2: By how much the corners' variances are exceeded, robustly; at least 1.
    """

    fit: Fit
    agrees: BoolArray
    spread2: float

    @property
    def chi2(self) -> float:
        """Squared whitened residuals of the agreeing corners."""
        return float(self.fit.chi2[0])

    @property
    def freedom(self) -> int:
        """By how many the agreeing coordinates outnumber the pose's six."""
        return 2 * int(self.agrees.sum()) - 6


def agreements(starts: Poses, corners: BodyCorners, camera: Camera) -> list[Agreement]:
    """Return what each of n starting poses leads to."""
    plain = _plain(starts, corners, camera)
    if any(_explains_all(agreement, corners, camera) for agreement in plain):
        return plain
    count = len(starts.t_camera_body)
    return [_settled(starts[n : n + 1], corners, camera) for n in range(count)]


def is_chance(chi2: float, freedom: int) -> bool:
    """Say whether noise alone gives such a chi2 more often than once in a hundred times."""
    return freedom < 1 or bool(chi2 < chdtri(freedom, _CHANCE))


def _plain(starts: Poses, corners: BodyCorners, camera: Camera) -> list[Agreement]:
    """Refine the poses on all corners."""
    count = len(starts.t_camera_body)
    all_agree = np.ones(corners.pixels.shape[:2], dtype=bool)
    fit = refine(starts, corners.agreeing(all_agree).repeated(count), camera)
    return [Agreement(fit[n : n + 1], all_agree, 1.0) for n in range(count)]


def _explains_all(plain: Agreement, corners: BodyCorners, camera: Camera) -> bool:
    near = (corners.distances2(plain.fit.poses, camera) <= GATE).all()
    return bool(near) and is_chance(plain.chi2, plain.freedom)


def _settled(start: Poses, corners: BodyCorners, camera: Camera) -> Agreement:
    """Refine with Cauchy's weights, then on the corners that agree until they stay the same."""
    pose = _reweighted(start, corners, camera)
    settled = _agreement(pose, corners, camera)
    for _ in range(_ROUNDS):
        before, settled = settled, _agreement(settled.fit.poses, corners, camera)
        if (before.agrees == settled.agrees).all():
            break
    return settled


def _agreement(pose: Poses, corners: BodyCorners, camera: Camera) -> Agreement:
    """Refine a pose on the corners that agree with it."""
    distances2, spread2 = _spread(pose, corners, camera)
    agrees = distances2 <= GATE * spread2
    return Agreement(refine(pose, corners.agreeing(agrees), camera), agrees, spread2)


def _reweighted(pose: Poses, corners: BodyCorners, camera: Camera) -> Poses:
    """Refine with weights that fall with each corner's distance until they stay the same."""
    widening = np.zeros(corners.pixels.shape[:2])
    for _ in range(_ROUNDS):
        distances2, spread2 = _spread(pose, corners, camera)
        before, widening = widening, np.sqrt(1 + distances2 / (_CAUCHY * spread2))
        if (np.abs(widening - before) <= _STEADY * widening).all():
            break
        pose = refine(pose, corners.sightings(widening), camera, max_iterations=1).poses
    return pose


def _spread(pose: Poses, corners: BodyCorners, camera: Camera) -> tuple[Array, float]:
    """Return the corners' squared distances, and how far their median exceeds what is expected."""
    distances2 = corners.distances2(pose, camera)[0]
    return distances2, max(1.0, float(np.median(distances2)) / _MEDIAN)
