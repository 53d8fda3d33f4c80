"""The site's settings. Pages are the texts of the repository where they stand: its root is Sphinx' source folder."""

import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "doc" / "extensions"), str(ROOT / "python" / "src")]
if packages := os.environ.get("CLUSTERDEM_PACKAGES"):
    sys.path.append(packages)  # numpy and what else the Python package imports; after the site's own tools

project = "Cluster DEM"
author = "the Cluster DEM authors"
release = re.search(r"__version__ = \"(.*?)\"", (ROOT / "python/src/clusterdem/__init__.py").read_text())[1]
copyright = "the Cluster DEM authors, GPL-2.0-or-later"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",
    "lammps_pages",
    "tested_commands",
    "remaining_pages",
]
root_doc = "doc/index"
include_patterns = [
    "*.md",
    "doc/**.md",
    "bench/*.md",
    "python/*.md",
    "python/src/clusterdem/gas/README.md",
    "src/**.md",
    "src/CLUSTER/doc/*.rst",
    "tests/*.md",
    "tests/extremes/*.md",
    "tests/verification/**.md",
]
exclude_patterns = ["build*", "results", "trade", "**/.*", "**/__pycache__"]

myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "deflist"]
myst_heading_anchors = 3
nitpick_ignore_regex = [("py:.*", r".*")]  # names of numpy, polars, …: their documents are on the network

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
python_maximum_signature_line_length = 90

html_theme = "furo"
html_title = "Cluster DEM"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_extra_path = ["root"]
html_show_sourcelink = False
html_copy_source = False
html_show_sphinx = False
pygments_style = "tango"
