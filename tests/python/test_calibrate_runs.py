"""Real LAMMPS runs of a calibration: from file to report, killed and resumed, failures."""

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

# a fifteenth of case 1 up to 0.002 s, 400 steps: a tenth of a second each; K decides the number of clusters
STUDY = f"""
seeds = 2
[variables]
reading = "free"
setting = "fast"
tend = 0.002
law = "trancong {{c}} 1.1"
[[case]]
name = "case1"
input = "{ROOT}/inputs/case1.in"
solids = 2.0944e-3
[[case.target]]
quantity = "clusters"
time = 0.002
value = 5400
[[case.target]]
quantity = "mean_diameter"
time = 0.002
value = 900e-6
[[parameter]]
name = "K_3"
low = 0.005
high = 0.1
log = true
[[parameter]]
name = "c"
low = 0.4
high = 1
[[parameter]]
name = "begin"
choices = ["gas", "rest"]
[start]
A = {{ K_3 = 0.0399, c = 0.8, begin = "gas" }}
[search]
trials = 3
variables = {{ height = 0.0666666667 }}
limit = 20
[local]
[confirm]
variables = {{ height = 0.1333333333 }}
starts = ["A"]
"""


class Place:
    """A folder with a study and an engine that notes each of its runs."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.calls, self.out = folder, folder / "calls", folder / "out"
        self.lmp = folder / "lmp"
        note = f'case "$*" in *-var*) echo run >> "{self.calls}";; esac'
        self.lmp.write_text(f'#!/bin/sh\n{note}\nexec "{ENGINE}" "$@"\n')
        self.lmp.chmod(0o755)
        self.study(STUDY)

    def study(self, text: str) -> None:
        (self.folder / "tiny.toml").write_text(text)

    @property
    def arguments(self) -> list:
        return ["calibrate", self.folder / "tiny.toml", "--out", self.out, "--lmp", self.lmp, "--jobs", "1"]

    def launched(self) -> int:
        """Runs since the last question."""
        count = len(self.calls.read_text().splitlines()) if self.calls.exists() else 0
        self.calls.unlink(missing_ok=True)
        return count

    def done(self) -> dict[Path, int]:
        return {file: file.stat().st_mtime_ns for file in self.out.glob("runs/*/cost.json")}


@pytest.fixture
def place(tmp_path):
    return Place(tmp_path)


def test_from_file_to_report_and_killed_in_between(place, command):
    process = subprocess.Popen(
        [sys.executable, "-m", "clusterdem", *map(str, place.arguments)], stderr=subprocess.PIPE, start_new_session=True
    )
    while len(place.done()) < 3:
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    process.stderr.close()
    before = place.done()
    place.launched()
    code, out, err = command(*place.arguments)
    assert code == 0, err
    after, again = place.done(), place.launched()
    assert before.items() <= after.items()  # what was finished has not been touched
    assert again == len(after) - len(before)
    assert [Path(line).name for line in out.splitlines()] == ["tiny.csv", "tiny.md", "tiny.png"]

    with open(place.out / "tiny.csv") as file:
        rows = list(csv.DictReader(file))
    assert [row["name"] for row in rows[:3]] == ["A", "trial 1", "trial 2"]
    assert float(rows[0]["K_3"]) == 0.0399 and float(rows[0]["case1 N(0.002)"]) >= 5000
    report = (place.out / "tiny.md").read_text()
    for words in ("## The fit", "| begin | rest |", "## What the data tell", "start A, confirmed", "lmp -in case1.in"):
        assert words in report
    assert "-var height 0.1333333333" in report and f"{len(after)} runs" in report
    assert (place.out / "tiny.png").stat().st_size > 10_000
    # nothing large is kept
    assert not list(place.out.glob("runs/*/*.dump"))

    # once more: nothing is run, and all is as before
    text = report
    assert command(*place.arguments)[0] == 0
    assert place.launched() == 0 and (place.out / "tiny.md").read_text() == text


def test_a_run_beyond_its_limit_counts_as_worst_and_is_not_tried_again(place, command):
    """A tenth of the domain at 10 ns steps would take minutes; the limit is one core-second."""
    slow = STUDY.replace("limit = 20", "limit = 1").replace("tend = 0.002", "tend = 0.002\ndt = 1e-8\nevery = 1")
    place.study(slow.split("[local]")[0].replace("trials = 3", "trials = 1"))
    code, _, err = command(*place.arguments)
    assert code == 0, err
    assert place.launched() == 2 and "none" in (place.out / "tiny.md").read_text()
    assert command(*place.arguments)[0] == 0 and place.launched() == 0


def test_a_run_that_fails_is_a_bad_trial_and_the_study_goes_on(place, command):
    place.study(STUDY.replace('choices = ["gas", "rest"]', "choices = [1, 2]").replace('begin = "gas"', "begin = 1"))
    place.study(
        (place.folder / "tiny.toml")
        .read_text()
        .replace('name = "begin"', 'name = "spacing"')
        .replace("begin = 1", "spacing = 1")
        .replace("choices = [1, 2]", 'choices = [1, "wide"]')
        .replace("trials = 3", "trials = 12")
    )
    code, _, err = command(*place.arguments)
    assert code == 0 and "12 of 12 trials, best loss" in err
    report = (place.out / "tiny.md").read_text()
    assert "## Runs that failed" in report and "spacing = wide" in report and "ERROR" in report
    with open(place.out / "tiny.csv") as file:
        rows = list(csv.DictReader(file))
    bad = [row for row in rows if row["spacing"] == "wide"]
    assert bad and all(row["case1 N(0.002)"] == "nan" for row in bad)
    assert min(float(row["loss"]) for row in bad) > max(float(r["loss"]) for r in rows if r not in bad)


def test_a_study_whose_every_start_fails_ends_with_the_words_of_the_engine(place, command):
    place.study(STUDY.replace("tend = 0.002", "tend = 0.002\nn_max = 3000"))
    code, _, err = command(*place.arguments)
    assert code == 2 and "no start gives a number" in err and "ghost cutoff" in err


def test_each_case_may_have_its_own_limit(place, command):
    """As below, but the limit of one core-second stands in the case, over the stage's of 20."""
    slow = STUDY.replace("solids = 2.0944e-3", "solids = 2.0944e-3\nlimit = 1")
    slow = slow.replace("tend = 0.002", "tend = 0.002\ndt = 1e-8\nevery = 1")
    place.study(slow.split("[local]")[0].replace("trials = 3", "trials = 1"))
    assert command(*place.arguments)[0] == 0
    assert place.launched() == 2 and "none" in (place.out / "tiny.md").read_text()


def test_variables_that_the_script_does_not_know_are_refused(place, command):
    place.study(STUDY.replace('name = "begin"', 'name = "beginn"').replace("begin = ", "beginn = "))
    code, _, err = command(*place.arguments)
    assert code == 2 and "knows no variable 'beginn'" in err and place.launched() == 0


def test_a_time_without_a_frame_is_refused(place, command):
    place.study(STUDY.replace("time = 0.002\nvalue = 900e-6", "time = 0.003\nvalue = 900e-6"))
    code, _, err = command(*place.arguments)
    assert code == 2 and "no frame at 0.003 s" in err


@pytest.mark.parametrize("option", ["--jobs", "--trials"])
def test_counts_below_one_are_refused(place, command, option):
    code, _, err = command(*place.arguments, option, "0")
    assert code == 2 and f"{option}: must be 1 or more" in err
