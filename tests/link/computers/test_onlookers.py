"""What an arena tells all is believed if it is sealed, of this session, new and in time."""

import random
from itertools import count

import numpy as np
import pytest

from tagmetry.arena import RobotState
from tagmetry.link.computers.broadcast import Broadcast
from tagmetry.link.computers.keys import ARENA_ID, OPEN_KEY
from tagmetry.link.computers.onlooker import Onlooker
from tagmetry.link.computers.sight import Gathering, robot_state, state_message
from tagmetry.link.layout import Kind
from tagmetry.link.messages import ArenaState, Beat, Command, Neighbours, State
from tagmetry.link.packet import Header, Refusal, body_of, seal

KEY = bytes(range(32))
AHEAD_US = 700_000_000  # the onlooker's clock minus the host's
STATE = State(1, 0.5, 0.25, 0.125, 0.0, 0.0, 0.0, 1, tuple(float(n) for n in range(15)))


class Air:
    """A host and an onlooker; time passes only when the test says so."""

    def __init__(self, key: bytes = KEY, onlookers_key: bytes = KEY) -> None:
        self.host_us = 10_000_000
        self.broadcast = Broadcast(key, count(5_000_000_000).__next__)
        self.onlooker = Onlooker(onlookers_key, count(1001).__next__)

    @property
    def here_us(self) -> int:
        return self.host_us + AHEAD_US

    def greet(self, delay_us: int = 500) -> bytes:
        """Exchange HELLO and ASSIGN; return the ASSIGN."""
        hello = self.onlooker.due(self.here_us)
        assert hello is not None
        self.host_us += delay_us
        assign = self.broadcast.answer(hello, self.host_us)
        assert assign is not None
        self.host_us += delay_us
        self.onlooker.hear(assign, "host", self.here_us)
        return assign

    def say(self, robot_id: int = 3) -> bytes:
        return self.broadcast.seal(robot_id, STATE, self.host_us)

    def is_believed(self, packet: bytes) -> bool:
        return self.onlooker.hear(packet, "arena", self.here_us) is not None

    def why_not(self, packet: bytes) -> Refusal:
        """Return why a packet is refused."""
        before = self.onlooker.refused.copy()
        assert not self.is_believed(packet)
        ((why, number),) = (self.onlooker.refused - before).items()
        assert number == 1
        return why


@pytest.fixture
def air() -> Air:
    air = Air()
    air.greet()
    return air


def test_what_is_said_is_heard(air: Air) -> None:
    assert air.onlooker.hear(air.say(7), "arena", air.here_us) == (7, STATE)
    for kind in (Command(0.5), Neighbours(1, 0.5)):
        packet = air.broadcast.seal(7, kind, air.host_us)
        assert air.onlooker.hear(packet, "host", air.here_us) == (7, kind)


def test_nothing_is_believed_before_the_greeting() -> None:
    air = Air()
    assert air.why_not(air.say()) is Refusal.SESSION
    air.greet()
    assert air.is_believed(air.say())


def test_each_packet_is_believed_once(air: Air) -> None:
    packet = air.say()
    assert air.is_believed(packet)
    assert air.why_not(packet) is Refusal.REPLAYED


@pytest.mark.parametrize(("delay_us", "is_in_time"), [(240_000, True), (260_000, False)])
def test_a_packet_that_was_held_back_is_late(air: Air, delay_us: int, is_in_time: bool) -> None:
    packet = air.say()
    air.host_us += delay_us
    assert air.is_believed(packet) == is_in_time


def test_a_recording_of_an_earlier_session_is_worth_nothing(air: Air) -> None:
    recorded = [air.say() for _ in range(5)]
    air.broadcast = Broadcast(KEY, count(9_000_000_000).__next__)  # the host began anew
    air.host_us += 1_000_000
    air.greet()
    assert [air.why_not(packet) for packet in recorded] == [Refusal.SESSION] * 5
    assert air.is_believed(air.say())


def test_an_old_answer_begins_no_session() -> None:
    air = Air()
    old = air.greet()
    air.onlooker = Onlooker(KEY, count(2001).__next__)
    air.onlooker.due(air.here_us)
    assert air.onlooker.hear(old, "host", air.here_us) is None
    assert air.why_not(air.say()) is Refusal.SESSION


def test_what_another_computer_is_answered_is_no_attack(air: Air) -> None:
    another = Onlooker(KEY, count(3001).__next__)
    hello = another.due(air.here_us)
    assert hello is not None
    answer = air.broadcast.answer(hello, air.host_us)
    assert answer is not None
    assert air.onlooker.hear(answer, "host", air.here_us) is None
    assert air.onlooker.refused == {}


def test_an_answer_that_took_too_long_bounds_no_clock() -> None:
    air = Air()
    air.greet(delay_us=200_000)
    assert air.why_not(air.say()) is Refusal.SESSION


def test_a_forged_answer_to_this_very_greeting_is_refused() -> None:
    air, forger = Air(), Broadcast(OPEN_KEY, count(6_000_000_000).__next__)
    hello = air.onlooker.due(air.here_us)
    assert hello is not None
    read = body_of(hello)  # nothing in it is secret
    greeting = seal(OPEN_KEY, Header(Kind.HELLO, ARENA_ID, 0, 0, 0), read)
    answer = forger.answer(greeting, air.host_us)
    assert answer is not None
    assert air.onlooker.hear(answer, "host", air.here_us) is None
    assert air.onlooker.refused == {Refusal.TAG: 1}
    assert air.why_not(forger.seal(3, STATE, air.host_us)) is Refusal.SESSION


def test_the_hello_of_a_robot_is_not_answered(air: Air) -> None:
    hello = air.onlooker.due(air.here_us + 2_000_000)
    assert hello is not None
    assert air.broadcast.answer(hello, air.host_us) is not None
    of_robot = seal(KEY, Header(Kind.HELLO, 3, 0, 0, 0), body_of(hello))
    assert air.broadcast.answer(of_robot, air.host_us) is None


def test_another_key_opens_nothing() -> None:
    air = Air(onlookers_key=OPEN_KEY)
    hello = air.onlooker.due(air.here_us)
    assert hello is not None
    assert air.broadcast.answer(hello, air.host_us) is None


def test_a_new_session_is_found_within_a_fifth_of_a_second(air: Air) -> None:
    air.broadcast = Broadcast(KEY, count(9_000_000_000).__next__)
    assert air.onlooker.due(air.here_us) is None
    air.is_believed(air.say())
    air.host_us += 200_000
    air.greet()
    assert air.is_believed(air.say())


def test_a_session_whose_counters_are_used_up_gives_way_to_a_new_one(air: Air) -> None:
    assert air.is_believed(air.say())
    air.broadcast._sessions[3]._counter = 2**32 - 1
    air.host_us += 1_000_000
    assert air.why_not(air.say()) is Refusal.SESSION
    air.greet()
    assert air.is_believed(air.say())


def test_the_host_s_clock_is_never_taken_for_earlier(air: Air) -> None:
    for delay_us in (60_000, 100, 5_000):
        air.host_us += 1_000_000
        air.greet(delay_us)
        assert air.host_us <= air.onlooker.host_us(air.here_us) <= air.host_us + 60_500


def forgery(air: Air, recorded: list[bytes], rng: random.Random) -> bytes:
    """Return what an attacker makes who knows all that was said, and no key."""
    fresh = bytearray(air.say())
    sort = rng.randrange(5)
    if sort == 0:
        return rng.choice(recorded)
    if sort == 1:
        return rng.randbytes(rng.randrange(300))
    if sort == 2:
        return bytes(fresh[: rng.randrange(len(fresh))])
    if sort == 3:
        return Broadcast(rng.randbytes(32), lambda: 5_000_000_000).seal(3, STATE, air.host_us)
    fresh[rng.randrange(len(fresh))] ^= rng.randint(1, 255)
    return bytes(fresh)


@pytest.mark.parametrize("number", [5_000, pytest.param(500_000, marks=pytest.mark.slow)])
def test_no_forgery_is_believed(air: Air, number: int) -> None:
    rng = random.Random(4)  # noqa: S311
    recorded = [air.say() for _ in range(50)]
    assert all(map(air.is_believed, recorded))
    for _ in range(number):
        packet = forgery(air, recorded, rng)
        assert not air.is_believed(packet), packet.hex()
    assert air.is_believed(air.say())
    assert len(air.onlooker._sessions) == 1


def test_noise_is_no_hello(air: Air) -> None:
    rng = random.Random(5)  # noqa: S311
    hello = Onlooker(KEY, lambda: 1).due(0)
    assert hello is not None
    for _ in range(500):
        mutated = bytearray(hello)
        mutated[rng.randrange(len(mutated))] ^= rng.randint(1, 255)
        assert air.broadcast.answer(bytes(mutated), 0) is None
        assert air.broadcast.answer(rng.randbytes(rng.randrange(100)), 0) is None


def robot(number: int, rng: np.random.Generator) -> RobotState:
    root = rng.standard_normal((5, 5))
    values = rng.standard_normal(5).tolist()
    return RobotState(number, f"r{number}", *values, root @ root.T, 0.25, bool(number % 2), 7.0)


def test_a_state_arrives_as_it_was_to_the_precision_of_the_wire() -> None:
    air, rng = Air(), np.random.default_rng(0)
    air.greet()
    for number in range(20):
        sent = robot(number, rng)
        message = state_message(sent, 7_000_000, must_stand=False)
        packet = air.broadcast.seal(number, message, air.host_us)
        heard = air.onlooker.hear(packet, "arena", air.here_us)
        assert heard is not None
        assert isinstance(heard[1], State)
        got = robot_state(heard[0], sent.name, heard[1])
        assert (got.id, got.name, got.seen, got.time_s) == (number, sent.name, sent.seen, 7.0)
        np.testing.assert_allclose(got.covariance, sent.covariance, rtol=1e-6)
        for name in ("x_m", "y_m", "heading_rad", "speed_mps", "turn_rate_radps", "age_s"):
            assert getattr(got, name) == pytest.approx(getattr(sent, name), rel=1e-6)


def test_an_image_is_whole_when_its_end_is_told() -> None:
    gathering, rng = Gathering(), np.random.default_rng(0)
    for number in (5, 3):
        message = state_message(robot(number, rng), 9, must_stand=number == 5)
        assert gathering.add(number, f"r{number}", message) is None
    gathering.add(3, "r3", Command(0.5))
    sight = gathering.add(ARENA_ID, "", ArenaState(9, 41, 1, 3, 2))
    assert sight is not None
    assert [one.id for one in sight.world] == [3, 5]
    assert (sight.image, sight.is_stopped, sight.held, sight.missing) == (41, True, {5}, 1)
    assert sight.commanded == {3: Command(0.5)}


def test_the_next_image_shows_nothing_of_the_last() -> None:
    gathering, rng = Gathering(), np.random.default_rng(0)
    gathering.add(3, "r3", state_message(robot(3, rng), 9, must_stand=False))
    gathering.add(3, "r3", Command(0.5))
    gathering.add(ARENA_ID, "", ArenaState(9, 1, 0, 1, 1))
    sight = gathering.add(ARENA_ID, "", ArenaState(10, 2, 0, 0, 0))
    assert sight is not None
    assert (sight.world.robots, sight.commanded, sight.missing) == ((), {}, 0)
    assert gathering.add(ARENA_ID, "", Beat()) is None
