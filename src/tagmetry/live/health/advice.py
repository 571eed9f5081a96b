"""What is wrong with a running arena, and what to do about it, in words for people."""

from collections.abc import Iterator
from dataclasses import dataclass

_LATE_S, _PICTURE_AGE_S, _FEW_IMAGES = 0.1, 2.0, 0.7
_LOSS, _LOW_V, _LITTLE_DISK_BYTES = 0.05, 6.8, 10**9


@dataclass(frozen=True)
class Signs:
    """What an arena shows of its health.

    Attributes:
        late_s: How far it is behind the wall's clock.
        image_rate_hz: Images measured per second.
        wanted_rate_hz: Images per second that there should be.
        picture_age_s: Since the newest picture was taken; None where there is none.
        losses: Share of packets that are lost, by the robots' names.
        batteries_v: As the robots told last, by their names.
        missing: Names of robots that were never seen.
        is_recording: A recording is being written.
        dropped_count: What it could not write in time.
        disk_free_bytes: Where recordings go; None where it is not known.
        failure: Why the last recording ended early; empty while all is well.
    """

    late_s: float
    image_rate_hz: float
    wanted_rate_hz: float
    picture_age_s: float | None
    losses: dict[str, float]
    batteries_v: dict[str, float]
    missing: tuple[str, ...]
    is_recording: bool
    dropped_count: int
    disk_free_bytes: int | None
    failure: str


def advice(signs: Signs) -> tuple[str, ...]:
    """Return a line for everything that is wrong; none where all is well."""
    return (*_of_speed(signs), *_of_robots(signs), *_of_recording(signs))


def _of_speed(signs: Signs) -> Iterator[str]:
    if signs.image_rate_hz == 0:
        yield "No image was measured in the last second: the camera is gone, or the arena hangs."
    elif signs.late_s > _LATE_S:
        yield (
            f"This computer is too slow: the arena is {signs.late_s:.2f} s behind the clock. "
            "Fewer robots help, or no pictures."
        )
    elif signs.image_rate_hz < _FEW_IMAGES * signs.wanted_rate_hz:
        yield (
            f"Only {signs.image_rate_hz:.0f} of {signs.wanted_rate_hz:.0f} images a second are "
            "measured: the camera or this computer is too slow."
        )
    if signs.picture_age_s is not None and signs.picture_age_s > _PICTURE_AGE_S:
        yield f"The newest picture is {signs.picture_age_s:.0f} s old; robots are followed still."


def _of_robots(signs: Signs) -> Iterator[str]:
    for name, loss in signs.losses.items():
        if loss > _LOSS:
            yield (
                f"{name} loses {100 * loss:.0f} % of its packets: is it near enough to the radio, "
                "and the channel free?"
            )
    for name, battery_v in signs.batteries_v.items():
        if battery_v < _LOW_V:
            yield f"{name}'s battery is low: {battery_v:.2f} V. Charge it."
    if signs.missing:
        yield (
            f"Never seen yet: {', '.join(signs.missing)}. Is the marker on the robot, of the right "
            "family and id, and in the camera's view?"
        )


def _of_recording(signs: Signs) -> Iterator[str]:
    if signs.failure:
        yield f"The recording ended: {signs.failure}"
    if signs.is_recording and signs.dropped_count:
        yield f"The disk is too slow: {signs.dropped_count} messages were not recorded."
    if signs.disk_free_bytes is not None and signs.disk_free_bytes < _LITTLE_DISK_BYTES:
        yield (
            f"The disk has {1e-6 * signs.disk_free_bytes:.0f} MB left: a recording will soon end."
        )
