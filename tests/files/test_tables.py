"""YAML and JSON tables: what they mean, and what is refused."""

import contextlib
import json
import time
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.files import load_json, load_table, load_yaml
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.json_text import parse_json
from tagmetry.files.text import LARGEST_BYTES
from tagmetry.files.yaml_text import parse_yaml
from tagmetry.files.yaml_writer import yaml_of

INTEGERS = st.integers(-(10**18) + 1, 10**18 - 1)
SCALARS = st.none() | st.booleans() | INTEGERS | st.floats(allow_nan=False, allow_infinity=False)
TEXTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=20)
VALUES = st.recursive(
    SCALARS | TEXTS, lambda v: st.lists(v, max_size=4) | st.dictionaries(TEXTS, v, max_size=4)
)
WORDS = st.sampled_from(
    ["1e5", "1e400", "0x1f", "010", "1:30", "no", "~", "", ".5", "5.", ".nan", "-", "null", "+1"]
)


def write(tmp_path: Path, content: str | bytes, name: str = "file.yaml") -> Path:
    path = tmp_path / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


@given(st.dictionaries(TEXTS | WORDS, VALUES | WORDS, max_size=5))
def test_yaml_reads_what_was_written(table: dict[str, object]) -> None:
    assert parse_yaml(yaml_of(table)) == table


@given(st.dictionaries(TEXTS, VALUES, max_size=5))
def test_json_reads_what_was_written(table: dict[str, object]) -> None:
    assert parse_json(json.dumps(table)) == table


@given(st.dictionaries(TEXTS | WORDS, VALUES | WORDS, max_size=5))
def test_other_readers_understand_what_was_written(table: dict[str, object]) -> None:
    assert yaml.safe_load(yaml_of(table)) == table


@pytest.mark.parametrize(
    ("word", "value"),
    [
        ("1e-05", 1e-5),  # PyYAML's own rules make text of it
        ("5.", 5.0),
        (".5", 0.5),
        ("-3", -3),
        ("010", "010"),  # not octal
        ("1:30", "1:30"),  # not 90
        ("no", "no"),
        ("true", True),
        ("~", None),
        (".nan", ".nan"),  # refused where a number is expected
        ("1234567890123456789", 1.2345678901234567e18),
    ],
)
def test_plain_words(word: str, value: object) -> None:
    found = parse_yaml(f"key: {word}")
    assert found == {"key": value}
    assert isinstance(found, dict)
    assert type(found["key"]) is type(value)


def test_quoted_words_are_text() -> None:
    assert parse_yaml("""{a: "1", b: 'true', "3": x}""") == {"a": "1", "b": "true", "3": "x"}


def test_opencv_header_and_matrix_tag_are_understood() -> None:
    text = "%YAML:1.0\n---\nM: !!opencv-matrix\n   rows: 1\n   data: [ 1., .5,\n       2. ]\n"
    assert parse_yaml(text) == {"M": {"rows": 1, "data": [1.0, 0.5, 2.0]}}


def test_byte_order_mark_is_passed_over(tmp_path: Path) -> None:
    assert load_yaml(write(tmp_path, "\ufeffa: 1")) == {"a": 1}
    assert load_json(write(tmp_path, '\ufeff{"a": 1}')) == {"a": 1}


def test_content_tells_json_from_yaml(tmp_path: Path) -> None:
    assert load_table(write(tmp_path, ' {"a":\t1}')) == {"a": 1}
    assert load_table(write(tmp_path, "a: 1", "file.json")) == {"a": 1}


def test_33_levels_are_too_deep() -> None:
    for parse in (parse_yaml, parse_json):
        with pytest.raises(InputError, match="nested deeper than 32 levels"):
            parse("[" * 33 + "]" * 33)


def test_32_levels_are_fine() -> None:
    assert str(parse_yaml("[" * 32 + "]" * 32)) == "[" * 32 + "]" * 32
    assert str(parse_json("[" * 32 + "]" * 32)) == "[" * 32 + "]" * 32


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: 1\nb: 1\na: 2", "line 3: the key 'a' stands there twice"),
        ("a: &x 1", r"line 1: anchors \(&x\) are not allowed"),
        ("a: &x [*x]", r"anchors \(&x\) are not allowed"),
        ("a: *x", r"aliases \(\*x\) are not allowed"),
        (
            "a: 1\nb: !!python/object/apply:os.system [ls]",
            "line 2: the tag !!python/object/apply:os.system is not al",
        ),
        ("a: !!python/name:os.system ''", "the tag .* is not allowed"),
        ("a: !!opencv-matrix [1]", "the tag .*opencv-matrix is not allowed"),
        ("a: 1e400", "line 1: the number 1e400 is too large"),
        ("a: -" + "9" * 400, "the number -9+… is too large"),
        ("a: 1\n---\nb: 2", "a second one begins"),
        ("? [a]\n: 1", "a key must be a word"),
        ("a: [1, 2", "this is not YAML: line [12]: "),
        ("a: b: c", "this is not YAML: line 1: "),
        ("a: \x07", "this is not YAML: .*character"),
        ("# only a comment", "found nothing"),
        ("- 1", "found a list"),
        ("word", "found a single value"),
        ("<?xml version='1.0'?>", "this looks like XML"),
    ],
)
def test_yaml_refuses(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError, match=rf"file\.yaml: .*{message}") as caught:
        load_table(write(tmp_path, text))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"a": 1, "a": 2}', "the key 'a' stands there twice"),
        ('{"a": NaN}', "expected a finite number, found NaN"),
        ('{"a": -Infinity}', "expected a finite number, found -Infinity"),
        ('{"a": 1e400}', "the number 1e400 is too large"),
        ('{"a": ' + "9" * 5000 + "}", "the number 9+… is too large"),
        ('{"a": ["\\ud800"]}', "half a character"),
        ('{"a": 1', "this is not JSON: line 1: "),
        ("[1]", "found a list"),
        ("a: 1", "this is not JSON"),
    ],
)
def test_json_refuses(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError, match=rf"file\.yaml: .*{message}") as caught:
        load_json(write(tmp_path, text))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "the file is empty"),
        (b" \n\t\n", "the file is empty"),
        (b"a: \xff", "expected UTF-8 text, byte 3 is not"),
        ("a: 1".encode("utf-16"), "expected UTF-8 text, byte 0 is not"),
        (b"\x89PNG\r\n\x1a\n\0\0", "expected UTF-8 text"),
        (b"a: \0", "found a NUL byte at character 3"),
        (b"#" * (LARGEST_BYTES + 1), "at most 4 MiB"),
    ],
)
@pytest.mark.parametrize("load", [load_yaml, load_json, load_table])
def test_refuses_what_is_no_text(
    tmp_path: Path, content: bytes, message: str, load: Callable[[Path], object]
) -> None:
    with pytest.raises(InputError, match=message):
        load(write(tmp_path, content))


def test_refuses_what_is_no_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"nothing\.yaml: there is no such file"):
        load_yaml(tmp_path / "nothing.yaml")
    with pytest.raises(InputError, match="expected a file, this is a folder"):
        load_yaml(tmp_path)
    with pytest.raises(InputError, match="cannot be read: File name too long"):
        load_yaml(tmp_path / ("long" * 100))


@pytest.mark.parametrize(
    "text",
    [
        "[" * 100_000,
        '{"a":' * 100_000,
        "{a: " * 100_000,
        "- " * 100_000,
        "? " * 100_000,
        "a: " + "[" * 33,
        "\n".join(" " * depth + "a:" for depth in range(1000)),
        '{"a": ' + "[" * 100_000 + "]" * 100_000 + "}",
    ],
    ids=lambda text: text[:8],
)
def test_refuses_deep_nesting_at_once(tmp_path: Path, text: str) -> None:
    path = write(tmp_path, text)
    start_s = time.process_time()
    with pytest.raises(InputError, match=r"nested deeper than 32 levels|a key must be a word"):
        load_table(path)
    assert time.process_time() - start_s < 1.0


@pytest.mark.parametrize(
    "text", ['"' + '\\"' * 1_000_000, "{" + '"\\' * 1_000_000], ids=lambda text: text[:4]
)
def test_unclosed_strings_are_refused_at_once(text: str) -> None:
    start_s = time.process_time()
    with pytest.raises(InputError, match="this is not JSON"):
        parse_json(text)
    assert time.process_time() - start_s < 1.0


def test_brackets_in_strings_do_not_count() -> None:
    deep = "[" * 100 + '\\"' + "{" * 100
    assert parse_json(f'{{"a": "{deep}"}}') == {"a": deep.replace("\\", "")}


class _Sizes(FileModel):
    size_m: list[float]


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ({}, "size_m is missing"),
        ({"size_m": [1.0, float("inf")]}, r"size_m\.1: expected a finite number, found inf"),
        ({"size_m": ["1" * 100]}, r"size_m\.0: expected a valid number, found '1{39}…$"),
        (7, "the file: expected keys with values, found 7"),
    ],
)
def test_mistakes_in_a_table_are_one_line(table: object, message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        checked(_Sizes, table)
    assert "\n" not in str(caught.value)


@given(st.text(max_size=200))
def test_any_text_is_read_or_refused(text: str) -> None:
    for parse in (parse_yaml, parse_json):
        with contextlib.suppress(InputError):
            parse(text)
