"""Measure all engines, and write the tables and pictures of `how/speed.md`.

    python docs/make_bench_pictures.py results.json

draws what the file holds, as `tagmetry bench --json` writes it. Where there is no such file,
everything is measured first, case by case into that file: twenty minutes. With TAGMETRY_DATA
the real pictures are measured too. Run `tagmetry warmup` before: nobody may take more than five
minutes for his first image, kernels included. Peers that are not installed are left out; one that
crashes or does not answer says so in its cells.
"""

import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from tagmetry.lab.bench import (
    PACES,
    Results,
    Row,
    bench,
    load_results,
    real_sets,
    renderings,
    save_results,
    steps,
)
from tagmetry.lab.bench.goals import goals
from tagmetry.lab.bench.panels import available
from tagmetry.lab.bench.picture import figure_of
from tagmetry.lab.bench.real import FREE_OF
from tagmetry.lab.bench.setups import EXACT
from tagmetry.lab.bench.table import found, number
from tagmetry.lab.engines import OURS, installed

DOCS = Path(__file__).parent
GENERATED, IMAGES = DOCS / "generated", DOCS / "images" / "bench"
PICTURES = {"speed": ("time", "noise", "robots"), "accuracy": ("trade", "corners", "gamma")}
TIMED = ("count-1", "count-24", "count-360", "plain", "noise-8", "noise-16", "size-480p", "size-4k")
FILMS = ("film-24", "film-96", "film-360")
SIDES = ("side-12", "side-16", "side-20", "side-30", "count-24", "side-100", "side-200")
OTHERS = ("noise-16", "blur-0.3", "blur-1.5", "gamma-30", "gamma-60", "gamma-100")
EXACT_LINEAR = tuple(setup.name for setup in EXACT if setup.exponent == 1.0)
EXACT_GAMMA = tuple(setup.name for setup in EXACT if setup.exponent != 1.0)
FREE = tuple(f"free-{name}" for name in FREE_OF)
POSES = ("side-30", "count-24", "noise-16", "gamma-60")
DPI = 80
NOT_MEASURED = "Not measured in this run.\n"

Cell = Callable[[Row], str]


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    path = Path(sys.argv[1])
    results = load_results(path) if path.exists() else measured(path)
    GENERATED.mkdir(exist_ok=True)
    IMAGES.mkdir(parents=True, exist_ok=True)
    for name, text in pages(results).items():
        (GENERATED / f"bench_{name}.md").write_text(text, encoding="utf-8")
    for name, panels in PICTURES.items():
        shown = [panel for panel in panels if panel in available(results)]
        if shown:
            path = IMAGES / f"{name}.png"
            figure_of(results, shown).savefig(path, dpi=DPI, pil_kwargs={"optimize": True})


def measured(path: Path) -> Results:
    """Measure all cases with one thread, and some with all; write what is there after each."""
    works = renderings("full", "tag36h11")
    if "TAGMETRY_DATA" in os.environ:
        works += real_sets(Path(os.environ["TAGMETRY_DATA"]))
    to_do = steps(works, sorted({1, os.cpu_count() or 1}))
    for done, results in enumerate(bench(to_do, installed(), "tag36h11", PACES["default"]), 1):
        save_results(results, path)
        print(f"{done} of {len(to_do)}: {results.rows[-1].case}", flush=True)
    return load_results(path)


def pages(results: Results) -> dict[str, str]:
    """Return the parts of the page by name."""
    real = tuple(dict.fromkeys(r.case for r in results.rows if r.case.startswith("real-")))
    most = max(row.threads for row in results.rows)
    return {
        "machine": machine(results),
        "goals": goal_table(results),
        "times": by_case(results, TIMED, time_cell),
        "films": by_case(results, FILMS, time_cell),
        "threads": by_case(results, TIMED + FILMS, time_cell, most) if most > 1 else NOT_MEASURED,
        "sides": by_case(results, SIDES, error_cell) + bound_line(results, SIDES),
        "others": by_case(results, OTHERS, error_cell) + bound_line(results, OTHERS),
        "exact": by_case(results, EXACT_LINEAR, exact_cell) + bound_line(results, EXACT_LINEAR),
        "exact_gamma": by_case(results, EXACT_GAMMA, exact_cell) + bound_line(results, EXACT_GAMMA),
        "found": by_case(results, SIDES, found_cell),
        "free": by_case(results, FREE, lambda row: str(row.false_positives)),
        "poses": by_case(results, POSES, pose_cell),
        "costs": cost_table(results),
        "real": by_case(results, real, real_cell),
    }


def machine(results: Results) -> str:
    """Return where and with what the results were measured."""
    one = results.machine
    packages = ", ".join(f"{name} {version}" for name, version in one.packages.items())
    return f"{one.hardware}; {one.system}, Python {one.python}; {packages}.\n"


def goal_table(results: Results) -> str:
    """Return what is to hold, and whether it does."""
    lines = ["| | measured | wanted | bound | |", "|---|---|---|---|---|"]
    for goal in goals(results):
        limit = f"{'≥' if goal.at_least else '≤'} {number(goal.wanted)}"
        bound = "" if goal.bound is None else number(goal.bound)
        verdict = goal.verdict if goal.holds else f"**{goal.verdict}**"
        lines.append(f"| {goal.name} | {number(goal.measured)} | {limit} | {bound} | {verdict} |")
    return "\n".join(lines) + "\n"


def by_case(results: Results, cases: Sequence[str], cell: Cell, threads: int = 1) -> str:
    """Return a table of engines by cases; what was not measured is left out."""
    rows = [r for r in results.rows if r.case in cases and r.threads == threads]
    shown = [case for case in cases if any(row.case == case for row in rows)]
    if not shown:
        return NOT_MEASURED
    lines = [f"| | {' | '.join(shown)} |", "|---" * (len(shown) + 1) + "|"]
    for engine in dict.fromkeys(row.engine for row in rows):
        texts = [
            (row.failure or cell(row)) if (row := results.of(case, engine, threads)) else ""
            for case in shown
        ]
        name = f"**{engine}**" if engine.startswith(OURS) else engine
        lines.append(f"| {name} | {' | '.join(texts)} |")
    return "\n".join(lines) + "\n"


def bound_line(results: Results, cases: Sequence[str]) -> str:
    """Return the line of the bounds, to stand below the errors."""
    ours = [row for case in cases if (row := results.of(case, OURS, 1)) is not None]
    if not ours:
        return ""
    return f"| *bound* | {' | '.join(number(row.bound_px, 2) for row in ours)} |\n"


def time_cell(row: Row) -> str:
    """Return the time, and how many were found where that were not all."""
    missed = f" ({found(row)})" if row.found < row.expected else ""
    return f"{number(row.p50_ms)}{missed}"


def error_cell(row: Row) -> str:
    return number(row.corner_rms_px, 2)


def exact_cell(row: Row) -> str:
    """Return the error, the squared distance by the stated covariance, and what was not found."""
    missed = f" ({found(row)})" if row.found < row.expected else ""
    stated = f"; {number(row.distance2)}" if row.distance2 is not None else ""
    return f"{error_cell(row)}{stated}{missed}"


def found_cell(row: Row) -> str:
    false = f", {row.false_positives} false" if row.false_positives else ""
    return f"{found(row)}{false}"


def pose_cell(row: Row) -> str:
    position, angle = number(row.position_error_percent, 2), number(row.angle_error_deg, 2)
    return f"{position} %, {angle}°, {row.flips} flips"


def real_cell(row: Row) -> str:
    """Return time, share of what engines agree upon, what it sees alone, and its distance."""
    agreed = f"{found(row)} + {row.false_positives}" if row.expected else f"{row.false_positives}"
    off = f", {number(row.corner_rms_px, 2)} px" if row.corner_rms_px is not None else ""
    return f"{number(row.p50_ms)} ms, {agreed}{off}"


def cost_table(results: Results) -> str:
    """Return what an image, a megapixel and a marker cost, and the memory that it took."""
    if not results.costs:
        return NOT_MEASURED
    lines = [
        "| one thread | ms per image | ms per megapixel | ms per marker | misfit | memory |",
        "|---|---|---|---|---|---|",
    ]
    for cost in (one for one in results.costs if one.threads == 1):
        row = results.of("count-24", cost.engine, 1)
        parts = [cost.image_ms, cost.megapixel_ms, cost.marker_ms]
        memory = number(row.memory_mib, 2) if row else ""
        texts = [number(part, 2) for part in parts]
        texts += [f"{number(cost.misfit_percent, 2)} %", f"{memory} MiB"]
        lines.append(f"| {cost.engine} | {' | '.join(texts)} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
