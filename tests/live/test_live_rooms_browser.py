"""The rooms beside the arena in a real browser, each through its controls."""

import json
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from arena_page import DESK, PHONE, PICTURES
from chromium import Chromium, browser_path
from live_server import Served, served

from tagmetry.live.rooms.every import Furniture

PLACES = 50 if os.environ.get("LIVE_PICTURES") else 6  # of a camera that is carried
SLOW_S = 240.0  # pictures are rendered, on a busy computer


@pytest.fixture(scope="module")
def live(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    browser_path()
    with served(furniture=Furniture(cameras=tmp_path_factory.mktemp("page") / "cameras")) as own:
        yield own


def enter(browser: Chromium, live: Served, room: str) -> None:
    """Open a room as an operator."""
    browser.resize(*DESK, is_phone=False)
    browser.open(f"http://{live.host}/#{room}")
    browser.wait("document.getElementById('connection')?.className === 'live'")
    if not browser.run("document.getElementById('sign-in').hidden"):
        put(browser, "token", live.access.token)
        browser.run("document.getElementById('sign-in').requestSubmit(); true")
        browser.wait("document.getElementById('connection').textContent.includes('you command')")
    browser.wait(f"!document.getElementById('room-{room}').hidden")


def press(browser: Chromium, id_: str) -> None:
    browser.wait(f"!document.getElementById('{id_}').disabled")
    browser.run(f"document.getElementById('{id_}').click(); true")


def put(browser: Chromium, id_: str, value: str) -> None:
    """Type into a control."""
    element = f"document.getElementById({json.dumps(id_)})"
    browser.run(f"{element}.value = {json.dumps(value)}; true")
    for kind in ("input", "change"):
        browser.run(f"{element}.dispatchEvent(new Event('{kind}', {{ bubbles: true }}))")


def fits_a_phone(browser: Chromium, room: str) -> None:
    """Check a phone's size, in the dark; controls are large enough for fingers, and named."""
    browser.resize(*PHONE, is_phone=True)
    dark = [{"name": "prefers-color-scheme", "value": "dark"}]
    browser.ask("Emulation.setEmulatedMedia", features=dark)
    photograph(browser, f"{room}-phone")
    assert browser.run("document.documentElement.scrollWidth") <= PHONE[0]
    tab = "document.querySelector('#rooms a[aria-current]').getBoundingClientRect()"
    browser.wait(f"{tab}.left >= 0 && {tab}.right <= {PHONE[0]}")  # it comes into sight
    controls = (
        f"[...document.querySelectorAll('#room-{room} :is(button, input, select, a.button)')]"
    )
    small = f"{controls}.filter((e) => e.offsetParent && e.offsetHeight < 38).map((e) => e.id)"
    assert browser.run(small) == []
    nameless = f"{controls}.filter((e) => !(e.textContent.trim() || e.labels?.length)).length"
    assert browser.run(nameless) == 0
    browser.ask("Emulation.setEmulatedMedia", features=[])
    browser.resize(*DESK, is_phone=False)


def photograph(browser: Chromium, name: str) -> None:
    if PICTURES:
        browser.photograph(Path(PICTURES) / f"{name}.png")


def test_a_sheet_is_chosen_seen_and_fetched(window: Chromium, live: Served) -> None:
    enter(window, live, "print")
    told = "document.getElementById('print-told').textContent"
    shown = "document.getElementById('print-sheet')"
    window.wait(f"{told}.includes('tag36h11') && {shown}.naturalWidth > 0")
    put(window, "print-kind", "charuco")
    window.wait(f"{told}.includes('ChArUco 7x5') && {shown}.naturalWidth > {shown}.naturalHeight")
    photograph(window, "print")
    href = window.run("document.getElementById('print-pdf').href")
    got = window.run(
        f"fetch({json.dumps(href)}).then(async (a) => [a.status, (await a.text()).slice(0, 5)])"
    )
    assert got == [200, "%PDF-"]
    window.run("document.querySelector('#print-form [name=square]').value = '90mm'; true")
    window.run("document.getElementById('print-form').dispatchEvent(new Event('input')); true")
    window.wait("document.getElementById('print-answer').textContent.includes('largest square')")
    assert window.run("document.getElementById('print-files').hidden")
    window.run("document.querySelector('#print-form [name=square]').value = '30mm'; true")
    window.run("document.getElementById('print-form').dispatchEvent(new Event('input')); true")
    window.wait(f"{told}.includes('square 30 mm')")
    fits_a_phone(window, "print")


def test_a_camera_is_calibrated_on_the_twins_board(window: Chromium, live: Served) -> None:
    enter(window, live, "calibrate")
    says = "document.getElementById('calibrate-{}').textContent"
    assert "Nothing is being calibrated" in window.run(says.format("advice"))
    press(window, "calibrate-begin")
    window.wait(says.format("advice") + ".includes('Hold the board')", SLOW_S)
    window.wait(says.format("far") + ".includes('4 views')", SLOW_S)
    window.wait("document.getElementById('calibrate-picture').dataset.corners > 0", SLOW_S)
    photograph(window, "calibrate-looking")
    press(window, "calibrate-end")
    window.wait("!document.getElementById('calibrate-result').hidden", SLOW_S)
    numbers = window.run(says.format("numbers"))
    assert "fx" in numbers
    put(window, "calibrate-name", "door")
    window.run("document.getElementById('calibrate-save').requestSubmit(); true")
    window.wait(says.format("saved") + ".includes('door.yaml')")
    report = "fetch('/calibrate/report').then(async (a) => (await a.text()).slice(0, 15))"
    assert window.run(report) == "<!doctype html>"
    photograph(window, "calibrate")
    fits_a_phone(window, "calibrate")


def test_the_space_bar_stops_in_every_room(window: Chromium, live: Served) -> None:
    enter(window, live, "print")
    before = len(live.runner.asked)
    window.run("document.getElementById('print-kind').focus(); true")
    window.press_space()
    window.wait("true")
    asked = [type(one).__name__ for _, one in live.runner.asked[before:]]
    assert "Stop" in asked


def test_the_lens_is_driven_to_a_marker(window: Chromium, live: Served) -> None:
    enter(window, live, "lens")
    says = "document.getElementById('lens-say').textContent"
    assert "The lens rests" in window.run(says)
    press(window, "lens-begin")
    window.wait(f"{says}.includes('measured after')", SLOW_S)
    window.wait("document.getElementById('lens-picture').dataset.corners === '4'", SLOW_S)
    window.wait("!document.getElementById('lens-begin').disabled", SLOW_S)
    window.wait("document.querySelectorAll('#lens-bank tr').length === 31", SLOW_S)
    photograph(window, "lens")
    fits_a_phone(window, "lens")


def test_a_camera_is_carried_round_a_room(window: Chromium, live: Served) -> None:
    enter(window, live, "locate")
    says = "document.getElementById('locate-say').textContent"
    assert "No camera is being carried" in window.run(says)
    press(window, "locate-begin")
    window.wait("document.querySelectorAll('#locate-residuals tr').length >= 2", SLOW_S)
    window.wait(f"parseInt({says}.match(/(\\d+) places/)[1]) >= {PLACES}", SLOW_S)
    photograph(window, "locate")
    press(window, "locate-stop")
    window.wait(f"{says}.includes('stopped by hand')", SLOW_S)
    fits_a_phone(window, "locate")


def test_names_of_files_to_locate_from_are_asked_and_refused_in_words(
    window: Chromium, live: Served
) -> None:
    enter(window, live, "locate")
    for field, name in (("map-name", "hall.yaml"), ("camera", "camera.yaml"), ("images", "walk")):
        put(window, f"locate-{field}", name)
    press(window, "locate-open")
    window.wait("document.getElementById('notice').textContent.includes('there is no hall.yaml')")


@pytest.mark.parametrize(
    ("room", "empty"),
    [("recordings", "Nothing has been recorded yet"), ("health", "No news yet")],
)
def test_a_room_without_news_says_what_it_waits_for(
    window: Chromium, live: Served, room: str, empty: str
) -> None:
    enter(window, live, room)
    window.wait(f"document.getElementById('room-{room}').innerText.includes({json.dumps(empty)})")
    fits_a_phone(window, room)
