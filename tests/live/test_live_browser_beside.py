"""Beside the arena, on its own page: recordings, health, and that the address names the room."""

import json
import time
from pathlib import Path

from arena_page import PICTURES, release, sign_in
from chromium import Chromium

from tagmetry.live.opening import LivePage


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
