"""A robot's key: 32 random bytes, written as 64 hexadecimal digits."""

import re
import secrets
from hashlib import blake2s

from tagmetry.errors import InputError
from tagmetry.link.wire import KEY_BYTES

_DIGITS = re.compile(rf"[0-9a-fA-F]{{{2 * KEY_BYTES}}}")


def new_key() -> str:
    """Return a new random key as text."""
    return secrets.token_hex(KEY_BYTES)


def parse_key(text: str) -> bytes:
    """Return the 32 bytes of a key.

    Raises:
        InputError: It is no key; the text does not repeat it.
    """
    if not _DIGITS.fullmatch(text):
        raise InputError(
            f"expected a robot's key, {2 * KEY_BYTES} hexadecimal digits, got {len(text)} "
            "characters that are not; make one with tagmetry.link.new_key()"
        )
    return bytes.fromhex(text)


def session_key(key: bytes, robot_nonce: int, host_nonce: int) -> bytes:
    """Return the key of one session; nobody without the robot's key can derive it.

    Reference: RFC 7693, BLAKE2s with a key, over both nonces as 64-bit little-endian numbers.
    """
    nonces = robot_nonce.to_bytes(8, "little") + host_nonce.to_bytes(8, "little")
    return blake2s(nonces, key=key, digest_size=KEY_BYTES).digest()
