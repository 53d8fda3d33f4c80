"""Runs that are killed (SIGKILL) at random moments and resumed from their newest complete restart file."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import scenes
from lammps_run import LMP, Run, launch, run, write

TOTAL, EVERY = 1500, 50  # steps; a restart file every so many, `a` and `b` in turn
END_OF_FILE = b"LammpS RestartT\0"  # what the engine writes last


@dataclass
class Setting:
    """What runs: words of the scene, as in scenes.py."""

    name: str
    options: str = ""
    gas: str = scenes.GAS

    def start(self) -> str:
        return scenes.start() + scenes.fixes(options=self.options, gas=self.gas) + scenes.outputs()

    def again(self, file: str) -> str:
        return scenes.again(file, options=self.options, gas=self.gas)


SETTINGS = [
    Setting("gusts per cell"),
    Setting("test end, own gusts", "test end", scenes.GAS.replace("cell 8 1 8 4e-4 5", "own 4e-4 5")),
]

RESTARTS = f"restart {EVERY} a.restart b.restart\n"
END = write("f_size[1]", "f_size[2]", "f_size[3]") + (
    'print "$(f_size[3]) $(f_size[4]) $(f_size[5]) $(f_size[6]) $(f_size[7]:%.17g)" file totals.txt\n'
)


@dataclass
class Chain:
    """Kills so far, the moments, and the steps at which the state that counts was taken up again."""

    kills: int = 0
    cuts: list[int] = field(default_factory=list)
    cut_files: int = 0  # restart files that a kill left short
    from_start: int = 0


def complete(file: Path) -> bool:
    return file.exists() and file.read_bytes().endswith(END_OF_FILE)


def newest_complete(folder: Path) -> Path | None:
    files = [file for file in (folder / "a.restart", folder / "b.restart") if complete(file)]
    return max(files, key=lambda file: file.stat().st_mtime_ns, default=None)


def descendants(pid: int) -> list[int]:
    found: list[int] = []
    for tasks in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in map(int, tasks.read_text().split()):
            found += [child, *descendants(child)]
    return found


def kill_after(folder: Path, script: str, np_: int, seconds: float, one_rank: bool) -> bool:
    """Start the run, kill it (all processes, or one rank) after a while; False if it had finished by then."""
    (folder / "in.lmp").write_text(script)
    environment = dict(os.environ)
    if os.geteuid() == 0:
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    with open(folder / "output.txt", "w") as output:
        process = subprocess.Popen(
            [*launch(np_), LMP, "-in", "in.lmp", "-log", "none"],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
        )
        try:
            process.wait(seconds)
            assert process.returncode == 0, (folder / "output.txt").read_text()[-2000:]
            return False
        except subprocess.TimeoutExpired:
            pass
        family = descendants(process.pid)
        for pid in family[-1:] if one_rank and family else [*family, process.pid]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        process.wait(30)  # mpirun must notice that a rank is gone
        for pid in family:  # and nobody writes any more when the next run begins
            while Path(f"/proc/{pid}").exists() and "Z" not in Path(f"/proc/{pid}/stat").read_text().split()[2]:
                time.sleep(0.01)
    return True


def killed_chain(folder: Path, setting: Setting, np_: int, kills: int, seed: int) -> tuple[Run, Chain]:
    """Kill `kills` times at random moments, resuming each time, then run to the end."""
    dice = random.Random(seed)
    folder.mkdir(parents=True)
    chain = Chain()
    began = time.monotonic()
    run(folder / "timing", setting.start() + RESTARTS + f"run {TOTAL} upto\n", np_)
    whole = time.monotonic() - began
    while True:
        file = newest_complete(folder)
        if file is None:
            script = setting.start()
            chain.from_start += 1
        else:
            (folder / "taken.restart").write_bytes(file.read_bytes())  # the next restart may be written over it
            script = setting.again("taken.restart") + 'print "$(step)" file step.txt\n'
        script += RESTARTS + f"run {TOTAL} upto\n"
        (folder / "step.txt").unlink(missing_ok=True)
        last = chain.kills == kills
        to_go = 1.0 - (chain.cuts[-1] if chain.cuts else 0) / TOTAL
        seconds = 600.0 if last else dice.uniform(0.2, 0.3 + 0.7 * whole * to_go)
        killed = kill_after(folder, script + END, np_, seconds, one_rank=np_ > 1 and dice.random() < 0.3)
        if (folder / "step.txt").exists():
            step = int((folder / "step.txt").read_text())
            chain.cuts = [*(s for s in chain.cuts if s < step), step]
        if not killed and last:
            return Run(0, "", folder), chain
        if not killed:  # faster than the first run of all: begin again, and kill earlier
            whole *= 0.5
            chain = Chain()
            for name in ("a.restart", "b.restart"):
                (folder / name).unlink(missing_ok=True)
            continue
        chain.kills += 1
        chain.cut_files += sum((folder / f).exists() and not complete(folder / f) for f in ("a.restart", "b.restart"))


def cut_by_run(folder: Path, setting: Setting, np_: int, cuts: list[int]) -> Run:
    """The same input, never killed, cut by `run` commands at the steps where the chain was taken up."""
    runs = "".join(f"run {step} upto\n" for step in [*cuts, TOTAL])
    return run(folder, setting.start() + RESTARTS + runs + END, np_)


def difference(a: Run, b: Run) -> str:
    """Return the difference: nothing ("") if both ended with the same state to the last bit."""
    x, y = a.dump(), b.dump()
    if list(x) != list(y) or len(x["id"]) != len(y["id"]):
        return f"{len(x['id'])} clusters, not {len(y['id'])}"
    for column in x:
        if not np.array_equal(x[column], y[column]):
            return f"{column} differs by up to {np.abs(x[column] - y[column]).max()}"
    *counts, lost = np.loadtxt(a.folder / "totals.txt")
    *counts_b, lost_b = np.loadtxt(b.folder / "totals.txt")
    if counts != counts_b:
        return f"counts of events {counts}, not {counts_b}"
    # a restart file holds the sum over the ranks, which go on from there: the same numbers, added in another order
    return "" if abs(lost - lost_b) <= 1e-12 * abs(lost_b) else f"energy lost {lost!r}, not {lost_b!r}"


def tried(folder: Path, setting: Setting, np_: int, kills: int, seed: int) -> tuple[str, Chain]:
    """Difference ("" if none) of a killed chain and its reference."""
    ended, chain = killed_chain(folder / "killed", setting, np_, kills, seed)
    return difference(ended, cut_by_run(folder / "cut", setting, np_, chain.cuts)), chain
