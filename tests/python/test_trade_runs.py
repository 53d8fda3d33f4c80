"""Real LAMMPS runs of a study: each done once, resumed, failures reported, the answer runs."""

from __future__ import annotations

import csv
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
BUILT = ROOT / "build/bin/lmp"
ENGINE = os.environ.get("CLUSTERDEM_LMP") or (str(BUILT) if BUILT.exists() else shutil.which("lmp"))
pytestmark = pytest.mark.skipif(ENGINE is None, reason="no engine: build/bin/lmp is missing")

# a quarter of case 1, 200 steps: a third of a second each
STUDY = f"""
input = "{ROOT}/inputs/case1.in"
seeds = 3
[variables]
height = 0.25
tend = 2e-4
[switches]
"""


class Place:
    """A folder with a study and an engine that notes each of its runs."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.calls, self.out = folder, folder / "calls", folder / "out"
        self.lmp = folder / "lmp"
        note = f'case "$*" in *-var*) echo run >> "{self.calls}";; esac'
        self.lmp.write_text(f'#!/bin/sh\n{note}\nexec "{ENGINE}" "$@"\n')
        self.lmp.chmod(0o755)

    def study(self, switches: str) -> None:
        (self.folder / "tiny.toml").write_text(STUDY + switches)

    @property
    def arguments(self) -> list:
        return ["trade", self.folder / "tiny.toml", "--out", self.out, "--lmp", self.lmp, "--jobs", "1"]

    def launched(self) -> int:
        """Runs since the last question."""
        count = len(self.calls.read_text().splitlines()) if self.calls.exists() else 0
        self.calls.unlink(missing_ok=True)
        return count

    def done(self) -> dict[Path, int]:
        return {file: file.stat().st_mtime_ns for file in self.out.glob("runs/*/cost.json")}

    def table(self) -> list[dict[str, str]]:
        with open(self.out / "tiny.csv") as file:
            return list(csv.DictReader(file))


@pytest.fixture
def place(tmp_path):
    return Place(tmp_path)


def test_a_study_from_runs_to_answer(place, command):
    place.study("dt = [1e-6, 2e-6]\nevery = [1, 50]\n")
    code, out, err = command(*place.arguments, "--tolerance", "0.05")
    assert (code, err) == (0, "")
    rows = place.table()
    assert [row["setting"] for row in rows] == [
        "dt = 1e-6, every = 1",
        "dt = 2e-6",
        "every = 50",
        "dt = 2e-6, every = 50",
    ]
    assert place.launched() == 12 and len(place.done()) == 12
    assert all(float(row["core_seconds"]) > 0 and row["failed"] == "0" for row in rows)
    # all begin with the same clusters; checks at 50 steps instead of one come late, but not by much
    assert float(rows[0]["clusters_error"]) == 0 and 0 < float(rows[2]["clusters_error"]) < 0.05
    assert all(0.05 < float(row["map_spread"]) < 2 for row in rows)  # the seeds' clusters lie elsewhere
    for ending, begin in ((".md", "# tiny: case1.in"), (".png", None), (".in", "# tiny.toml: case1.in")):
        data = (place.out / f"tiny{ending}").read_bytes()
        assert data.startswith(b"\x89PNG" if begin is None else begin.encode())
    assert out.splitlines()[-1].startswith("Cheapest within 5 %: ")

    # the same study again, at another tolerance: no run at all
    before = place.done()
    assert command(*place.arguments, "--tolerance", "0.5")[0] == 0
    assert place.launched() == 0 and place.done() == before

    # another value and a fourth seed: what is there already is not done again
    (place.folder / "tiny.toml").write_text(STUDY.replace("seeds = 3", "seeds = 4") + "dt = [1e-6, 2e-6]\n")
    _, out, _ = command(*place.arguments, "--dry-run")
    assert out.startswith("# 8 of 8 runs are missing") and place.launched() == 0  # every is not given now
    settings = [line.split(", ", 1)[1] for line in out.splitlines() if line.startswith("# seed")]
    assert settings == ["reference: dt = 1e-6"] * 4 + ["dt: dt = 2e-6"] * 4
    place.study("dt = [1e-6, 2e-6, 4e-6]\nevery = [1, 50]\n")
    assert command(*place.arguments)[0] == 0 and place.launched() == 3

    # the answer is an input that runs, at its own tend, with the study's setting
    answer = [str(place.lmp), "-in", str(place.out / "tiny.in"), "-log", "log", "-var", "outdir", "."]
    done = subprocess.run(answer, cwd=place.folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-2000:]
    assert "variable height   index 0.25" in (place.folder / "log").read_text()
    assert (place.folder / "case1.00000000.dump").exists() and "Loop time" in done.stdout


def test_an_interrupted_study_goes_on(place, command):
    place.study("every = [1, 50]\n")
    process = subprocess.Popen(
        [sys.executable, "-m", "clusterdem", *map(str, place.arguments)], stderr=subprocess.PIPE, text=True
    )
    while len(place.done()) < 2 and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=60) == 130 and "interrupted" in process.stderr.read()
    finished = place.done()
    assert 2 <= len(finished) < 6
    place.launched()
    assert command(*place.arguments)[0] == 0
    assert place.launched() == 6 - len(finished)
    assert {path: place.done()[path] for path in finished} == finished
    assert not list(place.out.glob("runs/*.part"))


def test_a_run_that_fails_is_reported_and_the_others_go_on(place, command):
    place.study("n_max = [2000, 3000]\nevery = [1, 50]\n")
    code, _, err = command(*place.arguments, "--tolerance", "0.05")
    assert code == 2 and "3 of 9 runs failed; the others are in the table" in err
    assert "-var n_max 3000" in err and "ghost cutoff" in err and place.launched() == 9
    rows = place.table()
    assert [(row["finished"], row["failed"]) for row in rows] == [("3", "0"), ("0", "3"), ("3", "0")]
    report = (place.out / "tiny.md").read_text()
    assert (
        "## Runs that failed" in report and "n_max = 3000 (3 of 3 runs failed)" in report and "ghost cutoff" in report
    )
    assert "3000" not in (place.out / "tiny.in").read_text()


def test_runs_of_an_engine_that_changes_meanwhile_do_not_count(place, command):
    """Every run leaves the executable another than it was."""
    place.lmp.write_text(
        place.lmp.read_text().replace("\nexec", f'\ncase "$*" in *-var*) echo >> {place.lmp};; esac\nexec')
    )
    place.study("every = [1, 50]\n")
    code, _, err = command(*place.arguments)
    assert code == 2 and "was built anew during the study" in err and not place.done()


def test_what_is_accurate_alone_need_not_be_together(place, command):
    """50 steps instead of 200 are enough, checks at every 100th step too; but of 50 steps none is a 100th."""
    place.study("dt = [1e-6, 4e-6]\nevery = [1, 100]\n")
    code, out, _ = command(*place.arguments, "--tolerance", "0.05")
    assert code == 0
    errors = {row["setting"]: float(row["clusters_error"]) for row in place.table()}
    assert max(errors["dt = 4e-6"], errors["every = 100"]) < 0.05 < errors["dt = 4e-6, every = 100"]
    assert "dt = 4e-6, every = 100" not in out.splitlines()[-1]


def test_a_reference_that_fails(place, command):
    place.study("n_max = [3000, 2000]\n")
    code, _, err = command(*place.arguments)
    assert code == 2 and "the reference has 0 finished runs, it needs 3" in err and "ghost cutoff" in err


def test_a_second_process_in_the_same_folder_is_refused(place, command):
    import fcntl

    place.study("every = [1, 50]\n")
    (place.out / "runs").mkdir(parents=True)
    with open(place.out / "runs/.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        code, _, err = command(*place.arguments)
    assert code == 2 and "another clusterdem is running studies in this folder" in err and place.launched() == 0


@pytest.mark.skipif(shutil.which("mpirun") is None, reason="no mpirun")
def test_on_two_ranks(place, command, monkeypatch):
    for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"):
        monkeypatch.setenv(name, "1")
    place.study("every = [1, 50]\n")
    text = (place.folder / "tiny.toml").read_text()
    (place.folder / "tiny.toml").write_text("ranks = 2\n" + text)
    assert command(*place.arguments)[0] == 0
    assert place.launched() == 12  # six runs on two ranks each
    assert "on 2 procs" in next(place.out.glob("runs/*/log.lammps")).read_text()
