"""Residuals in units of their own noise."""

import numpy as np

from tagmetry.geometry import Array


def whitening(covariances_px2: Array) -> Array:
    """Return W with W C W^T = I for each covariance (n, m, m); NaN for one that is not positive."""
    identity = np.eye(covariances_px2.shape[-1])
    usable = np.asarray(np.isfinite(covariances_px2).all(axis=(1, 2)))
    safe = np.where(usable[:, None, None], covariances_px2, identity)
    usable &= np.linalg.eigvalsh(safe)[:, 0] > 0
    safe = np.where(usable[:, None, None], safe, identity)
    W = np.linalg.solve(np.linalg.cholesky(safe), np.broadcast_to(identity, safe.shape))
    return np.where(usable[:, None, None], W, np.nan)
