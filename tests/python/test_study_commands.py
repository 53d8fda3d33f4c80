"""How studies start their runs: what a dry run prints is what an engine gets; launchers; templates that run."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from clusterdem.errors import ArgumentError
from clusterdem.studies.launch import check_launcher, launch
from fake_engine import fake_engine

ROOT = Path(__file__).parents[2]
BUILT = ROOT / "build/bin/lmp"
ENGINE = os.environ.get("CLUSTERDEM_LMP") or (str(BUILT) if BUILT.exists() else shutil.which("lmp"))

SCRIPT = "variable gain index 1\nvariable note index x\nvariable seed index 1\n"
TRADE = """
input = "in.flow"
seeds = 3
observables = ["count", "mass"]
[variables]
note = "it's $HOME & more"
[switches]
gain = [1, 1.5]
"""
CALIBRATE = """
seeds = [4, 7]
[[case]]
name = "flow"
input = "in.flow"
[[case.target]]
quantity = "mean_diameter"
time = 0.02
value = 5e-4
[[parameter]]
name = "gain"
low = 1
high = 2
[search]
trials = 3
limit = 30
"""


class Place:
    """A folder, whose name a shell must have in quotes, with both studies and an engine that notes how it is started."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "a folder's"
        self.lmp, self.out = fake_engine(self.folder / "engine"), self.folder / "out"
        (self.folder / "in.flow").write_text(SCRIPT)
        (self.folder / "trade.toml").write_text(TRADE)
        (self.folder / "calibrate.toml").write_text(CALIBRATE)

    def arguments(self, study: str) -> list:
        return [study, self.folder / f"{study}.toml", "--out", self.out, "--lmp", self.lmp, "--jobs", "1"]

    def calls(self) -> list:
        """How the engine was started since the last question: words, folder, environment."""
        file = self.lmp.with_name("calls")
        found = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
        file.unlink(missing_ok=True)
        return found

    def launcher(self, text: str) -> Path:
        path = self.folder / "launcher"
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)
        return path


@pytest.fixture
def place(tmp_path, monkeypatch):
    for name in list(os.environ):
        if name.startswith(("OMPI_", "LAMMPS_", "OMP_", "LD_")):
            monkeypatch.delenv(name)
    return Place(tmp_path)


@pytest.mark.parametrize("study, runs", [("trade", 6), ("calibrate", 2)])
def test_pasted_lines_of_a_dry_run_start_what_the_study_starts(place, command, monkeypatch, study, runs):
    monkeypatch.setenv("LAMMPS_PLUGIN_PATH", "/some where/plugins")
    monkeypatch.setenv("OMP_NUM_THREADS", "1")
    before = sorted(place.folder.rglob("*"))
    code, out, err = command(*place.arguments(study), "--dry-run")
    assert (code, err) == (0, "") and sorted(place.folder.rglob("*")) == before and not place.calls()
    lines = out.splitlines()
    assert lines[0].startswith(f"# {runs} of {runs} runs are missing; ")
    assert [line[:6] for line in lines[1::2]] == ["# seed"] * runs and len(lines) == 1 + 2 * runs

    # all at once into a shell that knows nothing of this environment
    plain = {"PATH": os.environ["PATH"]}
    subprocess.run(["sh"], input=out, text=True, check=True, env=plain, cwd="/")
    pasted = place.calls()
    shutil.rmtree(place.out)
    assert command(*place.arguments(study))[0] == 0
    done = place.calls()
    assert len(pasted) == runs and (sorted(done[:runs]) == sorted(pasted))
    words, folder, environment = pasted[0]
    assert words[0] == str(place.lmp) and environment == {
        "LAMMPS_PLUGIN_PATH": "/some where/plugins",
        "OMP_NUM_THREADS": "1",
    }
    assert Path(folder).parent == place.out / "runs"
    if study == "trade":
        assert "it's $HOME & more" in words and len(done) == 6


def test_a_dry_run_of_what_is_done_and_of_what_follows(place, command):
    """Either change alone saves time and spoils nothing: with a tolerance both are then run together."""
    (place.folder / "in.flow").write_text(SCRIPT + "variable other index 1\n")
    (place.folder / "trade.toml").write_text(TRADE + "other = [1, 2]\n")
    arguments = place.arguments("trade")
    assert command(*arguments, "--dry-run")[1].startswith("# 9 of 9 runs are missing")
    assert command(*arguments)[0] == 0 and len(place.calls()) == 9
    assert command(*arguments, "--dry-run")[1] == "# all runs are done\n"
    assert command(*arguments, "--seeds", "4", "--dry-run")[1].startswith("# 3 of 12 runs are missing")
    lines = command(*arguments, "--tolerance", "0.01", "--dry-run")[1].splitlines()
    assert lines[0].startswith("# 3 of 3 runs are missing") and not place.calls()
    assert lines[1::2] == [f"# seed {seed}, gain + other: gain = 1.5, other = 2" for seed in (1, 2, 3)]


def test_a_dry_run_of_a_calibration_goes_on_where_it_was(place, command):
    arguments = place.arguments("calibrate")
    assert command(*arguments, "--trials", "1")[0] == 0
    first = len(place.calls())
    code, out, _ = command(*arguments, "--dry-run")
    assert code == 0 and not place.calls()
    lines = [line for line in out.splitlines() if line.startswith("(")]
    assert command(*arguments)[0] == 0
    later = place.calls()
    assert first == 2 and 0 < len(lines) <= len(later)
    for line, (words, folder, _) in zip(sorted(lines), sorted(later[: len(lines)], key=lambda call: call[1])):
        assert f"-var gain {words[words.index('gain') + 1]} " in line and folder in line.replace("'\"'\"'", "'")
    assert command(*arguments, "--dry-run")[1] == "# all runs are done\n"


@pytest.mark.parametrize("study", ["trade", "calibrate"])
@pytest.mark.parametrize("by", ["option", "key"])
def test_a_launcher_gets_ranks_name_and_folder(place, command, study, by):
    noted = place.folder / "noted"
    path = place.launcher(f'echo "$1|$2|$3|$PWD" >> "{noted}"; shift 3; exec "$@"')
    fake_engine(place.folder / "engine", ranks=3)
    words = f"'{path}' -n={{np}} {{name}} {{folder}}".replace("a folder's", "a folder'\"'\"'s")
    options = ["--launcher", words, "--ranks", "3"]
    if by == "key":
        file, options = place.folder / f"{study}.toml", []
        file.write_text(f"ranks = 3\nlauncher = {json.dumps(words)}\n" + file.read_text())
    code, _, err = command(*place.arguments(study), *options)
    assert code == 0, err
    calls, lines = place.calls(), noted.read_text().splitlines()
    assert len(lines) == len(calls) > 0
    for (_, folder, _), line in zip(calls, lines):
        assert line == f"-n=3|{Path(folder).stem}|{folder}|{folder}"


def test_ranks_without_a_launcher_are_mpiruns(tmp_path):
    assert launch(None, 1, tmp_path) == ()
    assert launch(None, 4, tmp_path) == ("mpirun", "-np", "4")
    assert launch("srun -n{np} --job-name '{name} of it' {{x}}", 1, tmp_path / "k.part") == (
        "srun", "-n1", "--job-name", "k of it", "{x}",
    )  # fmt: skip


@pytest.mark.parametrize(
    "template, words",
    [
        ("srun -n {n}", ["unknown place 'n' (did you mean 'np'?)", "np, name, folder"]),
        ("srun -n {}", ["unknown place ''"]),
        ("srun -n {np", ["is no command", "a brace is written {{"]),
        ("srun 'n", ["is no command (no closing quotation)"]),
        ("  ", ["must name a command"]),
    ],
)
def test_a_launcher_that_is_none(place, command, template, words):
    with pytest.raises(ArgumentError) as refused:
        check_launcher(template)
    code, _, err = command(*place.arguments("trade"), "--launcher", template)
    assert code == 2 and err.startswith("clusterdem: --launcher: ") and err.count("\n") == 1
    (place.folder / "trade.toml").write_text(f"launcher = {json.dumps(template)}\n" + TRADE)
    code, _, told = command(*place.arguments("trade"))
    assert code == 2 and f"trade.toml: launcher = {template!r}: " in told and told.count("\n") == 1
    for text in (str(refused.value), err, told):
        assert all(word in text for word in words)
    assert not place.calls() and not place.out.exists()


def test_a_launcher_that_is_not_there_or_fails_is_told_in_one_line(place, command):
    arguments = place.arguments("trade")
    code, _, err = command(*arguments, "--launcher", "gone -n {np}")
    assert (code, err) == (2, "clusterdem: --launcher: gone is no executable\n")
    place.launcher("echo starting; echo 'no partition of that name' >&2; exit 3")
    code, _, err = command(*arguments, "--launcher", "sh ../../../launcher {np}")
    assert code == 2 and err.endswith(
        "trade.toml: the reference has 0 finished runs, it needs 3; gain = 1, seed 1: "
        "sh ../../../launcher 1 ended with status 3 before LAMMPS began: no partition of that name\n"
    )
    assert err.count("\n") == 1 and not place.calls()


def test_a_launcher_that_starts_other_ranks_does_not_count(place, command):
    """As the mpirun of another MPI, which starts several runs on one rank each."""
    code, _, err = command(*place.arguments("trade"), "--launcher", "env", "--ranks", "2")
    assert code == 2 and "log.lammps: 1 ranks ran, and not 2, as env should have started" in err
    assert not list(place.out.glob("runs/*/cost.json"))


@pytest.mark.parametrize(
    "seeds, said", [(3, "the reference has 2 finished runs, it needs 3"), (4, "2 of 8 runs failed")]
)
def test_three_runs_make_a_reference(place, command, seeds, said):
    """Seed 2 fails at every setting: of three seeds two are too few, of four three are enough."""
    place.launcher('case "$*" in *"seed 2 "*) exit 3;; esac; exec "$@"')
    options = ("--launcher", "sh ../../../launcher", "--seeds", seeds)
    code, out, err = command(*place.arguments("trade"), *options)
    assert code == 2 and said in err and ("trade.md" in out) is (seeds == 4)


AFTER = '"$@";'


@pytest.mark.parametrize(
    "study, after, said",
    [
        ("trade", "exit 5", "ended with status 5"),
        ("trade", ": > log.lammps", "log.lammps: holds no time loop: the script must run at least one step"),
        ("trade", "sed -i 's/for 90 steps/for 0 steps/' log.lammps", "holds no time loop"),
        ("trade", "rm *0.dump *.N.txt", "holds no dump file"),
        ("trade", "rm *10.dump *40.dump *90.dump", "holds no frame after the start"),
        ("trade", "sed -i 1,2d *.dump", "frames hold no time, by which runs are compared"),
        ("trade", "rm *40.dump", ""),
        ("calibrate", "sed -i 1,2d *.dump", "frames hold no time, by which runs are compared"),
        ("calibrate", "rm *10.dump *40.dump *90.dump", "holds no frame after the start"),
        ("calibrate", "exit 5", "no start gives a number: gain = 1.5, seed 4"),
        ("calibrate", "rm *10.dump", ""),
        ("calibrate", "rm *40.dump", "case 'flow': its run has no frame at 0.02 s"),
    ],
)
def test_why_a_run_does_not_count(place, command, study, after, said):
    place.launcher(f"{AFTER} {after}")
    code, _, err = command(*place.arguments(study), "--launcher", "sh ../../../launcher")
    if not said:
        assert code == 0, err
        return
    assert code == 2 and said in err


def test_a_run_beyond_its_limit_is_not_tried_again_until_it_may_take_longer(place, command):
    """A launcher that computes for ever: its limit of 1 core-second ends it, as the kernel does."""
    launcher = place.launcher("while :; do :; done")
    text = CALIBRATE.replace("limit = 30", "limit = 1").replace("trials = 3", "trials = 1")
    (place.folder / "calibrate.toml").write_text(text)
    bounded = ("--launcher", f"prlimit --cpu=1:2 --core=0 sh '{launcher}'".replace("a folder's", "a folder'\"'\"'s"))
    assert command(*place.arguments("calibrate"), *bounded)[0] == 0
    marks = sorted(place.out.glob("runs/*.failed/overran"))
    assert [mark.read_text() for mark in marks] == ["1\n"] * 2 and not place.calls()
    report = place.out / "calibrate.md"
    assert report.read_text().count("\ntook more than 1 core-seconds, the limit\n") == 2
    assert command(*place.arguments("calibrate"))[0] == 0 and not place.calls()  # as long a limit: not again
    assert report.read_text().count("\ntook too long before\n") == 2
    (place.folder / "calibrate.toml").write_text(text.replace("limit = 1", "limit = 2"))
    assert command(*place.arguments("calibrate"))[0] == 0 and len(place.calls()) == 2


@pytest.mark.parametrize("option", ["--jobs", "--ranks"])
def test_counts_below_one_are_refused(place, command, option):
    code, _, err = command(*place.arguments("trade"), option, "0")
    assert (code, err) == (2, f"clusterdem: {option}: must be 1 or more, not 0\n")


@pytest.mark.skipif(ENGINE is None, reason="no engine: build/bin/lmp is missing")
@pytest.mark.parametrize("study", ["trade", "calibrate"])
def test_a_template_runs_as_it_is(tmp_path, command, study):
    code, text, _ = command(study, "--template")
    (tmp_path / "study.toml").write_text(text)
    code, out, err = command(study, tmp_path / "study.toml", "--out", tmp_path / "out", "--lmp", ENGINE)
    assert code == 0, err
    report = (tmp_path / "out/study.md").read_text()
    assert "mean speed" in report and "Runs that failed" not in report
