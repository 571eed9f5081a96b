"""The page in a real browser: opened, signed in, robots seen moving, stopped by the space bar."""

import json
import os
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from chromium import Chromium, browser_path
from live_server import served

from tagmetry.arena.place import Place
from tagmetry.live.messages import FloorErrors, LiveRobot, World
from tagmetry.live.opening import LivePage, opened_page
from tagmetry.live.show.watch import PATIENCE_S

PICTURES = os.environ.get("LIVE_PICTURES")  # a folder; for the docs
PHONE, DESK = (390, 844), (1280, 1150)


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LivePage]:
    browser_path()
    folder = tmp_path_factory.mktemp("recordings")
    with (
        opened_page("leader_follower", 12, "127.0.0.1", 0, folder, pictures=bool(PICTURES)) as own,
    ):
        yield own


@pytest.fixture(scope="module")
def window(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chromium]:
    with Chromium(tmp_path_factory.mktemp("profile"), DESK) as own:
        yield own


@pytest.fixture
def browser(window: Chromium, page: LivePage) -> Chromium:
    """Return a browser that shows the page; once signed in it stays so."""
    window.resize(*DESK, is_phone=False)
    window.open(page.url)
    window.wait("document.body?.dataset.places?.includes(';')", 40)
    return window


def sign_in(browser: Chromium, token: str) -> None:
    """Sign in, unless the browser was before: a page that joins anew lets go of the robots."""
    if browser.run("document.getElementById('sign-in').hidden"):
        return
    browser.run(f"document.getElementById('token').value = {json.dumps(token)}; true")
    browser.run("document.getElementById('sign-in').requestSubmit(); true")
    browser.wait("document.getElementById('connection').textContent.includes('you command')")


def places(browser: Chromium) -> np.ndarray:
    """Return (id, x, y, speed) of all robots as the page has them, shape (n, 4)."""
    text = browser.run("document.body.dataset.places")
    return np.array([[float(v) for v in line.split()] for line in text.split(";")])


def release(browser: Chromium) -> None:
    if browser.run("document.body.dataset.stopped") == "true":
        browser.wait("!document.getElementById('release').disabled")
        browser.run("document.getElementById('release').click(); true")
        browser.wait("document.body.dataset.stopped === 'false'")


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


def text_of(browser: Chromium) -> str:
    return browser.run("document.body.dataset.places")


def wait_for_motion(browser: Chromium, before: np.ndarray, seconds: float = 30.0) -> None:
    end_s = time.monotonic() + seconds
    while np.abs(places(browser)[:, 1:3] - before[:, 1:3]).max() < 0.05:
        assert time.monotonic() < end_s
        time.sleep(0.1)


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


def test_the_address_names_the_room(browser: Chromium) -> None:
    shown = "[...document.querySelectorAll('.room:not([hidden])')].map((e) => e.id).join()"
    current = "[...document.querySelectorAll('#rooms a[aria-current]')].map((e) => e.hash).join()"
    rooms = browser.run("[...document.querySelectorAll('.room')].map((e) => e.id.slice(5))")
    links = browser.run("[...document.querySelectorAll('#rooms a')].map((e) => e.hash.slice(1))")
    assert sorted(rooms) == sorted(links)
    for room in [*rooms, "arena"]:
        browser.run(f"location.hash = {json.dumps(room)}; true")
        browser.wait(f"{shown} === 'room-{room}' && {current} === '#{room}'")
    browser.run("location.hash = 'nowhere'; true")
    browser.wait(f"{shown} === 'room-arena'")


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


def test_records_from_the_page_and_shows_it_again(browser: Chromium, page: LivePage) -> None:
    sign_in(browser, page.token)
    release(browser)
    browser.run("location.hash = '#recordings'; true")
    button = "document.getElementById('recordings-record')"
    says = f"{button}.textContent"
    browser.run(f"{button}.click(); true")
    browser.wait(f"{says} === 'End recording'")
    browser.wait("document.getElementById('news').textContent.includes('.mcap')")
    time.sleep(3)
    browser.run(f"{button}.click(); true")
    browser.wait(f"{says} === 'Record'")
    see = "document.querySelector('#recordings-list button:not(:disabled)')"
    browser.wait(f"{see} !== null")
    browser.run(f"{see}.click(); true")
    browser.wait("!document.getElementById('replay').hidden")
    told = "document.getElementById('replay-told').textContent"
    browser.wait(f"{told}.includes('12 robots')")
    first = browser.run(told)
    browser.wait(f"{told} !== {json.dumps(first)}")  # it plays
    if PICTURES:
        photograph_room(browser)
    time_line = "document.getElementById('replay-time')"
    browser.wait(f"document.getElementById('replay-play').textContent === 'Play' && {told}")
    last = browser.run(told)
    browser.run(f"{time_line}.value = 0; {time_line}.dispatchEvent(new Event('input')); true")
    browser.wait(f"parseFloat({told}) < parseFloat({json.dumps(last)})")
    browser.run("document.getElementById('replay-leave').click(); true")
    browser.wait("document.getElementById('replay').hidden")


def photograph_room(browser: Chromium) -> None:
    time.sleep(1)
    browser.photograph(Path(PICTURES or ".") / "recordings.png")


def test_a_recording_is_deleted_when_asked_twice(browser: Chromium, page: LivePage) -> None:
    sign_in(browser, page.token)
    browser.run("location.hash = '#recordings'; true")
    count = "document.querySelectorAll('#recordings-list li').length"
    browser.wait(f"{count} >= 1")
    before = browser.run(count)
    remove = "document.querySelector('#recordings-list li button:last-child')"
    browser.run(f"{remove}.click(); true")
    browser.wait(f"{remove}.textContent === 'Really delete?'")
    assert browser.run(count) == before
    browser.run(f"{remove}.click(); true")
    browser.wait(f"{count} === {before - 1}")


def test_tells_how_it_does(browser: Chromium) -> None:
    browser.run("location.hash = '#health'; true")
    for figure in ("images", "turn", "told", "battery", "disk"):
        browser.wait(f"parseFloat(document.getElementById('health-{figure}').textContent) > 0")
    browser.wait("document.getElementById('health-advice').textContent.length > 5")
    browser.wait("document.getElementById('health-stages').textContent.includes('tell pages')")
    if PICTURES:
        time.sleep(10)
        browser.photograph(Path(PICTURES) / "health.png")


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
