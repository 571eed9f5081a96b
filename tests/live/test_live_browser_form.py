"""What the page is whatever it shows: text for names, named controls, its own host, a phone."""

import time

from arena_page import PHONE
from chromium import Chromium
from live_server import served

from tagmetry.live.messages import FloorErrors, LiveRobot, World


def test_names_are_text(browser: Chromium) -> None:
    name = "<img src=x onerror=\"document.body.dataset.broken='yes'\">"
    robot = LiveRobot(
        7, name, 0.0, 0.0, 0.0, 0.0, 0.08, (0.001, 0.001, 0.0), 0.0, True, True, name, "own", (),
        None, None, None, 0.0, None, (),
    )  # fmt: skip
    with served() as live:
        live.hub.give(World(1.0, (robot,), (name,), True, name))
        browser.open(f"http://{live.host}/")
        browser.wait("document.querySelectorAll('#table tr').length === 1")
        assert browser.run("document.querySelector('#table button').textContent") == name
        assert name in browser.run("document.getElementById('notice').textContent")
        time.sleep(0.2)
        assert browser.run("document.querySelectorAll('#room-arena img').length") == 0
        assert not browser.run("document.body.dataset.broken")


def test_the_error_map_is_shown_and_told(browser: Chromium) -> None:
    errors = tuple((0.1 * n - 1.0, 0.0, 1e-5 * n, 0.0, 1e-5) for n in range(20))
    with served() as live:
        live.hub.give(FloorErrors(False, 0.1, 0.09, errors))
        browser.open(f"http://{live.host}/")
        browser.wait("document.getElementById('errors-say')?.textContent.includes('rms')")
        told = browser.run("document.getElementById('errors-say').textContent")
        assert "0.190 mm at worst" in told
        before = browser.run(MAP_PICTURE)
        browser.run("document.getElementById('show-errors').click(); true")
        assert browser.run(MAP_PICTURE) != before


MAP_PICTURE = "document.getElementById('map').toDataURL()"


def test_fits_a_phone_without_scrolling_aside(browser: Chromium) -> None:
    browser.resize(*PHONE, is_phone=True)
    assert browser.run("document.documentElement.scrollWidth") <= PHONE[0]
    heights = browser.run(
        "[...document.querySelectorAll('header button, #commands button')]"
        ".map((b) => b.getBoundingClientRect().height)"
    )
    assert min(heights) >= 40  # for fingers


def test_every_control_has_a_name(browser: Chromium) -> None:
    nameless = browser.run(
        "[...document.querySelectorAll('button, input, select, canvas')].filter((e) =>"
        " !(e.textContent.trim() || e.getAttribute('aria-label') || e.labels?.length)).length"
    )
    assert nameless == 0


def test_loads_nothing_from_other_hosts(browser: Chromium) -> None:
    loaded = browser.run("performance.getEntriesByType('resource').map((one) => one.name)")
    own = browser.run("location.origin")
    assert [name for name in loaded if not name.startswith((own, "data:"))] == []
    assert len(loaded) > 4


def test_comes_back_within_two_seconds(browser: Chromium) -> None:
    says = "document.getElementById('connection').textContent"
    with served() as first:
        browser.open(f"http://{first.host}/")
        browser.wait(f"document.readyState === 'complete' && {says}.includes('looking')")
    browser.wait(f"{says}.includes('lost')", 5)
    with served(port=first.port):
        back_s = time.monotonic()
        browser.wait(f"{says}.includes('looking')")
        assert time.monotonic() - back_s < 2.0
