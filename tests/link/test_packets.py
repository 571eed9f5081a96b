"""Packets say what was said, in published bytes, and nothing that was touched is accepted."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.link import (
    Command,
    Kind,
    Neighbour,
    Neighbours,
    Odometry,
    Pose,
    Refusal,
    Telemetry,
    new_key,
    parse_key,
)
from tagmetry.link.bodies import pack_body, unpack_body
from tagmetry.link.layout import COVARIANCES
from tagmetry.link.messages import KINDS, ArenaState, Message, State, Time
from tagmetry.link.packet import Header, body_of, is_sealed_with, read_header, seal
from tagmetry.link.wire import BODIES, FRAME_BYTES

KEY = bytes(range(32))
U64 = st.integers(0, 2**64 - 1)
U32 = st.integers(0, 2**32 - 1)
U16 = st.integers(0, 2**16 - 1)
F32 = st.floats(allow_nan=False, allow_infinity=False, width=32)
NAMES = st.text("abcdefgh_0123456789 .", min_size=1, max_size=12)
MESSAGES = st.one_of(
    st.builds(Pose, U64, F32, F32, F32, F32, F32, F32, F32),
    st.builds(Command, F32, F32, F32, st.integers(0, 65535), st.integers(0, 65535)),
    st.builds(Odometry, U64, F32, F32, F32, F32, F32, F32),
    st.builds(Time, U64, U32, U32, U32, U32),
    st.builds(State, U64, F32, F32, F32, F32, F32, F32, U32, st.tuples(*[F32] * COVARIANCES)),
    st.builds(ArenaState, U64, U32, U32, U16, U16),
    st.builds(Telemetry, U64, st.lists(st.tuples(NAMES, F32), max_size=64).map(tuple)),
)


@given(MESSAGES, st.integers(0, 65535), U64, U32, U32)
def test_a_packet_says_what_was_said(
    message: Message, robot: int, sent_us: int, counter: int, session: int
) -> None:
    kind, body = pack_body(message)
    header = Header(kind, robot, sent_us, counter, session)
    packet = seal(KEY, header, body)
    assert read_header(packet, BODIES[kind].sender) == header
    assert is_sealed_with(KEY, packet)
    assert unpack_body(kind, body_of(packet)) == message


NEIGHBOUR = st.builds(
    Neighbour,
    st.integers(0, 65535),
    st.floats(0, 65.5),
    st.floats(-math.pi, math.pi),
    st.floats(-math.pi, math.pi),
    st.floats(0, 0.25),
    st.floats(0, 1),
)


@given(st.lists(NEIGHBOUR, max_size=120))
def test_neighbours_come_nearest_first_and_to_the_millimetre(seen: list[Neighbour]) -> None:
    kind, body = pack_body(Neighbours(5, 0.3, tuple(seen)))
    found = unpack_body(kind, body)
    assert isinstance(found, Neighbours)
    assert (len(found.seen), found.omitted) == (min(len(seen), 100), max(len(seen) - 100, 0))
    nearest = sorted(seen, key=lambda one: one.range_m)
    for sent, got in zip(nearest, found.seen, strict=False):
        assert got.id == sent.id
        assert got.range_m == pytest.approx(sent.range_m, abs=0.0005001)
        turned = math.remainder(got.bearing_rad - sent.bearing_rad, math.tau)
        assert abs(turned) <= 0.5001e-4
        assert got.age_s == pytest.approx(sent.age_s, abs=0.00051)
        assert got.quality == pytest.approx(sent.quality, abs=0.5 / 255 + 1e-9)


def test_the_bytes_of_a_command_are_little_endian() -> None:
    kind, body = pack_body(Command(0.5, -0.25, 2.0, 200, 513))
    assert body.hex() == "0000003f000080be00000040c8000102"
    packet = seal(KEY, Header(kind, 0x0302, 0x0807060504030201, 0x44332211, 0x88776655), body)
    assert packet[:24].hex() == "544d01090203100001020304050607081122334455667788"
    assert packet[-16:].hex() == "592eb5c9974dc39095e05f5bccffefe2"


def test_the_bytes_of_neighbours_are_little_endian() -> None:
    one = Neighbour(258, 0.3, -1.0, 3.0, 0.016, 1.0)
    _, body = pack_body(Neighbours(1, 0.5, (one,), omitted=2))
    assert body.hex() == "0100000000000000f401010202012c01f0d8307510ff"


def test_a_name_of_telemetry_fills_twelve_bytes() -> None:
    _, body = pack_body(Telemetry(1, (("volt", 7.5),)))
    assert body.hex() == "0100000000000000766f6c7400000000000000000000f040"


@given(st.binary(max_size=1300))
def test_no_bytes_are_a_crash(packet: bytes) -> None:
    for sender in ("robot", "host", "arena"):
        assert isinstance(read_header(packet, sender), Refusal)


@given(MESSAGES, st.data())
def test_a_packet_that_was_touched_is_not_sealed(message: Message, data: st.DataObject) -> None:
    kind, body = pack_body(message)
    packet = bytearray(seal(KEY, Header(kind, 3, 5, 6, 7), body))
    place = data.draw(st.integers(0, len(packet) - 1))
    packet[place] ^= data.draw(st.integers(1, 255))
    assert not is_sealed_with(KEY, bytes(packet))


@given(st.sampled_from(list(Kind)), st.binary(max_size=1160))
def test_any_sealed_body_is_understood_or_refused(kind: Kind, body: bytes) -> None:
    packet = seal(KEY, Header(kind, 3, 5, 6, 7), body)
    header = read_header(packet, BODIES[kind].sender)
    assert isinstance(header, Refusal) == (not BODIES[kind].fits(len(body)))
    if not isinstance(header, Refusal):
        message = unpack_body(kind, body)
        assert message is None or KINDS[type(message)] is kind


def test_a_packet_of_the_wrong_side_is_refused() -> None:
    kind, body = pack_body(Command(1.0))
    assert read_header(seal(KEY, Header(kind, 3, 5, 6, 7), body), "robot") is Refusal.SENDER


def test_every_message_has_the_fields_of_its_layout() -> None:
    for message_type, kind in KINDS.items():
        if BODIES[kind].item is None:
            names = tuple(message_type.__dataclass_fields__)
            assert names == tuple(field.name for field in BODIES[kind].layout.fields)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e39])
def test_a_command_that_is_no_number_is_not_sent(value: float) -> None:
    with pytest.raises(InputError, match="this COMMAND cannot be sent"):
        pack_body(Command(value))


@pytest.mark.parametrize(
    ("message", "reason"),
    [
        (Command(valid_for_ms=70000), "this COMMAND cannot be sent"),
        (Command(lamp=-1), "this COMMAND cannot be sent"),
        (Pose(-1, 0, 0, 0), "this POSE cannot be sent"),
        (Neighbours(1, 0.5, (Neighbour(70000, 1, 0, 0),)), "these neighbours cannot be sent"),
        (Neighbours(1, 0.5, (Neighbour(7, math.nan, 0, 0),)), "these neighbours cannot be sent"),
        (Neighbours(1, 0.5, (Neighbour(7, 1, math.inf, 0),)), "these neighbours cannot be sent"),
        (Neighbours(1, 0.5, (Neighbour(7, -1, 0, 0),)), "these neighbours cannot be sent"),
        (Telemetry(1, (("much too long a name", 1.0),)), "1 to 12 printable ASCII characters"),
        (Telemetry(1, (("", 1.0),)), "1 to 12 printable ASCII characters"),
        (Telemetry(1, (("ä", 1.0),)), "1 to 12 printable ASCII characters"),
        (Telemetry(1, (("a", 1e39),)), "this telemetry cannot be sent"),
        (Telemetry(1, (("a", 1.0),) * 65), "at most 64 readings in a packet, got 65"),
    ],
)
def test_what_does_not_fit_is_not_sent(message: Message, reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        pack_body(message)


def test_a_command_that_is_no_number_is_refused_though_sealed() -> None:
    _, body = pack_body(Command(1.0))
    assert unpack_body(Kind.COMMAND, b"\x00\x00\xc0\x7f" + body[4:]) is None


def test_a_count_that_does_not_fit_is_refused() -> None:
    _, body = pack_body(Neighbours(1, 0.5, (Neighbour(7, 1, 0, 0),)))
    assert unpack_body(Kind.NEIGHBOURS, body[:10] + b"\x02" + body[11:]) is None


def test_the_largest_packets_fit() -> None:
    everybody = tuple(Neighbour(n, 1, 0, 0) for n in range(100))
    readings = tuple((f"reading {n}", float(n)) for n in range(64))
    for message in (Neighbours(1, 1, everybody), Telemetry(1, readings)):
        kind, body = pack_body(message)
        packet = seal(KEY, Header(kind, 3, 5, 6, 7), body)
        assert isinstance(read_header(packet, BODIES[kind].sender), Header)
        assert len(packet) == FRAME_BYTES + len(body) <= 1200


def test_a_key_is_64_hexadecimal_digits() -> None:
    assert parse_key("00ff" * 16) == bytes([0, 255] * 16)
    assert len({parse_key(new_key()) for _ in range(100)}) == 100


@pytest.mark.parametrize("text", ["", "secret", "0g" * 32, "00" * 31, "00" * 33, "00" * 32 + "\n"])
def test_what_is_no_key_is_refused_and_not_repeated(text: str) -> None:
    with pytest.raises(InputError, match="expected a robot's key, 64 hexadecimal digits") as caught:
        parse_key(text)
    assert not text or text not in str(caught.value)


def test_a_header_holds_no_more_than_it_says() -> None:
    assert Header(Kind.BEAT, 1, 2, 3, 4) == (Kind.BEAT, 1, 2, 3, 4)
