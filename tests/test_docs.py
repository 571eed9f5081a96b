"""The documentation says what the program does, and its pages need no other host."""

import re
import subprocess
import sys
from html.parser import HTMLParser
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest

import tagmetry

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
PAGES = sorted(DOCS.rglob("*.md"))
SNIPPET = re.compile(r'^--8<-- "(?P<name>[^"]+)"$', re.MULTILINE)


def load_make_pages() -> ModuleType:
    spec = spec_from_file_location("make_pages", DOCS / "make_pages.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_reference_describes_exactly_the_public_names() -> None:
    text = (DOCS / "reference.md").read_text("utf-8")
    described = re.findall(r"^::: tagmetry\.(?:\w+\.)*(\w+)$", text, re.MULTILINE)
    assert sorted(described) == sorted(set(tagmetry.__all__) - {"__version__"})


@pytest.mark.parametrize(
    "name",
    ["README.md", "docs/cli.md", *(f"docs/generated/{n}.md" for n in ("forgiven", "live", "wire"))],
)
def test_written_pages_are_what_the_program_says(name: str) -> None:
    page = load_make_pages().PAGES[name]()
    assert (ROOT / name).read_text(encoding="utf-8") == page, "run `make pages`"


def test_every_example_is_shown_on_a_page() -> None:
    shown = {name for page in PAGES for name in SNIPPET.findall(page.read_text("utf-8"))}
    examples = {path.name for path in (DOCS / "examples").iterdir() if path.is_file()}
    assert examples - shown == set()


def test_readme_pictures_and_links_exist() -> None:
    text = (ROOT / "README.md").read_text("utf-8")
    for target in re.findall(r"\]\(([^)#]+)", text):
        assert target.startswith("http") or (ROOT / target).exists(), target


class Addresses(HTMLParser):
    """Gathers what a browser loads by itself: scripts, styles, fonts, pictures, frames."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.loaded: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        wanted = {"link": "href", "script": "src", "img": "src", "iframe": "src", "source": "src"}
        self.loaded += [value or "" for key, value in attrs if key == wanted.get(tag)]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("mkdocs", reason="the site is built with mkdocs")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "-d", str(folder)]
    built = subprocess.run(
        command, check=False, cwd=ROOT, capture_output=True, text=True, timeout=120
    )
    assert built.returncode == 0, built.stderr
    return folder


def test_pages_load_nothing_from_another_host(site: Path) -> None:
    pages = list(site.rglob("*.html"))
    written = [page for page in PAGES if DOCS / "generated" not in page.parents]  # parts of pages
    assert len(pages) > len(written)  # each, and one for addresses that lead nowhere
    for page in pages:
        for address in Addresses(page.read_text("utf-8")).loaded:
            assert not re.match(r"(https?:)?//", address), f"{page.name} loads {address}"


def test_styles_load_nothing_from_another_host(site: Path) -> None:
    for style in site.rglob("*.css"):
        assert not re.search(r"(url\(|@import)\s*['\"]?(https?:)?//", style.read_text("utf-8"))


def test_reference_page_has_every_name(site: Path) -> None:
    page = (site / "reference.html").read_text("utf-8")
    for name in set(tagmetry.__all__) - {"__version__"}:
        assert re.search(rf'id="tagmetry\.(\w+\.)*{name}"', page), name
