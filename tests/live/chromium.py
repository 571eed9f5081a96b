"""A real browser, driven through its debugging socket: scripts, keys, clicks, photographs."""

import base64
import json
import os
import shutil
import subprocess
import time
import urllib.request
from contextlib import ExitStack
from itertools import count
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import pytest
from websockets.sync.client import connect

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
STARTS_S, ANSWERS_S = 40.0, 20.0


def browser_path() -> str:
    """Return the browser's program, or skip the test."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        pytest.skip("no chromium is installed")
    return found


class Chromium:
    """One page of a browser without a window."""

    def __init__(self, folder: Path, size: tuple[int, int] = (1280, 900)) -> None:
        self._folder = folder
        self._command = [
            browser_path(), "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
            "--disable-dev-shm-usage", "--remote-debugging-port=0", "--disable-extensions",
            f"--window-size={size[0]},{size[1]}", f"--user-data-dir={folder}", "about:blank",
        ]  # fmt: skip
        self._numbers = count(1)

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            quiet = subprocess.DEVNULL
            environment = {**os.environ, "HOME": str(self._folder)}
            self._browser = subprocess.Popen(
                self._command, stdout=quiet, stderr=quiet, env=environment
            )
            stack.callback(self._end)
            self._socket = stack.enter_context(connect(self._page_address(), max_size=None))
            self.ask("Page.enable")
            self._open = stack.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._open.close()

    def ask(self, method: str, **values: object) -> dict[str, Any]:
        """Send one command of the protocol and return its answer."""
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": values}))
        while True:
            answer = json.loads(self._socket.recv(timeout=ANSWERS_S))
            if answer.get("id") == number:
                assert "error" not in answer, answer
                return answer["result"]

    def open(self, url: str) -> None:
        self.ask("Page.navigate", url=url)

    def run(self, script: str) -> Any:
        """Return the value of an expression in the page."""
        told = self.ask(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in told, told
        return told["result"].get("value")

    def wait(self, script: str, seconds: float = ANSWERS_S) -> Any:
        """Return an expression's value as soon as it is true."""
        end_s = time.monotonic() + seconds
        while not (value := self.run(script)):
            assert time.monotonic() < end_s, f"{script} was never true"
            time.sleep(0.05)
        return value

    def press_space(self) -> None:
        key = {"key": " ", "code": "Space", "windowsVirtualKeyCode": 32}
        self.ask("Input.dispatchKeyEvent", type="keyDown", text=" ", **key)
        self.ask("Input.dispatchKeyEvent", type="keyUp", **key)

    def click(self, x: float, y: float, *, is_shifted: bool = False) -> None:
        values = {"x": x, "y": y, "button": "left", "clickCount": 1, "modifiers": 8 * is_shifted}
        for kind in ("mousePressed", "mouseReleased"):
            self.ask("Input.dispatchMouseEvent", type=kind, **values)

    def photograph(self, path: Path) -> None:
        """Write what the page looks like."""
        path.write_bytes(base64.b64decode(self.ask("Page.captureScreenshot")["data"]))

    def resize(self, width: int, height: int, *, is_phone: bool) -> None:
        self.ask(
            "Emulation.setDeviceMetricsOverride",
            width=width, height=height, deviceScaleFactor=2 if is_phone else 1, mobile=is_phone,
        )  # fmt: skip

    def _page_address(self) -> str:
        """Return the page's debugging socket once the browser has started."""
        file, end_s = self._folder / "DevToolsActivePort", time.monotonic() + STARTS_S
        while not (file.exists() and file.read_text().count("\n")):
            assert time.monotonic() < end_s, "the browser did not start"
            assert self._browser.poll() is None, "the browser ended at once"
            time.sleep(0.05)
        port = file.read_text().splitlines()[0]
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list") as answer:
            pages = json.load(answer)
        return next(one["webSocketDebuggerUrl"] for one in pages if one["type"] == "page")

    def _end(self) -> None:
        self._browser.terminate()
        try:
            self._browser.wait(10)
        except subprocess.TimeoutExpired:
            self._browser.kill()
            self._browser.wait()
