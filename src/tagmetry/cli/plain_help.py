"""The help without what misleads: a switch takes no `<bool>`, an argument stands in capitals."""

from typing import Any

import typer


def with_plain_names(command: Any) -> Any:  # noqa: ANN401 (Typer's own classes have no public names)
    """Return a command whose help shows how it is typed, and those under it."""
    for parameter in (*command.params, command.get_help_option(typer.Context(command))):
        if parameter.metavar is None and getattr(parameter, "is_flag", False):
            parameter.metavar = ""
        elif parameter.metavar is None and parameter.param_type_name == "argument":
            parameter.metavar = parameter.name.upper()
    for under in getattr(command, "commands", {}).values():
        with_plain_names(under)
    return command
