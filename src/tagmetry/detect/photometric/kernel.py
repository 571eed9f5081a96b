"""How the loops over pixels are compiled: to disk, without the GIL, divisions by zero give inf."""

from numba import njit

_FLAGS = {"contract", "reassoc", "arcp", "nsz"}

kernel = njit(cache=True, nogil=True, error_model="numpy", fastmath=_FLAGS)

# A step of a page, written into its caller before that is compiled. Every kernel that calls another
# compiles that one's code again, so that pages that call pages would take minutes.
step = njit(inline="always", nogil=True, error_model="numpy", fastmath=_FLAGS)
