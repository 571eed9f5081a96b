"""A driver of a webcam as `fcntl.ioctl` shows it, written from the kernel's documentation.

The layouts stand here again, field by field, so that the tests do not share them with the code.
"""

import errno
from dataclasses import dataclass, field

BOOLEAN, INTEGER, MENU = 2, 1, 3


@dataclass
class FakeControl:
    """One control: name, type, minimum, maximum, step, default, value, flags, menu items."""

    name: str
    kind: int
    minimum: int
    maximum: int
    step: int
    default: int
    value: int
    flags: int = 0
    items: tuple[int, ...] = ()


def little(number: int, size: int = 4) -> bytes:
    return number.to_bytes(size, "little", signed=number < 0)


def whole(buffer: bytearray, at: int) -> int:
    return int.from_bytes(buffer[at : at + 4], "little")


def signed(buffer: bytearray, at: int) -> int:
    return int.from_bytes(buffer[at : at + 4], "little", signed=True)


@dataclass
class FakeDevice:
    """Answers requests as uvcvideo does: what an auto mode rules is not taken while it is on."""

    controls: dict[int, FakeControl]
    busy: set[int] = field(default_factory=set)
    asked: list[int] = field(default_factory=list)

    def ioctl(self, _file: int, request: int, buffer: bytearray) -> int:
        self.asked.append(request)
        number = request & 0xFF
        assert request >> 16 & 0x3FFF == len(buffer), "the size is a part of the request"
        if number == 0:
            buffer[16:48] = b"Fake webcam".ljust(32, b"\0")
            return 0
        control = self.controls.get(whole(buffer, 0))
        if control is None:
            raise OSError(errno.EINVAL, "Invalid argument")
        {36: self._query, 37: self._menu, 27: self._get, 28: self._set}[number](control, buffer)
        return 0

    def _query(self, control: FakeControl, buffer: bytearray) -> None:
        buffer[4:8] = little(control.kind)
        buffer[8:40] = control.name.encode().ljust(32, b"\0")
        numbers = (control.minimum, control.maximum, control.step, control.default, control.flags)
        for place, value in enumerate(numbers):
            buffer[40 + 4 * place : 44 + 4 * place] = little(value)

    def _menu(self, control: FakeControl, buffer: bytearray) -> None:
        if whole(buffer, 4) not in control.items:
            raise OSError(errno.EINVAL, "Invalid argument")

    def _get(self, control: FakeControl, buffer: bytearray) -> None:
        buffer[4:8] = little(control.value)

    def _set(self, control: FakeControl, buffer: bytearray) -> None:
        if whole(buffer, 0) in self.busy:
            raise OSError(errno.EBUSY, "Device or resource busy")
        if whole(buffer, 0) == 0x009A090A and self.controls[0x009A090C].value:
            raise OSError(errno.EACCES, "Permission denied")
        control.value = signed(buffer, 4)


def webcam() -> FakeDevice:
    """The controls of a webcam as the seed's."""
    return FakeDevice(
        {
            0x00980913: FakeControl("Gain", INTEGER, 0, 255, 1, 0, 12),
            0x009A0901: FakeControl("Auto Exposure", MENU, 0, 3, 1, 3, 3, items=(1, 3)),
            0x009A0902: FakeControl("Exposure Time, Absolute", INTEGER, 3, 2047, 1, 250, 333),
            0x009A090A: FakeControl("Focus, Absolute", INTEGER, 0, 250, 5, 0, 30),
            0x009A090C: FakeControl("Focus, Automatic Continuous", BOOLEAN, 0, 1, 1, 1, 1),
            0x009A090D: FakeControl("Zoom, Absolute", INTEGER, 100, 500, 1, 100, 100),
        }
    )
