"""The keys of other computers: one to look on, one to command.

Without a key to look on, packets are sealed with one that everybody knows: that guards against
accidents, not against people.
"""

from hashlib import blake2s

from tagmetry.link.wire import KEY_BYTES

OPEN_KEY = bytes(KEY_BYTES)
ARENA_ID = 0xFFFF  # whose packets are about no robot in particular


def command_key_of(robot_id: int, command_key: bytes) -> bytes:
    """Return the key of the link between one robot's stand-in and the computer that commands it.

    It is another for every robot, and never the robot's own, so that no packet of one link is worth
    anything in the other.
    """
    return blake2s(
        b"tagmetry computer" + robot_id.to_bytes(2, "little"),
        key=command_key,
        digest_size=KEY_BYTES,
    ).digest()
