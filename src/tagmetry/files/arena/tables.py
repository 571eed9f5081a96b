"""The tables of an arena's file, as a person writes them: lengths in metres, angles in degrees."""

from typing import Literal

from pydantic import Field

from tagmetry.files.checked import Metres, OwnFileModel


class MarkerTable(OwnFileModel):
    """A marker on a robot: how it is mounted."""

    id: int
    size_m: Metres | None = None
    height_m: Metres
    height_sd_m: Metres = 0.0
    forward_m: Metres = 0.0
    left_m: Metres = 0.0
    turn_deg: float = 0.0
    family: str | None = None


class SensorTable(OwnFileModel):
    """A sensor for neighbours."""

    range_m: Metres
    view_deg: float = 360.0
    view_center_deg: float = 0.0
    line_of_sight: bool = False
    range_sd_m: Metres = 0.0
    range_sd_share: float = 0.0
    bearing_sd_deg: float = 0.0
    heading_sd_deg: float = 0.0
    drop_probability: float = 0.0
    delay_s: float = 0.0
    range_step_m: Metres = 0.0
    angle_step_deg: float = 0.0
    most: int | None = None


class StartTable(OwnFileModel):
    """Where a simulated robot starts."""

    x_m: Metres
    y_m: Metres
    heading_deg: float = 0.0


class RobotTable(OwnFileModel):
    """A robot; a virtual one is simulated, and starts at a free place where none is given."""

    id: int
    name: str | None = None
    diameter_m: Metres | None = None
    marker: MarkerTable
    sensor: SensorTable | None = None
    key: str | None = None
    virtual: bool = False
    start: StartTable | None = None


class FloorMarkerTable(OwnFileModel):
    """A marker on the floor; without a place it is found by calibration."""

    id: int
    size_m: Metres | None = None
    family: str | None = None
    x_m: Metres | None = None
    y_m: Metres | None = None
    turn_deg: float = 0.0


class FloorTable(OwnFileModel):
    """The markers on the floor, or a board that lies on it, and the frame that they make."""

    markers: list[FloorMarkerTable] = Field(default_factory=list)
    board: str | None = None
    origin: int | None = None
    toward: int | None = None
    size_m: Metres | None = None


class ObstacleTable(OwnFileModel):
    """A virtual obstacle: a disc (center_m and radius_m) or a wall (from_m and to_m)."""

    name: str | None = None
    center_m: list[Metres] | None = Field(None, min_length=2, max_length=2)
    radius_m: Metres | None = None
    from_m: list[Metres] | None = Field(None, min_length=2, max_length=2)
    to_m: list[Metres] | None = Field(None, min_length=2, max_length=2)


class SafetyTable(OwnFileModel):
    """When robots are stopped."""

    unseen_s: float = 0.5
    margin_m: Metres = 0.0


class MotionTable(OwnFileModel):
    """How robots move, for the tracks."""

    acceleration_mps2: float = 0.5
    turning_radps2: float = 4.0
    slip_m: Metres = 0.005


class ZenohTable(OwnFileModel):
    """Other computers: where they meet the arena, and with which keys."""

    listen: str | None = None
    connect: str | None = None
    view_key: str | None = None
    command_key: str | None = None


class ArenaTable(OwnFileModel):
    """An arena."""

    tagmetry: Literal["arena"]
    version: int
    name: str = "arena"
    camera: str | None = None
    world: str | None = None
    family: str = "tag36h11"
    marker_size_m: Metres | None = None
    diameter_m: Metres | None = None
    floor: FloorTable
    robots: list[RobotTable]
    sensor: SensorTable | None = None
    seed: int = 0
    obstacles: list[ObstacleTable] = Field(default_factory=list)
    fence_m: list[list[Metres]] | None = None
    safety: SafetyTable = Field(default_factory=SafetyTable)
    motion: MotionTable = Field(default_factory=MotionTable)
    zenoh: ZenohTable | None = None
