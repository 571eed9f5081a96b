"""One robot on the page: sent, charted, on a path, tuned, its wheels beside the camera."""

import json

import numpy as np
import pytest
from arena_page import PICTURES, box_of, photograph, release, sign_in
from chromium import Chromium

from tagmetry.arena.place import Place
from tagmetry.live.opening import LivePage


def test_a_click_sends_the_selected_robot(browser: Chromium, page: LivePage) -> None:
    sign_in(browser, page.token)
    release(browser)
    browser.run("document.querySelector('#table button').click(); true")
    browser.wait("document.getElementById('map').classList.contains('armed')")
    box = box_of(browser, "map")
    browser.click(box[0] + 0.5 * box[2], box[1] + 0.15 * box[3])
    browser.wait("document.getElementById('table').textContent.includes('sent by hand')")
    browser.wait("!document.getElementById('resume').disabled")
    browser.run("document.getElementById('resume').click(); true")
    browser.wait("!document.getElementById('table').textContent.includes('sent by hand')")


CHARTS = "document.querySelectorAll('#charts canvas')"
INKS = """[...document.querySelectorAll('#charts canvas')].map((one) => {
  const { data } = one.getContext('2d').getImageData(0, 0, one.width, one.height);
  return data.filter((value, n) => n % 4 === 3 && value > 0).length;
})"""


def test_charts_of_the_selected_robot_are_drawn(browser: Chromium, page: LivePage) -> None:
    assert browser.run("document.getElementById('charts').hidden")
    browser.run("document.querySelector('#table button').click(); true")
    browser.wait(f"{CHARTS}.length === 6 && {INKS}.every((ink) => ink > 200)", 30)
    captions = browser.run(
        "[...document.querySelectorAll('#charts figcaption')].map((one) => one.textContent)"
    )
    assert captions[0].startswith("Speed ")
    assert all(any(letter.isdigit() for letter in one) for one in captions)
    assert "off the camera" in browser.run("document.getElementById('selected').textContent")


def test_a_path_is_drawn_on_the_map_and_driven(browser: Chromium, page: LivePage) -> None:
    sign_in(browser, page.token)
    release(browser)
    browser.run("document.querySelector('#table button').click(); true")
    x, y, width, height = box_of(browser, "map")
    for share in (0.4, 0.6):
        browser.click(x + share * width, y + 0.2 * height, is_shifted=True)
    text = browser.run("document.getElementById('path').value")
    points = [[float(one) for one in point.split(",")] for point in text.split(";")]
    assert points[0] == pytest.approx([-points[1][0], points[1][1]], abs=0.02)
    browser.run("document.getElementById('path-send').click(); true")
    browser.wait("document.getElementById('table').textContent.includes('on a path')")
    if PICTURES:
        photograph(browser)
    browser.run("document.getElementById('halt').click(); true")
    browser.wait("document.getElementById('table').textContent.includes('waits')")
    browser.run("document.getElementById('resume').click(); true")
    browser.wait("!document.getElementById('table').textContent.includes('waits')")


@pytest.mark.parametrize(("text", "is_path"), [("0.5, -0.2; 0, 0", 1), ("0.5", 0), ("a, b", 0)])
def test_a_path_may_be_typed(browser: Chromium, text: str, is_path: int) -> None:
    browser.run(
        f"(() => {{ const one = document.getElementById('path'); one.value = {json.dumps(text)};"
        " one.dispatchEvent(new Event('input')); })()"
    )
    assert browser.run("document.getElementById('path').validity.valid") == bool(is_path)


def test_a_parameter_is_set_by_its_slider(browser: Chromium, page: LivePage) -> None:
    sign_in(browser, page.token)
    browser.wait("document.querySelectorAll('#parameters input').length === 5")
    browser.run(
        "(() => { const one = [...document.querySelectorAll('#parameters label')].find((label) =>"
        " label.textContent.startsWith('damping')).querySelector('input');"
        " one.value = 0.8; one.dispatchEvent(new Event('change')); })()"
    )
    browser.wait("document.getElementById('parameters').textContent.includes('damping: 0.8')")
    stage = page.runner._show.steered[1].parameters
    assert {one.name: one.value for one in stage}["damping"] == pytest.approx(0.8, abs=0.01)
    release(browser)


def test_wheels_and_camera_are_compared_as_places_are(browser: Chromium) -> None:
    """The page's arithmetic of places is the library's; a drift of 3 cm and 0.1 rad is told."""
    own, other = Place(0.3, -0.2, 2.9), Place(0.5, 0.1, 0.7)
    found = browser.run(
        "import('/arena/ghosts.js').then((m) =>"
        f" [m.joined({values(own)}, {values(other)}), m.inverse({values(own)})])"
    )
    for place, want in zip(found, (own @ other, own.inverse()), strict=True):
        np.testing.assert_allclose(place[:2], want.xy_m, atol=1e-12)
        assert np.sin(place[2] - want.heading_rad) == pytest.approx(0.0, abs=1e-12)
    seen, wheels = Place(1.0, 0.5, 1.2), Place(-0.4, 0.2, -2.0)
    ahead = Place(0.3, 0.05, 0.4)
    moved, drifted = seen @ ahead, wheels @ ahead @ Place(0.03, 0.0, 0.1)
    told = browser.run(
        "import('/arena/ghosts.js').then((m) => { const ghosts = new m.Ghosts(), one = (a, b) =>"
        " ({ id: 1, is_seen: true, x_m: a[0], y_m: a[1], heading_rad: a[2], odometry: b });"
        f" ghosts.take([one({values(seen)}, {values(wheels)})]);"
        f" const now = one({values(moved)}, {values(drifted)}); ghosts.take([now]);"
        " return ghosts.off(now); })"
    )
    assert (told["off_m"], told["turned_rad"]) == pytest.approx((0.03, 0.1), abs=1e-9)


def values(place: Place) -> list[float]:
    return [place.x_m, place.y_m, place.heading_rad]
