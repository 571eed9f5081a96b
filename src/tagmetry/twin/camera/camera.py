"""A simulated camera: a `Source` of images on simulated time, with controls.

Image k of a camera with n images per second begins at k / n, wherever the consumer is. Time stands
still while the consumer has an image, unless it says how long it takes: `advance`. Whoever takes
too long misses images, as with a real camera; the newest is given.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tagmetry.camera import Camera, Image
from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.twin.camera.auto import better_exposed, first_climb, sharpness_of
from tagmetry.twin.camera.development import Taking, image_pixels
from tagmetry.twin.camera.device import Device
from tagmetry.twin.camera.dials import TwinControls
from tagmetry.twin.camera.faults import Faults
from tagmetry.twin.camera.intrinsics import image_camera, sensor_shot
from tagmetry.twin.camera.quick import quick_pixels
from tagmetry.twin.camera.setting import Setting
from tagmetry.twin.scenes import Path, Scene, Still
from tagmetry.twin.truth import ImageTruth, image_truth

_AT_ORIGIN = Still(RigidTransform.identity())
_SAME_S = 1e-9


class TwinCamera(Closing):
    """The images of a simulated camera."""

    def __init__(
        self,
        scene: Scene,
        device: Device,
        path: Path = _AT_ORIGIN,
        *,
        seed: int = 0,
        faults: Faults | None = None,
        tells_camera: bool = False,
        quick: bool = False,
    ) -> None:
        """Switch on, at time 0.

        Args:
            scene: What there is to see; its paths run on the camera's clock.
            device: The hardware.
            path: Where the camera is, T_world_camera.
            seed: Of the noise; an image's noise depends on it and the image's number alone.
            faults: What is wrong with the controls.
            tells_camera: Give every image its exact intrinsics, which no real camera knows.
            quick: Take only what lies around things exactly; elsewhere neighbours' noise has
                nothing in common. For scenes of which things fill little.
        """
        self.name = f"twin {device.name}"
        self._scene, self._device, self._path = scene, device, path
        self._seed, self._tells_camera = seed, tells_camera
        self._develop = quick_pixels if quick else image_pixels
        self._now_s, self._sequence = 0.0, -1
        self._controls = TwinControls(device, faults or Faults(), lambda: self._now_s)
        focus = device.available.get("focus")
        self._climb = first_climb(focus) if focus else None
        self._is_closed = False

    @property
    def is_live(self) -> bool:
        """Yes: images that nobody takes in time are dropped."""
        return True

    @property
    def length(self) -> int | None:
        """Unknown."""
        return None

    @property
    def controls(self) -> TwinControls:
        """What can be set."""
        return self._controls

    @property
    def now_s(self) -> float:
        """The simulated time."""
        return self._now_s

    def advance(self, busy_s: float) -> None:
        """Let time pass, as a consumer does that works or waits."""
        if not 0 <= busy_s < np.inf:
            raise InputError(f"time only goes on: expected 0 s or more, got {busy_s}")
        self._now_s += busy_s

    def __iter__(self) -> Iterator[Image]:
        """Give the newest image each time, or the next one to come, until the camera is closed."""
        while not self._is_closed:
            yield self.take()

    def take(self) -> Image:
        """Return the newest image that was not given yet; time goes on to its arrival."""
        if self._is_closed:
            raise InputError(f"{self.name} is closed")
        self._sequence = self._newest()
        self._now_s = max(self._now_s, self._arrival_s(self._sequence))
        setting = self.setting()
        image = self._image(setting)
        self._automatics(image, setting)
        return image

    def close(self) -> None:
        """Give no more images; may be called twice."""
        self._is_closed = True

    def setting(self) -> Setting:
        """Return what was in effect for the newest image given, or now before there is one."""
        return self._controls.setting_at(self._begin_s(max(self._sequence, 0)))

    def true_camera(self) -> Camera:
        """Return the exact intrinsics of the newest image given: with its zoom and breathing."""
        return image_camera(self._device, self.setting())

    def truth(self) -> ImageTruth:
        """Return everything that is exactly so in the newest image given: poses, corners, blur."""
        setting = self.setting()
        middle_s = self._middle_s(max(self._sequence, 0), setting)
        return image_truth(self._scene, sensor_shot(self._device, setting, self._path, middle_s))

    def _newest(self) -> int:
        """Return the number of the newest image that has arrived, at least the next one."""
        newest = int(np.floor((self._now_s + _SAME_S) / self._device.period_s))
        while newest > self._sequence + 1 and self._arrival_s(newest) > self._now_s + _SAME_S:
            newest -= 1
        return max(newest, self._sequence + 1)

    def _begin_s(self, sequence: int) -> float:
        return sequence * self._device.period_s

    def _middle_s(self, sequence: int, setting: Setting) -> float:
        return self._begin_s(sequence) + setting.exposure_s / 2

    def _arrival_s(self, sequence: int) -> float:
        begin_s = self._begin_s(sequence)
        return begin_s + self._controls.setting_at(begin_s).exposure_s + self._device.latency_s

    def _image(self, setting: Setting) -> Image:
        middle_s = self._middle_s(self._sequence, setting)
        rng = np.random.default_rng((self._seed, self._sequence))
        taking = Taking(self._device, setting, self._scene, self._path, middle_s)
        pixels = self._develop(taking, rng)
        image = Image(pixels, middle_s, "capture", self._sequence, self.name)
        return replace(image, camera=self.true_camera()) if self._tells_camera else image

    def _automatics(self, image: Image, setting: Setting) -> None:
        """Let the auto modes that are on see an image."""
        if self._controls.is_automatic("exposure"):
            self._expose_better(image, setting)
        if self._climb is not None and self._controls.is_automatic("focus"):
            self._focus_better(image, setting)

    def _expose_better(self, image: Image, setting: Setting) -> None:
        exposure = self._device.available.get("exposure")
        better = better_exposed(setting, image.pixels, self._device.output.white_grey, exposure)
        if better is not None:
            self._controls.drive("exposure", better[0])
            self._controls.drive("gain", better[1])

    def _focus_better(self, image: Image, setting: Setting) -> None:
        """Climb on, once the motor stands."""
        begin_s = self._begin_s(image.sequence)
        if self._climb is None or not self._controls.rests_at("focus", begin_s):
            return
        control = self._device.available["focus"]
        self._climb, focus = self._climb.next(setting.focus, sharpness_of(image.pixels), control)
        self._controls.drive("focus", focus)
