"""Conclusions as lines of text."""

from collections.abc import Sequence

from tagmetry.lab.conclusions import Check


def check_lines(checks: Sequence[Check]) -> list[str]:
    """Return a line for every check."""
    return [
        f"{verdict(one):<5} {one.told}: {one.measured}; required: {one.required}" for one in checks
    ]


def verdict(check: Check) -> str:
    """Return whether a check holds, in a word."""
    return {True: "holds", False: "FAILS", None: "-"}[check.holds]
