"""A scene, and what it takes to photograph it."""

from dataclasses import dataclass, field

from tagmetry.twin.scenes.light import Light
from tagmetry.twin.scenes.thing import Thing


@dataclass(frozen=True, eq=False)
class Scene:
    """Everything there is to see.

    Attributes:
        things: In any order; of surfaces in one plane, a later one lies on an earlier one.
        light: The light on them.
        background: Radiance where there is nothing; white paper in ambient light has 0.85.
    """

    things: tuple[Thing, ...]
    light: Light = field(default_factory=Light)
    background: float = 0.45
