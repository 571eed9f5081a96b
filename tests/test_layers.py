"""A module imports only from folders above its own; the pure ones touch nothing outside.

The order is that of the design: what stands further down may use what stands above it.
"""

import ast
import re
import sys
import tomllib
from collections.abc import Iterator
from importlib.metadata import metadata, packages_distributions
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src" / "tagmetry"
LAYERS = (
    "errors", "closing", "geometry", "markers", "camera", "detect", "calibrate", "pose", "localize",
    "lens", "arena", "files", "sources", "twin", "record", "link", "pipeline", "lab", "live", "cli",
    "__main__",
)  # fmt: skip
PURE = LAYERS[: LAYERS.index("arena") + 1]
IMPURE_MODULES = {
    "asyncio", "datetime", "glob", "http", "io", "logging", "multiprocessing", "os", "pathlib",
    "pickle", "requests", "shutil", "socket", "subprocess", "sys", "tempfile", "threading", "time",
    "urllib", "warnings",
}  # fmt: skip
COMPANIONS = {  # required by, and documented with, what is declared
    "pydantic_core": {"pydantic"},
    "starlette": {"fastapi"},
}
IMPURE_CALLS = {"print", "open", "input", "exec", "eval", "breakpoint"}
IMPURE_METHODS = {"imread", "imwrite", "imshow", "VideoCapture", "VideoWriter", "FileStorage"}


def imported_names(tree: ast.AST) -> Iterator[str]:
    """Give every import as a dotted name: `from a.b import c` is a.b.c."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            home = "." * node.level + (node.module or "")
            yield from (f"{home}.{alias.name}" for alias in node.names)


def layer_faults(layer: str, tree: ast.AST) -> list[str]:
    """Return what a module of a layer imports from its own package and may not."""
    return [
        name
        for name in imported_names(tree)
        if name.split(".")[0] in ("tagmetry", "") and not _may_import(layer, name)
    ]


def _may_import(layer: str, name: str) -> bool:
    parts = name.split(".")
    if name == "tagmetry.__version__":
        return True
    if parts[0] != "tagmetry" or len(parts) < 2 or parts[1] not in LAYERS:
        return False  # relative, or the package's lazy front door
    return LAYERS.index(parts[1]) <= LAYERS.index(layer)


def purity_faults(tree: ast.AST) -> list[str]:
    """Return what reaches outside: modules, and calls that read, write or speak."""
    imports = [name for name in imported_names(tree) if name.split(".")[0] in IMPURE_MODULES]
    return imports + [call for call in _called(tree) if call in IMPURE_CALLS | IMPURE_METHODS]


def _called(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            yield node.func.id
        elif isinstance(node, ast.Attribute) and node.attr in IMPURE_METHODS:
            yield node.attr


def modules() -> list[tuple[str, str, ast.AST]]:
    """Return every module but the package's own `__init__`: its path, its layer and its tree."""
    paths = sorted(path for path in PACKAGE.rglob("*.py") if path != PACKAGE / "__init__.py")
    names = [path.relative_to(PACKAGE) for path in paths]
    return [
        (name.as_posix(), name.with_suffix("").parts[0], ast.parse(path.read_text("utf-8")))
        for name, path in zip(names, paths, strict=True)
    ]


def declared_distributions() -> list[str]:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = [line for lines in project["optional-dependencies"].values() for line in lines]
    names = [re.match(r"[\w.-]+", line)[0].lower() for line in project["dependencies"] + extras]
    return sorted(set(names) - {"tagmetry"})


def test_every_folder_is_in_the_order() -> None:
    assert {layer for _, layer, _ in modules()} <= set(LAYERS)


def test_every_module_imports_only_from_above() -> None:
    faults = {name: layer_faults(layer, tree) for name, layer, tree in modules()}
    assert {name: found for name, found in faults.items() if found} == {}


def test_the_pure_layers_touch_nothing_outside() -> None:
    faults = {name: purity_faults(tree) for name, layer, tree in modules() if layer in PURE}
    assert {name: found for name, found in faults.items() if found} == {}


def test_only_declared_packages_are_imported() -> None:
    homes, declared = packages_distributions(), declared_distributions()
    for name, _, tree in modules():
        for package in {imported.split(".")[0] for imported in imported_names(tree)}:
            if package == "tagmetry" or package in sys.stdlib_module_names:
                continue
            provided_by = {home.lower() for home in homes.get(package, [])}
            provided_by |= COMPANIONS.get(package, set())
            assert provided_by & set(declared), f"{name} imports {package}, declared nowhere"


@pytest.mark.parametrize("distribution", declared_distributions())
def test_no_dependency_is_under_the_gpl(distribution: str) -> None:
    try:
        about = metadata(distribution)
    except ModuleNotFoundError:
        pytest.skip(f"{distribution} is an extra that is not installed")
    classifiers = about.get_all("Classifier") or []
    licences = [line for line in classifiers if line.startswith("License ::")]
    licences += (about.get("License-Expression") or about.get("License") or "").splitlines()[:1]
    assert licences
    assert not any(re.search(r"(?<!L)GPL(?!.*WITH GCC-exception)", line) for line in licences)


@pytest.mark.parametrize(
    ("layer", "source", "fault"),
    [
        ("geometry", "from tagmetry.camera import Camera", "tagmetry.camera.Camera"),
        ("detect", "def f():\n    import tagmetry.pose.marker", "tagmetry.pose.marker"),
        ("markers", "from tagmetry import camera", "tagmetry.camera"),
        ("pose", "from tagmetry import Detector", "tagmetry.Detector"),
        ("cli", "import tagmetry", "tagmetry"),
        ("pose", "from . import marker", "..marker"),
        ("pose", "from ..detect import Detection", "..detect.Detection"),
        ("errors", "from tagmetry.geometry import Array", "tagmetry.geometry.Array"),
    ],
)
def test_the_check_sees_an_import_from_below(layer: str, source: str, fault: str) -> None:
    assert layer_faults(layer, ast.parse(source)) == [fault]


@pytest.mark.parametrize(
    ("layer", "source"),
    [
        ("camera", "from tagmetry.geometry import Array"),
        ("camera", "from tagmetry.camera.lens import Lens"),
        ("geometry", "from tagmetry.errors import InputError\nimport numpy as np"),
        ("cli", "from tagmetry import __version__\nfrom tagmetry.lab import figures"),
    ],
)
def test_the_check_lets_imports_from_above_pass(layer: str, source: str) -> None:
    assert layer_faults(layer, ast.parse(source)) == []


@pytest.mark.parametrize(
    ("source", "fault"),
    [
        ("import os.path", "os.path"),
        ("from pathlib import Path", "pathlib.Path"),
        ("def f():\n    from time import monotonic", "time.monotonic"),
        ("def f(x):\n    print(x)", "print"),
        ("pixels = cv2.imread(name)", "imread"),
    ],
)
def test_the_check_sees_what_reaches_outside(source: str, fault: str) -> None:
    assert purity_faults(ast.parse(source)) == [fault]


def test_the_check_lets_pure_code_pass() -> None:
    source = "import cv2\nimport numpy as np\nmarked = cv2.resize(np.zeros((2, 2)), (4, 4))"
    assert purity_faults(ast.parse(source)) == []
