"""Distance, yaw and number of markers beside what seed 002 says of its figures."""

from collections.abc import Sequence

from tagmetry.lab.beside.sample import sample
from tagmetry.lab.beside.seed002_yaw_checks import every_check
from tagmetry.lab.beside.seed002_yaw_figures import every_figure
from tagmetry.lab.beside.seed002_yaw_halves import half_checks, halves
from tagmetry.lab.beside.seed002_yaw_tables import by_distance, by_method, consistency
from tagmetry.lab.conclusions import Conclusions
from tagmetry.lab.published.seed002 import seed002
from tagmetry.lab.rows import Localization

_SETUP = (
    "The paper tells neither side nor focal length nor inclination: markers of 200 mm, 60 degrees "
    "of view (554 px) and 40 degrees are taken. Simulator: 0.5 px of blur, noise of 1 grey value; "
    "webcam: 1 px, 4 grey values, JPEG. The camera stands up to 5 mm and 0.5 degrees off at random."
)

_COVARIANCE = (
    "Stated covariances are too large on the simulator's clean pictures (the mean squared "
    "Mahalanobis distance is below 6): the corners' have a floor for blur that is sharp on whole "
    "pixels. They are too small for one marker that faces the camera far off, as the webcam's rows "
    "show: its lean is not normal, and corners with exactly the stated noise give the same."
)


def conclude(rows: Sequence[Localization]) -> Conclusions:
    """Return the statements, the trends, every method, and figures 4 to 6 and 13 to 25."""
    everything = sample(rows)
    exact = everything.where(look="simulator")
    return Conclusions(
        checks=(*every_check(exact), *half_checks(exact)),
        tables=(by_distance(exact), by_method(exact), halves(exact), consistency(everything)),
        figures=tuple(every_figure(everything, exact)),
        remarks=(_SETUP, _COVARIANCE, *seed002().remarks[:3], seed002().remarks[4]),
    )
