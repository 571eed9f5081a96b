"""The page's types are the messages', and its scripts keep to them."""

import re
import shutil
import subprocess
from importlib.resources import files
from pathlib import Path

import pytest

from tagmetry.live import page
from tagmetry.live.messages import CONTRACT
from tagmetry.live.messages.page_types import page_types

FOLDER = Path(str(files(page)))
PLAIN = {"number", "string", "boolean", "null", "Blob"}


def test_the_declarations_are_up_to_date() -> None:
    assert (FOLDER / "messages.d.ts").read_text("utf-8") == page_types(), "run `make pages`"


def test_every_message_is_declared_with_all_its_fields() -> None:
    text = page_types()
    for rule in CONTRACT:
        body = re.search(rf"interface {rule.name} {{\n(.*?)^}}", text, re.DOTALL | re.MULTILINE)
        assert body is not None
        names = re.findall(r"^  (\w+)\??: ", body[1], re.MULTILINE)
        assert names == ["type", *rule.message.__dataclass_fields__]


def test_every_type_that_is_used_is_declared() -> None:
    interfaces, _ = page_types().split("export type", 1)
    text = re.sub(r'/\*\*.*?\*/|"\w+"', "", interfaces)
    used = {name for line in re.findall(r": (.+);", text) for name in re.findall(r"\w+", line)}
    assert used - PLAIN <= set(re.findall(r"interface (\w+)", text))


def test_the_page_s_scripts_keep_to_them() -> None:
    checker = shutil.which("tsc")
    if checker is None:
        pytest.skip("no checker of types for scripts (tsc) is installed")
    checked = [path for path in FOLDER.rglob("*.js") if "// @ts-check" in path.read_text("utf-8")]
    options = "--noEmit --allowJs --strict --noImplicitAny false --target es2022 --module esnext"
    command = [checker, *options.split(), *map(str, checked)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
