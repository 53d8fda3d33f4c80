"""Runs of LAMMPS, each done once: a run's folder is named by the hash of all that decides its result."""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import shlex
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Protocol

import numpy as np
from tqdm import tqdm

from ..errors import ArgumentError, InputError
from ..frame import Frame
from ..io.enginelog import read_log
from ..io.output import write_text
from ..observables import check_frame, columns_of, find
from ..run import Run
from .engine import Engine
from .file import Variables
from .launch import launch, pasted
from .schema import OWN_VARIABLES
from .script import read_script

TAIL = 12
"""Lines of a failed run's output that are shown."""


LOG = "log.lammps"
"""A run's log, in its folder."""

OVERRAN = "overran"
"""Marks a run that took longer than its limit, which it holds."""


@dataclass(frozen=True)
class Setting:
    """One setting of an input script.

    Parameters
    ----------
    axis : str
        What kind of setting it is: the axis of a trade on which it leaves the reference, the case of a calibration.
    name : str
        What is set.
    variables : dict of str to str
        All variables but the seed.
    """

    axis: str
    name: str
    variables: Variables


@dataclass(frozen=True)
class Keeping:
    """What is kept of a run's dumps, which themselves are not.

    Parameters
    ----------
    format : str or int
        Changed when that changes: older runs are then done again.
    keep : callable
        Writes it; raises InputError where the dumps do not hold it.
    """

    format: str | int
    keep: Callable[[Run], None]


def frames_of(found: Run, names: Sequence[str]) -> list[Frame]:
    """A run's frames with what observables need, for what is kept of it.

    Raises
    ------
    InputError
        If there is none after the start, if they hold no time, or not what an observable needs.
    """
    of_run = any(find(name).of_run for name in names)
    frames = list(found.frames(("y", *columns_of(names))))
    if of_run:
        frames = [replace(frame, run=found.numbers_at(frame.step)) for frame in frames]
    if len(frames) < 2:
        raise InputError(found.path, "holds no frame after the start")
    if any(np.isnan(frame.time) for frame in frames):
        raise InputError(found.dumps[0], "frames hold no time, by which runs are compared: dump_modify … time yes")
    for frame in frames[1:]:
        check_frame(frame, names)
    return frames


class Task(Protocol):
    """What a study's runs have in common."""

    @property
    def path(self) -> Path:
        """The study file."""

    @property
    def input(self) -> Path:
        """The input script."""

    @property
    def seeds(self) -> tuple[int, ...]:
        """Every setting runs with each of them."""

    @property
    def ranks(self) -> int:
        """MPI ranks of a run."""

    @property
    def launcher(self) -> str | None:
        """What starts a run, as :mod:`clusterdem.studies.launch` has it."""


@dataclass(frozen=True)
class StudyRun:
    """One run of a setting with one seed.

    Parameters
    ----------
    key : str
        Hash of the scripts and data files it reads, its variables, its ranks and the engine.
    folder : Path
        Where its results are once it is done.
    launcher : tuple of str
        What starts it; empty where the engine starts by itself.
    command : tuple of str
        How it is started, the launcher's words first.
    ranks : int
        MPI ranks.
    engine : Engine
        What runs it.
    keeping : Keeping
        What is kept of it.
    limit : int, optional
        Core-seconds after which each of its processes is ended.
    """

    setting: Setting
    seed: int
    key: str
    folder: Path
    launcher: tuple[str, ...]
    command: tuple[str, ...]
    ranks: int
    engine: Engine
    keeping: Keeping
    limit: int | None = None

    @property
    def done(self) -> bool:
        """Whether its results are there."""
        return (self.folder / "cost.json").is_file()

    @property
    def part_folder(self) -> Path:
        """Where it runs."""
        return self.folder.with_name(f"{self.key}.part")

    @property
    def line(self) -> str:
        """The line for a shell that does the same."""
        return pasted(self.command, self.part_folder)

    @property
    def failed_folder(self) -> Path:
        """Where its remains are if it failed."""
        return self.folder.with_name(f"{self.key}.failed")

    @property
    def overran(self) -> bool:
        """Whether it has been tried, and took longer than it may now: it is not tried again."""
        mark = self.failed_folder / OVERRAN
        return self.limit is not None and mark.is_file() and int(mark.read_text()) >= self.limit


@dataclass(frozen=True)
class Cost:
    """What a run took.

    Parameters
    ----------
    wall : float
        Seconds in the time loop.
    core_seconds : float
        The same times the ranks, times the share of the time that they really computed (LAMMPS' "CPU use"), so
        that other work on the machine does not count.
    """

    wall: float
    core_seconds: float


@dataclass(frozen=True)
class Failure:
    """A run that did not end well: why, and the end of what it said."""

    run: StudyRun
    reason: str

    @property
    def text(self) -> str:
        """Several lines for a report."""
        return f"{self.run.setting.name}, seed {self.run.seed}\n$ {shlex.join(self.run.command)}\n{self.reason}"


def plan(
    study: Task,
    settings: Iterable[Setting],
    engine: Engine,
    folder: Path,
    keeping: Keeping,
    limit: int | None = None,
) -> list[StudyRun]:
    """The runs of settings: every one with every seed."""
    runs = []
    for setting in settings:
        inputs = study.input.parent
        script = read_script(study.input, {"inputs": str(inputs), "outdir": ".", **setting.variables})
        for name in ("seed", *setting.variables):
            if name not in script.names:
                raise InputError(study.path, f"{study.input.name} knows no variable {name!r}: it would change nothing")
        files = [
            (os.path.relpath(file, inputs), hashlib.sha256(file.read_bytes()).hexdigest()) for file in script.files
        ]
        for seed in study.seeds:
            decides = [keeping.format, engine.identity, study.ranks, sorted(setting.variables.items()), seed, files]
            key = hashlib.sha256(json.dumps(decides).encode()).hexdigest()[:24]
            launcher = launch(study.launcher, study.ranks, folder / f"{key}.part")
            bounded = ["prlimit", f"--cpu={limit}:{limit + 1}", "--core=0"] if limit else []
            command = [*launcher, *bounded, engine.path, "-in", str(study.input), "-log", LOG]
            own = dict(zip(OWN_VARIABLES, (str(seed), str(inputs), ".")))
            for name, value in {**setting.variables, **own}.items():
                command += ["-var", name, value]
            words, place = tuple(command), folder / key
            runs.append(StudyRun(setting, seed, key, place, launcher, words, study.ranks, engine, keeping, limit))
    return runs


def read_cost(run: StudyRun) -> Cost:
    """What a finished run took."""
    return Cost(**json.loads((run.folder / "cost.json").read_text()))


@contextmanager
def only_one(folder: Path) -> Iterator[None]:
    """Refuse a second process that would run in the same folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / ".lock", "w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise InputError(folder, "another clusterdem is running studies in this folder") from None
        yield


@dataclass
class _Workers:
    """Processes that run now, to be ended when the study is interrupted."""

    live: set[subprocess.Popen[bytes]] = field(default_factory=set)
    guard: threading.Lock = field(default_factory=threading.Lock)
    stopped: bool = False

    def run(self, command: Sequence[str], folder: Path) -> int:
        with open(folder / "screen.txt", "wb") as screen:
            with self.guard:
                if self.stopped:
                    return -1
                process = subprocess.Popen(
                    command, cwd=folder, stdin=subprocess.DEVNULL, stdout=screen, stderr=subprocess.STDOUT
                )
                self.live.add(process)
            code = process.wait()
            with self.guard:
                self.live.discard(process)
        return code

    def stop(self) -> None:
        with self.guard:
            self.stopped = True
            for process in self.live:
                process.terminate()


class Missing(Exception):
    """Runs that would have to be done now, of a study that is only looked at."""

    def __init__(self, runs: Sequence[StudyRun], wanted: int) -> None:
        super().__init__(f"{len(runs)} of {wanted} runs are missing")
        self.runs = runs


def perform(runs: Sequence[StudyRun], jobs: int, quiet: bool = False, dry: bool = False) -> dict[str, Failure]:
    """Do the runs that are not done, at most ``jobs`` at a time; the failures by key.

    An interrupted run leaves nothing that counts; finished ones are not run again.

    Raises
    ------
    Missing
        If ``dry`` and a run is not done.
    ArgumentError
        If what starts the runs is no executable.
    """
    failures = {run.key: Failure(run, "took too long before") for run in runs if not run.done and run.overran}
    missing = list({run.key: run for run in runs if not run.done and run.key not in failures}.values())
    if dry and missing:
        raise Missing(missing, len({run.key for run in runs}))
    for word in {run.launcher[0] for run in missing if run.launcher}:
        if shutil.which(word) is None:
            raise ArgumentError("launcher", f"{word} is no executable")
    workers = _Workers()
    hidden = quiet or not missing or not sys.stderr.isatty()
    bar = tqdm(total=len(missing), unit="run", disable=hidden, leave=False, file=sys.stderr)
    with bar, ThreadPoolExecutor(jobs) as pool:
        pending: set[Future[Failure | None]] = {pool.submit(_execute, run, workers) for run in missing}
        try:
            while pending:
                finished, pending = wait(pending, return_when=FIRST_COMPLETED)
                for future in finished:
                    if (failure := future.result()) is not None:
                        failures[failure.run.key] = failure
                    bar.update()
        except BaseException:
            for future in pending:
                future.cancel()
            workers.stop()
            raise
    return failures


def _execute(run: StudyRun, workers: _Workers) -> Failure | None:
    part, failed = run.part_folder, run.failed_folder
    for folder in (part, failed):
        shutil.rmtree(folder, ignore_errors=True)
    part.mkdir(parents=True)
    write_text(part / "command.txt", shlex.join(run.command) + "\n")
    code = workers.run(run.command, part)
    reason = f"ended with status {code}"
    if code == 0:
        try:
            if run.engine.changed:
                raise InputError(
                    run.engine.path, "it or a plugin was built anew during the study: start the study again"
                )
            _keep(part, run)
            os.replace(part, run.folder)
            return None
        except InputError as error:
            reason = str(error)
    said = (part / "screen.txt").read_text(errors="replace").splitlines()
    told = [*said[-TAIL:], f"all it said: {failed / 'screen.txt'}"]
    if run.limit and code in (-signal.SIGXCPU, 128 + signal.SIGXCPU):
        reason = f"took more than {run.limit} core-seconds, the limit"
        write_text(part / OVERRAN, f"{run.limit}\n")
    elif code != 0 and run.launcher and not (part / LOG).exists():
        reason = f"{shlex.join(run.launcher)} ended with status {code} before LAMMPS began: {' '.join(said[-1:])}"
        told = []
    os.replace(part, failed)
    return Failure(run, "\n".join([reason, *told]))


def _keep(folder: Path, run: StudyRun) -> None:
    """Keep of a run's dumps what the study needs, note its cost, and drop what is large."""
    log = read_log(folder / LOG)
    if not log.steps:
        raise InputError(folder / LOG, "holds no time loop: the script must run at least one step")
    if log.ranks != run.ranks:
        rule = f"{log.ranks} ranks ran, and not {run.ranks}, as {shlex.join(run.launcher) or 'the study'} should have started"
        raise InputError(folder / LOG, rule)
    found = Run(folder)
    run.keeping.keep(found)
    for file in [*found.dumps, *found.maps, *folder.glob("*.restart")]:
        file.unlink()
    write_text(folder / "cost.json", json.dumps({"wall": log.loop, "core_seconds": log.core_seconds}) + "\n")
