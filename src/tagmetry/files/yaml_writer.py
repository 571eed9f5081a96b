"""Values to YAML that YAML 1.1, YAML 1.2 and OpenCV's reader understand alike.

Numbers read back exactly. Short lists stay in one line, and text is quoted when a reader could take
it for something else.
"""

import re
import sys

import yaml

# Words that PyYAML leaves bare when they mean themselves; numbers by our rules begin otherwise.
_SIMPLE = re.compile(r"[A-Za-z](?:[\w ./-]*[\w./-])?", re.ASCII)


class PlainDumper(yaml.SafeDumper):
    """PyYAML's, with text quoted by our rules and no aliases."""

    def ignore_aliases(self, data: object) -> bool:  # noqa: ARG002
        """Write a value out each time it occurs."""
        return True

    def increase_indent(self, flow: bool = False, indentless: bool = False) -> None:  # noqa: ARG002
        """Indent lists below their key: OpenCV's reader stops at one that is not."""
        super().increase_indent(flow, False)


def yaml_of(table: object, dumper: type[PlainDumper] = PlainDumper) -> str:
    """Return the YAML text of a table."""
    return yaml.dump(
        table,
        Dumper=dumper,
        sort_keys=False,
        default_flow_style=None,
        allow_unicode=True,
        width=sys.maxsize,
    )


def _represented_text(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    style = None if _SIMPLE.fullmatch(text) else '"'
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=style)


PlainDumper.add_representer(str, _represented_text)
