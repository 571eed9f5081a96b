"""A bank of calibrations: the camera at any focus and zoom that it was calibrated around.

Keys are the image size, the zoom and the focus. Between calibrated settings the camera is
interpolated (`between`), outside it is refused. Digital zoom is exact and applied once, here: with
the camera that a bank gives, depth comes out real, and z = z' n (seed 000, equation 8) must not be
applied again.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tagmetry.camera.bank.assess import gaps_of, left_out_of
from tagmetry.camera.bank.line import Line
from tagmetry.camera.bank.node import Approach, BankNode
from tagmetry.camera.bank.parameters import alike
from tagmetry.camera.bank.repeats import merged, repeat_of
from tagmetry.camera.bank.report import Gap, LeftOut, Repeat
from tagmetry.camera.model import Camera
from tagmetry.camera.resize import scaled, zoomed
from tagmetry.errors import InputError

_Key = tuple[tuple[int, int], float]  # image size and zoom


@dataclass(frozen=True, eq=False)
class CameraBank:
    """Calibrations of one camera.

    Attributes:
        nodes: In any order; several at one setting are averaged.
        zoom_is_digital: Zoom only enlarges the middle of the image: all nodes then have one zoom,
            the reference, and other zooms follow exactly. Otherwise zoom is interpolated too.
        may_scale: Images of another size show the whole sensor, resampled: their camera follows
            from the largest calibrated size. Otherwise only calibrated sizes are answered.
    """

    nodes: tuple[BankNode, ...]
    zoom_is_digital: bool = False
    may_scale: bool = False

    def __post_init__(self) -> None:
        if not self.nodes:
            raise InputError("a bank needs at least one calibration, found none")
        _check_one_camera([node.camera for node in self.nodes])
        zooms = sorted({node.zoom for node in self.nodes})
        if self.zoom_is_digital and len(zooms) > 1:
            raise InputError(
                f"a digital zoom has one reference: expected all calibrations at one zoom, found "
                f"{', '.join(f'{zoom:g}' for zoom in zooms)}; keep those at the smallest"
            )

    @property
    def name(self) -> str:
        """What the camera is called."""
        return self.nodes[0].camera.name

    @property
    def sizes_px(self) -> tuple[tuple[int, int], ...]:
        """The calibrated image sizes (width, height), the largest first."""
        sizes = {node.camera.size_px for node in self.nodes}
        return tuple(sorted(sizes, key=lambda size: (-size[0] * size[1], size)))

    def camera_at(
        self,
        *,
        focus: float,
        zoom: float | None = None,
        width_px: int | None = None,
        height_px: int | None = None,
    ) -> Camera:
        """Return the camera at a setting.

        Args:
            focus: In the camera's own unit, as the calibrations'.
            zoom: In the calibrations' unit; may be left out where all have the same.
            width_px: Columns of the images; size may be left out where all have the same.
            height_px: Rows.

        Returns:
            The camera with `zoom` and `focus` set. Its covariance is that of the calibrations
            around carried to it, plus the error of interpolating as leaving one out shows it; None
            where a calibration that has a say has none.

        Raises:
            InputError: The setting lies outside the calibrated range, or is not known well enough.
        """
        size_px = self._asked_size(width_px, height_px)
        base_px = size_px if size_px in self.sizes_px else self._scaling_base(size_px)
        camera = self._at_zoom(base_px, self._asked_zoom(zoom, base_px), focus)
        return replace(scaled(camera, *size_px) if size_px != base_px else camera, focus=focus)

    def with_node(self, camera: Camera, approach: Approach | None = None) -> "CameraBank":
        """Return the bank with one more calibration."""
        return replace(self, nodes=(*self.nodes, BankNode(camera, approach)))

    def drop(
        self,
        *,
        focus: float | None = None,
        zoom: float | None = None,
        approach: Approach | None = None,
    ) -> "CameraBank":
        """Return the bank without the calibrations that have all the properties given."""

        def goes(node: BankNode) -> bool:
            asked = [(focus, node.focus), (zoom, node.zoom), (approach, node.approach)]
            return all(wanted in (None, found) for wanted, found in asked)

        kept = tuple(node for node in self.nodes if not goes(node))
        if len(kept) == len(self.nodes):
            raise InputError(
                f"there is no calibration at focus {focus}, zoom {zoom}, approach {approach}"
            )
        return replace(self, nodes=kept)

    def gaps(self, step: float) -> tuple[Gap, ...]:
        """Return the neighbours in focus that are farther apart than a step."""
        if not step > 0:
            raise InputError(f"the step of the focus must be positive, got {step}")
        return tuple(gap for line in self._lines.values() for gap in gaps_of(line, step))

    def leave_one_out(self) -> tuple[LeftOut, ...]:
        """Compare each calibration, but for the first and last, with what the others predict."""
        return tuple(one for line in self._lines.values() for one in left_out_of(line))

    def repeats(self) -> tuple[Repeat, ...]:
        """Say how well calibrations at one setting agree, for each setting that has several."""
        return tuple(
            repeat_of(nodes)
            for by_focus in self._grouped.values()
            for nodes in by_focus.values()
            if len(nodes) > 1
        )

    @cached_property
    def _grouped(self) -> dict[_Key, dict[float, list[BankNode]]]:
        """The nodes by size and zoom, then by focus, all ascending."""
        groups: dict[_Key, dict[float, list[BankNode]]] = defaultdict(lambda: defaultdict(list))
        ordered = sorted(self.nodes, key=lambda n: (n.camera.size_px, n.zoom, n.focus))
        for node in ordered:
            groups[node.camera.size_px, node.zoom][node.focus].append(node)
        return groups

    @cached_property
    def _lines(self) -> dict[_Key, Line]:
        """One line of calibrations along the focus for each size and zoom."""
        return {
            key: Line("focus", tuple(by_focus), alike([merged(n) for n in by_focus.values()]))
            for key, by_focus in self._grouped.items()
        }

    def _asked_size(self, width_px: int | None, height_px: int | None) -> tuple[int, int]:
        if width_px is not None and height_px is not None:
            return width_px, height_px
        if width_px is None and height_px is None and len(self.sizes_px) == 1:
            return self.sizes_px[0]
        raise InputError(f"say for which image size: the bank has {_sizes_text(self.sizes_px)}")

    def _scaling_base(self, size_px: tuple[int, int]) -> tuple[int, int]:
        """Return the largest calibrated size of the same shape, where scaling is allowed."""
        width_px, height_px = size_px
        for base_px in self.sizes_px if self.may_scale else ():
            # the other side may be rounded to a whole pixel
            if abs(width_px * base_px[1] / base_px[0] - height_px) <= 0.5:
                return base_px
        allowed = "of that shape" if self.may_scale else "and the bank does not allow scaling"
        raise InputError(
            f"no calibration for {width_px}x{height_px} images {allowed}; there are "
            f"{_sizes_text(self.sizes_px)}"
        )

    def _asked_zoom(self, zoom: float | None, size_px: tuple[int, int]) -> float:
        zooms = self._zooms(size_px)
        if zoom is not None:
            return zoom
        if len(zooms) > 1:
            raise InputError(f"say at which zoom: the bank has {zooms[0]:g} to {zooms[-1]:g}")
        return zooms[0]

    def _zooms(self, size_px: tuple[int, int]) -> list[float]:
        return [zoom for size, zoom in self._lines if size == size_px]

    def _at_zoom(self, size_px: tuple[int, int], zoom: float, focus: float) -> Camera:
        zooms = self._zooms(size_px)
        if zoom in zooms:
            return self._lines[size_px, zoom].camera_at(focus)
        if self.zoom_is_digital:
            return self._digitally_zoomed(self._lines[size_px, zooms[0]], zoom, focus)
        if len(zooms) == 1:
            raise InputError(
                f"zoom {zoom:g} was asked for, the bank has only {zooms[0]:g}; calibrate at others "
                "too, or say that the zoom is digital"
            )
        cameras = alike([self._lines[size_px, each].camera_at(focus) for each in zooms])
        return replace(Line("zoom", tuple(zooms), cameras).camera_at(zoom), zoom=zoom)

    def _digitally_zoomed(self, line: Line, zoom: float, focus: float) -> Camera:
        reference = line.cameras[0].zoom
        if not (np.isfinite(zoom) and zoom >= reference):
            raise InputError(
                f"a digital zoom of {zoom:g} was asked for, the calibrations are at {reference:g}: "
                "what lies outside their images is not known"
            )
        return replace(zoomed(line.camera_at(focus), zoom / reference), zoom=zoom)


def _check_one_camera(cameras: Sequence[Camera]) -> None:
    names = sorted({camera.name for camera in cameras})
    if len(names) > 1:
        raise InputError(
            f"a bank is of one camera, found calibrations of {', '.join(map(repr, names[:4]))}"
        )
    kinds = sorted({camera.lens.kind for camera in cameras})
    if len(kinds) > 1:
        raise InputError(f"a bank has one lens model, found {' and '.join(kinds)}")


def _sizes_text(sizes_px: Sequence[tuple[int, int]]) -> str:
    return ", ".join(f"{width}x{height}" for width, height in sizes_px)
