"""The bank: many calibrations of one camera, and the camera at any setting between them."""

from tagmetry.camera.bank.bank import CameraBank
from tagmetry.camera.bank.node import Approach, BankNode
from tagmetry.camera.bank.report import Gap, LeftOut, Repeat

__all__ = ["Approach", "BankNode", "CameraBank", "Gap", "LeftOut", "Repeat"]
