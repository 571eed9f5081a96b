"""How exact will a pose be, before a marker is printed? An error budget from the bounds."""

from tagmetry.pose.plan.predict import Prediction, predict
from tagmetry.pose.plan.reach import range_m, shortest_side_px
from tagmetry.pose.plan.setup import Imaging, Setup
from tagmetry.pose.plan.solve import Free, solved
from tagmetry.pose.plan.volume import Volume, over_volume

__all__ = [
    "Free",
    "Imaging",
    "Prediction",
    "Setup",
    "Volume",
    "over_volume",
    "predict",
    "range_m",
    "shortest_side_px",
    "solved",
]
