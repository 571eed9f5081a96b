"""Sizes and windows in pixels, as they are typed."""


def whole_numbers(text: str, example: str, pattern: str) -> tuple[int, ...]:
    """Return the numbers of a text like the example.

    Args:
        text: As typed.
        example: What the error shows.
        pattern: Regular expression with a group for each number.
    """
    import re

    from tagmetry.errors import InputError

    match = re.fullmatch(pattern, text, re.ASCII)
    if match is None or max(map(len, match.groups())) > 6:
        raise InputError(f"expected pixels like {example}, found {text[:40]!r}")
    return tuple(int(number) for number in match.groups())
