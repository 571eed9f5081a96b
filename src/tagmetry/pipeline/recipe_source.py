"""The pictures of a scene of the twin as a source: as many as its file says, made as taken."""

from collections.abc import Iterator

from tagmetry.camera import Image
from tagmetry.closing import Closing
from tagmetry.twin.recipe import Recipe, pictures


class RecipeSource(Closing):
    """The images of a recipe, each with the time of its middle."""

    def __init__(self, recipe: Recipe, name: str, *, tells_camera: bool = False) -> None:
        """Take nothing yet.

        Args:
            recipe: What there is to see, who sees it, and when.
            name: Of the scene, for people.
            tells_camera: Give every image its exact intrinsics.
        """
        self.name = f"twin {name}"
        self._recipe = recipe
        self._camera = recipe.shot.picture_camera if tells_camera else None
        self._is_closed = False

    @property
    def is_live(self) -> bool:
        """No: every picture is given."""
        return False

    @property
    def length(self) -> int | None:
        """How many pictures the scene has."""
        return self._recipe.count

    def __iter__(self) -> Iterator[Image]:
        """Give the pictures until there are no more or the source is closed."""
        for one in pictures(self._recipe):
            if self._is_closed:
                return
            yield Image(
                one.pixels,
                one.truth.time_s,
                "capture",
                sequence=one.number,
                source=self.name,
                camera=self._camera,
            )

    def close(self) -> None:
        """Give no more pictures; may be called twice."""
        self._is_closed = True
