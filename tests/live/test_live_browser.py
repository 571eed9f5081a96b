"""The page in a real browser: opened, signed in, robots seen moving, and all that stops them."""

import json
import time
from pathlib import Path

import numpy as np
from arena_page import DESK, places, release, sign_in, text_of, wait_for_motion
from chromium import Chromium

from tagmetry.live.opening import LivePage
from tagmetry.live.show.watch import PATIENCE_S


def test_a_viewer_sees_robots_move_can_stop_them_and_nothing_else(
    browser: Chromium, page: LivePage
) -> None:
    browser.wait("document.querySelectorAll('#table tr').length === 12")
    before = places(browser)
    browser.wait(f"document.body.dataset.places !== {json.dumps(text_of(browser))}")
    wait_for_motion(browser, before)
    enabled = browser.run("document.querySelectorAll('[data-operator]:enabled').length")
    assert enabled == 0
    browser.run("document.getElementById('stop').click(); true")
    browser.wait("document.body.dataset.stopped === 'true'", 5)
    assert browser.run("document.getElementById('release').disabled")
    sign_in(browser, page.token)
    release(browser)


def test_the_space_bar_stops_all_robots_and_a_button_releases(
    browser: Chromium, page: LivePage
) -> None:
    sign_in(browser, page.token)
    release(browser)
    wait_for_motion(browser, places(browser))
    browser.press_space()
    browser.wait("document.body.dataset.stopped === 'true'", 5)
    browser.wait("!document.getElementById('notice').hidden")
    end_s = time.monotonic() + 10
    while np.abs(places(browser)[:, 3]).max() > 0.01:
        assert time.monotonic() < end_s
        time.sleep(0.05)
    stood = places(browser)
    time.sleep(0.5)
    assert np.abs(places(browser)[:, 1:3] - stood[:, 1:3]).max() < 0.005
    release(browser)
    wait_for_motion(browser, stood)


def test_a_page_that_is_closed_while_it_drives_stops_the_robots(
    browser: Chromium, page: LivePage, tmp_path: Path
) -> None:
    sign_in(browser, page.token)
    release(browser)
    with Chromium(tmp_path / "other", DESK) as other:
        other.open(page.url)
        other.wait("document.body?.dataset.places?.includes(';')", 40)
        sign_in(other, page.token)
        other.press_space()
        other.wait("document.body.dataset.stopped === 'true'")
        release(other)
        other.open("about:blank")
        browser.wait("document.body.dataset.stopped === 'true'", 5)
    told = browser.run("document.getElementById('notice').textContent")
    assert "closed, hidden or cut off" in told
    release(browser)


def test_a_page_that_is_hidden_while_it_drives_stops_the_robots(
    browser: Chromium, page: LivePage
) -> None:
    sign_in(browser, page.token)
    browser.press_space()
    browser.wait("document.body.dataset.stopped === 'true'")
    release(browser)
    time.sleep(2 * PATIENCE_S)
    assert browser.run("document.body.dataset.stopped") == "false"
    browser.run("Object.defineProperty(document, 'hidden', { value: true }); true")
    browser.wait("document.body.dataset.stopped === 'true'", 5)
