"""The one error that means: what came in from outside cannot be used.

The command line prints its text as one line and exits with code 2; anything else that is raised
is a fault of the program.
"""


class InputError(ValueError):
    """An input that cannot be used; the text says what was expected, found, and what to do."""


class ControlError(InputError):
    """A camera's control does not do what it was told; the text names it and says what happened."""


class MissingExtraError(InputError):
    """An optional part of tagmetry is missing; the text gives the command that installs it."""

    def __init__(self, purpose: str, extra: str) -> None:
        super().__init__(f"{purpose} needs an optional part: pip install 'tagmetry[{extra}]'")
