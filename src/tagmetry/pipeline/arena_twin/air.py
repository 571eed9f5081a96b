"""The air between the host and the robots: every packet late, some never."""

import heapq
from itertools import count

import numpy as np

from tagmetry.pipeline.arena_twin.scenario import Radio

HOST = -1  # a receiver like the robots, which go by their ids


class Air:
    """Packets on their way."""

    def __init__(self, radio: Radio, rng: np.random.Generator) -> None:
        self._radio, self._rng = radio, rng
        self._flying: list[tuple[float, int, int, bytes]] = []
        self._number = count()

    def send(self, receiver: int, packet: bytes, now_s: float) -> None:
        """Let a packet go; the same random numbers are drawn whether it is lost or not."""
        chance, more = self._rng.random(2)
        if chance >= self._radio.loss:
            arrives_s = now_s + self._radio.delay_s + more * self._radio.jitter_s
            heapq.heappush(self._flying, (arrives_s, next(self._number), receiver, packet))

    def arrived(self, now_s: float) -> list[tuple[int, bytes]]:
        """Return what has arrived since the last call, with its receiver, in order."""
        here = []
        while self._flying and self._flying[0][0] <= now_s + 1e-9:
            _, _, receiver, packet = heapq.heappop(self._flying)
            here.append((receiver, packet))
        return here
