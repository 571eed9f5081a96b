"""Where the camera is: one or more hypotheses with their covariances, and what they rest on."""

from dataclasses import dataclass

from scipy.special import chdtri

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform, UncertainTransform
from tagmetry.markers.bodies import MarkerKey

_CHANCE = 0.01


@dataclass(frozen=True)
class Rejection:
    """A marker of the image that did not help, and why.

    Attributes:
        key: Family and id.
        why: The reason in words.
    """

    key: MarkerKey
    why: str


@dataclass(frozen=True, eq=False)
class CameraHypothesis:
    """One of the camera poses that explain what was seen.

    Attributes:
        T_world_camera: The camera in the world.
        covariance: Shape (6, 6), (translation, rotation vector) on the left in the world frame, m
            and rad; from the corners' noise and the map's, not from the calibration's.
        probability: Probability that this and not another of the hypotheses is the true one.
        used: The markers that it rests on.
        rejected: Known markers that disagree with it.
        chi2: Squared residuals by their covariance; NaN where the method has none.
        freedom: By how many numbers what was seen exceeds what was asked; 0 where it has none.
    """

    T_world_camera: RigidTransform
    covariance: Array
    probability: float
    used: tuple[MarkerKey, ...]
    rejected: tuple[Rejection, ...] = ()
    chi2: float = float("nan")
    freedom: int = 0

    @property
    def uncertain(self) -> UncertainTransform:
        """The pose with its covariance, ready to be chained."""
        return UncertainTransform(self.T_world_camera, self.covariance)


@dataclass(frozen=True, eq=False)
class CameraPose:
    """What one image says of the camera's pose in the world.

    Attributes:
        method: How it was computed.
        hypotheses: By falling probability; none where the image does not tell the pose.
        passed_over: Markers of the image that no hypothesis could use: unknown ones, those seen
            twice, those whose numbers are unusable.
        why: Why there is no pose; empty where there is one.
    """

    method: str
    hypotheses: tuple[CameraHypothesis, ...]
    passed_over: tuple[Rejection, ...] = ()
    why: str = ""

    @property
    def best(self) -> CameraHypothesis:
        """The most probable hypothesis."""
        if not self.hypotheses:
            raise InputError(f"no camera pose: {self.why}; check `hypotheses` before asking")
        return self.hypotheses[0]

    @property
    def alternatives(self) -> tuple[CameraHypothesis, ...]:
        """The others."""
        return self.hypotheses[1:]

    @property
    def T_world_camera(self) -> RigidTransform:  # noqa: N802 (a frame's name)
        """The best hypothesis's pose."""
        return self.best.T_world_camera

    @property
    def covariance(self) -> Array:
        """Covariance of the best hypothesis, shape (6, 6)."""
        return self.best.covariance

    @property
    def ambiguity(self) -> float:
        """Probability that the best hypothesis is a wrong one."""
        return 1.0 - self.best.probability

    @property
    def used(self) -> tuple[MarkerKey, ...]:
        """The markers that the best hypothesis rests on; none where there is no pose."""
        return self.hypotheses[0].used if self.hypotheses else ()

    @property
    def rejected(self) -> tuple[Rejection, ...]:
        """Every marker of the image that did not help the best hypothesis, and why."""
        return (*self.passed_over, *(self.hypotheses[0].rejected if self.hypotheses else ()))


def excess(chi2: float, freedom: int) -> float:
    """Return by what covariances grow: chi2 by its freedom, where noise seldom gives as much.

    Seldom is less than once in a hundred times.
    """
    if freedom < 1 or chi2 < chdtri(freedom, _CHANCE):
        return 1.0
    return chi2 / freedom
