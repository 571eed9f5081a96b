"""Maps measured from pictures: places of cameras and markers that fit all corners together.

The most frequent marker is the world. The others are placed one after another, the surest first;
each is tried in both poses that fit its corners, all places are refined, and the better one stays.
It shares only OpenCV's and SciPy's code, none with what it is to judge.
"""

import cv2
import numpy as np
from scipy.optimize import least_squares
from scipy.sparse import lil_matrix

from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers import marker_corners_m


def surveyed_map(views, camera, size_m, family) -> MarkerMap:
    """Return the map of all markers that pictures join to the most frequent one.

    Args:
        views: For every picture its corners (4, 2) by id.
        camera: Without distortion.
        size_m: Side of all markers.
        family: Of all markers.
    """
    survey = _Survey(views, camera, size_m)
    while links := survey.links():
        survey.place(*max(links)[1:])
    placed = survey.refined(survey.markers, 40)[1]
    return MarkerMap(
        tuple(MapMarker(family, k, size_m, _transform(placed[k])) for k in sorted(placed))
    )


class _Survey:
    """What is placed so far, as (translation, rotation vector) by id; the first is the world."""

    def __init__(self, views, camera, size_m):
        self.views, self.camera = views, camera
        self.corners_m = marker_corners_m(size_m)
        ids = [k for view in views for k in view]
        self.markers = {max(sorted(set(ids)), key=ids.count): np.zeros(6)}
        self.own = {(n, k): self._two_poses(v[k]) for n, v in enumerate(views) for k in v}

    def links(self):
        """Give surety, picture and id of markers beside one that is placed."""
        found = []
        for n, view in enumerate(self.views):
            known = view.keys() & self.markers.keys()
            for k in view.keys() - self.markers.keys():
                if known:
                    end = np.inf if len(known) > 1 else max(self.own[n, one][1] for one in known)
                    found.append((min(end, self.own[n, k][1]), n, k))
        return found

    def place(self, n, k):
        """Place a marker by a picture, in the one of its two poses that fits all better."""
        T_camera_world = self._camera(n, self.markers)
        tried = [
            self.refined({**self.markers, k: _six(T_camera_world.inv() * T_camera_marker)}, 12)
            for T_camera_marker in self.own[n, k][0]
        ]
        self.markers = min(tried, key=lambda one: one[0])[1]

    def refined(self, markers, steps):
        """Return the cost and the places of markers that fit all corners."""
        numbers = [n for n, view in enumerate(self.views) if len(view.keys() & markers.keys()) > 1]
        order = {k: len(numbers) + i for i, k in enumerate(list(markers)[1:])}
        seen = [
            (i, order.get(k, -1), self.views[n][k])
            for i, n in enumerate(numbers)
            for k in self.views[n].keys() & markers.keys()
        ]
        start = [_six(self._camera(n, markers)) for n in numbers] + [markers[k] for k in order]
        solved = least_squares(
            lambda values: self._residuals(values.reshape(-1, 6), seen),
            np.concatenate(start),
            jac_sparsity=_pattern(seen, len(start)),
            loss="soft_l1",
            max_nfev=steps,
        )
        poses = solved.x.reshape(-1, 6)
        return solved.cost, {k: poses[order[k]] if k in order else markers[k] for k in markers}

    def _residuals(self, poses, seen):
        cameras = np.array([one[0] for one in seen])
        owners = np.array([one[1] for one in seen])
        points = np.repeat(self.corners_m[None], len(seen), axis=0)
        moved = owners >= 0
        points[moved] = _moved(poses[owners[moved]], points[moved])
        p = _moved(poses[cameras], points)
        pixels = p[..., :2] / np.maximum(p[..., 2:], 1e-3) * self.camera.focal_px
        return (pixels + self.camera.center_px - np.array([one[2] for one in seen])).ravel()

    def _camera(self, n, markers):
        """Return T_camera_world of a picture by the markers that are placed."""
        known = sorted(self.views[n].keys() & markers.keys())
        if len(known) == 1:
            return self.own[n, known[0]][0][0] * _transform(markers[known[0]]).inv()
        points = _moved(
            np.array([markers[k] for k in known]), np.repeat(self.corners_m[None], len(known), 0)
        )
        pixels = np.array([self.views[n][k] for k in known])
        _, turn, place = cv2.solvePnP(
            points.reshape(-1, 3),
            pixels.reshape(-1, 2),
            self.camera.matrix,
            np.zeros(5),
            flags=cv2.SOLVEPNP_SQPNP,
        )
        return _transform(np.concatenate([place.ravel(), turn.ravel()]))

    def _two_poses(self, pixels):
        """Return both poses of a marker alone, the better first, and by how much it fits better."""
        _, turns, places, errors_px = cv2.solvePnPGeneric(
            self.corners_m, pixels, self.camera.matrix, np.zeros(5), flags=cv2.SOLVEPNP_IPPE_SQUARE
        )
        both = [
            _transform(np.concatenate([place.ravel(), turn.ravel()]))
            for place, turn in zip(places, turns, strict=True)
        ]
        return both, float(errors_px[1, 0] - errors_px[0, 0])


def _pattern(seen, count):
    pattern = lil_matrix((8 * len(seen), 6 * count), dtype=int)
    for row, (camera, owner, _) in enumerate(seen):
        for place in (camera, owner) if owner >= 0 else (camera,):
            pattern[8 * row : 8 * row + 8, 6 * place : 6 * place + 6] = 1
    return pattern


def _six(T):
    return np.concatenate([T.translation, T.rotation.as_rotvec()])


def _transform(six):
    return RigidTransform.from_components(six[:3], Rotation.from_rotvec(six[3:]))


def _moved(sixes, points):
    """Return points (n, 4, 3) moved by n transforms."""
    R = Rotation.from_rotvec(sixes[:, 3:]).as_matrix()
    return points @ np.swapaxes(R, 1, 2) + sixes[:, None, :3]
