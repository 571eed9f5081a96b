"""The host's answer to a greeting, checked alike by robots and by computers that look on."""

from tagmetry.link.bodies import unpack_body
from tagmetry.link.layout import Kind
from tagmetry.link.messages import Assign
from tagmetry.link.packet import Refusal, body_of, is_sealed_with
from tagmetry.link.wire import LATE_US


def opened_assign(packet: bytes, key: bytes, nonce: int, now_us: int) -> Assign | Refusal:
    """Return what an ASSIGN says, or why it is refused.

    Args:
        packet: Header, body and tag.
        key: That it must be sealed with.
        nonce: Of the greeting that it must answer.
        now_us: When, in the clock of who greeted; an answer that took long is refused.
    """
    if not is_sealed_with(key, packet):
        return Refusal.TAG
    assign = unpack_body(Kind.ASSIGN, body_of(packet))
    if not isinstance(assign, Assign) or assign.robot_nonce != nonce:
        return Refusal.REPLAYED
    if not 0 <= now_us - assign.robot_us <= LATE_US:
        return Refusal.LATE
    return assign
