"""A server with nothing behind it; and an arena whose page a real browser shows."""

import os
from collections.abc import Iterator

import pytest
from arena_page import DESK
from chromium import Chromium, browser_path
from live_server import Served, served

from tagmetry.live.opening import LivePage, opened_page
from tagmetry.live.show.programme import Programme


@pytest.fixture(scope="module")
def live() -> Iterator[Served]:
    with served() as own:
        yield own


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LivePage]:
    """Give an arena of robots that follow one another, and its page."""
    browser_path()
    folder = tmp_path_factory.mktemp("recordings")
    pictures = "LIVE_PICTURES" in os.environ
    programme = Programme("leader_follower", 12, folder, pictures=pictures)
    with opened_page(programme, "127.0.0.1", 0) as own:
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
