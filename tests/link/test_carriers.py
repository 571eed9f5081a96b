"""Packets arrive as they were sent and from whom, one by one or many at once."""

import sys
from collections.abc import Iterator

import pytest

from tagmetry.link.batched import BatchedUdpCarrier
from tagmetry.link.sockets import LOOPBACK, UdpCarrier

needs_linux = pytest.mark.skipif(sys.platform != "linux", reason="many at once is Linux's")


@pytest.fixture(
    name="carrier", params=[UdpCarrier, pytest.param(BatchedUdpCarrier, marks=needs_linux)]
)
def _carrier(request: pytest.FixtureRequest) -> Iterator[UdpCarrier]:
    opened = request.param(LOOPBACK, 0)
    yield opened
    opened.close()


@pytest.fixture(name="others")
def _others() -> Iterator[list[UdpCarrier]]:
    opened = [UdpCarrier(LOOPBACK, 0) for _ in range(3)]
    yield opened
    for one in opened:
        one.close()


def test_many_packets_go_where_they_shall(carrier: UdpCarrier, others: list[UdpCarrier]) -> None:
    packets = [bytes([k % 256]) * (1 + 3 * k) for k in range(300)]  # more than fit in one call
    sent = [(packet, others[k % 3].address) for k, packet in enumerate(packets)]
    assert carrier.write_all(sent) == [True] * 300
    for n, other in enumerate(others):
        assert other.read_some(400) == [(packet, carrier.address) for packet in packets[n::3]]


def test_packets_are_read_with_who_sent_them(carrier: UdpCarrier, others: list[UdpCarrier]) -> None:
    for k in range(10):
        others[k % 3].write(b"x" * k, carrier.address)
    assert carrier.wait(1.0)
    expected = [(b"x" * k, others[k % 3].address) for k in range(10)]
    assert carrier.read_some(4) + carrier.read_some(100) == expected
    assert carrier.read_some(100) == []


def test_one_that_cannot_leave_is_lost_alone(carrier: UdpCarrier, others: list[UdpCarrier]) -> None:
    to = others[0].address
    sent = [(b"first", to), (b"", (LOOPBACK, 0)), (b"x" * 70_000, to), (b"last", to)]
    assert carrier.write_all(sent) == [True, False, False, True]
    assert [packet for packet, _ in others[0].read_some(9)] == [b"first", b"last"]


def test_nothing_to_send_is_nothing(carrier: UdpCarrier) -> None:
    assert carrier.write_all([]) == []


@needs_linux
def test_strangers_cannot_fill_its_memory() -> None:
    carrier = BatchedUdpCarrier(LOOPBACK, 0)
    for k in range(10_000):
        carrier._name((f"127.0.{k // 250}.{k % 250}", 9))
    assert len(carrier._names) <= 4096
    carrier.close()
