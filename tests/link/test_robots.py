"""Both clients, Python and C, do the same: link, obey what is fresh, and stop by themselves."""

import pytest
from air import ID, KEY, ROBOTS, Air

from tagmetry.link import Command, EmergencyStop, Neighbour, Neighbours, Odometry, Pose, Refusal
from tagmetry.link.bodies import pack_body
from tagmetry.link.layout import Kind
from tagmetry.link.messages import Assign, Beat, TimeReply
from tagmetry.link.packet import Header, seal


@pytest.fixture(params=ROBOTS)
def air(request: pytest.FixtureRequest) -> Air:
    return Air(ROBOTS[request.param]())


def is_still(command: Command) -> bool:
    return (command.forward_mps, command.left_mps, command.turn_radps, command.lamp) == (0, 0, 0, 0)


def test_links_and_moves_as_it_is_told(air: Air) -> None:
    assert is_still(air.robot.command(air.robot_us))
    air.link()
    assert air.robot.is_linked()
    assert air.to_robot(air.send(Command(0.5, 0.25, -1.0, 200, 7)))
    assert air.robot.command(air.robot_us) == Command(0.5, 0.25, -1.0, 200, 7)


def test_takes_neighbours_and_poses(air: Air) -> None:
    air.link()
    seen = Neighbours(5, 0.5, (Neighbour(7, 0.25, 1.0, -2.0, 0.01, 1.0),), 3)
    assert air.to_robot(air.send(Pose(5, 1.0, 2.0, 0.5)))
    assert air.to_robot(air.send(seen))
    found = air.robot.neighbours
    assert (found.captured_us, found.range_limit_m, found.omitted) == (5, 0.5, 3)
    assert found.seen[0].bearing_rad == pytest.approx(1.0)


def test_the_host_hears_what_it_says(air: Air) -> None:
    air.link()
    assert air.is_heard(air.say(Odometry(5, 1.0, 2.0, 3.0)))
    link = air.peer.link(air.host_us)
    assert link.is_linked
    assert link.loss_from_robot == 0


@pytest.mark.parametrize("lifetime_ms", [0, 1, 100, 250, 400, 65535])
def test_a_command_ends_when_it_says_and_never_later_than_250_ms(
    air: Air, lifetime_ms: int
) -> None:
    air.link()
    sent_us = air.host_us
    packet = air.send(Command(1.0, valid_for_ms=lifetime_ms))
    air.wait(300)
    assert air.to_robot(packet)
    last_us = min(lifetime_ms, 250) * 1000
    moved_us = [us for us in range(300, 300_000, 500) if moves_at(air, sent_us + us)]
    assert all(us < last_us for us in moved_us)
    assert lifetime_ms < 2 or max(moved_us) >= last_us - 2000  # the bound of the clock: 2 ms


def moves_at(air: Air, host_us: int) -> bool:
    air.host_us = host_us
    return not is_still(air.robot.command(air.robot_us))


def test_stands_still_250_ms_after_the_last_word_was_sent(air: Air) -> None:
    air.link()
    sent_us = air.host_us
    assert air.to_robot(air.send(Beat()))
    for us in range(0, 300_000, 1000):
        air.host_us = sent_us + us
        assert not (air.robot.may_move(air.robot_us) and us > 250_000)
    air.host_us = sent_us + 240_000
    assert air.robot.may_move(air.robot_us)


@pytest.mark.parametrize("message", [TimeReply(0), EmergencyStop(0, 2)])
def test_what_the_link_says_by_itself_is_no_sign_of_a_living_program(
    air: Air, message: TimeReply | EmergencyStop
) -> None:
    air.link()
    assert air.to_robot(air.send(message))
    assert not air.robot.may_move(air.robot_us)
    assert air.to_robot(air.send(Beat()))
    assert air.robot.may_move(air.robot_us)


def test_a_beat_that_was_held_back_does_not_prolong(air: Air) -> None:
    air.link()
    beat = air.send(Beat())
    sent_us = air.host_us
    air.wait(240_000)
    assert air.to_robot(beat)
    air.host_us = sent_us + 251_000
    assert not air.robot.may_move(air.robot_us)


def test_a_command_that_is_late_is_refused(air: Air) -> None:
    air.link()
    packet = air.send(Command(1.0))
    air.wait(251_000)
    assert not air.to_robot(packet)


def test_a_burst_that_was_held_back_runs_nothing(air: Air) -> None:
    air.link()
    held = [air.send(Command(1.0 + n)) for n in range(20)]
    air.wait(260_000)
    assert [air.to_robot(packet) for packet in held] == [False] * 20
    assert is_still(air.robot.command(air.robot_us))


def test_an_older_command_does_not_replace_a_newer_one(air: Air) -> None:
    air.link()
    old = air.send(Command(1.0))
    air.wait(1000)
    new = air.send(Command(2.0))
    assert air.to_robot(new)
    assert air.to_robot(old)
    assert air.robot.command(air.robot_us).forward_mps == 2.0


def test_a_packet_counts_once(air: Air) -> None:
    air.link()
    packets = [air.send(Command(float(n))) for n in range(70)]
    order = [5, 3, 60, 4, 3, 60, 0, 69, 5]
    assert [air.to_robot(packets[n]) for n in order] == [1, 1, 1, 1, 0, 0, 1, 1, 0]
    said = air.say(Odometry(1, 0, 0, 0))
    assert air.is_heard(said)
    assert not air.is_heard(said)
    assert air.peer.link(air.host_us).refused == {Refusal.REPLAYED: 1}


@pytest.mark.parametrize("drift", [-1e-4, 1e-4])
def test_the_host_s_time_is_never_taken_for_earlier_than_it_is(air: Air, drift: float) -> None:
    air.drift = drift
    air.link(delay_us=20_000)
    errors_us = []
    for step in range(4000):
        air.wait(10_000)
        errors_us.append(air.robot.host_us(air.robot_us) - air.host_us)
        packet = air.robot.due(air.robot_us)
        if packet is not None:
            air.wait(3000 if step % 7 else 200)
            for reply in air.to_host(packet):
                air.wait(2000 if step % 5 else 100)
                air.to_robot(reply)
        elif step % 5 == 0:
            air.to_robot(air.send(Beat()))
    assert min(errors_us) >= 0
    assert max(errors_us[1000:]) < 6000


def test_a_question_that_was_held_back_makes_the_clock_no_worse(air: Air) -> None:
    air.link()
    air.wait(600_000)
    question = air.robot.due(air.robot_us)
    air.wait(200_000)
    replies = air.to_host(question)
    before_us = air.robot.host_us(air.robot_us)
    assert air.to_robot(replies[0])
    assert abs(air.robot.host_us(air.robot_us) - before_us) <= 1


def test_a_new_robot_with_a_running_host_begins_anew(air: Air) -> None:
    air.link()
    old = air.send(Command(1.0))
    fresh = Air(ROBOTS["python"](), hearing=air.hearing, host_us=air.host_us)
    fresh.robot._nonce = 4711
    fresh.link()
    assert not fresh.to_robot(old)
    assert fresh.to_robot(fresh.send(Command(2.0)))


def test_a_silent_host_is_asked_anew_with_another_nonce(air: Air) -> None:
    first = air.robot.due(air.robot_us)
    air.link_from(first)
    air.wait(1_100_000)
    second = air.robot.due(air.robot_us)
    assert not air.robot.is_linked()
    assert second[3] == Kind.HELLO
    assert first[24:32] != second[24:32]
    air.link_from(second)
    assert air.robot.is_linked()


def test_a_hello_that_is_sent_again_changes_nothing(air: Air) -> None:
    hello = air.robot.due(air.robot_us)
    air.link_from(hello)
    assert not air.is_heard(hello)
    air.wait(1_100_000)
    air.link_from(air.robot.due(air.robot_us))
    assert not air.is_heard(hello)


def test_a_hello_from_the_days_of_an_earlier_host_gets_no_more_than_an_offer(air: Air) -> None:
    hello = air.robot.due(air.robot_us)
    air.wait(200_000)
    air.link()
    later = Air(air.robot, host_us=air.host_us + 1_100_000).link()
    assert later.to_host(hello)
    assert later.to_robot(later.send(Command(1.0)))  # and the session goes on
    assert later.is_heard(later.say(Odometry(1, 0, 0, 0)))


def test_an_assign_that_is_sent_again_opens_nothing(air: Air) -> None:
    (assign,) = air.to_host(air.robot.due(air.robot_us))
    assert air.to_robot(assign)
    assert not air.to_robot(assign)
    air.wait(1_100_000)
    air.robot.due(air.robot_us)
    assert not air.to_robot(assign)


def test_an_assign_that_took_too_long_is_refused(air: Air) -> None:
    (assign,) = air.to_host(air.robot.due(air.robot_us))
    air.wait(251_000)
    assert not air.to_robot(assign)


def test_a_robot_that_is_held_may_not_steer_by_itself_either(air: Air) -> None:
    air.link()
    assert air.to_robot(air.send(Beat()))
    assert air.robot.may_move(air.robot_us)
    assert air.to_robot(air.send(Command(0.0, valid_for_ms=0)))
    for _ in range(24):
        air.wait(10_000)
        assert air.to_robot(air.send(Beat()))
        assert not air.robot.may_move(air.robot_us)
    assert air.to_robot(air.send(Command(1.0)))  # a newer command lets it go at once,
    assert air.robot.may_move(air.robot_us)
    assert air.to_robot(air.send(Command(0.0, valid_for_ms=0)))
    air.wait(251_000)  # and so does silence about it
    assert air.to_robot(air.send(Beat()))
    assert air.robot.may_move(air.robot_us)


def test_the_emergency_stop_latches_until_it_is_released(air: Air) -> None:
    air.link()
    assert air.to_robot(air.send(EmergencyStop(4, 1)))
    assert air.to_robot(air.send(Command(1.0)))
    assert air.robot.is_stopped
    assert is_still(air.robot.command(air.robot_us))
    assert air.to_robot(air.send(EmergencyStop(3, 2)))  # an older release
    assert air.robot.is_stopped
    assert air.to_robot(air.send(EmergencyStop(5, 2)))
    assert not air.robot.is_stopped
    assert air.to_robot(air.send(EmergencyStop(4, 1)))  # an older stop
    assert not air.robot.is_stopped


def test_the_emergency_stop_outlives_the_host(air: Air) -> None:
    air.link()
    air.to_robot(air.send(EmergencyStop(1, 1)))
    air.wait(1_100_000)
    again = Air(air.robot, host_us=air.host_us).link()
    assert again.robot.is_stopped
    again.to_robot(again.send(Command(1.0)))
    assert not again.robot.may_move(again.robot_us)
    assert again.peer.link(again.host_us).is_stopped
    again.to_robot(again.send(EmergencyStop(1, 2)))
    assert again.robot.may_move(again.robot_us)


def test_a_host_with_another_key_is_not_obeyed(air: Air) -> None:
    air.robot.due(air.robot_us)
    for key in (bytes(32), bytes(range(1, 33))):
        _, body = pack_body(Assign(1001, 77, air.robot_us))
        forged = seal(key, Header(Kind.ASSIGN, ID, air.host_us, 0, 0), body)
        assert not air.to_robot(forged)


def test_the_robot_s_own_key_seals_no_command(air: Air) -> None:
    air.link()
    _, body = pack_body(Command(1.0))
    session = int.from_bytes(air.send(Beat())[20:24], "little")
    forged = seal(KEY, Header(Kind.COMMAND, ID, air.host_us, 99, session), body)
    assert not air.to_robot(forged)


def test_what_it_says_itself_is_not_taken_for_the_host_s(air: Air) -> None:
    air.link()
    assert not air.to_robot(air.say(Odometry(1, 0, 0, 0)))
    assert not air.is_heard(air.send(Command(1.0)))


def test_a_time_reply_of_the_future_is_not_used(air: Air) -> None:
    air.link()
    before_us = air.robot.host_us(air.robot_us)
    air.to_robot(air.send(TimeReply(air.robot_us + 10_000_000)))
    assert air.robot.host_us(air.robot_us) == before_us


def test_tells_the_host_how_well_it_hears(air: Air) -> None:
    air.link()
    for n in range(100):
        packet = air.send(Beat())
        if n % 4:
            assert air.to_robot(packet)
    air.wait(500_000)
    air.to_host(air.robot.due(air.robot_us))
    link = air.peer.link(air.host_us)
    assert link.loss_to_robot == pytest.approx(25 / 101, abs=0.011)
    assert link.round_trip_s == pytest.approx(0.001, abs=1e-4)
