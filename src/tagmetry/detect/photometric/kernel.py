"""How the loops over pixels are compiled: to disk, without the GIL, divisions by zero give inf."""

from numba import njit

kernel = njit(
    cache=True,
    nogil=True,
    error_model="numpy",
    fastmath={"contract", "reassoc", "arcp", "nsz"},
)
