"""The section `tagmetry` of a map's file: what the formats of others have no place for."""

from dataclasses import dataclass

import numpy as np
from pydantic import Field

from tagmetry.errors import InputError
from tagmetry.files.checked import OwnFileModel, checked
from tagmetry.files.maps.places import MapDefaults
from tagmetry.files.tables import Table
from tagmetry.geometry import Array, RigidTransform
from tagmetry.localize import MapMarker, MarkerMap


@dataclass(frozen=True, eq=False)
class Found:
    """A marker as a format has it: its id, its pose, and where it says so its covariance."""

    id: int
    T_world_marker: RigidTransform
    covariance: Array | None = None


class MarkerNote(OwnFileModel):
    """What is known of a marker beyond its pose."""

    id: int
    family: str
    size_m: float
    covariance: list[list[float]] | None = None
    body: str | None = None


class _Section(OwnFileModel):
    name: str = "map"
    markers: list[MarkerNote] = Field(default_factory=list)


class Notes:
    """What a file's section says of its markers, in the order of the file."""

    def __init__(self, table: Table, defaults: MapDefaults) -> None:
        self._section = checked(_Section, table.get("tagmetry", {}))
        self._defaults = defaults

    @property
    def name(self) -> str:
        """What the map is called."""
        return self._section.name

    def marker(
        self, number: int, marker: Found, family: str | None = None, size_m: float | None = None
    ) -> MapMarker:
        """Return a marker of the file, completed by its note or the defaults.

        Args:
            number: Its place in the file.
            marker: Its id and pose.
            family: Its family, where the format says it.
            size_m: Its size, where the format says it.
        """
        note = self._note(number, marker.id)
        if note is not None:
            family, size_m = note.family, note.size_m if size_m is None else size_m
        covariance = marker.covariance
        if note is not None and note.covariance is not None:
            covariance = covariance_array(note.covariance)
        return MapMarker(
            self._defaults.family_of(marker.id, family),
            marker.id,
            self._defaults.size_of(marker.id, size_m),
            marker.T_world_marker,
            np.zeros((6, 6)) if covariance is None else covariance,
            None if note is None else note.body,
        )

    def _note(self, number: int, marker_id: int) -> MarkerNote | None:
        notes = self._section.markers
        if not notes:
            return None
        if number >= len(notes) or notes[number].id != marker_id:
            raise InputError(
                f"the section tagmetry does not go with the markers: number {number} is id "
                f"{marker_id}; the file was changed, remove the section"
            )
        return notes[number]


def section_of(marker_map: MarkerMap) -> Table:
    """Return the section of a map."""
    return {"name": marker_map.name, "markers": [note_of(one) for one in marker_map.markers]}


def note_of(marker: MapMarker) -> Table:
    """Return what a note says of a marker."""
    table: Table = {"id": marker.id, "family": marker.family, "size_m": float(marker.size_m)}
    if not marker.is_exact:
        table["covariance"] = marker.covariance.tolist()
    if marker.body is not None:
        table["body"] = marker.body
    return table


def covariance_array(rows: list[list[float]]) -> Array:
    """Return a covariance, shape (6, 6), of its rows."""
    if len(rows) != 6 or {len(row) for row in rows} != {6}:
        raise InputError(f"covariance: expected 6 rows of 6 numbers, found {len(rows)} rows")
    return np.array(rows, dtype=np.float64)
