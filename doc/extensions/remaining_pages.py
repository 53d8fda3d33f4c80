"""In the index, the line `(all other pages)` of a list stands for every page that no list names."""

import re
from fnmatch import fnmatch
from posixpath import dirname, join, normpath

from sphinx.application import Sphinx

PLACEHOLDER = "(all other pages)"
ENTRY = re.compile(r"^(?:.*<)?([\w./*-]+)>?$", re.M)


def fill(app: Sphinx, docname: str, content: list[str]) -> None:
    """Replaces the placeholder before the index is parsed."""
    if docname != app.config.root_doc:
        return
    lists = "\n".join(re.findall(r"^```\{toctree\}\n(.*?)^```$", content[0], re.M | re.S))
    named = [normpath(join(dirname(docname), entry)) for entry in ENTRY.findall(lists)]
    others = sorted(d for d in app.env.found_docs if d != docname and not any(fnmatch(d, name) for name in named))
    content[0] = content[0].replace(PLACEHOLDER, "\n".join(f"/{other}" for other in others))


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("source-read", fill)
    return {"parallel_read_safe": True}
