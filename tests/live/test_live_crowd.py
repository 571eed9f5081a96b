"""A thousand pages, and pages that stay for long: the arena goes on, memory stays flat.

LIVE_SOAK_S=1800 makes the second test as long as a lecture; -s shows the figures.
"""

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from chromium import Chromium, browser_path

from tagmetry.live.health.memory import resident_bytes
from tagmetry.live.opening import LivePage, opened_page
from tagmetry.live.show.programme import Programme

SOAK_S, STEP_S = float(os.environ.get("LIVE_SOAK_S", "180")), 5.0
HEALTHY, SLOW, HALF_OPEN = 900, 50, 50


@pytest.fixture
def page(tmp_path: Path) -> Iterator[LivePage]:
    with opened_page(Programme("leader_follower", 12, tmp_path), "127.0.0.1", 0) as own:
        time.sleep(8)  # the floor is lit
        yield own


def image_rate_hz(page: LivePage, seconds: float) -> float:
    """Return the images measured per second, by the arena's own clock."""
    began_s, before_s = time.monotonic(), page.runner.time_s
    time.sleep(seconds)
    return 30 * (page.runner.time_s - before_s) / (time.monotonic() - began_s)


@pytest.mark.slow
def test_a_thousand_pages_delay_nothing(page: LivePage) -> None:
    port = int(page.url.rstrip("/").rsplit(":", 1)[1])
    alone_hz = image_rate_hz(page, 10)
    script = [sys.executable, str(Path(__file__).with_name("crowd.py")), str(port)]
    counts = ["--healthy", str(HEALTHY), "--slow", str(SLOW), "--half-open", str(HALF_OPEN)]
    with subprocess.Popen([*script, *counts], stdout=subprocess.PIPE, text=True) as crowd:
        while page.runner.viewers < HEALTHY + HALF_OPEN:
            assert crowd.poll() is None, "the crowd has gone"
            time.sleep(0.1)
        among_hz = image_rate_hz(page, 10)
        told = json.loads(crowd.communicate(timeout=120)[0])
    again_hz = image_rate_hz(page, 10)
    print(f"\nimages/s {alone_hz:.1f}, among 1,000 pages {among_hz:.1f}, after {again_hz:.1f}")
    print(told)
    assert told["in_order"]
    assert told["cut_off"] == 0
    assert told["pictures"] > HEALTHY
    assert among_hz >= 0.95 * min(alone_hz, again_hz)
    assert told["p99_s"] <= 0.2


@pytest.mark.slow
def test_memory_stays_flat(page: LivePage, tmp_path: Path) -> None:
    browser_path()
    heap_mb, server_mb = [], []
    with Chromium(tmp_path / "profile") as browser:
        browser.open(page.url)
        browser.wait("document.body?.dataset.places?.includes(';')", 40)
        browser.ask("HeapProfiler.enable")
        time.sleep(min(20.0, SOAK_S / 4))  # charts and trails are full
        end_s = time.monotonic() + SOAK_S
        while time.monotonic() < end_s:
            browser.ask("HeapProfiler.collectGarbage")
            heap_mb.append(1e-6 * browser.ask("Runtime.getHeapUsage")["usedSize"])
            server_mb.append(1e-6 * (resident_bytes() or 0))
            time.sleep(STEP_S)
    heap, server = (drift_mb_per_30_min(one) for one in (heap_mb, server_mb))
    print(f"\nheap of the page {heap_mb[0]:.1f} to {heap_mb[-1]:.1f} MB, {heap:+.1f} MB in 30 min;")
    print(f"server {server_mb[0]:.0f} to {server_mb[-1]:.0f} MB, {server:+.0f} MB in 30 min")
    assert heap < 10
    assert server < 100


def drift_mb_per_30_min(values_mb: list[float]) -> float:
    """Return the slope of a line through the later two thirds."""
    later = values_mb[len(values_mb) // 3 :]
    return float(np.polyfit(STEP_S * np.arange(len(later)), later, 1)[0] * 1800)
