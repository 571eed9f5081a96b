"""Engines that behave badly in known ways; child processes import them by name."""

import os
import sys
import time

import numpy as np

from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.engines import EngineKind, Found

SQUARE_PX = np.array([[10.0, 10.0], [30.0, 10.0], [30.0, 30.0], [10.0, 30.0]])
DARK = 50


class Fake:
    def __init__(self, _family: str, threads: int) -> None:
        self.threads = threads


class Good(Fake):
    """Finds marker 7 in every image, moved by the image's first pixel."""

    def detect(self, grey: GreyPixels) -> Found:
        return Found.of([7], [SQUARE_PX + 0.1 * grey[0, 0]])


class Slow(Good):
    def detect(self, grey: GreyPixels) -> Found:
        sum(range(200_000))
        return super().detect(grey)


class Hungry(Good):
    def detect(self, grey: GreyPixels) -> Found:
        np.ones(50 * 2**20, np.uint8).sum()
        return super().detect(grey)


class ShowsThreads(Fake):
    def detect(self, _grey: GreyPixels) -> Found:
        return Found.of([self.threads, int(os.environ["OMP_NUM_THREADS"])], [SQUARE_PX] * 2)


class DiesOnDark(Good):
    def detect(self, grey: GreyPixels) -> Found:
        if grey.max() < DARK:
            os.abort()
        return super().detect(grey)


class RaisesOnDark(Good):
    def detect(self, grey: GreyPixels) -> Found:
        if grey.max() < DARK:
            raise RuntimeError("too dark to see")
        return super().detect(grey)


class HangsOnDark(Good):
    def detect(self, grey: GreyPixels) -> Found:
        while grey.max() < DARK:
            time.sleep(1)
        return super().detect(grey)


class WarmsUp(Good):
    """Takes a second for its first image."""

    is_warm = False

    def detect(self, grey: GreyPixels) -> Found:
        if not self.is_warm:
            time.sleep(1)
        self.is_warm = True
        return super().detect(grey)


class Chatty(Good):
    def detect(self, grey: GreyPixels) -> Found:
        os.write(1, b"noise on the output\n")
        sys.stderr.write("noise on the error\n")
        return super().detect(grey)


class NeverMade:
    def __init__(self, _family: str, _threads: int) -> None:
        raise ImportError("no such library")


def kind(fake: type, name: str = "fake", author: str = "nobody", **more: bool) -> EngineKind:
    families = frozenset({"tag36h11"})
    return EngineKind(name, f"{__name__}:{fake.__name__}", families, author, **more)
