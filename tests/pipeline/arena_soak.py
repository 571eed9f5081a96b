"""Holds an arena's loop at a rate for long: images from memory, 24 robots, packets over loopback.

    python tests/pipeline/arena_soak.py --seconds 600 --rate 120 --robots 24

Images come from memory at their times, the newest wins, and what the loop was too late for counts
as dropped. The time from image to packet is from when an image was due until all packets that it
led to had left. Robots answer from a process of their own.
"""

import argparse
import multiprocessing
import resource
import time
from collections.abc import Iterator, Sequence

import cv2
import numpy as np

from tagmetry.arena import Arena, Neighbourhood, NeighbourSensor, OverheadView, Roster
from tagmetry.camera import Image
from tagmetry.detect import Detector, Tracker
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lab.rigs.crowd import crowd, film
from tagmetry.lab.rigs.overhead import CAMERA, FAMILY, T_WORLD_CAMERA
from tagmetry.link import Host, RobotClient
from tagmetry.pipeline.arena import ArenaMeasurement, ArenaResult, Turning, run_arena
from tagmetry.pipeline.arena.linked import LinkTaker

_LENGTH = 6  # of the film, which is played there and back
_WARM = 60  # images before the clock runs
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


def answer(count: int, port: int) -> None:
    """Be so many robots until killed."""
    robots = [RobotClient(n, _KEYS[n], port=port) for n in range(count)]
    while True:
        for robot in robots:
            robot.step(0.0)
        time.sleep(0.01)


def soak(count: int, rate: float, seconds: float, every_s: float) -> str:
    """Return what a run gave, in words."""
    pictures, loop = pictures_of(count), measurement(count)
    for k in range(_WARM):
        loop.measure(Image(pictures[0], time.monotonic(), "capture", k, "memory"))
    images = NewestDue(pictures, rate, seconds)
    to_packet_s: list[float] = []
    results: list[ArenaResult] = []
    begun_mb = memory_mb()
    with Host({n: _KEYS[n] for n in range(count)}, port=0) as host:
        robots = multiprocessing.Process(target=answer, args=(count, host.address[1]), daemon=True)
        robots.start()
        for result in run_arena(images, loop, [LinkTaker(host, 0.3, every_s=every_s)]):
            to_packet_s.append(time.monotonic() - result.taken_s)
            results.append(result)
            results = results[-1000:]
        linked = sum(one.is_linked for one in host.links())
        robots.terminate()
    counted_ms = 1000 * np.array(to_packet_s)
    middle, tail, most = np.quantile(counted_ms, [0.5, 0.99, 1.0])
    stages = {
        name: 1000 * float(np.median([getattr(one.times, name) for one in results]))
        for name in ("detect_s", "follow_s", "tell_s", "drive_s")
    }
    told = ", ".join(f"{name[:-2]} {ms:.2f}" for name, ms in stages.items())
    seen = np.mean([len(one.step.seen) for one in results])
    return (
        f"{count} robots, {seen:.1f} seen, {linked} linked: {len(to_packet_s)} images at "
        f"{len(to_packet_s) / seconds:.1f} per s, {images.dropped} dropped; image to packet "
        f"{middle:.2f} ms (median), {tail:.2f} (99 %), {most:.1f} (longest); "
        f"median ms: {told}; memory {begun_mb:.0f} MB, in the end {memory_mb():.0f}"
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
    asked = parser.parse_args()
    cv2.setNumThreads(asked.threads)
    for count in asked.robots:
        print(soak(count, asked.rate, asked.seconds, asked.send_every), flush=True)


if __name__ == "__main__":
    main()
