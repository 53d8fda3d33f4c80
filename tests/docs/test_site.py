"""The site that `./run docs` builds: nothing in it asks the network for anything, and its links lead somewhere."""

import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from checkout import ROOT

# what a browser loads by itself, as against links that a reader may click
LOADED = {
    "script": "src",
    "img": "src",
    "iframe": "src",
    "source": "src",
    "video": "src",
    "link": "href",
    "object": "data",
}
CSS_URL = re.compile(r"""url\(\s*['"]?(?!data:|#)([^'")]+)|@import\s+['"]([^'"]+)""")


class Page(HTMLParser):
    """What a page loads, links to, and can be linked to."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.links: list[str] = []
        self.anchors: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        if "id" in values:
            self.anchors.add(values["id"])
        if LOADED.get(tag) in values:
            self.loads.append(values[LOADED[tag]])
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        self.loads += [found[0] or found[1] for found in CSS_URL.findall(values.get("style", ""))]


def external(address: str) -> bool:
    return bool(urlsplit(address).scheme or urlsplit(address).netloc) and not address.startswith("data:")


def test_site_loads_nothing_from_elsewhere(site: Path) -> None:
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > 30
    wrong = [f"{p.relative_to(site)}: {u}" for p in pages for u in Page(p).loads if external(u)]
    for style in site.rglob("*.css"):
        wrong += [f"{style.name}: {a or b}" for a, b in CSS_URL.findall(style.read_text("utf-8")) if external(a or b)]
    assert not wrong


def test_what_pages_load_is_there(site: Path) -> None:
    missing = []
    for page in site.rglob("*.html"):
        for address in Page(page).loads:
            path = unquote(urlsplit(address).path)
            if path and not external(address) and not (page.parent / path).exists():
                missing.append(f"{page.relative_to(site)}: {address}")
    assert not missing
    assert (site / "_static/mathjax/tex-chtml.js").exists()


def test_links_within_the_site_lead_to_an_anchor(site: Path) -> None:
    pages = {path.resolve(): Page(path) for path in site.rglob("*.html")}
    broken = []
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.exists() or (parts.fragment and target in pages):
                known = pages[target].anchors | {""} if target in pages else set()
                if unquote(parts.fragment) not in known:
                    broken.append(f"{path.relative_to(site.resolve())}: {link}")
    assert not broken


def test_external_links_are_well_formed(site: Path) -> None:
    """That they lead somewhere cannot be seen without a network."""
    for path in site.rglob("*.html"):
        for link in Page(path).links:
            if external(link):
                parts = urlsplit(link)
                assert parts.scheme in ("https", "http", "mailto") and " " not in link, f"{path}: {link}"


def test_pages_of_the_repository_are_on_the_site(site: Path) -> None:
    for name in ("README", "bench/trade", "doc/theory", "doc/faq", "src/CLUSTER/doc/fix_drag_cluster", "python/README"):
        assert (site / f"{name}.html").exists()
    assert "doc/start.md" in (site / "doc/tested.html").read_text("utf-8")


def test_functions_named_by_the_theory_exist() -> None:
    text = (ROOT / "doc/theory.md").read_text(encoding="utf-8")
    named = re.findall(r"((?:`\w+`(?:,| and)?\s+)+)in\s+\[(\w+\.h)\]", text)
    pairs = [(function, header) for some, header in named for function in re.findall(r"\w+(?=`)", some)]
    assert len(pairs) > 25
    wrong = []
    for function, header in pairs:
        code = (ROOT / "src/CLUSTER/model" / header).read_text(encoding="utf-8")
        if not re.search(rf"(?:^|\s){function}\(|struct {function}\b", code):
            wrong.append(f"{function} in {header}")
    assert not wrong
