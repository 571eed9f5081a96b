"""The report's file; it appears whole or not at all."""

from pathlib import Path

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.files import write_atomically
from tagmetry.lab.report.chapter import chapters
from tagmetry.lab.report.page import page


def write_report(home: Path, path: Path) -> None:
    """Write one page of all results in a folder.

    Raises:
        InputError: There are no results, one is broken, or the page cannot be written there.
        MissingExtraError: Matplotlib is not installed.
    """
    require_figures()
    told = tuple(chapters(home))
    if all(one.origin is None for one in told):
        raise InputError(f"{home} has no results; `tagmetry lab run` makes them")
    write_atomically(path, page(told))


def require_figures() -> None:
    """Raise MissingExtraError unless figures can be drawn."""
    try:
        import matplotlib as mpl  # noqa: F401
    except ImportError as error:
        raise MissingExtraError("the laboratory's report", "report") from error
