"""Views of a board to a camera with its covariance, and what that camera is good for."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tagmetry.calibrate.choice import LensName as LensName
    from tagmetry.calibrate.choice import ModelChoice as ModelChoice
    from tagmetry.calibrate.choice import ModelRow as ModelRow
    from tagmetry.calibrate.doctor import BoardAdvice as BoardAdvice
    from tagmetry.calibrate.doctor import diagnose_board as diagnose_board
    from tagmetry.calibrate.guidance import Verdict as Verdict
    from tagmetry.calibrate.guidance import verdict as verdict
    from tagmetry.calibrate.result import Calibration as Calibration
    from tagmetry.calibrate.second_look import look_again as look_again
    from tagmetry.calibrate.targets import BoardFindings as BoardFindings
    from tagmetry.calibrate.targets import explain_board as explain_board
    from tagmetry.calibrate.targets import find_board as find_board
    from tagmetry.calibrate.view import BoardView as BoardView
    from tagmetry.calibrate.view import RejectedView as RejectedView
    from tagmetry.calibrate.views_to_camera import calibrate as calibrate

_HOMES = {
    "BoardAdvice": "doctor",
    "BoardFindings": "targets",
    "BoardView": "view",
    "Calibration": "result",
    "LensName": "choice",
    "ModelChoice": "choice",
    "ModelRow": "choice",
    "RejectedView": "view",
    "Verdict": "guidance",
    "calibrate": "views_to_camera",
    "diagnose_board": "doctor",
    "explain_board": "targets",
    "find_board": "targets",
    "look_again": "second_look",
    "verdict": "guidance",
}

__all__ = [
    "BoardAdvice",
    "BoardFindings",
    "BoardView",
    "Calibration",
    "LensName",
    "ModelChoice",
    "ModelRow",
    "RejectedView",
    "Verdict",
    "calibrate",
    "diagnose_board",
    "explain_board",
    "find_board",
    "look_again",
    "verdict",
]


def __getattr__(name: str) -> object:
    """Import on first use: finding boards needs OpenCV, solving does not."""
    if name not in _HOMES:
        raise AttributeError(f"module 'tagmetry.calibrate' has no attribute {name!r}")
    return getattr(import_module(f"tagmetry.calibrate.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
