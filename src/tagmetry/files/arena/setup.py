"""An arena as its YAML file has it: robots, floor markers, fence, obstacles, sensors; checked."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from tagmetry.arena import (
    Disc,
    Fence,
    Motion,
    Mount,
    Neighbourhood,
    NeighbourSensor,
    Obstacle,
    Robot,
    Roster,
    SafetyRules,
    Wall,
)
from tagmetry.errors import InputError
from tagmetry.files.arena.tables import (
    ArenaTable,
    FloorMarkerTable,
    FloorTable,
    ObstacleTable,
    RobotTable,
    SensorTable,
)
from tagmetry.files.board_text import parse_board
from tagmetry.files.checked import checked
from tagmetry.files.plain import shortened
from tagmetry.files.tables import load_yaml
from tagmetry.files.text import named_errors
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers.bodies import MarkerKey

_VERSION = 1
_KEY = re.compile(r"[0-9a-fA-F]{64}")


@dataclass(frozen=True, eq=False)
class FloorMarker:
    """A marker on the floor.

    Attributes:
        key: Its family and id.
        size_m: Side of its black square.
        T_world_marker: Where it lies; None where calibration finds that.
    """

    key: MarkerKey
    size_m: float
    T_world_marker: RigidTransform | None = None


@dataclass(frozen=True, eq=False)
class ArenaSetup:
    """All that a person says of an arena.

    Attributes:
        name: What it is called.
        roster: The robots.
        floor: The floor markers.
        origin: The floor marker that is the world's origin, where places are not given.
        toward: The floor marker to which the world's x axis points, likewise.
        camera_file: Of the camera's intrinsics; None where the images bring them.
        world_file: Where its world is, or will be.
        sensor: For neighbours, of all robots; None where nothing is told.
        sensors: Of some robots, by id, another one.
        obstacles: Virtual ones.
        safety: When robots are stopped.
        motion: How robots move.
        seed: Of the sensors' random numbers.
    """

    name: str
    roster: Roster
    floor: tuple[FloorMarker, ...]
    origin: MarkerKey | None
    toward: MarkerKey | None
    camera_file: Path | None
    world_file: Path
    sensor: NeighbourSensor | None = None
    sensors: Mapping[int, NeighbourSensor] = field(default_factory=dict)
    obstacles: tuple[Obstacle, ...] = ()
    safety: SafetyRules = field(default_factory=SafetyRules)
    motion: Motion = field(default_factory=Motion)
    seed: int = 0

    @property
    def families(self) -> tuple[str, ...]:
        """The families that a detector has to look for, each once."""
        names = [one.family for one in self.roster.robots] + [one.key.family for one in self.floor]
        return tuple(dict.fromkeys(names))

    @property
    def measured_floor(self) -> MarkerMap | None:
        """The floor markers as they were measured by hand; None where calibration finds them."""
        placed = [one for one in self.floor if one.T_world_marker is not None]
        if not placed:
            return None
        markers = (
            MapMarker(one.key.family, one.key.id, one.size_m, one.T_world_marker)
            for one in placed
            if one.T_world_marker is not None
        )
        return MarkerMap(tuple(markers), self.name)

    @property
    def neighbourhood(self) -> Neighbourhood | None:
        """What says what each robot may know; None where no robot has a sensor."""
        if self.sensor is None and not self.sensors:
            return None
        radii_m = {robot.id: robot.radius_m for robot in self.roster.robots}
        sensor = self.sensor if self.sensor is not None else NeighbourSensor()
        return Neighbourhood(sensor, self.sensors, self.obstacles, radii_m, self.seed)

    def keys(self) -> Mapping[int, bytes]:
        """Return the robots' keys by id, for the link.

        Raises:
            InputError: A robot has none.
        """
        found = {robot.id: robot.key for robot in self.roster.robots if robot.key is not None}
        without = [robot.name for robot in self.roster.robots if robot.key is None]
        if without:
            raise InputError(
                f"{without[0]} has no key, and without one no robot is talked to; give it "
                "`key:` with 64 random hexadecimal digits, as tagmetry.link.new_key() makes them"
            )
        return found


def load_arena(path: str | Path) -> ArenaSetup:
    """Return an arena from its file.

    Raises:
        InputError: It is no arena, or something in it cannot be; the text is one line.
    """
    path = Path(path)
    table = load_yaml(path)
    with named_errors(path):
        if table.get("tagmetry") != "arena":
            raise InputError("expected an arena: a file that begins with `tagmetry: arena`")
        if table.get("version") != _VERSION:
            raise InputError(
                f"expected version {_VERSION} of an arena, found {table.get('version')}; a later "
                "tagmetry may read it"
            )
        return _setup(checked(ArenaTable, table), path)


def _setup(table: ArenaTable, path: Path) -> ArenaSetup:
    floor = _floor(table)
    if not table.robots:
        raise InputError("robots: there is none; list at least one with its id and its marker")
    roster = Roster(tuple(_robot(one, table) for one in table.robots))
    _check_apart(roster, floor)
    origin, toward = _frame(table.floor, floor)
    sensors = {one.id: _sensor(one.sensor) for one in table.robots if one.sensor is not None}
    fence = None if table.fence_m is None else Fence(tuple(map(_point, table.fence_m)))
    world = table.world if table.world is not None else f"{path.stem}.world.yaml"
    return ArenaSetup(
        table.name,
        roster,
        floor,
        origin,
        toward,
        path.parent / table.camera if table.camera is not None else None,
        path.parent / world,
        _sensor(table.sensor) if table.sensor is not None else None,
        sensors,
        tuple(_obstacle(n, one) for n, one in enumerate(table.obstacles)),
        SafetyRules(table.safety.unseen_s, fence, table.safety.margin_m),
        Motion(**table.motion.model_dump()),
        table.seed,
    )


def _robot(one: RobotTable, table: ArenaTable) -> Robot:
    with named_errors(f"robot {one.id}"):
        size_m = one.marker.size_m if one.marker.size_m is not None else table.marker_size_m
        diameter_m = one.diameter_m if one.diameter_m is not None else table.diameter_m
        if size_m is None:
            raise InputError("the size of its marker is missing: marker.size_m, or marker_size_m")
        if diameter_m is None:
            raise InputError("its diameter is missing: diameter_m, here or for all robots")
        mount = Mount(
            one.marker.height_m,
            one.marker.forward_m,
            one.marker.left_m,
            float(np.radians(one.marker.turn_deg)),
            one.marker.height_sd_m,
        )
        family = one.marker.family or table.family
        name = one.name if one.name is not None else f"robot {one.id}"
        return Robot(one.id, name, diameter_m, family, one.marker.id, size_m, mount, _key(one.key))


def _key(text: str | None) -> bytes | None:
    if text is None:
        return None
    if not _KEY.fullmatch(text):
        raise InputError(
            f"expected a key of 64 hexadecimal digits, found {len(text)} characters that are not; "
            "make one with tagmetry.link.new_key(), and put it in quotes"
        )
    return bytes.fromhex(text)


def _floor(table: ArenaTable) -> tuple[FloorMarker, ...]:
    if table.floor.board is not None:
        return _board(table.floor.board, table.floor)
    if not table.floor.markers:
        raise InputError(
            "floor.markers: there is none; lay at least one marker on the floor, better four "
            "toward the image's corners, and list them; or lay a board, and name it (floor.board)"
        )
    floor = tuple(_floor_marker(one, table) for one in table.floor.markers)
    keys = [one.key for one in floor]
    for key in keys:
        if keys.count(key) > 1:
            raise InputError(f"floor.markers: {key.family} id {key.id} stands there twice")
    placed = [one.T_world_marker is not None for one in floor]
    if any(placed) and not all(placed):
        raise InputError(
            "floor.markers: some have a place (x_m and y_m) and some have none; measure all, or "
            "leave all to calibration"
        )
    return floor


def _board(text: str, table: FloorTable) -> tuple[FloorMarker, ...]:
    """Return the markers of a board whose frame is the world's."""
    if table.markers:
        raise InputError("floor: expected markers or a board, found both")
    with named_errors("floor.board"):
        markers = parse_board(text).markers()
    if not markers:
        raise InputError(
            f"floor.board: {shortened(text)} has no markers; take a grid or a ChArUco board"
        )
    return tuple(
        FloorMarker(MarkerKey(one.family, one.id), one.size_m, one.T_body_marker) for one in markers
    )


def _floor_marker(one: FloorMarkerTable, table: ArenaTable) -> FloorMarker:
    with named_errors(f"floor marker {one.id}"):
        size_m = one.size_m if one.size_m is not None else table.floor.size_m
        if size_m is None or not 0 < size_m < np.inf:
            raise InputError(f"expected its size_m, here or for all, positive, found {size_m}")
        key = MarkerKey(one.family or table.family, one.id)
        if (one.x_m is None) != (one.y_m is None):
            raise InputError("expected both x_m and y_m, or none of them")
        if one.x_m is None or one.y_m is None:
            return FloorMarker(key, size_m)
        turn = Rotation.from_euler("z", one.turn_deg, degrees=True)
        at = RigidTransform.from_components([one.x_m, one.y_m, 0.0], turn)
        return FloorMarker(key, size_m, at)


def _frame(
    table: FloorTable, floor: tuple[FloorMarker, ...]
) -> tuple[MarkerKey | None, MarkerKey | None]:
    """Return the markers of the origin and of the x axis."""
    by_id = {one.key.id: one.key for one in floor}
    for name, marker_id in (("origin", table.origin), ("toward", table.toward)):
        if marker_id is not None and marker_id not in by_id:
            listed = ", ".join(map(str, by_id))
            raise InputError(f"floor.{name}: {marker_id} is no floor marker; there are {listed}")
    origin = by_id[table.origin] if table.origin is not None else floor[0].key
    toward = by_id[table.toward] if table.toward is not None else None
    if toward == origin:
        raise InputError("floor.toward: the x axis needs another marker than the origin")
    return (origin, toward) if floor[0].T_world_marker is None else (None, None)


def _check_apart(roster: Roster, floor: tuple[FloorMarker, ...]) -> None:
    for one in floor:
        if one.key in roster.row_by_marker:
            robot = roster.robots[roster.row_by_marker[one.key]]
            raise InputError(
                f"{one.key.family} id {one.key.id} is a floor marker and {robot.name}'s; each "
                "marker has an id of its own"
            )


def _sensor(table: SensorTable) -> NeighbourSensor:
    numbers = {
        name.replace("_deg", "_rad"): np.radians(value) if name.endswith("_deg") else value
        for name, value in table.model_dump().items()
    }
    with named_errors("sensor"):
        return NeighbourSensor(**numbers)


def _obstacle(number: int, table: ObstacleTable) -> Obstacle:
    name = table.name if table.name is not None else f"obstacle {number + 1}"
    if table.center_m is not None and table.radius_m is not None and table.from_m is None:
        return Disc(_point(table.center_m), table.radius_m, name)
    if table.from_m is not None and table.to_m is not None and table.center_m is None:
        return Wall(_point(table.from_m), _point(table.to_m), name)
    raise InputError(f"{name}: expected a disc (center_m and radius_m) or a wall (from_m and to_m)")


def _point(values: list[float]) -> tuple[float, float]:
    if len(values) != 2:
        raise InputError(f"expected a place [x, y] in metres, found {values}")
    return values[0], values[1]
