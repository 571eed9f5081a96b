"""What `tagmetry.calibrate` offers, and what is loaded for it."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import tagmetry.calibrate as package


def modules_after(statement: str) -> set[str]:
    """Return the top-level modules that a fresh interpreter has after a statement."""
    source = f"import sys; {statement}; print(*{{name.split('.')[0] for name in sys.modules}})"
    run = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_the_lists_are_the_same() -> None:
    assert package.__all__ == sorted(package._HOMES)
    assert dir(package) == package.__all__
    tree = ast.parse(Path(package.__file__).read_text("utf-8"))
    typed = {
        node.names[0].name: node.module.removeprefix("tagmetry.calibrate.")
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module.startswith("tagmetry.calibrate.")
    }
    assert typed == package._HOMES


@pytest.mark.parametrize("name", package.__all__)
def test_every_name_is_there_and_hides_no_module(name: str) -> None:
    assert getattr(package, name) is not None
    assert not (Path(package.__file__).parent / f"{name}.py").exists()
    assert not (Path(package.__file__).parent / name).exists()


def test_calibrate_is_the_function() -> None:
    from tagmetry.calibrate import calibrate
    from tagmetry.calibrate.views_to_camera import calibrate as same

    assert calibrate is same


def test_a_name_that_is_not_there_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match=r"'tagmetry.calibrate' has no attribute 'Calibrator'"):
        package.Calibrator  # noqa: B018 (the look-up is what is tested)


def test_importing_it_loads_nothing_heavy() -> None:
    assert modules_after("import tagmetry.calibrate") & {"numpy", "scipy", "cv2"} == set()
    assert "cv2" not in modules_after("from tagmetry.calibrate import calibrate, Calibration")
