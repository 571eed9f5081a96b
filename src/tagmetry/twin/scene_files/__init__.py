"""Scenes as files: YAML that people write, read into a recipe for pictures."""

from tagmetry.twin.scene_files.load import load_recipe, recipe_of

__all__ = ["load_recipe", "recipe_of"]
