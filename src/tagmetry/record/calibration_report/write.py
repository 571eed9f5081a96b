"""The report's files; each appears whole or not at all."""

from pathlib import Path

from tagmetry.errors import InputError
from tagmetry.files import write_atomically
from tagmetry.record.calibration_report.facts import CalibrationFacts
from tagmetry.record.calibration_report.figures import every_figure
from tagmetry.record.calibration_report.page import page
from tagmetry.record.calibration_report.tables import every_table
from tagmetry.record.report.plot import png


def write_report(facts: CalibrationFacts, path: str | Path) -> None:
    """Write the page with everything in it.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: It cannot be written there.
    """
    write_atomically(Path(path), page(facts))


def write_figures(facts: CalibrationFacts, folder: str | Path) -> tuple[Path, ...]:
    """Write the figures as PNG into a folder, which is made where there is none.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: They cannot be written there.
    """
    drawn = {f"{figure.name}.png": png(figure.draw()) for figure in every_figure(facts)}
    return _write_all(drawn, folder)


def write_tables(facts: CalibrationFacts, folder: str | Path) -> tuple[Path, ...]:
    """Write the tables as CSV into a folder, which is made where there is none.

    Raises:
        InputError: They cannot be written there.
    """
    return _write_all({f"{one.name}.csv": one.csv_text() for one in every_table(facts)}, folder)


def _write_all(
    contents: "dict[str, bytes] | dict[str, str]", folder: str | Path
) -> tuple[Path, ...]:
    home = Path(folder)
    try:
        home.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot make the folder {home}: {error.strerror}") from error
    for name, content in contents.items():
        write_atomically(home / name, content)
    return tuple(home / name for name in contents)
