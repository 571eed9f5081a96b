"""What can be located from: maps, cameras and images in one folder of the server."""

import re
from dataclasses import dataclass
from pathlib import Path

from tagmetry.errors import InputError
from tagmetry.files import load_camera
from tagmetry.files.maps import load_map
from tagmetry.live.rooms.locate.taken import Taken
from tagmetry.pipeline import open_images

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,59}")


@dataclass(frozen=True)
class Chosen:
    """Files by their names.

    Attributes:
        map_name: Of the marker map.
        camera: Of the intrinsics.
        images: Of a recording, a video, or a folder of pictures.
    """

    map_name: str
    camera: str
    images: str


class Folder:
    """One folder, of which nothing else is ever read."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def opened(self, chosen: Chosen) -> Taken:
        """Return the images, ready to be located.

        Raises:
            InputError: There is none of a name, or one of them cannot be used.
        """
        marker_map = load_map(self.checked(chosen.map_name))
        camera = load_camera(self.checked(chosen.camera))
        return Taken(marker_map, camera, open_images(str(self.checked(chosen.images))))

    def checked(self, name: str) -> Path:
        """Return where a name lies.

        Raises:
            InputError: It is no plain name, or nothing of this name lies in the folder itself.
        """
        if not _NAME.fullmatch(name):
            raise InputError(
                f"expected a name of 1 to 60 letters, digits, ., - and _, found {name[:40]!r}"
            )
        path = self._path / name
        if path.is_symlink() or not path.exists():
            raise InputError(f"there is no {name} in the server's folder of maps")
        return path
