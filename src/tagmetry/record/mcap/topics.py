"""What a recording holds: its topics, and the schema of each in JSON.

Images are `foxglove.CompressedImage`, so that common viewers show them; what they have no place for
stands in a member `tagmetry` that others ignore.
"""

import json
from dataclasses import dataclass
from functools import cache

from tagmetry.record.line import ImageLine

IMAGES = "/camera/image"
DETECTIONS = "/detections"
STATES = "/states"
PACKETS = "/packets"

_NUMBER, _TEXT = {"type": "number"}, {"type": "string"}
_INTEGER, _TRUTH = {"type": "integer"}, {"type": "boolean"}
_BYTES = {"type": "string", "contentEncoding": "base64"}


@dataclass(frozen=True)
class Schema:
    """A name and a JSON schema; both empty for what has none."""

    name: str
    text: bytes


@cache
def schema_of(topic: str) -> Schema:
    """Return the schema of a topic; a topic that is not known has a name and any object."""
    if topic == DETECTIONS:
        return _schema("tagmetry.ImageResult", ImageLine.model_json_schema())
    name, properties = _PROPERTIES.get(topic, ("tagmetry.Note", {}))
    return _schema(name, {"title": name, **_object(properties)})


def _schema(name: str, schema: dict[str, object]) -> Schema:
    return Schema(name, json.dumps(schema).encode())


def _object(properties: dict[str, object]) -> dict[str, object]:
    return {"type": "object", "properties": properties}


_PROPERTIES: dict[str, tuple[str, dict[str, object]]] = {
    IMAGES: (
        "foxglove.CompressedImage",
        {
            "timestamp": _object({"sec": _INTEGER, "nsec": _INTEGER}),
            "frame_id": _TEXT,
            "data": _BYTES,
            "format": _TEXT,
            "tagmetry": _object(
                {"time_s": _NUMBER, "time_kind": _TEXT, "sequence": _INTEGER, "source": _TEXT}
            ),
        },
    ),
    STATES: (
        "tagmetry.WorldState",
        {
            "time_s": _NUMBER,
            "robots": {
                "type": "array",
                "items": _object(
                    {
                        "id": _INTEGER,
                        "name": _TEXT,
                        "x_m": _NUMBER,
                        "y_m": _NUMBER,
                        "heading_rad": _NUMBER,
                        "speed_mps": _NUMBER,
                        "turn_rate_radps": _NUMBER,
                        "covariance": {"type": "array", "items": {"type": "array"}},
                        "age_s": _NUMBER,
                        "seen": _TRUTH,
                    }
                ),
            },
        },
    ),
    PACKETS: (
        "tagmetry.Packet",
        {
            "time_s": _NUMBER,
            "robot": _INTEGER,
            "kind": _TEXT,
            "incoming": _TRUTH,
            "data": _BYTES,
            "says": _object({}),
        },
    ),
}
