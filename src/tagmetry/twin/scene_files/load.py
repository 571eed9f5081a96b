"""A scene file as a recipe for pictures.

    camera:
      size_px: [1280, 720]
      field_of_view_deg: 60
      at: {translation_m: [0.3, -0.5, 2.5], looking_at_m: [0, 0, 1]}
    things:
      - {marker: tag36h11, ids: [7], size: 120mm, at: {translation_m: [0, 0, 1]}}

or a ready-made scene with its parameters:

    ready: arena
    robots: 12
"""

from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from tagmetry.errors import InputError
from tagmetry.files.checked import OwnFileModel, checked
from tagmetry.files.tables import Table, load_table
from tagmetry.files.text import named_errors
from tagmetry.twin.recipe import Recipe, check_something_is_seen
from tagmetry.twin.scene_files.camera import CameraTable
from tagmetry.twin.scene_files.fields import NotNegative, Positive, Vector
from tagmetry.twin.scene_files.things import thing_of
from tagmetry.twin.scenes import Lamp, Light, Scene, Thing
from tagmetry.twin.scenes.ready import ready_recipe

_MOST_THINGS = 1000
_MOST_LAMPS = 100


class _Lamp(OwnFileModel):
    """A lamp at a place; what it adds to a sheet that faces it at 1 m."""

    at_m: Vector
    strength: Positive

    def lamp(self) -> Lamp:
        """Return the lamp."""
        return Lamp(np.array(self.at_m), self.strength)


class _Light(OwnFileModel):
    """The light."""

    ambient: NotNegative = 1.0
    lamps: Annotated[list[_Lamp], Field(max_length=_MOST_LAMPS)] = []  # noqa: RUF012


class _SceneFile(OwnFileModel):
    """The whole file."""

    camera: CameraTable
    things: Annotated[list[dict[str, object]], Field(min_length=1, max_length=_MOST_THINGS)]
    light: _Light = _Light()
    background: NotNegative = 0.45
    images: Annotated[int, Field(ge=1)] | None = None
    duration_s: Positive | None = None
    rate_hz: Positive = 30.0
    seed: Annotated[int, Field(ge=0)] = 0

    def count(self) -> int:
        """Return how many images there are."""
        if self.images is not None and self.duration_s is not None:
            raise InputError("give one of images and duration_s")
        if self.duration_s is not None:
            return max(round(self.duration_s * self.rate_hz), 1)
        return self.images or 1


def load_recipe(path: str | Path) -> Recipe:
    """Return the recipe of a scene file.

    Raises:
        InputError: The file is missing or broken, or no picture would show anything.
    """
    table = load_table(path)
    with named_errors(path):
        return recipe_of(table)


def recipe_of(table: Table) -> Recipe:
    """Return the recipe that the table of a scene file describes."""
    if "ready" in table:
        parameters = {key: value for key, value in table.items() if key != "ready"}
        recipe = ready_recipe(str(table["ready"]), parameters)
    else:
        recipe = _recipe(checked(_SceneFile, table))
    check_something_is_seen(recipe)
    return recipe


def _recipe(file: _SceneFile) -> Recipe:
    lamps = tuple(one.lamp() for one in file.light.lamps)
    things = tuple(_thing(number, table) for number, table in enumerate(file.things))
    scene = Scene(things, Light(file.light.ambient, lamps), file.background)
    with named_errors("camera"):
        shot = file.camera.shot()
    return Recipe(scene, shot, file.count(), file.rate_hz, file.seed)


def _thing(number: int, table: Table) -> Thing:
    with named_errors(f"things.{number}"):
        return thing_of(table)
