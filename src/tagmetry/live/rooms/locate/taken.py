"""Images that a camera took, and where the markers of a map say that it was."""

from collections.abc import Generator

from tagmetry.camera import Camera, Image, Source
from tagmetry.detect import Detector
from tagmetry.files import resolve_family
from tagmetry.live.rooms.locate.looked import Looked
from tagmetry.localize import Localizer, MarkerMap


class Taken:
    """The images of a source.

    Attributes:
        marker_map: The markers that were in sight.
    """

    def __init__(self, marker_map: MarkerMap, camera: Camera, images: Source) -> None:
        """Get ready.

        Args:
            marker_map: Where markers stand.
            camera: Intrinsics of the images.
            images: Is closed when they were looked through.
        """
        self.marker_map, self._camera, self._images = marker_map, camera, images
        self._detector = Detector([resolve_family(name) for name in marker_map.families])
        self._localizer = Localizer(marker_map, camera)

    def looks(self) -> Generator[Looked]:
        """Give what each image shows.

        Raises:
            InputError: An image is of another size than the camera, or cannot be read.
        """
        try:
            for image in self._images:
                yield self._looked(image)
        finally:
            self._images.close()

    def _looked(self, image: Image) -> Looked:
        self._camera.check_image(image.width_px, image.height_px)
        seen = tuple(self._detector.detect(image.pixels, self._camera))
        return Looked(self._camera, None, seen, self._localizer.locate(seen))
