"""Everything that is exactly so in one picture.

Poses are those of the middle of the exposure of the middle row. Corners are where they are seen at
the middle of their own row's exposure, by the twin's own rays, in pixels of the picture that is
given out: a digital zoom has been through.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers import MountedMarker
from tagmetry.twin.rendering.seen import SeenSheet, seen_sheets
from tagmetry.twin.rendering.shot import Shot
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.thing import Thing
from tagmetry.twin.truth.places import places_px
from tagmetry.twin.truth.visible import Window, visible_fraction


@dataclass(frozen=True, eq=False)
class ThingTruth:
    """Where a thing is.

    Attributes:
        name: What it is called.
        T_world_thing: Its pose.
    """

    name: str
    T_world_thing: RigidTransform


@dataclass(frozen=True, eq=False)
class MarkerTruth:
    """One marker, seen or not.

    Attributes:
        family: Its family.
        id: Its id.
        size_m: Side of its black square.
        thing: Name of the thing that it is on.
        T_camera_marker: Its pose.
        corners_px: Clockwise from its own top left, shape (4, 2); also outside the image and from
            behind; NaN where the lens shows none.
        visible_fraction: Share of its black square that the picture shows, 0 to 1.
        tilt_deg: Angle between its normal and the way to the camera; above 90 it is turned away.
        disc_px: Radius of the disc of defocus at its centre, in the picture; 0 without a lens, NaN
            behind it.
    """

    family: str
    id: int
    size_m: float
    thing: str
    T_camera_marker: RigidTransform
    corners_px: Array
    visible_fraction: float
    tilt_deg: float
    disc_px: float

    @property
    def distance_m(self) -> float:
        """From the camera's centre to the marker's."""
        return float(np.linalg.norm(self.T_camera_marker.translation))

    @property
    def depth_m(self) -> float:
        """Along the camera's axis."""
        return float(self.T_camera_marker.translation[2])

    @property
    def side_px(self) -> float:
        """Mean length of its four sides in the picture; NaN where a corner is not seen."""
        sides = np.roll(self.corners_px, -1, axis=0) - self.corners_px
        return float(np.linalg.norm(sides, axis=1).mean())


@dataclass(frozen=True, eq=False)
class BoardTruth:
    """One board.

    Attributes:
        thing: Name of the thing that it is.
        T_camera_board: Its pose.
        corners_px: Where its `corners_m` are in the picture, shape (n, 2); NaN where the lens
            shows none.
    """

    thing: str
    T_camera_board: RigidTransform
    corners_px: Array


@dataclass(frozen=True, eq=False)
class ImageTruth:
    """One picture.

    Attributes:
        camera: Its intrinsics.
        time_s: Middle of the exposure of the middle row.
        T_world_camera: The camera's pose.
        things: Where everything is.
        markers: All markers of the scene.
        boards: All boards of the scene.
    """

    camera: Camera
    time_s: float
    T_world_camera: RigidTransform
    things: tuple[ThingTruth, ...]
    markers: tuple[MarkerTruth, ...]
    boards: tuple[BoardTruth, ...]


def image_truth(scene: Scene, shot: Shot) -> ImageTruth:
    """Return what is exactly so in the picture of a scene.

    Args:
        scene: What there is to see.
        shot: Who sees it.
    """
    view = shot.view()
    seen = seen_sheets(scene, view, margin_px=0)
    return ImageTruth(
        shot.picture_camera,
        shot.time_s,
        view.T_world_thing(shot.path),
        tuple(ThingTruth(one.name, view.T_world_thing(one.path)) for one in scene.things),
        tuple(_marker(m, one, seen, shot) for one in scene.things for m in one.markers),
        tuple(board for one in scene.things if (board := _board(one, shot)) is not None),
    )


def _marker(marker: MountedMarker, thing: Thing, seen: list[SeenSheet], shot: Shot) -> MarkerTruth:
    view = shot.view()
    T_camera_marker = view.T_camera_thing(thing.path) * marker.T_body_marker
    return MarkerTruth(
        marker.family,
        marker.id,
        marker.size_m,
        thing.name,
        T_camera_marker,
        _given_out(places_px(marker.corners_m, thing.path, view), shot),
        visible_fraction(marker, thing, seen, view, _window(shot)),
        _tilt_deg(T_camera_marker),
        _disc_px(T_camera_marker, shot),
    )


def _board(thing: Thing, shot: Shot) -> BoardTruth | None:
    if thing.board is None:
        return None
    view = shot.view()
    corners_px = _given_out(places_px(thing.board.corners_m, thing.path, view), shot)
    return BoardTruth(thing.name, view.T_camera_thing(thing.path), corners_px)


def _given_out(sensor_px: Array, shot: Shot) -> Array:
    """Return where pixels of the sensor are in the picture."""
    sensor, picture = shot.camera, shot.picture_camera
    bent = (sensor_px - sensor.center_px) / sensor.focal_px
    return np.asarray(bent * picture.focal_px + picture.center_px)


def _window(shot: Shot) -> Window:
    """Return the part of the sensor that the picture shows."""
    sensor, picture = shot.camera, shot.picture_camera
    ends_px = np.array([[-0.5, -0.5], [picture.width_px - 0.5, picture.height_px - 0.5]])
    bent = (ends_px - picture.center_px) / picture.focal_px
    (left, top), (right, bottom) = bent * sensor.focal_px + sensor.center_px
    return Window(float(left), float(top), float(right), float(bottom))


def _tilt_deg(T_camera_marker: RigidTransform) -> float:
    """Return the angle between a marker's normal and the way to the camera."""
    to_camera = -np.asarray(T_camera_marker.translation)
    outward = T_camera_marker.rotation.as_matrix()[:, 2]
    aside = np.linalg.norm(np.cross(outward, to_camera))
    return float(np.degrees(np.arctan2(aside, outward @ to_camera)))


def _disc_px(T_camera_marker: RigidTransform, shot: Shot) -> float:
    lens = shot.optics.lens
    if lens is None:
        return 0.0
    sensor_px = lens.blur_radius_px(T_camera_marker.translation[2], shot.optics.focus_m)
    return float(sensor_px) * shot.picture_camera.focal_px[0] / shot.camera.focal_px[0]
