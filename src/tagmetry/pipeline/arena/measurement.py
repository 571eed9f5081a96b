"""One image in, the state of all robots out: detect, follow, decide, and what each is told."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Protocol

from tagmetry.arena import Arena, ArenaStep, Decision, StopForAll, Told, WorldState
from tagmetry.arena.controllers import Controller
from tagmetry.arena.drive import Twist
from tagmetry.camera import Camera, Image
from tagmetry.detect import Detection, Detector, Tracker
from tagmetry.errors import InputError
from tagmetry.files.arena import ArenaSetup, ArenaWorld
from tagmetry.files.text import named_errors
from tagmetry.pipeline.arena.drivers import Drivers
from tagmetry.pipeline.arena.guarded import Guarded
from tagmetry.pipeline.arena.stage_times import NOT_TIMED, StageTimes
from tagmetry.pipeline.arena.turning import Turn, Turning

_LONGEST_LEAD_S = 0.5


@dataclass(frozen=True, eq=False)
class ArenaResult:
    """All that came of one image.

    Attributes:
        image: The image itself, for the record and for pictures.
        detections: All its markers.
        step: What they tell.
        world: All robots at the time of sending.
        told: What each robot may know, where there is a sensor, as of the image.
        decisions: Whether each robot may drive.
        stop: The stop for all.
        commands: How every robot shall move that has a controller, by id.
        taken_s: When the image was there, on the clock `time.monotonic`.
        done_s: When all of this was known, on the same clock.
        times: How long each step took.
    """

    image: Image
    detections: tuple[Detection, ...]
    step: ArenaStep
    world: WorldState
    told: tuple[Told, ...]
    decisions: tuple[Decision, ...]
    stop: StopForAll
    commands: Mapping[int, Twist]
    taken_s: float
    done_s: float
    times: StageTimes = NOT_TIMED

    @property
    def latency_s(self) -> float:
        """From the image to the result."""
        return self.done_s - self.taken_s


class Beside(Protocol):
    """Robots that are simulated beside the real ones."""

    def look(self, time_s: float) -> tuple[Detection, ...]:
        """Return the markers that an image of this moment would show."""

    def drive(self, turn: Turn) -> None:
        """Take what the host decided."""


@dataclass
class ArenaMeasurement:
    """What is done with every image of an arena.

    Attributes:
        turning: What is done with the markers.
        camera: Intrinsics of the images.
        detector: Finds the markers.
        tracker: Follows them from image to image; where None, every image is looked at whole.
        is_live: Images arrive by themselves; the state is predicted to the time of sending.
        lead_s: How much later than the sending what is told takes effect, predicted as well.
        clock: Seconds that never go back.
        beside: Simulated robots; none when None.
    """

    turning: Turning
    camera: Camera
    detector: Detector
    tracker: Tracker | None = None
    is_live: bool = False
    lead_s: float = 0.0
    clock: Callable[[], float] = time.monotonic
    beside: Beside | None = None

    def __post_init__(self) -> None:
        if not 0 <= self.lead_s <= _LONGEST_LEAD_S:
            raise InputError(f"lead_s must be 0 to {_LONGEST_LEAD_S} s, got {self.lead_s}")

    @classmethod
    def of(
        cls,
        setup: ArenaSetup,
        world: ArenaWorld,
        *,
        track: bool = True,
        is_live: bool = False,
        lead_s: float = 0.0,
        controllers: Callable[[int], Controller] | None = None,
        is_driven: Callable[[int], bool] | None = None,
        beside: Beside | None = None,
    ) -> "ArenaMeasurement":
        """Return the measurement of an arena's files.

        Args:
            setup: The arena.
            world: As calibration found it.
            track: Follow markers from image to image; else every image is looked at whole.
            is_live: Images arrive by themselves.
            lead_s: How much later than the sending what is told takes effect.
            controllers: Makes a robot's controller from its id; robots drive themselves when None.
            is_driven: Says whether a robot's controller drives it just now; always when None.
            beside: Simulated robots of the arena.

        Raises:
            InputError: A robot's marker would be higher than the camera.
        """
        _check_below_camera(setup, world)
        arena = Arena(setup.roster, world.view, world.floor, world.reference, setup.motion)
        detector = Detector(setup.families)
        driven = setup.roster.robots if controllers is not None else ()
        guarded = {one.id: Guarded(controllers(one.id)) for one in driven if controllers}
        drivers = Drivers(guarded, is_driven)
        return cls(
            Turning(arena, setup.neighbourhood, setup.safety, drivers),
            world.view.camera,
            detector,
            Tracker(detector) if track else None,
            is_live,
            lead_s,
            beside=beside,
        )

    def measure(self, image: Image) -> ArenaResult:
        """Return what an image tells.

        Raises:
            InputError: It is of another size than the camera's, or its time does not rise.
        """
        taken_s = self.clock()
        with named_errors(image.source or "image"):
            self.camera.check_image(image.width_px, image.height_px)
            time_s = image_time_s(image)
            begun_s = time.monotonic()
            detections = self._detections(image, time_s)
            detect_s = time.monotonic() - begun_s
            if self.is_live and 0 <= taken_s - image.time_s < _LONGEST_LEAD_S:
                taken_s = image.time_s  # a live source's clock is this one
            began_s = taken_s
            turn = self.turning.turn(
                detections, time_s, lambda: time_s + self._until_it_acts_s(began_s)
            )
        if self.beside is not None:
            self.beside.drive(turn)
        return ArenaResult(
            image,
            detections,
            turn.step,
            turn.world,
            turn.told,
            turn.decisions,
            turn.stop,
            turn.commands,
            taken_s,
            self.clock(),
            replace(turn.times, detect_s=detect_s),
        )

    @property
    def stop(self) -> StopForAll:
        """The stop for all."""
        return self.turning.stop

    def press_stop(self, why: str, time_s: float) -> None:
        """Stop all robots until `release_stop`."""
        self.turning.stop = self.stop.pressed(why, time_s)

    def release_stop(self) -> None:
        """Let robots drive again; a camera that was moved presses again at once."""
        self.turning.stop = self.stop.reset()

    def _detections(self, image: Image, time_s: float) -> tuple[Detection, ...]:
        simulated = self.beside.look(time_s) if self.beside is not None else ()
        if self.tracker is None:
            return self.detector.detect(image.pixels, self.camera) + simulated
        return self.tracker.track(image.pixels, time_s, self.camera) + simulated

    def _until_it_acts_s(self, taken_s: float) -> float:
        """Return how long after the image what is told takes effect.

        Of pictures and videos only the lead counts, so that every run gives the same.
        """
        if not self.is_live:
            return self.lead_s
        return min(max(self.clock() - taken_s, 0.0), _LONGEST_LEAD_S) + self.lead_s


def image_time_s(image: Image) -> float:
    """Return an image's time; pictures without one count as one second each."""
    return float(image.sequence) if image.time_kind == "none" else image.time_s


def _check_below_camera(setup: ArenaSetup, world: ArenaWorld) -> None:
    camera_m = float(world.view.T_world_camera.translation[2])
    for robot in setup.roster.robots:
        if robot.mount.height_m >= camera_m:
            raise InputError(
                f"{robot.name}: its marker's height of {robot.mount.height_m} m is above the "
                f"camera, which hangs {camera_m:.2f} m over the floor; heights are in metres"
            )
