"""The tracker: markers followed from image to image, each found anew in every one.

predict (where should it be? motion) -> look (is it there? nudge, sight) -> search (around lost
ones, and a strip of the image for new ones) -> exact (where exactly).

What is reported was read and measured in this image alone. The past only says where to look, so
errors of one image do not reach the next, and a marker that is covered is not reported.
"""

from collections.abc import Iterable
from functools import partial

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.detection import Detection
from tagmetry.detect.detector import Detector
from tagmetry.detect.exact import Exact
from tagmetry.detect.report import detections
from tagmetry.detect.track.claims import claimed
from tagmetry.detect.track.expected import as_expected
from tagmetry.detect.track.followed import followed
from tagmetry.detect.track.greyed import Greyed
from tagmetry.detect.track.hunt import Part
from tagmetry.detect.track.known import Announced, Known, known_at
from tagmetry.detect.track.lost import Lost, lost_of
from tagmetry.detect.track.measured import measured
from tagmetry.detect.track.search import Search
from tagmetry.detect.track.seen import Seen
from tagmetry.detect.track.tracks import Tracks
from tagmetry.detect.workers import both
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.markers import MarkerFamily


class Tracker:
    """Follows markers through the images of one camera.

    The first image is looked at whole, and so is the first one after a gap longer than `forget_s`
    or of another size: it begins anew then. In every other image, followed markers are looked for
    where they should be, and now and then new ones in one part of the image. A new marker has been
    looked for at its place after `acquire_s`, or after `images_to_acquire` images if that is later.

    Args:
        detector: What to look for: a detector, or families for one.
        strips: Into how many strips of rows the image is cut to look for new small markers. More
            make an image quicker, and the search of all of it takes more images.
        acquire_s: How soon all of the image is to be searched. Where images come faster than that
            takes, some of them are not searched.
        forget_s: For how long a marker that is not seen is looked for where it should be.
        fastest_px_s: How fast a marker may move that was seen once only.
    """

    def __init__(
        self,
        detector: Detector | Iterable[str | MarkerFamily] = ("tag36h11",),
        *,
        strips: int = 16,
        acquire_s: float = 0.5,
        forget_s: float = 0.5,
        fastest_px_s: float = 1200.0,
    ) -> None:
        self.detector = detector if isinstance(detector, Detector) else Detector(detector)
        if strips < 1:
            raise InputError(f"strips must be 1 or more, got {strips}")
        times = ("acquire_s", acquire_s), ("forget_s", forget_s), ("fastest_px_s", fastest_px_s)
        for name, value in times:
            if not 0 < value < np.inf:
                raise InputError(f"{name} must be positive, got {value}")
        self.strips = strips
        self.acquire_s = acquire_s
        self.forget_s = forget_s
        self.fastest_px_s = fastest_px_s
        self._search = Search(self.detector, strips, acquire_s)
        self._announced: list[Announced] = []
        self.reset()

    def reset(self) -> None:
        """Forget everything: the next image may be of another time, camera or place."""
        self._tracks = Tracks.none()
        self._search.begin_anew()
        self._time_s: float | None = None
        self._size_px: tuple[int, int] | None = None

    @property
    def lost(self) -> tuple[Lost, ...]:
        """The markers that the last image did not show and that are still looked for."""
        if self._time_s is None:
            return ()
        lost = self._tracks.at(self._tracks.seen_s < self._time_s)
        return lost_of(lost, self.detector.families, self._time_s, self.fastest_px_s)

    def images_to_acquire(self, width_px: int, height_px: int) -> int:
        """Return in how many images of a size, one part each, all of it is searched.

        After so many, but not before `acquire_s`, a new marker has been looked for at its place.
        That is a bound for markers of all sizes that move less than 16 px between searches, and
        that a glance finds. Those with faint borders, or that touch what is beside them, take four
        times as long at most: the looks that they need take turns.
        """
        return len(self._search.plan((width_px, height_px)))

    def expect(
        self,
        family: str,
        marker_id: int,
        corners_px: Array,
        deviation_px: float,
        *,
        is_inverted: bool = False,
    ) -> None:
        """Say where a marker should be in the next image, for example by a map and a known motion.

        Args:
            family: Name of its family, one that the detector looks for.
            marker_id: Its id.
            corners_px: Clockwise from its own top left, shape (4, 2).
            deviation_px: How far it may be from there, standard deviation.
            is_inverted: It is printed white on black.
        """
        names = [one.name for one in self.detector.families]
        if family not in names:
            raise InputError(f"{family} is not looked for; this tracker knows {', '.join(names)}")
        place = names.index(family)
        corners = np.array(corners_px, dtype=np.float64)
        if corners.shape != (4, 2) or not np.isfinite(corners).all():
            raise InputError("corners_px must be finite and of shape (4, 2)")
        if not 0 < deviation_px < np.inf:
            raise InputError(f"deviation_px must be positive, got {deviation_px}")
        number = self.detector.families[place].checked_id(marker_id)
        self._announced.append(Announced(place, number, corners, deviation_px, is_inverted))

    def track(
        self, image: AnyPixels, time_s: float, camera: Camera | None = None
    ) -> tuple[Detection, ...]:
        """Return the markers that an image shows, ordered by family and id.

        Args:
            image: Grey or BGR, uint8 or uint16, shape (h, w) or (h, w, 3).
            time_s: When it was taken; later than the image before.
            camera: Intrinsics of the image; may differ from image to image.

        Raises:
            InputError: No such image, or time stands still or runs backwards.
        """
        looked_at = self._checked(image, time_s, camera)
        size_px, families = looked_at.size_px, self.detector.families
        since_s = self._since_s(size_px, time_s)
        known = known_at(self._tracks, self._announced, time_s, since_s, self.fastest_px_s)
        expected = as_expected(looked_at, families, self.detector.rules, known)
        is_lost = expected.others(len(known.tracks))
        parts = self._search.parts(known, is_lost, size_px, time_s, since_s)
        seen, exact = self._searched_and_measured(looked_at, known, expected, parts, camera)
        self._tracks = followed(known, seen, exact, time_s, self.forget_s)
        self._time_s, self._size_px = time_s, size_px
        self._announced = []
        return detections(seen, exact, families, size_px)

    def _searched_and_measured(
        self,
        looked_at: Greyed,
        known: Known,
        expected: Seen,
        parts: list[Part],
        camera: Camera | None,
    ) -> tuple[Seen, Exact]:
        """Return the markers that are reported, with their exact corners.

        What was seen where it was expected must be measured too, to be believed; while it is,
        another thread searches for others.
        """
        looks, families = known.tracks.looks[expected.rows], self.detector.families
        measure = partial(measured, looked_at.grey, expected, families, camera, looks)
        if not parts:  # no thread need be woken
            exact = measure()
            return expected.at(exact.refined), exact.at(exact.refined)
        search = partial(self._search.found, looked_at, parts, expected.corners_px)
        found, exact = both(search, measure)
        new = claimed(found, known, expected.others(len(known.tracks)))
        also = measured(looked_at.grey, new, families, camera)
        seen = expected.at(exact.refined).and_also(new)
        return seen, exact.at(exact.refined).and_also(also)

    def _checked(self, image: AnyPixels, time_s: float, camera: Camera | None) -> Greyed:
        looked_at = Greyed(image)
        if camera is not None:
            camera.check_image(*looked_at.size_px)
        if not np.isfinite(time_s):
            raise InputError(f"time_s must be finite, got {time_s}")
        if self._time_s is not None and time_s <= self._time_s:
            raise InputError(
                f"time_s must rise from image to image, got {time_s} after {self._time_s}; "
                "call reset() before images of another time"
            )
        return looked_at

    def _since_s(self, size_px: tuple[int, int], time_s: float) -> float:
        """Return the time since the last image; 0 where all begins anew."""
        if self._time_s is not None and size_px == self._size_px:
            since_s = time_s - self._time_s
            if since_s <= self.forget_s:
                return since_s
        self.reset()
        return 0.0
