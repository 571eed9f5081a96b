"""The live page's data and commands for programs and notebooks."""

from tagmetry.live.client.client import LiveClient

__all__ = ["LiveClient"]
