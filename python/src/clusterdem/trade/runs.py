"""Runs of LAMMPS, each done once: a run's folder is named by the hash of all that decides its result."""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import shlex
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from tqdm import tqdm

from ..enginelog import read_log
from ..errors import InputError
from ..output import write_text
from ..reader import read_dumps
from ..rundir import find_run
from .engine import Engine
from .frames import write_frames
from .script import read_script
from .settings import Setting
from .study import OWN_VARIABLES, Study

FORMAT = 1
"""Raised when what is kept of a run changes: older runs are then done again."""

TAIL = 12
"""Lines of a failed run's output that are shown."""


@dataclass(frozen=True)
class Run:
    """One run of a setting with one seed.

    Parameters
    ----------
    key : str
        Hash of the scripts and data files it reads, its variables, its ranks and the engine.
    folder : Path
        Where its results are once it is done.
    command : tuple of str
        How it is started.
    engine : Engine
        What runs it.
    """

    setting: Setting
    seed: int
    key: str
    folder: Path
    command: tuple[str, ...]
    engine: Engine

    @property
    def done(self) -> bool:
        """Whether its results are there."""
        return (self.folder / "cost.json").is_file()


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
    """A run that did not end well: its command and the end of what it said."""

    run: Run
    reason: str

    @property
    def text(self) -> str:
        """Several lines for a report."""
        return f"{self.run.setting.name}, seed {self.run.seed}\n$ {shlex.join(self.run.command)}\n{self.reason}"


def plan(study: Study, settings: Iterable[Setting], engine: Engine, folder: Path) -> list[Run]:
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
            decides = [FORMAT, engine.identity, study.ranks, sorted(setting.variables.items()), seed, files]
            key = hashlib.sha256(json.dumps(decides).encode()).hexdigest()[:24]
            launch = ["mpirun", "-np", str(study.ranks)] if study.ranks > 1 else []
            command = [*launch, engine.path, "-in", str(study.input), "-log", "log.lammps"]
            own = dict(zip(OWN_VARIABLES, (str(seed), str(inputs), ".")))
            for name, value in {**setting.variables, **own}.items():
                command += ["-var", name, value]
            runs.append(Run(setting, seed, key, folder / key, tuple(command), engine))
    return runs


def read_cost(run: Run) -> Cost:
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
            raise InputError(folder, "another clusterdem trade is running in this folder") from None
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


def perform(runs: Sequence[Run], jobs: int) -> dict[str, Failure]:
    """Do the runs that are not done, at most ``jobs`` at a time; the failures by key.

    An interrupted run leaves nothing that counts; finished ones are not run again.
    """
    missing = list({run.key: run for run in runs if not run.done}.values())
    failures: dict[str, Failure] = {}
    workers = _Workers()
    bar = tqdm(
        total=len(missing), unit="run", disable=not missing or not sys.stderr.isatty(), leave=False, file=sys.stderr
    )
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


def _execute(run: Run, workers: _Workers) -> Failure | None:
    part, failed = (run.folder.with_name(f"{run.key}.{what}") for what in ("part", "failed"))
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
            _keep(part)
            os.replace(part, run.folder)
            return None
        except InputError as error:
            reason = str(error)
    os.replace(part, failed)
    tail = (failed / "screen.txt").read_text(errors="replace").splitlines()[-TAIL:]
    return Failure(run, "\n".join([*tail, reason, f"all it said: {failed / 'screen.txt'}"]))


def _keep(folder: Path) -> None:
    """Reduce a run's dumps to what observables need, note its cost, and drop what is large."""
    log = read_log(folder / "log.lammps")
    if not log.steps:
        raise InputError(folder / "log.lammps", "holds no time loop: the script must run at least one step")
    found = find_run(folder)
    if write_frames(folder / "frames.npz", read_dumps(found.dumps, columns=())) < 2:
        raise InputError(found.dumps[0], "holds no frame after the start")
    for file in [*found.dumps, *folder.glob("*.restart")]:
        file.unlink()
    write_text(folder / "cost.json", json.dumps({"wall": log.loop, "core_seconds": log.core_seconds}) + "\n")
