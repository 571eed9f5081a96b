"""`tagmetry twin`: pictures of simulated scenes with exact truth."""

from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tagmetry.twin.recipe import Recipe

app = typer.Typer(help="Pictures of simulated scenes with exact truth.", no_args_is_help=True)


@app.command()
def render(
    *,
    scene: Annotated[
        str,
        typer.Argument(help="Scene file (.yaml), or a ready-made scene that `twin list` names."),
    ],
    out: Annotated[Path, typer.Option(help="Folder for pictures, or one .png or .mp4.")],
    images: Annotated[
        int | None, typer.Option(min=1, help="How many pictures; by default as the scene says.")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(min=0, help="Of the noise; of a ready-made scene, of all of it.")
    ] = None,
    truth: Annotated[
        Path | None,
        typer.Option(help="Truth: .jsonl, or one .json; by default beside the pictures."),
    ] = None,
    set_: Annotated[
        list[str] | None,
        typer.Option("--set", help="Parameter of a ready-made scene: robots=20; several times."),
    ] = None,
    jobs: Annotated[int, typer.Option(min=1, help="Pictures made at the same time.")] = 1,
) -> None:
    """Write pictures or a video of a scene, and what is exactly so in them."""
    from tagmetry.cli.interrupts import held_back
    from tagmetry.cli.progress import counted
    from tagmetry.pipeline.rendered import RenderedWriter
    from tagmetry.twin.recipe import pictures

    recipe = _recipe(scene, images, seed, set_ or [])
    with (
        RenderedWriter(out, recipe, truth) as writer,
        closing(pictures(recipe, jobs)) as made,
    ):
        for picture in counted(made, recipe.count, scene):
            with held_back():
                writer.write(picture)
    count = "1 picture" if recipe.count == 1 else f"{recipe.count} pictures"
    typer.echo(f"wrote {count} -> " + ", ".join(map(str, writer.files)))


@app.command(name="list")
def list_() -> None:
    """Name the ready-made scenes and their parameters."""
    from tagmetry.twin.scenes.ready import READY
    from tagmetry.twin.scenes.ready.choose import parameters_of, sentence

    for name in READY:
        parameters = ", ".join(f"{key}={value}" for key, value in parameters_of(name).items())
        typer.echo(f"{name}: {sentence(name)}\n    {parameters}")


def _recipe(scene: str, images: int | None, seed: int | None, settings: list[str]) -> "Recipe":
    """Return the recipe of a file or of a ready-made scene, with what the options change."""
    from tagmetry.errors import InputError
    from tagmetry.twin.scene_files import load_recipe, recipe_of

    if Path(scene).suffix.lower() not in (".yaml", ".yml", ".json"):
        changed = {key: one for key, one in (("images", images), ("seed", seed)) if one is not None}
        return recipe_of({"ready": scene, **dict(map(_setting, settings)), **changed})
    if settings:
        raise InputError("--set is for ready-made scenes; change the scene file instead")
    recipe = load_recipe(scene)
    return replace(
        recipe,
        count=recipe.count if images is None else images,
        seed=recipe.seed if seed is None else seed,
    )


def _setting(text: str) -> tuple[str, object]:
    """Return the name and the value of `robots=20`."""
    from tagmetry.errors import InputError
    from tagmetry.files.plain import plain_value, shortened

    key, equals, value = text.partition("=")
    if not (equals and key):
        raise InputError(f"expected --set NAME=VALUE like robots=20, found {shortened(text)!r}")
    return key, plain_value(value)
