"""What came out of a file, checked against what was expected; a mistake becomes one line."""

from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator
from pydantic_core import ErrorDetails

from tagmetry.errors import InputError
from tagmetry.files.plain import shortened

Metres = Annotated[float, Field(ge=-1e9, le=1e9)]  # what is farther is a slip of the unit


class FileModel(BaseModel):
    """A table of a file: strict types, finite numbers; unknown keys are passed over."""

    model_config = ConfigDict(strict=True, frozen=True, extra="ignore", allow_inf_nan=False)


class OwnFileModel(FileModel):
    """A table that only tagmetry writes: a key that it does not know is a mistake."""

    @model_validator(mode="before")
    @classmethod
    def _refuse_unknown_keys(cls, table: Any) -> Any:  # noqa: ANN401
        if isinstance(table, dict) and (unknown := sorted(set(table) - set(cls.model_fields))):
            raise ValueError(
                f"there is no key {shortened(unknown[0])!r}; there are "
                f"{', '.join(cls.model_fields)}"
            )
        return table


Model = TypeVar("Model", bound=FileModel)


def checked(model: type[Model], table: object) -> Model:
    """Return the table as its model.

    Raises:
        InputError: The first thing that does not fit: its field, what was expected and found.
    """
    try:
        return model.model_validate(table)
    except ValidationError as error:
        raise InputError(_one_line(error.errors(include_url=False)[0])) from error


def _one_line(details: ErrorDetails) -> str:
    field = ".".join(str(part) for part in details["loc"]) or "the file"
    if details["type"] == "missing":
        return f"{field} is missing"
    if details["type"] == "model_type":
        return f"{field}: expected keys with values, found {shortened(repr(details['input']))}"
    message = details["msg"].removeprefix("Value error, ")
    if not message.startswith("Input should be "):
        return f"{field}: {message}"
    expected = message.removeprefix("Input should be ")
    return f"{field}: expected {expected}, found {shortened(repr(details['input']))}"
