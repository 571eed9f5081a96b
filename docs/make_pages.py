"""Write the parts of the documentation that follow from the program: `make pages`.

A test compares what is committed with what this gives, so that the pages cannot drift.
"""

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import typer
from typer.core import TyperArgument, TyperCommand, TyperGroup, TyperOption

import tagmetry.cli.main
from tagmetry.link.layout import Layout
from tagmetry.link.wire import BODIES, HEADER
from tagmetry.live.messages import CONTRACT, Rule
from tagmetry.live.messages.page_types import page_types
from tagmetry.markers import family, family_names

DOCS = Path(__file__).parent
ROOT = DOCS.parent
README_EXAMPLE = re.compile(r"<!-- (?P<path>\S+) -->\n```(?P<kind>\w+)\n.*?```", re.DOTALL)

Command = TyperCommand | TyperGroup
Parameter = TyperArgument | TyperOption

CLI_INTRODUCTION = """\
# Command line

Written by the program itself; `tagmetry COMMAND --help` says the same.

Exit codes: 0 done, 1 a fault of the program, 2 an input that cannot be used (one line on standard
error says what was expected, what was found and what to do), 130 interrupted.
"""


def command_line() -> str:
    """Return the page with all commands and their options."""
    root = typer.main.get_command(tagmetry.cli.main.app)
    sections = [section(*command) for command in commands(root, "tagmetry") if command[1] != root]
    return "\n".join([CLI_INTRODUCTION, *sections])


def commands(command: Command, name: str) -> Iterator[tuple[str, Command]]:
    """Give a command and those below it with their full names."""
    yield name, command
    for key, below in sorted(getattr(command, "commands", {}).items()):
        yield from commands(below, f"{name} {key}")


def section(name: str, command: Command) -> str:
    """Return the part of the page about one command."""
    lines = [f"{'#' * name.count(' ')}# {name}", "", plain(command.help), ""]
    shown = [p for p in command.params if p.name != "help" and not getattr(p, "hidden", False)]
    if shown:
        rows = [f"| {spelled(p)} | {cell(p.help)} | {default(p)} |" for p in shown]
        lines += ["| | | default |", "|---|---|---|", *rows, ""]
    return "\n".join(lines)


def spelled(parameter: Parameter) -> str:
    """Return how a parameter is typed: `--size LENGTH`, `SOURCES…`."""
    many = " …" if parameter.multiple or parameter.nargs == -1 else ""
    if parameter.param_type_name == "argument":
        return f"`{(parameter.metavar or parameter.name).upper().strip('[].')}`{many}"
    both = "`, `".join([*parameter.opts, *parameter.secondary_opts])
    return f"`{both}`{many}"


def default(parameter: Parameter) -> str:
    """Return what holds when a parameter is not given."""
    if parameter.required:
        return "required"
    value = parameter.default
    if value is None or value is False or callable(value) or value in ("", (), []):
        return ""
    return f"`{getattr(value, 'value', value)}`"


def cell(text: str | None) -> str:
    """Return a help text as one cell of a table."""
    return plain(text).replace("\n", " ").replace("|", "\\|")


def plain(text: str | None) -> str:
    """Return a help text without the marks that only a terminal understands."""
    return re.sub(r"\s*\f.*", "", (text or "").strip(), flags=re.DOTALL)


def forgiven_bits() -> str:
    """Return the table of how many wrong bits each family forgives, and at what chance."""
    rows = [
        "| family | bits | ids | repairable | forgiven | random match |",
        "|---|---|---|---|---|---|",
    ]
    for name in family_names():
        markers = family(name)
        chance = markers.chance_of_random_match(markers.forgiven_bits)
        rows.append(
            f"| `{name}` | {markers.layout.bit_count} | {len(markers)} | "
            f"{markers.correction_bits} | {markers.forgiven_bits} | {chance:.1g} |"
        )
    return "\n".join(rows) + "\n"


def readme() -> str:
    """Return the README with its examples as their files are now."""
    return README_EXAMPLE.sub(shown, (ROOT / "README.md").read_text(encoding="utf-8"))


def shown(example: re.Match[str]) -> str:
    """Return the part of the README that shows one example."""
    text = (ROOT / example["path"]).read_text(encoding="utf-8")
    return f"<!-- {example['path']} -->\n```{example['kind']}\n{text}```"


def wire_tables() -> str:
    """Return what every packet of the link is, byte by byte."""
    parts = [layout_table("Header", "every packet", HEADER)]
    for body in BODIES.values():
        title = f"{body.kind.name} ({int(body.kind)})"
        parts.append(layout_table(title, f"from the {body.sender}. {body.meaning}", body.layout))
        if body.item is not None:
            parts.append(f"then any number of times, {body.item.size_bytes} bytes each:\n")
            parts.append(rows_of_layout(body.item))
    return "\n".join(parts)


def layout_table(title: str, about: str, layout: Layout) -> str:
    """Return the part of the page about one layout."""
    head = f"### {title}\n\n{layout.size_bytes} bytes, {about}\n"
    return f"{head}\n{rows_of_layout(layout)}" if layout.fields else head


def rows_of_layout(layout: Layout) -> str:
    """Return one row for each field."""
    rows = ["| at | field | type | |", "|---|---|---|---|"]
    places = layout.offsets_bytes()
    rows += [f"| {places[f.name]} | `{f.name}` | {f.c_type} | {f.meaning} |" for f in layout.fields]
    return "\n".join(rows) + "\n"


def live_messages() -> str:
    """Return what the live page's server and its pages say to each other."""
    rows = ["| message | from | role | fields | |", "|---|---|---|---|---|"]
    return "\n".join([*rows, *map(message_row, CONTRACT)]) + "\n"


def message_row(rule: Rule) -> str:
    """Return the line of one message: the fields' meanings stand in its class."""
    names = ", ".join(f"`{name}`" for name in rule.message.__dataclass_fields__)
    about = (rule.message.__doc__ or "").splitlines()[0]
    return f"| `{rule.name}` | {rule.sender} | {rule.role} | {names} | {about} |"


PAGES: dict[str, Callable[[], str]] = {
    "README.md": readme,
    "docs/cli.md": command_line,
    "docs/generated/forgiven.md": forgiven_bits,
    "docs/generated/live.md": live_messages,
    "docs/generated/wire.md": wire_tables,
    "src/tagmetry/live/page/messages.d.ts": page_types,
}


def write() -> None:
    """Write all pages."""
    for name, page in PAGES.items():
        path = ROOT / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    write()
