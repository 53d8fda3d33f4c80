"""Pieces of a self-contained HTML page: text is escaped, figures are inside."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape

from matplotlib.figure import Figure

from ..plot.style import RC

STYLE = """
:root { color-scheme: light; --ink: #1d2329; --soft: #5b6672; --line: #d6dce2; --tint: #f4f6f8; --accent: #0072b2; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.2rem 1rem 3rem; max-width: 62rem; color: var(--ink); background: #fff;
       font: 16px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0.5rem 0 0.2rem; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 0.6rem; padding-top: 0.6rem; border-top: 2px solid var(--accent); }
p.lead { color: var(--soft); margin: 0 0 1rem; }
p.note, figcaption, td.note { color: var(--soft); font-size: 0.875rem; }
dl.facts { display: grid; grid-template-columns: repeat(auto-fit, minmax(9.5rem, 1fr)); gap: 0.6rem; margin: 1rem 0; }
dl.facts div { background: var(--tint); border-radius: 6px; padding: 0.5rem 0.75rem; }
dt { color: var(--soft); font-size: 0.8rem; }
dd { margin: 0; font-weight: 600; font-variant-numeric: tabular-nums; }
figure { margin: 1rem 0; }
figure img { display: block; width: 100%; height: auto; }
figure.small img { max-width: 34rem; }
figure.medium img { max-width: 46rem; margin: 0 auto; }
div.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.875rem; font-variant-numeric: tabular-nums; width: 100%; }
th, td { padding: 0.28rem 0.45rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child { text-align: left; }
thead th { white-space: normal; vertical-align: bottom; border-bottom: 2px solid var(--ink); background: var(--tint); }
pre { background: var(--tint); padding: 0.75rem; font-size: 0.75rem; line-height: 1.35; overflow: auto; max-height: 24rem; }
@media (max-width: 40rem) { body { padding: 0.75rem 0.75rem 2rem; } h1 { font-size: 1.35rem; }
  div.wide > img { min-width: 36rem; } }
@media print { body { max-width: none; padding: 0; font-size: 10.5pt; } pre { max-height: none; white-space: pre-wrap; }
  figure, tr, dl.facts div { break-inside: avoid; } h2 { break-after: avoid; } div.wide { overflow: visible; }
  table { font-size: 8pt; } th, td { white-space: normal; padding: 0.15rem 0.3rem; } }
"""


def paragraph(text: str, kind: str = "") -> str:
    """A paragraph, with a class of the style sheet."""
    return f'<p class="{kind}">{escape(text)}</p>\n' if kind else f"<p>{escape(text)}</p>\n"


def bullets(items: Iterable[str]) -> str:
    """A list."""
    return "<ul>\n" + "".join(f"<li>{escape(item)}</li>\n" for item in items) + "</ul>\n"


def facts(pairs: Iterable[tuple[str, str]]) -> str:
    """Key figures, name and value."""
    return (
        '<dl class="facts">\n'
        + "".join(f"<div><dt>{escape(name)}</dt><dd>{escape(value)}</dd></div>\n" for name, value in pairs)
        + "</dl>\n"
    )


def table(rows: Sequence[Sequence[str]]) -> str:
    """A table, the heading first; scrolls sideways on its own where the screen is narrow."""
    head, *body = rows
    lines = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>\n" for row in body)
    heading = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    return f'<div class="wide"><table>\n<thead><tr>{heading}</tr></thead>\n<tbody>\n{lines}</tbody></table></div>\n'


def preformatted(text: str) -> str:
    """Text in its own layout."""
    return f"<pre>{escape(text)}</pre>\n"


def picture(figure: Figure, caption: str, kind: str = "") -> str:
    """A figure inside the page, as PNG; ``small`` or ``medium`` where it need not be as wide as the page."""
    data = io.BytesIO()
    figure.savefig(data, dpi=RC["savefig.dpi"], format="png", metadata={"Software": "clusterdem"})
    source = base64.b64encode(data.getvalue()).decode()
    image = f'<img alt="{escape(caption)}" src="data:image/png;base64,{source}">'
    scrolls = image if kind else f'<div class="wide">{image}</div>'
    return f'<figure class="{kind}">{scrolls}<figcaption>{escape(caption)}</figcaption></figure>\n'


def page(title: str, body: str) -> str:
    """The whole page; it asks for nothing from anywhere."""
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n<link rel="icon" href="data:,">\n'
        f"<title>{escape(title)}</title>\n<style>{STYLE}</style></head>\n<body>\n{body}</body></html>\n"
    )
