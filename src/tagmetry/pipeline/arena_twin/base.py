"""The host's end of the link in simulated time: the real packets, no sockets, no threads."""

from collections.abc import Mapping

import numpy as np

from tagmetry.link import Beat, Command, Message, RobotLink
from tagmetry.link.emergency import Emergency
from tagmetry.link.hearing import Hearing
from tagmetry.link.messages import Hello, Time
from tagmetry.link.peer import Peer
from tagmetry.link.traffic import Received
from tagmetry.link.wire import BEAT_US
from tagmetry.pipeline.arena_twin.air import HOST, Air

_ADDRESS = ("twin", 0)


class Base:
    """Talks to all robots through the air."""

    def __init__(self, keys: Mapping[int, bytes], air: Air, rng: np.random.Generator) -> None:
        def draw_nonce() -> int:
            return int(rng.integers(1, 2**63))

        self._hearing = Hearing({one: Peer(one, key, draw_nonce) for one, key in keys.items()})
        self._air = air
        self._emergency = Emergency()
        self._received: list[Received] = []
        self._beaten_us = 0

    def hear(self, packet: bytes, now_us: int) -> None:
        """Take a packet of a robot, and answer it where it wants that."""
        heard = self._hearing.hear(packet, _ADDRESS, now_us)
        if heard is None:
            return
        peer, received = heard
        if not isinstance(received.message, (Hello, Time)):
            self._received.append(received)
        reply = self._hearing.reply(received)
        if reply is not None:
            self._air.send(peer.robot_id, reply[1], now_us / 1e6)

    def send(self, robot_id: int, message: Message, now_us: int) -> None:
        """Send a message to a robot; none while it is not linked, no command in an emergency."""
        peer = self._hearing.peers[robot_id]
        if peer.has_session and not (isinstance(message, Command) and self.is_stopped):
            self._air.send(robot_id, peer.seal(message, now_us), now_us / 1e6)

    def beat(self, now_us: int) -> None:
        """Repeat the emergency stop, or tell robots that the host lives, when it is time."""
        if now_us - self._beaten_us < BEAT_US // 2:
            return
        self._beaten_us = now_us
        urgent = self._emergency.message()
        for robot_id, peer in self._hearing.peers.items():
            if urgent is not None:
                self.send(robot_id, urgent, now_us)
            elif now_us - peer.sent_us >= BEAT_US // 2:
                self.send(robot_id, Beat(), now_us)
        self._emergency.count_down()

    @property
    def is_stopped(self) -> bool:
        """Whether the emergency stop is latched."""
        return self._emergency.is_latched

    def stop(self) -> None:
        """Stop all robots, and keep them stopped."""
        self._emergency.stop()

    def release(self) -> None:
        """Let them move again."""
        self._emergency.release()

    def take(self) -> list[Received]:
        """Return what robots told since the last call."""
        taken, self._received = self._received, []
        return taken

    def links(self, now_us: int) -> tuple[RobotLink, ...]:
        """Return how every robot's link does, by rising id."""
        peers = self._hearing.peers
        return tuple(peers[one].link(now_us) for one in sorted(peers))


__all__ = ["HOST", "Base"]
