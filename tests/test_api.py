"""What `import tagmetry` offers, and that it is quick to import."""

import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import tagmetry

REFERENCE = Path(__file__).resolve().parents[1] / "docs" / "reference.md"
HEAVY = {"cv2", "scipy", "numpy", "av", "pyarrow", "reportlab", "pydantic", "typer"}


def modules_after(statement: str) -> set[str]:
    """Return the top-level modules that a fresh interpreter has after a statement."""
    source = f"import sys; {statement}; print(*{{name.split('.')[0] for name in sys.modules}})"
    run = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_the_list_is_the_lazy_table_and_the_version() -> None:
    assert set(tagmetry.__all__) == {*tagmetry._HOMES, "__version__"}
    assert len(tagmetry.__all__) == len(set(tagmetry.__all__))
    assert dir(tagmetry) == sorted(tagmetry.__all__)


@pytest.mark.parametrize("name", tagmetry.__all__)
def test_every_name_is_there(name: str) -> None:
    assert getattr(tagmetry, name) is not None


@pytest.mark.parametrize(
    "name", [name for name, home in tagmetry._HOMES.items() if home != "errors"]
)
def test_every_name_is_exported_by_its_home(name: str) -> None:
    assert name in import_module(f"tagmetry.{tagmetry._HOMES[name]}").__all__


def test_the_list_is_what_the_reference_documents() -> None:
    documented = re.findall(
        r"^::: tagmetry\.(?:\w+\.)*(\w+)$", REFERENCE.read_text("utf-8"), re.MULTILINE
    )
    assert sorted([*documented, "__version__"]) == sorted(tagmetry.__all__)


def test_the_type_checker_s_list_is_the_same() -> None:
    source = Path(tagmetry.__file__).read_text("utf-8")
    typed = re.findall(r"^    from tagmetry\.([\w.]+) import (\w+) as \2$", source, re.MULTILINE)
    assert {name: home for home, name in typed} == tagmetry._HOMES


def test_a_name_that_is_not_there_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="module 'tagmetry' has no attribute 'Markers'"):
        tagmetry.Markers  # noqa: B018 (the look-up is what is tested)


def test_importing_tagmetry_imports_nothing_heavy() -> None:
    assert modules_after("import tagmetry") & HEAVY == set()


@pytest.mark.parametrize("folder", ["geometry", "markers", "camera"])
def test_the_core_is_imported_without_opencv(folder: str) -> None:
    assert "cv2" not in modules_after(f"import tagmetry.{folder}")


def test_the_version_is_a_version() -> None:
    assert re.fullmatch(r"\d+\.\d+\.\d+", tagmetry.__version__)
