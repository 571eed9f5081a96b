"""An arena as its YAML file has it: robots, floor markers, fence, obstacles, sensors; checked."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import radians
from pathlib import Path

from tagmetry.arena import (
    Fence,
    Motion,
    Neighbourhood,
    NeighbourSensor,
    Obstacle,
    Roster,
    SafetyRules,
)
from tagmetry.arena.place import Place, turned_rad
from tagmetry.errors import InputError
from tagmetry.files.arena.computers import ZenohSetup, zenoh_of
from tagmetry.files.arena.floor import FloorMarker, floor_of, frame_of
from tagmetry.files.arena.places import starts_of
from tagmetry.files.arena.robots import robot_of
from tagmetry.files.arena.senses import obstacle_of, point_of, sensor_of
from tagmetry.files.arena.tables import ArenaTable
from tagmetry.files.checked import checked
from tagmetry.files.families import resolve_family
from tagmetry.files.tables import load_yaml
from tagmetry.files.text import named_errors
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers import MarkerFamily
from tagmetry.markers.bodies import MarkerKey

_VERSION = 1


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
        families: Those that a detector has to look for, each once.
        virtual: Where robots start that are simulated, by id; the others are real.
        zenoh: How other computers reach it; None where they do not.
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
    families: tuple[MarkerFamily, ...] = ()
    virtual: Mapping[int, Place] = field(default_factory=dict)
    zenoh: ZenohSetup | None = None

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
        """Return the real robots' keys by id, for the link.

        Raises:
            InputError: A robot has none.
        """
        real = [robot for robot in self.roster.robots if robot.id not in self.virtual]
        found = {robot.id: robot.key for robot in real if robot.key is not None}
        without = [robot.name for robot in real if robot.key is None]
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
    floor = floor_of(table)
    if not table.robots:
        raise InputError("robots: there is none; list at least one with its id and its marker")
    roster = Roster(tuple(robot_of(one, table) for one in table.robots))
    _check_apart(roster, floor)
    origin, toward = frame_of(table.floor, floor)
    sensors = {one.id: sensor_of(one.sensor) for one in table.robots if one.sensor is not None}
    fence = None if table.fence_m is None else Fence(tuple(map(point_of, table.fence_m)))
    world = table.world if table.world is not None else f"{path.stem}.world.yaml"
    return ArenaSetup(
        table.name,
        roster,
        floor,
        origin,
        toward,
        path.parent / table.camera if table.camera is not None else None,
        path.parent / world,
        sensor_of(table.sensor) if table.sensor is not None else None,
        sensors,
        tuple(obstacle_of(n, one) for n, one in enumerate(table.obstacles)),
        SafetyRules(table.safety.unseen_s, fence, table.safety.margin_m),
        Motion(**table.motion.model_dump()),
        table.seed,
        _families(table, floor),
        _virtual(table, roster, fence),
        zenoh_of(table.zenoh),
    )


def _virtual(table: ArenaTable, roster: Roster, fence: Fence | None) -> dict[int, Place]:
    """Return where each simulated robot starts."""
    given = {one.id: one.start for one in table.robots if one.virtual}
    astray = [one.id for one in table.robots if one.start is not None and not one.virtual]
    if astray:
        raise InputError(f"robot {astray[0]}: a start is for simulated robots; add `virtual: true`")
    said = {
        key: Place(one.x_m, one.y_m, turned_rad(radians(one.heading_deg))) if one else None
        for key, one in given.items()
    }
    widest_m = max(robot.diameter_m for robot in roster.robots)
    with named_errors("robots"):
        return starts_of(said, fence, widest_m)


def _families(table: ArenaTable, floor: tuple[FloorMarker, ...]) -> tuple[MarkerFamily, ...]:
    """Return all families there are; those of a board have names, others may be files."""
    names = [one.marker.family or table.family for one in table.robots]
    names += [one.family or table.family for one in table.floor.markers]
    names += [one.key.family for one in floor] if table.floor.board is not None else []
    found = [resolve_family(name) for name in dict.fromkeys(names)]
    return tuple({one.name: one for one in found}.values())


def _check_apart(roster: Roster, floor: tuple[FloorMarker, ...]) -> None:
    for one in floor:
        if one.key in roster.row_by_marker:
            robot = roster.robots[roster.row_by_marker[one.key]]
            raise InputError(
                f"{one.key.family} id {one.key.id} is a floor marker and {robot.name}'s; each "
                "marker has an id of its own"
            )
