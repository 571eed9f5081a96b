"""OpenCV's FileStorage text, written without OpenCV: YAML with its header, or JSON."""

import json

import yaml

from tagmetry.files.tables import Table
from tagmetry.files.yaml_writer import PlainDumper, yaml_of
from tagmetry.geometry.arrays import Array


class OpenCVMatrix(dict[str, object]):
    """A matrix of doubles, as FileStorage spells it."""

    def __init__(self, values: Array) -> None:
        rows, columns = values.shape
        super().__init__(rows=rows, cols=columns, dt="d", data=values.ravel().tolist())


def filestorage_text(table: Table, *, as_json: bool) -> str:
    """Return the text of a table whose matrices are `OpenCVMatrix`."""
    if as_json:
        tagged = {key: _with_type_id(value) for key, value in table.items()}
        return json.dumps(tagged, indent=4, ensure_ascii=False) + "\n"
    return "%YAML:1.0\n---\n" + yaml_of(table, _Dumper)


def _with_type_id(value: object) -> object:
    return {"type_id": "opencv-matrix"} | value if isinstance(value, OpenCVMatrix) else value


class _Dumper(PlainDumper):
    """Marks matrices as OpenCV's reader wants them."""


def _represented_matrix(dumper: yaml.SafeDumper, matrix: OpenCVMatrix) -> yaml.MappingNode:
    return dumper.represent_mapping("tag:yaml.org,2002:opencv-matrix", matrix)


_Dumper.add_representer(OpenCVMatrix, _represented_matrix)
