"""How long do detection and pose take? `make bench`; see --help to save and compare.

Every picture is measured through the public interface, several times; the median counts. Times are
only comparable on the same machine with nothing else running.
"""

import argparse
import json
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

import tagmetry
from tagmetry.geometry.arrays import GreyPixels

SIZES_PX = ((640, 480), (1280, 720), (1920, 1080))
COUNTS = (1, 6, 24)
FAMILY = "tag36h11"


@dataclass(frozen=True)
class Row:
    """What one picture took.

    Attributes:
        picture: Its size and how many markers it shows.
        found: How many of them were found.
        detect_ms: Median time of the detection.
        pose_ms: Median time of the poses of all markers found.
    """

    picture: str
    found: int
    detect_ms: float
    pose_ms: float


def main() -> None:
    """Measure all pictures, and print them beside an earlier run if there is one."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=11, help="runs of each picture")
    parser.add_argument("--save", type=Path, help="write the times to this JSON file")
    parser.add_argument("--compare", type=Path, help="show the times of this JSON file, too")
    options = parser.parse_args()
    rows = [measured(size_px, n, options.repeats) for size_px in SIZES_PX for n in COUNTS]
    earlier = json.loads(options.compare.read_text()) if options.compare else []
    show(rows, {row["picture"]: row["detect_ms"] for row in earlier})
    if options.save:
        options.save.write_text(json.dumps([asdict(row) for row in rows], indent=1))


def measured(size_px: tuple[int, int], marker_count: int, repeats: int) -> Row:
    """Return what one picture takes."""
    width_px, height_px = size_px
    image = picture(width_px, height_px, marker_count)
    center_px = ((width_px - 1) / 2, (height_px - 1) / 2)
    camera = tagmetry.Camera(width_px, height_px, (width_px, width_px), center_px)
    detector = tagmetry.Detector(families=[FAMILY])
    found = detector.detect(image, camera)
    detect_ms = median_ms(lambda: detector.detect(image, camera), repeats)
    pose_ms = median_ms(
        lambda: [tagmetry.estimate_pose(one, camera, size_m=0.1) for one in found], repeats
    )
    return Row(f"{width_px}x{height_px}, {marker_count} markers", len(found), detect_ms, pose_ms)


def picture(width_px: int, height_px: int, marker_count: int) -> GreyPixels:
    """Return markers in rows on a noisy grey ground, each with its quiet zone."""
    markers, rng = tagmetry.family(FAMILY), np.random.default_rng(0)
    canvas = np.full((height_px, width_px), 150.0)
    columns = int(np.ceil(np.sqrt(marker_count * width_px / height_px)))
    rows = -(-marker_count // columns)
    cell_px = int(0.8 * min(width_px / columns, height_px / rows) / 10)
    for n in range(marker_count):
        cells = np.pad(markers.picture(n), 1, constant_values=True)
        grey = np.kron(np.where(cells, 220.0, 30.0), np.ones((cell_px, cell_px)))
        y = int((n // columns + 0.5) * height_px / rows - len(grey) / 2)
        x = int((n % columns + 0.5) * width_px / columns - len(grey) / 2)
        canvas[y : y + len(grey), x : x + len(grey)] = grey
    return np.clip(canvas + rng.normal(0, 3, canvas.shape), 0, 255).astype(np.uint8)


def median_ms(work: Callable[[], object], repeats: int) -> float:
    """Return the median time of some work."""
    times_s = []
    for _ in range(repeats):
        start_s = time.perf_counter()
        work()
        times_s.append(time.perf_counter() - start_s)
    return 1000 * float(np.median(times_s))


def show(rows: list[Row], earlier_ms: dict[str, float]) -> None:
    """Print the table."""
    print(f"{'picture':26} {'found':>5} {'detect':>10} {'pose':>10}  before")
    for row in rows:
        before = f"{earlier_ms[row.picture]:7.1f} ms" if row.picture in earlier_ms else ""
        times = f"{row.detect_ms:7.1f} ms {row.pose_ms:7.1f} ms"
        print(f"{row.picture:26} {row.found:5} {times}  {before}".rstrip())


if __name__ == "__main__":
    main()
