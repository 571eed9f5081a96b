"""What the server and the page say to each other: the contract, and who may say what.

Every message is a JSON object whose `type` is its class's name. `CONTRACT` declares each one's
sender and the role that it needs; the page of the protocol is written from it.
"""

from dataclasses import dataclass
from typing import Literal

from tagmetry.live.messages.asked import (
    Beat,
    ChooseScenario,
    FollowPath,
    GoTo,
    Halt,
    MeasureErrors,
    Release,
    Resume,
    Seen,
    SetParameter,
    StartRecording,
    Stop,
    StopRecording,
)
from tagmetry.live.messages.robots import Stage, World
from tagmetry.live.messages.told import (
    Delivery,
    FloorErrors,
    Health,
    Picture,
    Refused,
    Role,
    Welcome,
)
from tagmetry.live.rooms.calibrate.messages import (
    CalibrationPicture,
    CalibrationState,
    EndCalibration,
    SaveCalibration,
    StartCalibration,
)
from tagmetry.live.rooms.lens.messages import LensPicture, LensTrace, StartLens, StopLens
from tagmetry.live.rooms.locate.messages import LocateImages, LocateTrace, StartLocate, StopLocate

Sender = Literal["server", "page"]

Told = (
    Welcome
    | World
    | Stage
    | Picture
    | Health
    | Delivery
    | FloorErrors
    | Refused
    | CalibrationPicture
    | CalibrationState
    | LensPicture
    | LensTrace
    | LocateTrace
)
Asked = (
    Beat
    | Seen
    | Stop
    | Release
    | GoTo
    | FollowPath
    | Halt
    | Resume
    | SetParameter
    | ChooseScenario
    | MeasureErrors
    | StartRecording
    | StopRecording
    | StartCalibration
    | EndCalibration
    | SaveCalibration
    | StartLens
    | StopLens
    | LocateImages
    | StartLocate
    | StopLocate
)

# who sends one of these drives from then on
DRIVING = (Release, GoTo, FollowPath, Resume, SetParameter, ChooseScenario)


@dataclass(frozen=True)
class Rule:
    """One line of the contract.

    Attributes:
        message: Its class.
        sender: Who sends it.
        role: What the page needs to get it, or to be heard.
    """

    message: type[Told] | type[Asked]
    sender: Sender
    role: Role

    @property
    def name(self) -> str:
        """Its `type`."""
        return self.message.__name__


CONTRACT = (
    Rule(Welcome, "server", "viewer"),
    Rule(World, "server", "viewer"),
    Rule(Stage, "server", "viewer"),
    Rule(Picture, "server", "viewer"),
    Rule(Health, "server", "viewer"),
    Rule(Delivery, "server", "viewer"),
    Rule(FloorErrors, "server", "viewer"),
    Rule(Refused, "server", "viewer"),
    Rule(CalibrationPicture, "server", "viewer"),
    Rule(CalibrationState, "server", "viewer"),
    Rule(LensPicture, "server", "viewer"),
    Rule(LensTrace, "server", "viewer"),
    Rule(LocateTrace, "server", "viewer"),
    Rule(Beat, "page", "operator"),
    Rule(Seen, "page", "viewer"),
    Rule(Stop, "page", "viewer"),  # stopping is always safe
    Rule(Release, "page", "operator"),
    Rule(GoTo, "page", "operator"),
    Rule(FollowPath, "page", "operator"),
    Rule(Halt, "page", "operator"),
    Rule(Resume, "page", "operator"),
    Rule(SetParameter, "page", "operator"),
    Rule(ChooseScenario, "page", "operator"),
    Rule(MeasureErrors, "page", "operator"),
    Rule(StartRecording, "page", "operator"),
    Rule(StopRecording, "page", "operator"),
    Rule(StartCalibration, "page", "operator"),
    Rule(EndCalibration, "page", "operator"),
    Rule(SaveCalibration, "page", "operator"),
    Rule(StartLens, "page", "operator"),
    Rule(StopLens, "page", "operator"),
    Rule(StartLocate, "page", "operator"),
    Rule(LocateImages, "page", "operator"),
    Rule(StopLocate, "page", "operator"),
)
