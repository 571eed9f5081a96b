"""`tagmetry info`: what is installed, and which marker families there are."""

from importlib.metadata import PackageNotFoundError, version

from tagmetry import __version__
from tagmetry.cli.answer import answer
from tagmetry.cli.options import Json

_PARTS = {
    "print": "reportlab",
    "video": "av",
    "parquet": "pyarrow",
    "report": "matplotlib",
    "arena": "mcap",
    "robots": "mujoco-core",
    "live": "fastapi",
    "cluster": "distributed",
    "zenoh": "eclipse-zenoh",
    "bench": "pyapriltags",
}  # the package that tells whether a part is there
_PACKAGES = ("numpy", "scipy", "opencv-python-headless", "pydantic")


def info(*, json: Json = False) -> None:
    """Say what is installed, and which marker families there are."""
    table = _table()
    answer(json=json, table=lambda: table, lines=lambda: _lines(table))


def _table() -> dict[str, dict[str, object]]:
    import platform

    from tagmetry.markers import family, family_names

    families = {name: family(name) for name in family_names()}
    return {
        "versions": {
            "tagmetry": __version__,
            "python": platform.python_version(),
            **{package: _installed(package) for package in _PACKAGES},
        },
        "parts": {part: _installed(package) for part, package in _PARTS.items()},
        "families": {
            name: {
                "ids": len(one),
                "bits": one.layout.bit_count,
                "corrects": one.correction_bits,
                "forgives": one.forgiven_bits,
            }
            for name, one in families.items()
        },
    }


def _lines(table: dict[str, dict[str, object]]) -> list[str]:
    versions = [f"{name} {found or 'not installed'}" for name, found in table["versions"].items()]
    lines = [", ".join(versions), "", "optional parts:"]
    for part, found in table["parts"].items():
        state = f"{_PARTS[part]} {found}" if found else f"pip install 'tagmetry[{part}]'"
        lines.append(f"  {part:<8} {state}")
    lines += ["", f"{'family':<16} {'ids':>5} {'bits':>5} {'corrects':>9} {'forgives':>9}"]
    for name, one in table["families"].items():
        numbers = one if isinstance(one, dict) else {}
        row = [numbers["ids"], numbers["bits"], numbers["corrects"], numbers["forgives"]]
        lines.append(f"{name:<16} {row[0]:>5} {row[1]:>5} {row[2]:>9} {row[3]:>9}")
    return [*lines, "", "forgives: wrong bits let through by default, fewer than can be corrected"]


def _installed(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None
