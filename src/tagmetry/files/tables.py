"""YAML and JSON files whose top is a table of keys and values."""

from pathlib import Path

from tagmetry.errors import InputError
from tagmetry.files.json_text import parse_json
from tagmetry.files.text import named_errors, read_text
from tagmetry.files.yaml_text import parse_yaml

Table = dict[str, object]


def load_table(path: str | Path) -> Table:
    """Return the table of a YAML or JSON file, whichever the content is.

    Raises:
        InputError: The file is missing, too large, not text, or not such a table.
    """
    path = Path(path)
    text = read_text(path)
    with named_errors(path):
        return parse_table(text)


def load_yaml(path: str | Path) -> Table:
    """Return the table of a YAML file, read safely: no aliases, tags or repeated keys."""
    path = Path(path)
    text = read_text(path)
    with named_errors(path):
        return _as_table(parse_yaml(text))


def load_json(path: str | Path) -> Table:
    """Return the table of a JSON file: no repeated keys, only finite numbers."""
    path = Path(path)
    text = read_text(path)
    with named_errors(path):
        return _as_table(parse_json(text))


def parse_table(text: str) -> Table:
    """Return the table that a text spells, JSON when it begins with a brace, YAML otherwise."""
    beginning = text.lstrip()[:1]
    if beginning == "<":
        raise InputError("expected YAML or JSON, this looks like XML; save it as .yaml or .json")
    return _as_table(parse_json(text) if beginning == "{" else parse_yaml(text))


def _as_table(value: object) -> Table:
    if not isinstance(value, dict):
        kind = {list: "a list", type(None): "nothing"}.get(type(value), "a single value")
        raise InputError(f"expected keys with values (`key: value`), found {kind}")
    return value
