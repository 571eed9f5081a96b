"""Kinds of values that several tables of a scene file hold."""

from typing import Annotated

from pydantic import BeforeValidator, Field

from tagmetry.errors import InputError
from tagmetry.files.checked import Metres
from tagmetry.files.lengths import parse_length_m


def _length_m(value: object) -> object:
    """Return a length in metres of `0.12`, or of text with a unit such as `120mm`."""
    if not isinstance(value, str):
        return value
    try:
        return parse_length_m(value)
    except InputError as error:
        raise ValueError(str(error)) from error


Length = Annotated[float, BeforeValidator(_length_m), Field(gt=0)]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]
Share = Annotated[float, Field(ge=0, le=1)]
Vector = Annotated[list[Metres], Field(min_length=3, max_length=3)]
Quaternion = Annotated[list[float], Field(min_length=4, max_length=4)]
Pair = Annotated[list[float], Field(min_length=2, max_length=2)]
Lengths2 = Annotated[list[Length], Field(min_length=2, max_length=2)]
Lengths3 = Annotated[list[Length], Field(min_length=3, max_length=3)]
SizePx = Annotated[list[Annotated[int, Field(gt=0)]], Field(min_length=2, max_length=2)]
