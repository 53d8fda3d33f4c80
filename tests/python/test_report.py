"""The report, opened in a real headless browser."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from clusterdem import Run, write_report
from clusterdem.analysis.needs import needs_of, statements
from synthetic import random_frame, write_dump, write_run

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
FLAGS = (
    "--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
    "--disable-component-update --disable-sync --hide-scrollbars --enable-logging=stderr --v=0"
).split()

PROBE = """<script>
addEventListener("load", () => {
  const images = [...document.images];
  const found = {
    images: images.length,
    seen: images.filter(i => i.complete && i.naturalWidth > 300 && i.getBoundingClientRect().width > 100).length,
    described: images.filter(i => i.alt.length > 10).length,
    outside: performance.getEntriesByType("resource").filter(r => !r.name.startsWith("data:")).length,
    overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth,
    tables: document.querySelectorAll("table").length,
  };
  document.title = "FOUND" + JSON.stringify(found);
});
</script></body>"""


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    from clusterdem.cli import main

    folder = tmp_path_factory.mktemp("run")
    write_run(folder, 6, 300)
    needs = [
        f"{100 * i} {6 * i} {0.5 * i} {3.5 * i} {10 * i} {0.04 * i} 0 {25 * i} 0 {0.3 * i} {2 * i} {0.001 * i} {4 * i}"
        for i in range(6)
    ]
    rows = "".join(
        f"{i} {i / 100} {300 + i} 7 {10 * i} {i} {30 * i} 0 1e-9 0 1e-4 2e-4 3e-4 {needs[i]}\n" for i in range(6)
    )
    (folder / "case1.N.txt").write_text(
        "# case1, reading A, seed 4711 <b>&\n# step time clusters particles breakups merges born deferred E_merge E_birth d_min d_mean d_max tests share_st "
        "share_cc share_mf breakups_by_st breakups_by_cc whole_by_st whole_by_mf merges_by_st merges_by_mf F_drag F_contact weight\n"
        + rows
    )
    (folder / "case1.log").write_text(
        "LAMMPS (4 Feb 2025)\nvariable seed index 4711\nLoop time of 2.5 on 2 procs for 5 steps with 9 atoms\n"
        "Pair    | 0.5        | 1.0        | 1.5        |   0.0 | 40.00\nModify  | 0.5        | 1.5        | 1.5        |   0.0 | 60.00\n"
    )
    (folder / "command.txt").write_text("lmp -in case1.in -var seed 4711\n")
    assert main(["report", str(folder)]) == 0
    return folder / "report.html"


def test_one_file_with_everything_inside(page):
    text = page.read_text()
    assert not re.findall(r'(?:src|href)="(?!data:)', text) and "url(" not in text and "@import" not in text
    for words in (
        "Beside the published numbers",
        "62524",
        "Conservation ledger",
        "LAMMPS (4 Feb 2025)",
        "lmp -in case1.in",
        "seed 4711 &lt;b&gt;&amp;",
        "Engine time",
        "Events",
        "What this scene needs",
        "N_cc decided 0.4 % of the breakups, and is 5 % of the power behind them: a minor part, try -var ncc 0.",
        "N_smf kept 25 % of the clusters whole at a check and decided 30 % of the merges: needed.",
        "in units of its weight: drag 0.5, the forces of contacts 0.00025.",
        "paper&#x27;s scale",
        "differs in",
        "Primary particles",
    ):
        assert words in text, words
    assert text.count("<img") >= 11


def test_what_was_fed_and_left_is_part_of_the_ledger(tmp_path):
    """Two frames, the second with other clusters: the table says how many particles came and went."""
    for step, count in ((0, 100), (50, 130)):
        write_dump(tmp_path / f"own.{step}.dump", random_frame(count, step, 1e-3 * step))
    first, second = (int(random_frame(count, step)["n"].sum()) for step, count in ((0, 100), (50, 130)))
    table = f"# own\n# step time clusters particles fed left\n0 0 100 {first} 0 0\n50 0.05 130 {second} "
    for left, said in ((7, "(conserved exactly)"), (8, "(NOT conserved: off by up to 1)")):
        (tmp_path / "own.N.txt").write_text(f"{table}{second - first + 7} {left}\n")
        path, error = write_report(Run(tmp_path))
        page = path.read_text()
        text = f"{first:,} at first, {second - first + 7:,} fed, {left} left, {second:,} at last {said}."
        assert error is None and page.count(text) == 2  # of the dumps, and of the engine's own count
        assert "Mass: goes with the particles" in page and "paper" not in page


def test_needs_of_older_tables_and_quiet_runs():
    names = (
        "breakups merges born tests share_st share_cc share_mf breakups_by_st breakups_by_cc whole_by_st whole_by_mf "
    )
    names += "merges_by_st merges_by_mf F_drag F_contact weight"
    quiet = {name: [0.0] for name in names.split()}
    assert needs_of({"time": [0.0], "breakups": [3.0], "merges": [1.0], "born": [6.0]}) is None  # no such columns
    assert needs_of(quiet) is None  # no check yet
    said = " ".join(statements(needs_of(quiet | {"weight": [2.0], "tests": [5.0]})))
    assert "No cluster broke." in said and "Nothing merged" in said and "Contact forces were zero" in said
    sheared = {
        "weight": [1.0],
        "tests": [900.0],
        "breakups": [10.0],
        "born": [30.0],
        "share_cc": [6.0],
        "share_st": [4.0],
    }
    said = " ".join(
        statements(needs_of(quiet | sheared | {"breakups_by_cc": [5.0], "merges": [4.0], "F_contact": [3.0]}))
    )
    assert "N_cc decided 50 % of the breakups, and is 60 % of the power behind them: needed." in said
    assert "Merges took back 20 % of the clusters that breakups made (4 merges): needed." in said
    said = " ".join(statements(needs_of(quiet | sheared | {"share_cc": [0.0], "merges": [0.1]})))
    assert (
        "N_cc decided none of the breakups, and is none of the power behind them: this run could do without (-var ncc 0)."
        in said
    )


@pytest.mark.skipif(CHROMIUM is None, reason="needs chromium")
@pytest.mark.parametrize("width", [390, 1100])
def test_in_a_browser(page, width, tmp_path):
    """Every figure is seen, nothing is fetched, no console error; on a phone only tables and figures scroll sideways."""
    probed = tmp_path / "probed.html"
    probed.write_text(page.read_text().replace("</body>", PROBE))
    command = [
        CHROMIUM,
        *FLAGS,
        f"--user-data-dir={tmp_path}/profile",
        f"--window-size={max(width, 500)},900",
        "--virtual-time-budget=5000",
    ]
    if width < 500:  # headless windows are at least 500 wide: a frame stands for the phone
        outer = tmp_path / "outer.html"
        outer.write_text(
            f'<!DOCTYPE html><iframe id="f" src="probed.html" width="{width}" height="800"></iframe><script>'
            'addEventListener("message", e => document.title = e.data);</script>'
        )
        probed.write_text(probed.read_text().replace("document.title = ", "parent.document.title = "))
        command.append("--allow-file-access-from-files")
        probed = outer
    done = subprocess.run([*command, "--dump-dom", probed.as_uri()], capture_output=True, text=True, timeout=120)
    match = re.search(r"FOUND(\{.*?\})", done.stdout)
    assert match, done.stdout[:300] + done.stderr[-2000:]
    found = json.loads(match[1])
    assert found["images"] >= 11 and found["seen"] == found["described"] == found["images"]
    assert found["outside"] == 0 and found["overflow"] <= 0 and found["tables"] >= 5
    assert "CONSOLE" not in done.stderr, [line for line in done.stderr.split("\n") if "CONSOLE" in line]


@pytest.mark.skipif(CHROMIUM is None, reason="needs chromium")
def test_a_console_error_would_be_seen(tmp_path):
    bad = tmp_path / "bad.html"
    bad.write_text("<!DOCTYPE html><script>nothing.here()</script>")
    command = [CHROMIUM, *FLAGS, f"--user-data-dir={tmp_path}/profile", "--dump-dom", bad.as_uri()]
    assert "CONSOLE" in subprocess.run(command, capture_output=True, text=True, timeout=120).stderr


@pytest.mark.skipif(CHROMIUM is None, reason="needs chromium")
def test_prints(page, tmp_path):
    pdf = tmp_path / "report.pdf"
    command = [
        CHROMIUM,
        *FLAGS,
        f"--user-data-dir={tmp_path}/profile",
        f"--print-to-pdf={pdf}",
        "--no-pdf-header-footer",
    ]
    subprocess.run([*command, page.as_uri()], capture_output=True, timeout=120, check=True)
    data = Path(pdf).read_bytes()
    assert data.startswith(b"%PDF") and 2 <= len(re.findall(rb"/Type\s*/Page\b", data)) <= 20
