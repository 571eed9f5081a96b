"""What a pose estimate is: one or two hypotheses, each with its own uncertainty."""

from dataclasses import dataclass

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform, UncertainTransform


@dataclass(frozen=True, eq=False)
class PoseHypothesis:
    """One of the poses that explain what was seen.

    Attributes:
        T_camera_marker: The marker (or body) in the camera frame.
        covariance: Shape (6, 6), (translation, rotation vector) on the left in the camera frame, m
            and rad. It carries the corners' noise only: not the size, not the calibration.
        reprojection_rms_px: Root mean square distance between seen and projected corners.
        chi2: Squared residuals weighted by the corners' covariance.
        probability: Probability that this and not another of the hypotheses is the true one.
    """

    T_camera_marker: RigidTransform
    covariance: Array
    reprojection_rms_px: float
    chi2: float
    probability: float

    @property
    def uncertain(self) -> UncertainTransform:
        """The pose with its covariance, ready to be chained."""
        return UncertainTransform(self.T_camera_marker, self.covariance)


@dataclass(frozen=True)
class MarkerPose:
    """The pose of a flat marker: the likelier hypothesis first.

    Attributes:
        family: Family of the marker.
        id: Its id.
        size_m: Side of its black square that the pose was computed with.
        hypotheses: One or two, by falling probability; one where only one minimum exists; none
            where the corners show no marker in front of the camera.
    """

    family: str
    id: int
    size_m: float
    hypotheses: tuple[PoseHypothesis, ...]

    @property
    def best(self) -> PoseHypothesis:
        """The most probable hypothesis."""
        if not self.hypotheses:
            raise InputError(
                f"{self.family} id {self.id} has no pose: its corners are not those of a marker "
                "seen from the front; check `hypotheses` before asking for the best"
            )
        return self.hypotheses[0]

    @property
    def alternatives(self) -> tuple[PoseHypothesis, ...]:
        """The others."""
        return self.hypotheses[1:]

    @property
    def covariance(self) -> Array:
        """Covariance of the best hypothesis, shape (6, 6)."""
        return self.best.covariance

    @property
    def ambiguity(self) -> float:
        """Probability that the best hypothesis is the wrong one, 0 to 0.5."""
        return 1.0 - self.best.probability
