"""Which images show a change of the camera's controls: by what they show, never by a clock.

After a command, images come that were taken before it took effect. The first that shows the change
differs from its predecessor by far more than images did before (a jump); images differ on while a
motor turns; the first that differs little is fresh. Little is what was usual before, or, as a gain
may have made more noise, twice the same and next to nothing beside the jump. A change too small to
be seen makes no jump: then as many images pass as a change of this control took the longest.
"""

from collections import deque
from dataclasses import dataclass, field, replace

from tagmetry.camera import ControlStuckError, Image
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.controls.evidence import step_grey2

_REMEMBERED = 6  # steps between images that say what is usual
_JUMP = 3.0  # of the usual step
_NOTHING = 0.02  # of the greatest step of a change
_SAME = 1.5  # ratio of two steps that are alike
_QUIET_GREY2 = 50.0  # noise with a deviation of 4; more is a scene that moves
_LEAST_GREY2 = 0.5  # the rounding of images without noise
_UNKNOWN_GREY2 = 10.0  # noise of a poor webcam, before any was seen


@dataclass(frozen=True)
class _Pending:
    """A change that was commanded.

    Attributes:
        names: The controls.
        sequence: The newest image at the command.
        is_visible: Whether it must be seen.
        greatest_grey2: Greatest step of the change so far; 0 before its jump.
        newest_grey2: The newest one.
        jumped: Images from the command to the jump.
    """

    names: frozenset[str]
    sequence: int
    is_visible: bool
    greatest_grey2: float = 0.0
    newest_grey2: float = 0.0
    jumped: int = 0

    def moved(self, step_grey2: float) -> "_Pending":
        """Return it after another step."""
        greatest = max(self.greatest_grey2, step_grey2)
        return replace(self, greatest_grey2=greatest, newest_grey2=step_grey2)

    def rests(self, step_grey2: float) -> bool:
        """Say whether two steps are alike and next to nothing beside the change."""
        less, more = sorted((self.newest_grey2, step_grey2))
        return more <= _SAME * less and more <= _NOTHING * self.greatest_grey2


@dataclass
class Settling:
    """Tells stale images from fresh ones; shown every image of a source, in order.

        settling = Settling()
        for image in source:
            if settling.is_stale(image):
                continue
            ...                                # measure
            controls.write("zoom", 300)
            settling.expect("zoom")

    Attributes:
        most_images: How many images a change may take to be seen, and to come to rest after that.
        took: Control to how many images its changes took at most to be seen.
    """

    most_images: int = 12
    took: dict[str, int] = field(default_factory=dict)
    _steps_grey2: deque[float] = field(default_factory=lambda: deque(maxlen=_REMEMBERED))
    _last: AnyPixels | None = None
    _sequence: int = -1
    _pending: _Pending | None = None

    def __post_init__(self) -> None:
        if self.most_images < 1:
            raise InputError(f"most_images must be at least 1, got {self.most_images}")

    def expect(self, *names: str, is_visible: bool = True) -> None:
        """Say that controls were just set; what was expected before still is.

        Args:
            names: Those whose value changed.
            is_visible: Whether it must be seen in the images. Not so for a small step of the focus;
                nor for any change while much moves, in which it may drown.
        """
        before = self._pending
        is_visible &= max(self._steps_grey2, default=0.0) <= _QUIET_GREY2
        if before is not None:
            names, is_visible = (*before.names, *names), before.is_visible or is_visible
        if names:
            self._pending = _Pending(frozenset(names), self._sequence, is_visible)

    def is_stale(self, image: Image) -> bool:
        """Say whether an image was taken before the last change was through.

        Raises:
            ControlStuckError: A change that must be seen was not, in `most_images`.
        """
        step = None if self._last is None else step_grey2(self._last, image.pixels)
        self._last, self._sequence = image.pixels, image.sequence
        if self._pending is None:
            self._steps_grey2.extend([] if step is None else [step])
            return False
        self._pending = self._after(self._pending, step)
        return self._pending is not None

    def _after(self, pending: _Pending, step_grey2: float | None) -> _Pending | None:
        """Return what is still to come after another image; None where it is fresh."""
        passed = self._sequence - pending.sequence
        if step_grey2 is not None and step_grey2 > self._jump_grey2 and not pending.jumped:
            return self._seen(pending, step_grey2, passed)
        if pending.jumped:
            return self._moving(pending, step_grey2 or 0.0, passed)
        return self._unseen(pending, passed)

    def _seen(self, pending: _Pending, step_grey2: float, passed: int) -> _Pending:
        """Note when a change was first seen, for controls that were set alone."""
        if len(pending.names) == 1:
            (name,) = pending.names
            self.took[name] = max(passed, self.took.get(name, 0))
        return replace(pending.moved(step_grey2), jumped=passed)

    def _moving(self, pending: _Pending, step_grey2: float, passed: int) -> _Pending | None:
        """Wait until images are still, and every control had the time that it takes."""
        is_still = step_grey2 <= self._jump_grey2 or pending.rests(step_grey2)
        is_over = is_still and passed > self._longest(pending, otherwise=0)
        if not is_over and passed - pending.jumped < self.most_images:
            return pending.moved(step_grey2)
        self._steps_grey2.clear()  # noise and motion may be others now
        self._steps_grey2.append(step_grey2)
        return None

    def _unseen(self, pending: _Pending, passed: int) -> _Pending | None:
        """Wait for a jump, as long as one may take."""
        if not pending.is_visible and passed > self._longest(pending, otherwise=self.most_images):
            return None
        if passed < self.most_images:
            return pending
        self._pending = None
        if not pending.is_visible:
            return None
        names = " and ".join(sorted(pending.names))
        raise ControlStuckError(
            f"{names}: no image showed the change in {self.most_images} images; it sticks, or "
            "takes effect later than that"
        )

    def _longest(self, pending: _Pending, *, otherwise: int) -> int:
        """Return how many images the changes of the pending controls took at most."""
        return max(self.took.get(name, otherwise) for name in pending.names)

    @property
    def _jump_grey2(self) -> float:
        usual = max(self._steps_grey2, default=_UNKNOWN_GREY2)
        return _JUMP * max(usual, _LEAST_GREY2)
