"""The few calls of Video4Linux that read and set a camera's controls.

Numbers and layouts are those of <linux/videodev2.h> on x86 and ARM, where a request is

    direction (2 bits: 1 write, 2 read) | size of the structure (14) | 'V' (8) | number (8)

Reference: Linux kernel documentation, Userspace API, Video for Linux, function reference.
"""

import struct
from collections.abc import Callable
from dataclasses import dataclass

Ioctl = Callable[[int, int, bytearray], object]
"""`fcntl.ioctl` with a buffer that it writes into; raises OSError."""

_CAPABILITY = struct.Struct("=16s32s32sIII12x")  # v4l2_capability
_QUERY = struct.Struct("=II32siiiiI8x")  # v4l2_queryctrl
_VALUE = struct.Struct("=Ii")  # v4l2_control
_MENU = struct.Struct("=II32s4x")  # v4l2_querymenu, packed

_READ, _BOTH = 2, 3


def _request(direction: int, number: int, layout: struct.Struct) -> int:
    return direction << 30 | layout.size << 16 | ord("V") << 8 | number


VIDIOC_QUERYCAP = _request(_READ, 0, _CAPABILITY)
VIDIOC_G_CTRL = _request(_BOTH, 27, _VALUE)
VIDIOC_S_CTRL = _request(_BOTH, 28, _VALUE)
VIDIOC_QUERYCTRL = _request(_BOTH, 36, _QUERY)
VIDIOC_QUERYMENU = _request(_BOTH, 37, _MENU)

GAIN = 0x00980913
EXPOSURE_AUTO = 0x009A0901
EXPOSURE_ABSOLUTE = 0x009A0902
FOCUS_ABSOLUTE = 0x009A090A
FOCUS_AUTO = 0x009A090C
ZOOM_ABSOLUTE = 0x009A090D

_DISABLED, _READ_ONLY, _WRITE_ONLY = 0x0001, 0x0004, 0x0040


@dataclass(frozen=True)
class Queried:
    """What the driver says of a control, in its own whole numbers.

    Attributes:
        id: Its number.
        minimum: Least value.
        maximum: Greatest value.
        step: Of the values.
        default: After switching on.
        flags: What can be done with it.
    """

    id: int
    minimum: int
    maximum: int
    step: int
    default: int
    flags: int

    @property
    def is_usable(self) -> bool:
        """Whether it can be read and set, now or once an auto mode is off."""
        return not self.flags & (_DISABLED | _READ_ONLY | _WRITE_ONLY)


def card(ioctl: Ioctl, file: int) -> str:
    """Return a device's name.

    Raises:
        OSError: It is no video device.
    """
    buffer = bytearray(_CAPABILITY.size)
    ioctl(file, VIDIOC_QUERYCAP, buffer)
    name: bytes = _CAPABILITY.unpack(buffer)[1]
    return name.split(b"\0")[0].decode("utf-8", "replace")


def query(ioctl: Ioctl, file: int, control: int) -> Queried | None:
    """Return what a control is like; None where the device has none."""
    buffer = bytearray(_QUERY.pack(control, 0, b"", 0, 0, 0, 0, 0))
    try:
        ioctl(file, VIDIOC_QUERYCTRL, buffer)
    except OSError:
        return None
    _, _, _, minimum, maximum, step, default, flags = _QUERY.unpack(buffer)
    return Queried(control, minimum, maximum, step, default, flags)


def has_item(ioctl: Ioctl, file: int, control: int, index: int) -> bool:
    """Say whether a menu has an item."""
    try:
        ioctl(file, VIDIOC_QUERYMENU, bytearray(_MENU.pack(control, index, b"")))
    except OSError:
        return False
    return True


def get(ioctl: Ioctl, file: int, control: int) -> int:
    """Return a control's value.

    Raises:
        OSError: The device does not tell.
    """
    buffer = bytearray(_VALUE.pack(control, 0))
    ioctl(file, VIDIOC_G_CTRL, buffer)
    return int(_VALUE.unpack(buffer)[1])


def put(ioctl: Ioctl, file: int, control: int, value: int) -> None:
    """Set a control.

    Raises:
        OSError: The device does not take it.
    """
    ioctl(file, VIDIOC_S_CTRL, bytearray(_VALUE.pack(control, value)))
