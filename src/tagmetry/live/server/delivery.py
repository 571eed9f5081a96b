"""How messages reach the pages, told to them once in a while."""

import asyncio
import time

from tagmetry.live.messages import Delivery
from tagmetry.live.server.hub import Hub

_EVERY_S, _SENDS_PER_S = 0.5, 250  # to all pages together


async def tell_delivery(hub: Hub) -> None:
    """Tell all pages how it went since they were told last, until this is cancelled."""
    then_s, before = time.monotonic(), hub.counts
    while True:
        await asyncio.sleep(max(_EVERY_S, hub.pages / _SENDS_PER_S))
        now_s, counts = time.monotonic(), hub.counts
        passed_s = now_s - then_s
        hub.give(
            Delivery(
                hub.pages,
                (counts.told - before.told) / passed_s,
                (counts.missed - before.missed) / passed_s,
                hub.delays.quantile_s(0.5),
                hub.delays.quantile_s(0.99),
            )
        )
        then_s, before = now_s, counts
