"""Holds an arena's loop at a rate for long: images from memory, 24 robots, packets over loopback.

    python tests/pipeline/arena_soak.py --seconds 600 --rate 120 --robots 24

Images come from memory at their times, the newest wins, and what the loop was too late for counts
as dropped. The time from image to packet is from when an image was due until all packets that it
led to had left. The robots are one program in C, which needs gcc; they tell their odometry too.
Where other programs keep the cores busy: `chrt -f 1 python …`.
"""

import argparse
import resource
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np

import tagmetry.link.client
from tagmetry.arena import Arena, Neighbourhood, NeighbourSensor, OverheadView, Roster
from tagmetry.camera import Image
from tagmetry.detect import Detector, Tracker
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lab.rigs.crowd import crowd, film
from tagmetry.lab.rigs.overhead import CAMERA, FAMILY, T_WORLD_CAMERA
from tagmetry.link import Host
from tagmetry.pipeline.arena import ArenaMeasurement, ArenaResult, StageTimes, Turning, run_arena
from tagmetry.pipeline.arena.linked import LinkTaker

_LENGTH = 6  # of the film, which is played there and back
_WARM = 60  # images before the clock runs
_SOURCES = Path(tagmetry.link.client.__file__).parent
_KEYS = [bytes([n % 251 + 1, n // 251]) * 16 for n in range(1000)]


class NewestDue:
    """Images from memory at their times; those that nobody asked for in time are dropped."""

    def __init__(self, pictures: Sequence[AnyPixels], rate: float, seconds: float) -> None:
        self._pictures, self._rate, self._count = pictures, rate, int(rate * seconds)
        self.dropped = 0

    def __iter__(self) -> Iterator[Image]:
        period, begin_s, k = 2 * (len(self._pictures) - 1), time.monotonic() + 0.1, 0
        while k < self._count:
            due_s = begin_s + k / self._rate
            time.sleep(max(due_s - time.monotonic(), 0.0))
            newest = min(int((time.monotonic() - begin_s) * self._rate), self._count - 1)
            newest = max(newest, k)
            self.dropped += newest - k
            k = newest
            place = min(k % period, period - k % period)
            due_s = begin_s + k / self._rate
            yield Image(self._pictures[place], due_s, "capture", k, "memory")
            k += 1


def measurement(count: int) -> ArenaMeasurement:
    """Return the loop of so many robots."""
    arena = Arena(Roster(crowd(count)), OverheadView(CAMERA, T_WORLD_CAMERA, np.zeros((6, 6))))
    turning = Turning(arena, Neighbourhood(NeighbourSensor(0.3)))
    detector = Detector([FAMILY])
    return ArenaMeasurement(turning, CAMERA, detector, Tracker(detector), is_live=True)


@contextmanager
def robots(count: int, port: int, odometry_hz: int) -> Iterator[None]:
    """Be so many robots until the block ends."""
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "robots"
        own = Path(__file__).with_name("soak_robots.c")
        linked = [_SOURCES / "tagmetry_link.c", _SOURCES / "tagmetry_posix.c"]
        built: list[str | Path] = [
            "gcc",
            "-O2",
            "-D_DEFAULT_SOURCE",
            f"-I{_SOURCES}",
            own,
            *linked,
            "-lm",
            "-o",
            program,
        ]
        subprocess.run(built, check=True)
        running = subprocess.Popen([program, str(count), str(port), str(odometry_hz)])
        try:
            yield
        finally:
            running.kill()
            running.wait()


def wait_until_linked(host: Host, longest_s: float = 20.0) -> None:
    """Wait until the host hears all robots."""
    end_s = time.monotonic() + longest_s
    while time.monotonic() < end_s and not all(one.is_linked for one in host.links()):
        host.pulse()
        time.sleep(0.05)


@dataclass
class Tally:
    """What a run gave, image by image."""

    to_packet_s: list[float] = field(default_factory=list)
    times: list[StageTimes] = field(default_factory=list)
    seen: list[int] = field(default_factory=list)

    def add(self, result: ArenaResult) -> None:
        self.to_packet_s.append(time.monotonic() - result.taken_s)
        self.times.append(result.times)
        self.seen.append(len(result.step.seen))

    def told(self) -> str:
        """Return the times in words."""
        middle, tail, most = np.quantile(1000 * np.array(self.to_packet_s), [0.5, 0.99, 1.0])
        names = ("detect_s", "follow_s", "tell_s", "drive_s")
        medians_ms = [
            1000 * np.median([getattr(one, name) for one in self.times]) for name in names
        ]
        stages = ", ".join(
            f"{name[:-2]} {ms:.2f}" for name, ms in zip(names, medians_ms, strict=True)
        )
        return (
            f"image to packet {middle:.2f} ms (median), {tail:.2f} (99 %), {most:.1f} (longest); "
            f"median ms: {stages}"
        )


def soak(count: int, asked: argparse.Namespace) -> str:
    """Return what a run gave, in words."""
    pictures, loop, tally = pictures_of(count), measurement(count), Tally()
    images = NewestDue(pictures, asked.rate, asked.seconds)
    with (
        Host({n: _KEYS[n] for n in range(count)}, port=0) as host,
        robots(count, host.address[1], asked.odometry_hz),
    ):
        wait_until_linked(host)
        taker = LinkTaker(host, 0.3, every_s=asked.send_every)
        for k in range(_WARM):
            picture = pictures[k % len(pictures)]
            taker.take(loop.measure(Image(picture, time.monotonic(), "capture", k, "memory")))
        begun_mb, began_s = memory_mb(), time.process_time()
        for result in run_arena(images, loop, [taker]):
            tally.add(result)
        busy = (time.process_time() - began_s) / asked.seconds
        linked, heard = sum(one.is_linked for one in host.links()), len(host.take())
    seen, done = np.mean(tally.seen), len(tally.seen)
    return (
        f"{count} robots, {seen:.1f} seen, {linked} linked, {heard} messages kept: "
        f"{done} images at {done / asked.seconds:.1f} per s, {images.dropped} dropped; "
        f"{tally.told()}; {100 * busy:.0f} % of a core; "
        f"memory {begun_mb:.0f} MB, in the end {memory_mb():.0f}"
    )


def pictures_of(count: int) -> list[AnyPixels]:
    """Return the film's pictures."""
    return [one.pixels for one in film(count, _LENGTH, np.random.default_rng(3))]


def memory_mb() -> float:
    """Return the most memory that this process held until now."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--rate", type=float, default=120.0)
    parser.add_argument("--robots", type=int, nargs="+", default=[24])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--send-every", type=float, default=0.0, help="s; 0 is with every image")
    parser.add_argument("--odometry-hz", type=int, default=50, help="of every robot; 0 is none")
    asked = parser.parse_args()
    cv2.setNumThreads(asked.threads)
    for count in asked.robots:
        print(soak(count, asked), flush=True)


if __name__ == "__main__":
    main()
