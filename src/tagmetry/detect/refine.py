"""Where exactly are a marker's corners? A blurred step is fitted to the raw pixels along each side.

Around a side the image is modelled as

    I(p) = black(u) + contrast(u) * Phi((d(p) - offset - turn * u - bow * (u^2 - 1)) / blur)

with d the distance of pixel p from the side's first guess (outward positive), u in -1..1 along it,
black and contrast linear in u, and Phi the Gaussian's integral: eight numbers per side, found by
Gauss and Newton with weights against dirt. Offset and turn say where the side's ends are, and
neighbouring sides meet in the corners. The covariance is that of the fit, with the noise taken from
its residuals.

Through a lens with distortion a side is a curve. Where the camera is known, d is measured from that
curve. What bow remains is judged on all sides of the image together: how strongly they bow beyond
what noise explains is the spread that each side's own bow is then believed with, so straight sides
cost no accuracy and bowed ones no honesty.

A camera's gamma curve moves every such edge outward or inward by up to 0.3 px, which a single side
cannot tell and the covariance does not contain.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr

from tagmetry.camera import Camera
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_ITERATIONS = 10
_BLUR_PX = (0.35, 4.0)
_REACH_PX = (2.0, 5.0)  # how far from a side pixels are looked at, at least and at most
_REACH_CELLS = 0.9
_CORNER_GAP_PX = 2.0
_BOWING_HALF_PX = 15.0
_COLUMNS = 96  # most pixels along a side that are looked at
_FLOOR_PX = 0.005  # what the model does not describe, per side
_LEAK = (0.9, 1.3)  # how far blur carries the next cells into a side; measured on rendered markers
_LOST_PX = 2.5  # a side that moved farther was not the one meant
_UNREFINED_PX2 = np.diag([4.0, 4.0])  # of a side's offset and turn, where the fit failed


@dataclass(frozen=True)
class Corners:
    """Refined corners of n markers.

    Attributes:
        corners_px: Shape (n, 4, 2).
        covariances_px2: Shape (n, 8, 8).
        refined: Whether all four sides were found, shape (n,); a side that was not found stays
            where it was given, with a covariance to match.
    """

    corners_px: Array
    covariances_px2: Array
    refined: BoolArray


def refine(
    grey: GreyPixels, corners_px: Array, cell_counts: Array, camera: Camera | None = None
) -> Corners:
    """Refine corners to a few hundredths of a pixel.

    Args:
        grey: 8-bit image, shape (height, width).
        corners_px: First guesses, good to about a pixel, clockwise, shape (n, 4, 2).
        cell_counts: Cells along a side of each marker, shape (n,).
        camera: Intrinsics, so that sides are followed along their curves.
    """
    sides = _Sides.of(corners_px, cell_counts, camera)
    fit, covariance, sound = _fitted(_gather(grey, sides))
    sound &= np.abs(fit[:, :2]).sum(axis=1) < _LOST_PX
    tells = sound & sides.may_bow
    shift, covariance = _straightened(fit[:, :3], covariance, sides.half_px, tells)
    covariance = covariance + _model_error(sides.cell_px, fit[:, 7])
    shift = np.where(sound[:, None], shift, 0.0)
    covariance = np.where(sound[:, None, None], covariance, _UNREFINED_PX2)
    moved, covariances = _meet(sides, shift, covariance)
    usable = np.asarray(np.isfinite(moved).all(axis=(1, 2)))
    usable &= np.isfinite(covariances).all(axis=(1, 2))
    return Corners(
        np.where(usable[:, None, None], moved, corners_px),
        np.where(usable[:, None, None], covariances, 2 * _UNREFINED_PX2[0, 0] * np.eye(8)),
        sound.reshape(-1, 4).all(axis=1) & usable,
    )


@dataclass(frozen=True)
class _Sides:
    """4 n sides, four after four: from corner i to corner i + 1.

    Attributes:
        middle: Shape (s, 2).
        along: Unit vectors, shape (s, 2).
        outward: Unit normals away from the marker, shape (s, 2).
        half_px: Half lengths, shape (s,).
        cell_px: Size of a cell perpendicular to the side, shape (s,).
        sag_px: How far outside the chord the side runs at `_SAG_AT`, shape (s, 17).
    """

    middle: Array
    along: Array
    outward: Array
    half_px: Array
    cell_px: Array
    sag_px: Array

    @property
    def reach_px(self) -> Array:
        """How far from a side pixels belong to it alone, shape (s,)."""
        return np.clip(_REACH_CELLS * self.cell_px, *_REACH_PX)

    @property
    def may_bow(self) -> BoolArray:
        """Whether a side is long enough for a bow to be told from noise and dirt."""
        return np.asarray(self.half_px >= _BOWING_HALF_PX)

    @classmethod
    def of(cls, corners_px: Array, cell_counts: Array, camera: Camera | None) -> "_Sides":
        starts = corners_px.reshape(-1, 2)
        ends = np.roll(corners_px, -1, axis=1).reshape(-1, 2)
        length = np.maximum(np.linalg.norm(ends - starts, axis=1), 1e-9)
        along = (ends - starts) / length[:, None]
        outward = np.stack([along[:, 1], -along[:, 0]], axis=1)
        cells_px = _cell_heights(corners_px, outward) / np.repeat(cell_counts, 4)
        return cls(
            (starts + ends) / 2,
            along,
            outward,
            length / 2,
            cells_px,
            _sag(starts, ends, outward, camera),
        )


def _cell_heights(corners_px: Array, outward: Array) -> Array:
    """Return the marker's extent perpendicular to each side, shape (4 n,)."""
    opposite = (np.roll(corners_px, -2, axis=1) + np.roll(corners_px, -3, axis=1)) / 2
    own = (corners_px + np.roll(corners_px, -1, axis=1)) / 2
    across = (own - opposite).reshape(-1, 2)
    return np.asarray(np.abs((across * outward).sum(axis=1)))


_SAG_AT = np.linspace(-1.0, 1.0, 17)


def _sag(starts: Array, ends: Array, outward: Array, camera: Camera | None) -> Array:
    """Return how a straight edge between two pixels bows in this camera's image, shape (s, 17)."""
    if camera is None or not camera.lens.coefficients:
        return np.zeros((len(starts), len(_SAG_AT)))
    first, last = camera.unproject(starts)[:, None], camera.unproject(ends)[:, None]
    chord = (starts[:, None] + ends[:, None]) / 2 + _SAG_AT[:, None] * (ends - starts)[:, None] / 2
    share = (_SAG_AT[:, None] + 1) / 2
    curve = camera.project(first + share * (last - first))
    return np.asarray(np.nan_to_num(((curve - chord) * outward[:, None]).sum(axis=2)))


@dataclass(frozen=True)
class _Window:
    """The pixels around s sides, m each.

    Attributes:
        values: Grey values, shape (s, m).
        distance_px: Distance outside the first guess, shape (s, m).
        u: Place along the side, -1 to 1, shape (s, m).
        arch: u^2 - 1, how a bow is spread along the side; 0 on sides too short to tell, shape
            (s, m).
        weight: 1 for pixels to use, 0 for the others, shape (s, m).
    """

    values: Array
    distance_px: Array
    u: Array
    arch: Array
    weight: Array


def _gather(grey: GreyPixels, sides: _Sides) -> _Window:
    """Take whole pixels, each once: columns across a level side, rows across a steep one."""
    height_px, width_px = grey.shape
    steep = np.abs(sides.along[:, 1]) > np.abs(sides.along[:, 0])
    rate = np.abs(np.where(steep, sides.along[:, 1], sides.along[:, 0]))
    steps = np.clip(np.ceil(2 * sides.half_px * rate).astype(int), 1, _COLUMNS)
    column = np.arange(min(int(steps.max(initial=1)), _COLUMNS))
    u = (2 * column[None, :] + 1) / steps[:, None] - 1
    guess = sides.middle[:, None] + (u * sides.half_px[:, None])[..., None] * sides.along[:, None]
    across = np.arange(-8.0, 9.0)
    grid = np.rint(guess)[:, :, None, :] + _across_offsets(steep, across)[:, None]
    grid = grid.reshape(len(steep), -1, 2)
    relative = grid - sides.middle[:, None]
    place = (relative * sides.along[:, None]).sum(axis=2) / sides.half_px[:, None]
    distance = (relative * sides.outward[:, None]).sum(axis=2) - _bow(sides.sag_px, place)
    usable = np.repeat(column[None, :] < steps[:, None], len(across), axis=1)
    usable &= np.abs(distance) <= sides.reach_px[:, None]
    gap = np.minimum(_CORNER_GAP_PX / sides.half_px, 0.3)[:, None]
    usable &= np.abs(place) <= 1 - gap
    usable &= (grid >= 0).all(axis=2) & (grid <= [width_px - 1, height_px - 1]).all(axis=2)
    x, y = np.clip(grid, 0, [width_px - 1, height_px - 1]).astype(np.intp).transpose(2, 0, 1)
    arch = np.where(sides.may_bow[:, None], place**2 - 1, 0.0)
    values = np.asarray(grey[y, x], dtype=np.float64)
    return _Window(values, distance, place, arch, usable.astype(float))


def _across_offsets(steep: BoolArray, across: Array) -> Array:
    zero = np.zeros_like(across)
    level = np.stack([zero, across], axis=1)
    return np.where(steep[:, None, None], level[:, ::-1], level)


def _bow(sag_px: Array, u: Array) -> Array:
    """Interpolate the sag along the sides, shape (s, m)."""
    steps = len(_SAG_AT) - 1
    place = (np.clip(u, -1, 1) + 1) * steps / 2
    left = np.minimum(place.astype(int), steps - 1)
    share = place - left
    row = np.arange(len(sag_px))[:, None]
    return np.asarray(sag_px[row, left] * (1 - share) + sag_px[row, left + 1] * share)


def _fitted(window: _Window) -> tuple[Array, Array, BoolArray]:
    """Fit all sides: numbers (s, 8), covariances of the first three (s, 3, 3), which are sound."""
    fit = _first_fit(window)
    weight = window.weight
    for _ in range(_ITERATIONS):
        model, jacobian = _model(fit, window)
        residual = window.values - model
        weight = window.weight * _trust(residual, window.weight)
        step, _ = _solved(jacobian, residual, weight)
        fit = _limited(fit + step * _shortening(step))
    model, jacobian = _model(fit, window)
    residual = window.values - model
    _, inverse = _solved(jacobian, residual, weight)
    freedom = weight.sum(axis=1) - fit.shape[1]
    noise2 = (weight * residual**2).sum(axis=1) / np.maximum(freedom, 1)
    sound = (freedom >= 12) & np.isfinite(fit).all(axis=1)
    sound &= np.abs(fit[:, 5]) > 3 * np.sqrt(noise2)
    return fit, noise2[:, None, None] * inverse[:, :3, :3], sound


def _shortening(step: Array) -> Array:
    """Return factors that keep a step within a pixel of offset, turn and bow."""
    return np.asarray(1 / np.maximum(1.0, np.abs(step[:, :3]).max(axis=1, keepdims=True)))


def _first_fit(window: _Window) -> Array:
    """Start from the mean grey inside and outside."""
    inside = window.weight * (window.distance_px < 0)
    outside = window.weight * (window.distance_px > 0)
    dark = (inside * window.values).sum(axis=1) / np.maximum(inside.sum(axis=1), 1)
    bright = (outside * window.values).sum(axis=1) / np.maximum(outside.sum(axis=1), 1)
    zero = np.zeros_like(dark)
    return np.stack([zero, zero, zero, dark, zero, bright - dark, zero, zero + 0.8], axis=1)


def _model(fit: Array, window: _Window) -> tuple[Array, Array]:
    """Return the modelled values (s, m) and their derivatives (s, m, 8)."""
    offset, turn, bow, black, black_u, contrast, contrast_u, blur = (c[:, None] for c in fit.T)
    u, arch = window.u, window.arch
    z = (window.distance_px - offset - turn * u - bow * arch) / blur
    step, bell = ndtr(z), np.exp(-0.5 * z * z) / np.sqrt(2 * np.pi)
    height = contrast + contrast_u * u
    by_offset = -height * bell / blur
    by_line = [by_offset, by_offset * u, by_offset * arch]
    jacobian = np.stack([*by_line, np.ones_like(u), u, step, step * u, by_offset * z], axis=2)
    return black + black_u * u + height * step, jacobian


def _model_error(cell_px: Array, blur_px: Array) -> Array:
    """Return the covariance of (offset, turn) by what a lone step does not describe, (s, 2, 2).

    Where cells are few blurs wide, the bits behind the border and what lies behind the quiet zone
    reach into the window; by how much depends on the code.
    """
    amplitude, decay = _LEAK
    leak_px = amplitude * blur_px * np.exp(-cell_px / (decay * blur_px))
    variance = _FLOOR_PX**2 + leak_px**2
    return np.asarray(variance[:, None, None] * np.diag([1.0, 1 / 3]))


def _straightened(
    line: Array, covariance: Array, half_px: Array, tells: BoolArray
) -> tuple[Array, Array]:
    """Believe the sides' bows as far as all of them together show that sides bow here.

    The spread of curvatures beyond their own errors is estimated over the image (DerSimonian and
    Laird's moment), then each side is updated with the prior that its bow is zero within it.

    Args:
        line: (offset, turn, bow) of each side, shape (s, 3).
        covariance: Shape (s, 3, 3).
        half_px: Half lengths, shape (s,).
        tells: Sides whose bow was fitted and counts, shape (s,).

    Returns:
        (offset, turn), shape (s, 2), and their covariances, shape (s, 2, 2).
    """
    bow, bow2 = line[:, 2], np.maximum(covariance[:, 2, 2], 1e-12)
    weight = np.where(tells, half_px**4 / bow2, 0.0)
    excess = (weight * bow**2 / half_px**4).sum() - tells.sum()
    spread2 = max(0.0, excess / max(weight.sum(), 1e-300)) * half_px**4
    gain = covariance[:, :2, 2] / (bow2 + spread2)[:, None]
    shift = line[:, :2] - gain * bow[:, None]
    return shift, covariance[:, :2, :2] - gain[:, :, None] * covariance[:, 2, None, :2]


def _trust(residual: Array, used: Array) -> Array:
    """Return Cauchy's weights, with the noise taken from the median residual."""
    ordered = np.sort(np.where(used > 0, np.abs(residual), np.inf), axis=1)
    middle = np.maximum(used.sum(axis=1).astype(int) // 2, 0)
    noise = np.take_along_axis(ordered, middle[:, None], axis=1) / 0.6745
    noise = np.where(np.isfinite(noise), np.maximum(noise, 0.3), 1.0)
    return 1 / (1 + (residual / (4 * noise)) ** 2)


def _solved(jacobian: Array, residual: Array, weight: Array) -> tuple[Array, Array]:
    """Return the steps (s, 8) and the inverses of the normal matrices (s, 8, 8)."""
    weighted = jacobian * weight[..., None]
    normal = np.swapaxes(weighted, 1, 2) @ jacobian
    scale = np.sqrt(np.maximum(np.einsum("sii->si", normal), 1e-12))
    scaled = normal / scale[:, :, None] / scale[:, None, :] + 1e-9 * np.eye(8)
    inverse = np.linalg.inv(scaled) / scale[:, :, None] / scale[:, None, :]
    right = np.einsum("smk,sm->sk", weighted, residual)
    return np.einsum("skl,sl->sk", inverse, right), inverse


def _limited(fit: Array) -> Array:
    line, levels, blur = fit[:, :3], fit[:, 3:7], fit[:, 7:]
    return np.concatenate([np.clip(line, -8, 8), levels, np.clip(blur, *_BLUR_PX)], axis=1)


def _meet(sides: _Sides, shift: Array, covariance: Array) -> tuple[Array, Array]:
    """Return the corners (n, 4, 2) where neighbouring sides meet, and their covariances (n, 8, 8).

    Corner i lies on side i (at u = -1) and on side i - 1 (at u = +1): it moves by the x that solves
    outward . x = offset + turn * u for both.
    """
    outward = sides.outward.reshape(-1, 4, 2)
    before = np.roll(outward, 1, axis=1)
    N = np.stack([outward, before], axis=2)  # (n, 4, 2 lines, 2)
    N_inverse = np.linalg.inv(np.where(np.abs(np.linalg.det(N))[..., None, None] > 1e-3, N, np.nan))
    offset, turn = shift.reshape(-1, 4, 2).transpose(2, 0, 1)
    at_start, at_end = offset - turn, np.roll(offset + turn, 1, axis=1)
    moved = N_inverse @ np.stack([at_start, at_end], axis=2)[..., None]
    first = (sides.middle - sides.half_px[:, None] * sides.along).reshape(-1, 4, 2)
    return first + moved[..., 0], _corner_covariances(N_inverse, covariance)


def _corner_covariances(N_inverse: Array, covariance: Array) -> Array:
    """Carry the sides' (offset, turn) to the corners: J blockdiag(covariance) J^T."""
    n = len(N_inverse)
    per_side = covariance.reshape(n, 4, 2, 2)
    J = np.zeros((n, 8, 8))
    for corner in range(4):
        for line, side, u in ((0, corner, -1.0), (1, (corner - 1) % 4, 1.0)):
            column = N_inverse[:, corner, :, line]
            J[:, 2 * corner : 2 * corner + 2, 2 * side] += column
            J[:, 2 * corner : 2 * corner + 2, 2 * side + 1] += u * column
    blocks = np.zeros((n, 8, 8))
    for side in range(4):
        blocks[:, 2 * side : 2 * side + 2, 2 * side : 2 * side + 2] = per_side[:, side]
    return np.asarray(J @ blocks @ np.swapaxes(J, 1, 2))
