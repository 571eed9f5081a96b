"""`tagmetry detect` as tests call it, and the lines that it prints."""

import json

import pytest
from cli_command import Scene


def measured(scene: Scene, *options: str) -> list[str]:
    return ["detect", scene.picture, "--camera", scene.camera, "--json", *options]


def lines_of(capsys: pytest.CaptureFixture) -> list[dict]:
    return [
        json.loads(line, parse_constant=refuse) for line in capsys.readouterr().out.splitlines()
    ]


def refuse(constant: str) -> None:
    raise AssertionError(f"{constant} is no JSON")
