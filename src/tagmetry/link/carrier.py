"""What brings a host's packets to its robots and back: UDP, or Zenoh between computers."""

from typing import Protocol

Address = tuple[str, int]


class Carrier(Protocol):
    """Carries packets of robots that have addresses; it may lose them, and never blocks."""

    @property
    def address(self) -> Address:
        """Where robots reach the host."""

    def wait(self, timeout_s: float) -> bool:
        """Wait until a packet is there, at most so long; say whether one is."""

    def read(self) -> tuple[bytes, Address] | None:
        """Return a packet and who sent it; None where none is there."""

    def write(self, packet: bytes, address: Address) -> bool:
        """Send a packet; say whether it left."""

    def close(self) -> None:
        """Let go of the network."""
