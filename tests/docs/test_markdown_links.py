"""Links between the repository's own texts hold where they are read without the site, too."""

import re
from pathlib import Path

import pytest
from checkout import ROOT
from command_blocks import pages

LINK = re.compile(r"(?<!`)\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^(```+).*?^\1$", re.M | re.S)
PAGES = [str(path.relative_to(ROOT)) for path in pages(ROOT)]


def anchors(path: Path) -> set[str]:
    """Anchors of a Markdown file's headings, as repository views make them."""
    found: dict[str, int] = {}
    for heading in re.findall(r"^#+ (.*)$", FENCE.sub("", path.read_text(encoding="utf-8")), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)|[`*$]", r"\1", heading).strip().lower()
        anchor = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        found[anchor] = found.get(anchor, -1) + 1
    return {name + (f"-{k}" if k else "") for name, count in found.items() for k in range(count + 1)}


@pytest.mark.parametrize("page", PAGES)
def test_links(page: str) -> None:
    source = ROOT / page
    text = re.sub(r"`[^`\n]*`", "``", FENCE.sub("", source.read_text(encoding="utf-8")))
    wrong = []
    for link in LINK.findall(text):
        if re.match(r"[a-z]+:", link):
            continue
        name, _, anchor = link.partition("#")
        target = source.parent / name if name else source
        if not target.exists() or (anchor and target.suffix == ".md" and anchor not in anchors(target)):
            wrong.append(link)
    assert not wrong
