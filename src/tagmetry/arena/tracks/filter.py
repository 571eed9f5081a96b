"""The filter's two steps for many tracks, compiled: what `motion` and `table` describe."""

import numpy as np

from tagmetry.arena.compiled import carried, dot, inverted, kernel, times, wrapped_rad
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray


@kernel
def predict(
    means: Array, covariances: Array, dt: float, strengths: tuple[float, float, float]
) -> None:
    """Replace n tracks by what they are dt seconds later.

    Args:
        means: (x, y, heading, speed, turn rate), shape (n, 5).
        covariances: Shape (n, 5, 5).
        dt: Seconds.
        strengths: Of the white accelerations of speed and turn rate, and of the slip.
    """
    F = np.eye(5)
    for n in range(len(means)):
        heading, speed, rate = means[n, 2], means[n, 3], means[n, 4]
        toward, half = heading + rate * dt / 2.0, rate * dt / 2.0
        share = np.sin(half) / half if half != 0.0 else 1.0
        cosine, sine = np.cos(toward), np.sin(toward)
        way_x, way_y = dt * share * cosine, dt * share * sine
        means[n, 0] += speed * way_x
        means[n, 1] += speed * way_y
        means[n, 2] = wrapped_rad(heading + rate * dt)
        F[0, 2], F[1, 2] = -speed * way_y, speed * way_x
        F[0, 3], F[1, 3] = way_x, way_y
        F[0, 4], F[1, 4], F[2, 4] = F[0, 2] * dt / 2.0, F[1, 2] * dt / 2.0, dt
        covariances[n] = carried(F, covariances[n]) + _unknown(dt, speed, cosine, sine, strengths)


@kernel
def _unknown(
    dt: float, speed: float, cosine: float, sine: float, strengths: tuple[float, float, float]
) -> Array:
    """Return what a step adds: in (along, to the left, f, v, w), turned to (x, y, f, v, w)."""
    a2, b2, slip2 = strengths[0] ** 2, strengths[1] ** 2, strengths[2] ** 2
    added, G = np.zeros((5, 5)), np.eye(5)
    added[0, 0], added[3, 3] = a2 * dt**3 / 3, a2 * dt
    added[2, 2], added[4, 4] = b2 * dt**3 / 3, b2 * dt
    added[1, 1] = slip2 * dt + b2 * speed**2 * dt**5 / 20
    added[0, 3], added[2, 4] = a2 * dt**2 / 2, b2 * dt**2 / 2
    added[1, 2], added[1, 4] = b2 * speed * dt**4 / 8, b2 * speed * dt**3 / 6
    for i in range(5):
        for j in range(i):
            added[i, j] = added[j, i]
    G[0, 0], G[0, 1], G[1, 0], G[1, 1] = cosine, -sine, sine, cosine
    return carried(G, added)


@kernel
def update(means: Array, covariances: Array, rows: IntArray, places: Array, noise: Array) -> None:
    """Replace some tracks by what they are after being seen: Kalman's update, in Joseph's form.

    Args:
        means: Of all tracks, shape (n, 5).
        covariances: Shape (n, 5, 5).
        rows: Which were seen, each once, shape (m,).
        places: Where, shape (m, 3).
        noise: Covariances of that, shape (m, 3, 3).
    """
    weight, keeps = np.empty((3, 3)), np.eye(5)
    for k, row in enumerate(rows):
        before = covariances[row].copy()
        if not inverted(before[:3, :3] + noise[k], weight):
            continue
        gain = np.empty((5, 3))
        for i in range(5):
            gain[i] = times(weight, before[i, :3])
            keeps[i, :3] = -gain[i]
        for i in range(3):
            keeps[i, i] += 1.0
        means[row] += times(gain, _innovation(means[row], places[k]))
        means[row, 2] = wrapped_rad(means[row, 2])
        covariances[row] = carried(keeps, before) + carried(gain, noise[k])


@kernel
def distances2(
    means: Array, covariances: Array, rows: IntArray, places: Array, noise: Array
) -> Array:
    """Return squared Mahalanobis distances of sightings from tracks, as `update` takes them."""
    found, weight = np.full(len(rows), np.inf), np.empty((3, 3))
    for k, row in enumerate(rows):
        if inverted(covariances[row, :3, :3] + noise[k], weight):
            off = _innovation(means[row], places[k])
            found[k] = dot(off, times(weight, off))
    return found


@kernel
def _innovation(mean: Array, place: Array) -> Array:
    """Return seen minus expected, the heading's the short way round, shape (3,)."""
    turned = wrapped_rad(place[2] - mean[2])
    return np.array([place[0] - mean[0], place[1] - mean[1], turned])
