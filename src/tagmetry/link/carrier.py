"""What brings a host's packets to its robots and back: UDP, or Zenoh between computers."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Protocol

Address = tuple[str, int]
Envelope = tuple[bytes, Address]  # a packet, and who sent it or shall have it


class Carrier(Protocol):
    """Carries packets of robots that have addresses; it may lose them, and never blocks."""

    @property
    def address(self) -> Address:
        """Where robots reach the host."""

    def wait(self, timeout_s: float) -> bool:
        """Wait until a packet is there, at most so long; say whether one is."""

    def read_some(self, most: int) -> list[Envelope]:
        """Return packets that are there, at most so many."""

    def write(self, packet: bytes, address: Address) -> bool:
        """Send a packet; say whether it left."""

    def write_all(self, packets: Sequence[Envelope]) -> list[bool]:
        """Send packets; say which left."""

    def close(self) -> None:
        """Let go of the network."""


class OneByOne(ABC):
    """What has a way for single packets carries many of them one by one."""

    @abstractmethod
    def read(self) -> Envelope | None:
        """Return a packet and who sent it; None where none is there."""

    @abstractmethod
    def write(self, packet: bytes, address: Address) -> bool:
        """Send a packet; say whether it left."""

    def read_some(self, most: int) -> list[Envelope]:
        """Return packets that are there, at most so many."""
        found: list[Envelope] = []
        while len(found) < most and (one := self.read()) is not None:
            found.append(one)
        return found

    def write_all(self, packets: Sequence[Envelope]) -> list[bool]:
        """Send packets; say which left."""
        return [self.write(packet, address) for packet, address in packets]
