"""Writes README.md of this folder from what `./run verify` recorded: one table of all cases.

usage: results_table.py FOLDER-OF-RECORDS
"""

from __future__ import annotations

import json
import platform
import subprocess
import sys
from datetime import date
from pathlib import Path

import matplotlib
import numpy
import scipy
from lammps_run import LMP

HERE = Path(__file__).resolve().parent
MARK = "<!-- measured: written by ./run verify -->"


def number(x: float) -> str:
    return f"{x:.6g}"


def judgement(row: dict) -> str:
    if row["tolerance"] is None:
        return "told"
    return "pass" if row["passed"] else "**fail**"


def limit(row: dict) -> str:
    return "–" if row["tolerance"] is None else f"{row['tolerance']:.2g}" + (" rel" if row["relative"] else " abs")


def line(row: dict) -> str:
    cells = [row["quantity"], number(row["reference"]), number(row["measured"]), f"{row['error']:.2g}", limit(row)]
    return "| " + " | ".join([*cells, judgement(row)]) + " |"


def summary(name: str, rows: list[dict]) -> str:
    """How near the case came to its tolerances."""
    judged = [row for row in rows if row["tolerance"] is not None]
    nearest = max(judged, key=lambda row: row["error"] / row["tolerance"])
    return (
        f"{sum(row['passed'] for row in judged)} of {len(judged)} quantities within their tolerance; the one nearest "
        f"to it: {nearest['quantity']}, error {nearest['error']:.2g} of {limit(nearest)}. "
        f"All of them: [results](../README.md#{name})."
    )


def write_measured(readme: Path, text: str) -> None:
    """Replace what follows the mark in a case's README, up to the next empty line."""
    before, _, after = readme.read_text().partition(MARK)
    rest = after.lstrip("\n").partition("\n\n")[2]
    readme.write_text(before + MARK + "\n" + text + "\n" + (f"\n{rest}" if rest else ""))


def versions() -> str:
    engine = subprocess.run([LMP, "-h"], capture_output=True, text=True, stdin=subprocess.DEVNULL).stdout
    name = next(text for text in engine.splitlines() if "Large-scale" in text).split(" - ")[1]
    return (
        f"LAMMPS {name}, Python {platform.python_version()}, numpy {numpy.__version__}, scipy {scipy.__version__}, "
        f"matplotlib {matplotlib.__version__}"
    )


def main(folder: Path) -> None:
    cases = sorted(path.parent.name for path in HERE.glob("*/README.md"))
    missing = [name for name in cases if not (folder / f"{name}.jsonl").exists()]
    if missing:
        sys.exit(f"no results of {', '.join(missing)}: its tests did not run; the table is left as it was")
    records = {name: list(map(json.loads, (folder / f"{name}.jsonl").read_text().splitlines())) for name in cases}
    judged = [row for rows in records.values() for row in rows if row["tolerance"] is not None]
    passed = sum(row["passed"] for row in judged)
    text = [
        "# Verification",
        "",
        "Analytic solutions and published data beside what the engine gives, through the stock styles and",
        "through this plugin's. `./run verify` runs every case, redraws its figure, and writes this file;",
        "`./run test` runs the same tests in their short form. Each case's folder says what it is, where its",
        "reference comes from, and why its tolerance is what it is.",
        "",
        f"{date.today():%d %b %Y}, `./run verify`, {versions()}: {passed} of {len(judged)} quantities pass.",
        "",
        "*told*: measured beside a reference of another model or an experiment, not judged. Errors are relative",
        "where the tolerance says *rel*, and absolute where it says *abs*.",
        "",
        "| case | | |",
        "| --- | --- | --- |",
    ]
    for name in cases:
        title = (HERE / name / "README.md").read_text().splitlines()[0].lstrip("# ")
        text.append(f"| [{name}](#{name}) | [{title}]({name}/README.md) | ![{name}]({name}/figure.png) |")
    for name, rows in records.items():
        text += [
            "",
            f"## {name}",
            "",
            "| quantity | reference | measured | error | tolerance | |",
            "| --- | ---: | ---: | ---: | ---: | --- |",
            *map(line, rows),
        ]
        write_measured(HERE / name / "README.md", summary(name, rows))
    (HERE / "README.md").write_text("\n".join(text) + "\n")
    print(f"{passed} of {len(judged)} quantities within their tolerance: tests/verification/README.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
