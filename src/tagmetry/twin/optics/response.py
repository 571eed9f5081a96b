"""Response curves: from the light that a pixel gathered to the code value that it reports.

Exposure is linear, 1 = full scale, and may exceed it; code values go from 0 to 1. All are monotone.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from tagmetry.errors import InputError

Levels = NDArray[np.floating]  # any shape


class Response(Protocol):
    """A monotone curve from exposure to code value."""

    @property
    def full_exposure(self) -> float:
        """The least exposure whose code is the greatest."""

    def code(self, exposure: Levels) -> Levels:
        """Return the codes of exposures, any shape; clipped to what the curve can report."""

    def exposure(self, code: Levels) -> Levels:
        """Return the exposures of codes 0..1, any shape: the inverse of `code`."""


@dataclass(frozen=True)
class Linear:
    """Code and exposure are equal, up to full scale."""

    @property
    def full_exposure(self) -> float:
        """The least exposure whose code is 1."""
        return 1.0

    def code(self, exposure: Levels) -> Levels:
        """Return exposure, clipped to 0..1."""
        return np.clip(exposure, 0, 1)

    def exposure(self, code: Levels) -> Levels:
        """Return the code."""
        return np.clip(code, 0, 1)


@dataclass(frozen=True)
class Gamma:
    """code = exposure^(1 / exponent).

    Attributes:
        exponent: Of the display that the code is made for, e.g. 2.2; 1 is linear.
    """

    exponent: float = 2.2

    def __post_init__(self) -> None:
        if not (np.isfinite(self.exponent) and self.exponent > 0):
            raise InputError(f"the exponent of a gamma curve must be positive, got {self.exponent}")

    @property
    def full_exposure(self) -> float:
        """The least exposure whose code is 1."""
        return 1.0

    def code(self, exposure: Levels) -> Levels:
        """Return codes, clipped to 0..1."""
        return np.clip(exposure, 0, 1) ** (1 / self.exponent)

    def exposure(self, code: Levels) -> Levels:
        """Return exposures."""
        return np.clip(code, 0, 1) ** self.exponent


@dataclass(frozen=True)
class Srgb:
    """The curve of sRGB pictures, IEC 61966-2-1: linear near black, then nearly a gamma of 2.4."""

    @property
    def full_exposure(self) -> float:
        """The least exposure whose code is 1."""
        return 1.0

    def code(self, exposure: Levels) -> Levels:
        """Return codes, clipped to 0..1."""
        linear = np.clip(exposure, 0, 1)
        return np.where(
            linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055
        ).astype(linear.dtype)

    def exposure(self, code: Levels) -> Levels:
        """Return exposures."""
        code = np.clip(code, 0, 1)
        return np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4).astype(
            code.dtype
        )


@dataclass(frozen=True)
class Curve:
    """A measured curve: straight between its points, level beyond them.

    Attributes:
        exposures: Increasing.
        codes: 0 to 1, never falling; the inverse exists where they increase.
    """

    exposures: tuple[float, ...]
    codes: tuple[float, ...]

    def __post_init__(self) -> None:
        if len(self.exposures) != len(self.codes) or len(self.codes) < 2:
            raise InputError(
                "a response curve takes as many exposures as codes, at least two, got "
                f"{len(self.exposures)} and {len(self.codes)}"
            )
        if not (np.isfinite(self.exposures).all() and (np.diff(self.exposures) > 0).all()):
            raise InputError("the exposures of a response curve must increase from point to point")
        if not ((np.diff(self.codes) >= 0).all() and 0 <= self.codes[0] <= self.codes[-1] <= 1):
            raise InputError("the codes of a response curve must lie in 0..1 and never fall")

    @property
    def full_exposure(self) -> float:
        """The least exposure whose code is the greatest."""
        return self.exposures[self.codes.index(self.codes[-1])]

    def code(self, exposure: Levels) -> Levels:
        """Return codes."""
        return np.interp(exposure, self.exposures, self.codes)

    def exposure(self, code: Levels) -> Levels:
        """Return exposures.

        Raises:
            InputError: When the curve is level somewhere, so that a code has many exposures.
        """
        if not (np.diff(self.codes) > 0).all():
            raise InputError("this response curve is level in places and has no inverse there")
        return np.interp(code, self.codes, self.exposures)


@dataclass(frozen=True)
class Hdr:
    """Linear up to a knee, then logarithmic, as high dynamic range sensors respond.

    code = a e below the knee k, a k (1 + ln(e / k)) above: no step, no bend, and a such that the
    code is 1 at 2^stops times full scale.

    Attributes:
        stops: How many doublings of light beyond full scale still differ.
        knee: Exposure where the logarithm begins; 1 with 0 stops is linear.
    """

    stops: float = 4.0
    knee: float = 0.25

    def __post_init__(self) -> None:
        if not 0 <= self.stops <= 60:
            raise InputError(
                f"an HDR response has 0 to 60 stops above full scale, got {self.stops}"
            )
        if not 0 < self.knee <= 1:
            raise InputError(f"the knee of an HDR response lies in 0..1, got {self.knee}")

    @property
    def full_exposure(self) -> float:
        """The least exposure whose code is 1."""
        return float(2**self.stops)

    def code(self, exposure: Levels) -> Levels:
        """Return codes, clipped to 0..1."""
        linear = np.clip(exposure, 0, self.full_exposure)
        above = self.knee * (1 + np.log(np.maximum(linear, self.knee) / self.knee))
        return np.minimum(self._slope * np.where(linear <= self.knee, linear, above), 1).astype(
            linear.dtype
        )

    def exposure(self, code: Levels) -> Levels:
        """Return exposures."""
        linear = np.clip(code, 0, 1) / self._slope
        above = self.knee * np.exp(np.maximum(linear / self.knee, 1) - 1)
        return np.where(linear <= self.knee, linear, above).astype(linear.dtype)

    @property
    def _slope(self) -> float:
        """The factor a."""
        return float(1 / (self.knee * (1 + np.log(self.full_exposure / self.knee))))
