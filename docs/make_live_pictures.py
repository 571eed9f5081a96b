"""Make the live page's pictures that need robots which drove for a while: desktop, errors, health.

The tests of the page take those of the other rooms, with LIVE_PICTURES naming the folder. It needs
chromium, and a computer that is not busy: the page of its health says so.
"""

import json
import sys
import tempfile
import time
from pathlib import Path

IMAGES = Path(__file__).parent / "images" / "live"
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "live"))

from arena_page import DESK, release, sign_in  # noqa: E402 (of the tests)
from chromium import Chromium  # noqa: E402

from tagmetry.live.opening import opened_page  # noqa: E402
from tagmetry.live.show.programme import Programme  # noqa: E402

ROBOTS, DRIVEN_S = 8, 45.0
PATH = "0.9, -0.6; 1.2, -0.3; 1.1, 0.2"


def arena(browser: Chromium) -> None:
    """Let them drive, send one on a path, and photograph."""
    browser.wait("document.getElementById('camera-hint').textContent.includes('found')", 120)
    browser.run("document.querySelectorAll('#table button')[2].click(); true")
    time.sleep(DRIVEN_S)
    browser.run(f"document.getElementById('path').value = {json.dumps(PATH)}; true")
    browser.run("document.getElementById('path-send').click(); true")
    time.sleep(3)
    browser.photograph(IMAGES / "desktop.png")


def errors(browser: Chromium) -> None:
    """Photograph the floor's error map."""
    browser.run("document.getElementById('measure-errors').click(); true")
    browser.wait("document.getElementById('errors-say').textContent.includes('stated')", 200)
    time.sleep(1)
    browser.photograph(IMAGES / "errors.png")


def health(browser: Chromium) -> None:
    """Photograph the figures once a minute's worth is there."""
    browser.run("location.hash = '#health'; true")
    time.sleep(60)
    browser.photograph(IMAGES / "health.png")


def main() -> None:
    """Open the page and a browser, and take the pictures."""
    with tempfile.TemporaryDirectory() as folder:
        programme = Programme("wander", ROBOTS, Path(folder))
        with (
            opened_page(programme, "127.0.0.1", 0) as page,
            Chromium(Path(folder) / "browser", DESK) as browser,
        ):
            browser.open(page.url)
            browser.wait("document.body?.dataset.places?.includes(';')", 60)
            sign_in(browser, page.token)
            release(browser)
            for take in (arena, errors, health):
                take(browser)


if __name__ == "__main__":
    main()
