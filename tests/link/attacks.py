"""Packets that nobody may accept: forged, mutated, replayed, late, spliced, reflected."""

import random
from collections.abc import Callable, Iterator

from air import ID, Air

from tagmetry.link import Command, EmergencyStop, Neighbour, Neighbours, Odometry, Pose, Telemetry
from tagmetry.link.bodies import pack_body
from tagmetry.link.packet import Header, seal
from tagmetry.link.wire import BODIES

TO_ROBOT = (
    Command(1.0),
    EmergencyStop(9, 2),
    Pose(1, 2.0, 3.0, 0.5),
    Neighbours(1, 0.5, (Neighbour(7, 0.3, 1.0, 2.0),)),
)
TO_HOST = (Odometry(1, 2.0, 3.0, 0.5), Telemetry(1, (("volt", 7.4),)))


class Attacker:
    """Has recorded what was said in both directions, and knows everything but the keys."""

    def __init__(self, air: Air, rng: random.Random, *, at_host: bool) -> None:
        self._rng, self._at_host = rng, at_host
        say = air.say if at_host else air.send
        accept = air.is_heard if at_host else air.to_robot
        self._messages = TO_HOST if at_host else TO_ROBOT
        heard = [say(rng.choice(self._messages)) for _ in range(40)]
        assert all(accept(packet) for packet in heard)
        self._late = [say(rng.choice(self._messages)) for _ in range(20)]
        air.wait(300_000)
        other = air.send if at_host else air.say
        self._other_way = [other(rng.choice(TO_ROBOT if at_host else TO_HOST)) for _ in range(20)]
        self._fresh = [say(message) for message in self._messages]  # never arrives untouched
        self._heard = heard
        self._session = int.from_bytes(heard[0][20:24], "little")
        self._now_us = air.host_us

    def packets(self, count: int) -> Iterator[bytes]:
        """Give so many packets, each of a random sort."""
        sorts: list[Callable[[], bytes]] = [
            self._noise,
            self._noise_with_a_header,
            lambda: self._mutated(self._rng.choice(self._heard)),
            lambda: self._mutated(self._rng.choice(self._fresh)),
            lambda: self._rng.choice(self._heard),
            lambda: self._rng.choice(self._late),
            lambda: self._rng.choice(self._other_way),
            self._cut,
            self._spliced,
            self._sealed_with_another_key,
        ]
        for _ in range(count):
            yield self._rng.choice(sorts)()

    def _noise(self) -> bytes:
        return self._rng.randbytes(self._rng.randrange(1300))

    def _noise_with_a_header(self) -> bytes:
        fresh = self._rng.choice(self._fresh)
        return fresh[:24] + self._rng.randbytes(len(fresh) - 24)

    def _mutated(self, packet: bytes) -> bytes:
        changed = bytearray(packet)
        for _ in range(self._rng.randint(1, 4)):
            place = self._rng.randrange(len(changed))
            changed[place] = (changed[place] + self._rng.randint(1, 255)) % 256
        return bytes(changed) if bytes(changed) != packet else self._mutated(packet)

    def _cut(self) -> bytes:
        fresh = self._rng.choice(self._fresh)
        if self._rng.random() < 0.5:
            return fresh[: self._rng.randrange(len(fresh))]
        return fresh + self._rng.randbytes(self._rng.randint(1, 40))

    def _spliced(self) -> bytes:
        head, tail = self._rng.choice(self._fresh), self._rng.choice(self._heard)
        return head[:24] + tail[24:]

    def _sealed_with_another_key(self) -> bytes:
        kind, body = pack_body(self._rng.choice(self._messages))
        now_us = self._now_us + self._rng.randint(-1000, 1000)
        header = Header(kind, ID, now_us, self._rng.randint(1, 2**32 - 1), self._session)
        assert (BODIES[kind].sender == "robot") == self._at_host
        return seal(self._rng.randbytes(32), header, body)
