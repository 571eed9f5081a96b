"""How often the truth lies in the stated 95 % ellipsoid: many cameras, many runs each.

    python tests/calibrate/coverage_study.py [runs] [common_px] [processes]

prints a table of 20 cameras from 55 to 120 degrees of view, 35 views each as in seed 003. Every
run makes new views and solves from the truth on (another start leads to the same minimum), with
outliers dropped as `calibrate` does. OpenCV projects; none of the solver's formulas are used.
"""

import sys
from dataclasses import dataclass
from functools import partial
from multiprocessing import Pool

import cv2
import numpy as np
from scipy import stats
from seen_boards import USUAL, WIDE, Truth, seen, truth

from tagmetry.calibrate.bundle import Bundle
from tagmetry.calibrate.choice import LensName
from tagmetry.calibrate.covariance import covariances
from tagmetry.calibrate.fit import refit, release_shape
from tagmetry.calibrate.freedom import Wanted
from tagmetry.calibrate.sightings import Sightings, gather
from tagmetry.calibrate.view import BoardView
from tagmetry.geometry import mahalanobis_squared


def barrel(view_deg: float, share: float, coefficients: int) -> Truth:
    """Return a Brown lens whose image radius lies between a pinhole's and a fisheye's."""
    focal_px = 640 / np.tan(np.radians(view_deg / 2))
    angle = np.linspace(0.01, np.arctan(1.02 * np.hypot(640, 486) / focal_px), 100)
    r = np.tan(angle)
    powers = r[:, None] ** (np.array([3, 5, 7]) if coefficients == 5 else np.array([3, 5]))
    radial = np.linalg.lstsq(powers, share * (angle - r), rcond=None)[0]
    lens = (*radial[:2], 0.0008, -0.0005, *radial[2:])
    return truth(view_deg, tuple(float(k) for k in lens))


def _fisheye(view_deg: float) -> Truth:
    return truth(view_deg, (0.02, -0.01, 0.003, -0.001), fisheye=True)


CAMERAS: dict[str, tuple[Truth, LensName]] = {
    **{f"{d} brown5": (barrel(d, 0.35, 5), "brown5") for d in (55, 62, 70, 78, 86, 94, 102, 110)},
    "70 usual brown5": (USUAL, "brown5"),
    "120 brown5": (WIDE, "brown5"),
    **{f"{d} brown4": (barrel(d, 0.3, 4), "brown4") for d in (60, 75, 90, 105)},
    **{f"{d} none": (truth(d, ()), "none") for d in (65, 100)},
    **{f"{d} fisheye": (_fisheye(d), "fisheye") for d in (80, 100, 110, 120)},
}


@dataclass(frozen=True)
class Coverage:
    """Shares of runs with the truth inside, and how far the focal length was off.

    Attributes:
        by_view: In the ellipsoid of `Calibration.camera.covariance`.
        formula: In that of the formula.
        focal_rms_percent: Root of the mean square.
        focal_worst_percent: Largest.
        sd_growth: Geometric mean over parameters and runs of the stated over the formula's sd.
    """

    by_view: float
    formula: float
    focal_rms_percent: float
    focal_worst_percent: float
    sd_growth: float


def coverage_of(
    name: str, runs: int, views: int = 35, shape: str = "flat", **kind: float
) -> Coverage:
    """Return what holds for one of the cameras; `kind` goes to `seen`."""
    camera, lens = CAMERAS[name]
    rng = np.random.default_rng(11)
    limit = stats.chi2.ppf(0.95, len(camera.intrinsics))
    inside, focal, growth = [], [], []
    for _ in range(runs):
        start, sightings, wanted = _views_and_start(camera, lens, views, rng, kind)
        fit = refit(start, sightings, wanted, robust=True)
        if shape == "free":
            fit = release_shape(fit, sightings, robust=True)
        found = covariances(fit.bundle, fit.seen, fit.freedom)
        error = fit.bundle.intrinsics - camera.intrinsics
        both = (found.by_view, found.formula)
        inside.append([mahalanobis_squared(error, covariance) < limit for covariance in both])
        focal.append(100 * error[0] / camera.intrinsics[0])
        growth.append(np.log(np.diag(found.by_view) / np.diag(found.formula)).mean() / 2)
    by_view, formula = np.mean(inside, axis=0)
    rms, worst = np.sqrt(np.mean(np.square(focal))), np.abs(focal).max()
    return Coverage(
        float(by_view), float(formula), float(rms), float(worst), float(np.exp(np.mean(growth)))
    )


def _views_and_start(
    camera: Truth, lens: LensName, count: int, rng: np.random.Generator, kind: dict[str, float]
) -> tuple[Bundle, Sightings, Wanted]:
    views = seen(camera, count, rng, **kind)
    sightings, wanted = gather(views), Wanted(lens)
    poses = [pose_of(camera, view) for view in views]
    R, t = (np.array(part) for part in zip(*poses, strict=True))
    return Bundle(wanted.kind, camera.intrinsics, R, t, sightings.p_board), sightings, wanted


def pose_of(camera: Truth, view: BoardView) -> tuple[np.ndarray, np.ndarray]:
    D = np.array(camera.coefficients) if camera.coefficients else None
    corners = view.corners_px[:, None]
    undistort = cv2.fisheye.undistortPoints if camera.fisheye else cv2.undistortPoints
    ideal = undistort(corners, camera.K, D)
    _, rvec, tvec = cv2.solvePnP(view.p_board, ideal, np.eye(3), None, flags=cv2.SOLVEPNP_IPPE)
    return cv2.Rodrigues(rvec)[0], tvec[:, 0]


def main(runs: int = 200, common_px: float = 0.0, processes: int = 2) -> None:
    """Print the table."""
    print(f"{runs} runs, 35 views, 0.1 px by each corner, {common_px} px by each view")
    print("camera           by view  formula  focal error rms, worst %  sd / formula's", flush=True)
    with Pool(processes) as pool:
        rows = []
        each = pool.imap(partial(coverage_of, runs=runs, common_px=common_px), CAMERAS)
        for name, row in zip(CAMERAS, each, strict=True):
            rows.append(row)
            print(
                f"{name:16s} {row.by_view:7.3f}  {row.formula:7.3f}  {row.focal_rms_percent:12.4f}"
                f" {row.focal_worst_percent:9.4f}  {row.sd_growth:12.2f}",
                flush=True,
            )
    mean = np.mean([[row.by_view, row.formula] for row in rows], axis=0)
    print(f"{'mean':16s} {mean[0]:7.3f}  {mean[1]:7.3f}")


if __name__ == "__main__":
    main(*(kind(text) for kind, text in zip((int, float, int), sys.argv[1:], strict=False)))
