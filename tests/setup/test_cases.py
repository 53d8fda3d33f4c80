"""./run CASE: nothing is touched before its words are checked; no two runs mix in a folder; every kind of dump ends with a report."""

import fcntl
import html
import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LMP = Path(os.environ.get("CLUSTERDEM_LMP", ROOT / "build" / "bin" / "lmp"))
pytestmark = pytest.mark.skipif(not LMP.exists(), reason="type ./run setup first")
SHORT = "-var tend 2e-4 -var frame_time 1e-4 -var height 0.1".split()


def run(*words):
    environment = os.environ | {"CLUSTERDEM_IS_SET_UP": "yes"}
    command = [str(ROOT / "run"), *map(str, words)]
    return subprocess.run(
        command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300, check=False, env=environment
    )


@pytest.fixture
def old(tmp_path):
    """A folder with what an earlier run left."""
    names = ["case1.00000000.dump", "case1.00000500.dump.zst", "case1.00000000.maps", "case1.N.txt", "case1.restart"]
    names += ["report.html", "command.txt", "map.0000000000.npz", "fraction.png"]
    for name in [*names, "case1.in", "notes.txt"]:
        (tmp_path / name).write_text(name)
    return tmp_path, names


@pytest.mark.parametrize(
    "words, said",
    [
        ("-np 2", "say --np N"),
        ("--np two", "--np wants the number of ranks"),
        ("-var sed 7", "the inputs know no variable 'sed'"),
        ("-var seed", "-var wants a name and a value"),
        ("-vra seed 7", "unknown argument '-vra'"),
        ("seed 7", "unknown argument 'seed'"),
        ("-in inputs/case2.in", "unknown argument '-in'"),
        ("--engine fast", "--engine wants lammps or liggghts"),
        ("--engine liggghts -var every 7 -var gusts x", "the inputs know no variable 'gusts'"),
    ],
)
def test_a_wrong_word_touches_nothing(old, words, said):
    folder, _ = old
    before = {path.name: path.stat().st_mtime_ns for path in folder.iterdir()}
    done = run("case1", "-var", "outdir", folder, *words.split())
    assert done.returncode == 2 and said in done.stderr
    assert {path.name: path.stat().st_mtime_ns for path in folder.iterdir()} == before


def test_help_touches_nothing(old):
    folder, _ = old
    before = sorted(path.name for path in folder.iterdir())
    done = run("case1", "-var", "outdir", folder, "--help")
    assert done.returncode == 0 and "usage: ./run case1" in done.stdout
    assert sorted(path.name for path in folder.iterdir()) == before


def test_the_earlier_run_is_kept_aside_whole(old):
    folder, names = old
    words = ["-var", "seed", "7", "-var", "law", "trancong 0.8 1.2"]
    done = run("case1", *SHORT, *words, "-var", "outdir", folder)
    assert done.returncode == 0, done.stdout[-1000:] + done.stderr
    kept = {path.name: path.read_text() for path in (folder / "earlier-1").iterdir()}
    assert kept == {name: name for name in names}
    assert (folder / "case1.in").read_text() == "case1.in" and (folder / "notes.txt").exists()
    assert sorted(path.name for path in folder.glob("case1.*.dump*")) == [f"case1.{s:08d}.dump" for s in (0, 100, 200)]
    # the report: the command with its quotes, the seed that ran (the input's own is 1), whole particles
    command = f"./run case1 {' '.join([*SHORT, *words[:-1]])} 'trancong 0.8 1.2' -var outdir {folder}"
    assert (folder / "command.txt").read_text() == command + "\n"
    page = html.unescape((folder / "report.html").read_text())
    assert f"<td>command</td><td>{command}</td>" in page and "<td>seed</td><td>7</td>" in page
    assert "Primary particles: 200,000 in every frame (conserved exactly)." in page and "NOT conserved" not in page
    assert "primary particles of 100 µm and 2000 kg/m³ (case1.log)" in page
    assert run("case1", *SHORT, "-var", "outdir", folder).returncode == 0
    assert (folder / "earlier-2/case1.00000200.dump").exists() and (folder / "earlier-1/case1.restart").exists()


def test_a_folder_in_which_another_writes(old):
    folder, _ = old
    with open(folder / ".lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        before = sorted(path.name for path in folder.iterdir())
        done = run("case1", *SHORT, "-var", "outdir", folder)
        assert done.returncode == 2 and f"another ./run writes into {folder}" in done.stderr
        assert sorted(path.name for path in folder.iterdir()) == before


@pytest.mark.parametrize("style", ["custom/zstd", "custom/gz", "binary", "none"])
def test_every_kind_of_dump_ends_with_a_report(tmp_path, style):
    done = run("case1", *SHORT, "-var", "dump_style", style, "-var", "maps", "yes", "-var", "outdir", tmp_path)
    if "Unrecognized dump style" in done.stdout:
        pytest.skip("a LAMMPS without the package COMPRESS")
    assert done.returncode == 0, done.stdout[-1000:] + done.stderr
    page = (tmp_path / "report.html").read_text()
    assert "Where the solids are" in page and ("Sizes</h2>" in page) == (style != "none")
    assert "The engine&#x27;s own count. Primary particles: 200,000" in page or style == "none"
    assert (tmp_path / "map.0000000200.npz").exists()


def test_neither_clusters_nor_maps(tmp_path):
    done = run("case1", *SHORT, "-var", "dump_style", "none", "-var", "outdir", tmp_path)
    assert done.returncode == 0 and "Events</h2>" in (tmp_path / "report.html").read_text()


def test_a_scene_that_begins_empty(tmp_path):
    done = run("scene", "feed", "-var", "tend", "0.004", "-var", "frame_time", "0.001", "-var", "outdir", tmp_path)
    assert done.returncode == 0, done.stdout[-1000:] + done.stderr
    page = html.unescape((tmp_path / "report.html").read_text())
    fed = int(re.search(r"Primary particles: 0 at first, ([\d,]+) fed", page)[1].replace(",", ""))
    rows = (tmp_path / "feed.N.txt").read_text().splitlines()
    assert fed == int(rows[-1].split()[rows[1].split().index("fed") - 1]) > 0
    assert "(conserved exactly)" in page and "NOT conserved" not in page
