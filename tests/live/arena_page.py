"""What tests of the arena's page share: to sign in, to see robots move, to photograph."""

import json
import os
import time
from pathlib import Path

import numpy as np
from chromium import Chromium

PICTURES = os.environ.get("LIVE_PICTURES")  # a folder; for the docs
PHONE, DESK = (390, 844), (1280, 1150)


def sign_in(browser: Chromium, token: str) -> None:
    """Sign in, unless the browser was before: a page that joins anew lets go of the robots."""
    if browser.run("document.getElementById('sign-in').hidden"):
        return
    browser.run(f"document.getElementById('token').value = {json.dumps(token)}; true")
    browser.run("document.getElementById('sign-in').requestSubmit(); true")
    browser.wait("document.getElementById('connection').textContent.includes('you command')")


def release(browser: Chromium) -> None:
    if browser.run("document.body.dataset.stopped") == "true":
        browser.wait("!document.getElementById('release').disabled")
        browser.run("document.getElementById('release').click(); true")
        browser.wait("document.body.dataset.stopped === 'false'")


def places(browser: Chromium) -> np.ndarray:
    """Return (id, x, y, speed) of all robots as the page has them, shape (n, 4)."""
    text = browser.run("document.body.dataset.places")
    return np.array([[float(v) for v in line.split()] for line in text.split(";")])


def text_of(browser: Chromium) -> str:
    return browser.run("document.body.dataset.places")


def wait_for_motion(browser: Chromium, before: np.ndarray, seconds: float = 30.0) -> None:
    end_s = time.monotonic() + seconds
    while np.abs(places(browser)[:, 1:3] - before[:, 1:3]).max() < 0.05:
        assert time.monotonic() < end_s
        time.sleep(0.1)


def box_of(browser: Chromium, name: str) -> list[float]:
    """Return an element's left, top, width and height."""
    return browser.run(
        f"(() => {{ const b = document.getElementById('{name}').getBoundingClientRect();"
        " return [b.x, b.y, b.width, b.height]; })()"
    )


def photograph(browser: Chromium) -> None:
    """Take the pictures of the docs, when the camera's first picture has come and robots drove."""
    folder = Path(PICTURES or ".")
    browser.wait("document.getElementById('camera-hint').textContent.includes('found')", 120)
    time.sleep(6)
    browser.photograph(folder / "desktop.png")
    browser.resize(*PHONE, is_phone=True)
    dark = [{"name": "prefers-color-scheme", "value": "dark"}]
    browser.ask("Emulation.setEmulatedMedia", features=dark)
    time.sleep(1)
    browser.photograph(folder / "phone.png")
    browser.resize(*DESK, is_phone=False)
