"""What can be wrong with a camera's controls, for tests of those who use them."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Faults:
    """Faults of controls, by their names; none by default.

    Attributes:
        refused: Never take a value.
        stuck: Take a value and read it back, but stay where they are.
        misread: What is added to what is read back.
        late_images: By how many more images a change comes late.
    """

    refused: frozenset[str] = frozenset()
    stuck: frozenset[str] = frozenset()
    misread: Mapping[str, float] = field(default_factory=dict)
    late_images: Mapping[str, int] = field(default_factory=dict)
