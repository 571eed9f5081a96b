"""Another computer commands robots: the host of a link whose robots are an arena's stand-ins."""

from collections.abc import Collection

from tagmetry.errors import InputError
from tagmetry.link.carrier import Address, Envelope, OneByOne
from tagmetry.link.computers.keys import command_key_of
from tagmetry.link.computers.net import Net
from tagmetry.link.computers.topics import Topics, checked_name, robot_of
from tagmetry.link.host import Host
from tagmetry.link.wire import KEY_BYTES

_KEPT = 2000  # answers; what is dropped is said again


class NetCarrier(OneByOne):
    """Carries packets between a computer that commands and an arena; a robot's address is its name.

    Attributes:
        address: The endpoint, and nothing.
    """

    def __init__(self, endpoint: str, topics: Topics) -> None:
        """Join the net, as `Net` does."""
        self.address: Address = endpoint, 0
        self._topics, self._net = topics, Net(connect=endpoint)
        self._inbox = self._net.inbox(topics.answer(), _KEPT)

    def wait(self, timeout_s: float) -> bool:
        """Wait until a packet is there, at most so long; say whether one is."""
        return self._inbox.wait(timeout_s)

    def read(self) -> Envelope | None:
        """Return a packet and its robot's name; None where none is there."""
        found = self._inbox.take()
        return None if found is None else (found[1], (robot_of(found[0]), 0))

    def write(self, packet: bytes, address: Address) -> bool:
        """Send a packet to a robot's stand-in; say whether it left."""
        return self._net.tell(self._topics.command(address[0]), packet, is_urgent=True)

    def close(self) -> None:
        """Leave the net."""
        self._net.close()


class Commander(Host):
    """Commands robots of an arena from another computer, as a host does its own robots.

    A robot obeys one commander at a time: the first, until that is silent for a second. The arena
    stays in between: its fence, its stops and its e-stop hold whatever a commander says.
    """

    def __init__(
        self, endpoint: str, robot_ids: Collection[int], key: bytes, arena: str = "arena"
    ) -> None:
        """Join the net; nobody is commanded before the with-block.

        Args:
            endpoint: The arena's computer, or a router: tcp/192.168.1.5:7447.
            robot_ids: The robots to command; others stay as they are.
            key: That of the arena's file to command with, as `parse_key` returns it.
            arena: The arena's name, as its file has it.

        Raises:
            InputError: Nobody answers there, or a name, an id or the key cannot be one.
            MissingExtraError: Zenoh is not installed.
        """
        if len(key) != KEY_BYTES:
            raise InputError(f"expected a key of {KEY_BYTES} bytes, got {len(key)}; see parse_key")
        beyond = [one for one in robot_ids if not 0 <= one < 0xFFFF]
        if beyond:
            raise InputError(f"expected robots' ids, 0 to 65534, got {beyond[0]}")
        keys = {one: command_key_of(one, key) for one in robot_ids}
        super().__init__(keys, carrier=NetCarrier(endpoint, Topics(checked_name(arena, "arena"))))
