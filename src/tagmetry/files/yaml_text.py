"""YAML to values, for text that nobody vouches for.

The values are built from the stream of events, without recursion: libyaml's own composer crashes on
deep nesting, and aliases can make a few lines unfold to gigabytes. Aliases, anchors, repeated keys
and tags are refused; the one tag understood is OpenCV's `!!opencv-matrix`, which marks an ordinary
mapping.
"""

import re
from dataclasses import dataclass, field

import yaml

from tagmetry.errors import InputError
from tagmetry.files.plain import plain_value, shortened
from tagmetry.files.text import DEEPEST_NESTING

_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_Node = yaml.ScalarEvent | yaml.CollectionStartEvent
_OPENCV_HEADER = re.compile(r"\A%YAML:1\.0[^\n]*")
_STANDARD = "tag:yaml.org,2002:"
_MATRIX_TAG = _STANDARD + "opencv-matrix"


def parse_yaml(text: str) -> object:
    """Return the value of one YAML document: dict, list, str, int, float, bool or None.

    Raises:
        InputError: It is not YAML, or uses what is refused.
    """
    builder = _Builder()
    try:
        for event in yaml.parse(_OPENCV_HEADER.sub("", text), Loader=_LOADER):
            builder.take(event)
    except yaml.YAMLError as error:
        raise InputError(f"this is not YAML: {_one_line(error)}") from error
    return builder.document


def _one_line(error: yaml.YAMLError) -> str:
    if isinstance(error, yaml.MarkedYAMLError) and error.problem_mark is not None:
        return f"line {error.problem_mark.line + 1}: {error.problem}"
    return shortened(" ".join(str(error).split()), 100)


@dataclass
class _Level:
    """A list or a mapping that is being filled; `key` waits for its value."""

    values: list[object] | dict[str, object]
    key: str | None = None

    @property
    def wants_key(self) -> bool:
        return isinstance(self.values, dict) and self.key is None

    def take_key(self, key: str) -> None:
        if key in self.values:
            raise InputError(f"the key {shortened(key)!r} stands there twice")
        self.key = key

    def take(self, value: object) -> None:
        if isinstance(self.values, list):
            self.values.append(value)
        elif self.key is None:
            raise InputError("a key must be a word, found a list or a mapping")
        else:
            self.values[self.key] = value
            self.key = None


@dataclass
class _Builder:
    """The document so far, and the levels that are still open."""

    document: object = None
    _levels: list[_Level] = field(default_factory=list)
    _documents: int = 0

    def take(self, event: yaml.Event) -> None:
        """Add what the event says; an error names its line."""
        try:
            self._take(event)
        except InputError as error:
            line = event.start_mark.line + 1 if event.start_mark else "?"
            raise InputError(f"line {line}: {error}") from error

    def _take(self, event: yaml.Event) -> None:
        match event:
            case yaml.DocumentStartEvent():
                self._start_document()
            case yaml.AliasEvent():
                raise InputError(f"aliases (*{event.anchor}) are not allowed; write the value out")
            case yaml.ScalarEvent():
                self._take_scalar(event)
            case yaml.SequenceStartEvent():
                self._open([], event)
            case yaml.MappingStartEvent():
                self._open({}, event)
            case yaml.CollectionEndEvent():
                self._levels.pop()

    def _start_document(self) -> None:
        self._documents += 1
        if self._documents > 1:
            raise InputError("expected one YAML document, a second one begins")

    def _take_scalar(self, event: yaml.ScalarEvent) -> None:
        _refuse_anchor_and_tag(event, allowed=())
        if self._levels and self._levels[-1].wants_key:
            self._levels[-1].take_key(event.value)
        else:
            is_plain = event.implicit[0]
            self._put(plain_value(event.value) if is_plain else event.value)

    def _open(self, values: list[object] | dict[str, object], event: _Node) -> None:
        _refuse_anchor_and_tag(event, allowed=(_MATRIX_TAG,) if isinstance(values, dict) else ())
        if len(self._levels) >= DEEPEST_NESTING:
            raise InputError(f"nested deeper than {DEEPEST_NESTING} levels")
        self._put(values)
        self._levels.append(_Level(values))

    def _put(self, value: object) -> None:
        if self._levels:
            self._levels[-1].take(value)
        else:
            self.document = value


def _refuse_anchor_and_tag(event: _Node, allowed: tuple[str, ...]) -> None:
    if event.anchor is not None:
        raise InputError(f"anchors (&{event.anchor}) are not allowed; write the value out")
    if event.tag is not None and event.tag not in allowed:
        tag = shortened(event.tag.replace(_STANDARD, "!!"))
        raise InputError(f"the tag {tag} is not allowed; only plain values are")
