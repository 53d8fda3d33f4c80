"""A run: frames, table over time, log and settings of one folder, read the same way by whoever asks."""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Collection, Iterator
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .analysis.ledger import Flow
from .errors import ArgumentError, InputError
from .frame import Box, Floats, Frame
from .io.enginelog import EngineLog, read_log
from .io.reader import check_same_box, is_later, natural_order, read_file
from .io.series import read_series
from .primary import Primary, primary_beside
from .times import nearest, tolerance_at

if TYPE_CHECKING:
    import MDAnalysis

FILE = re.compile(r"^(?P<name>[^.].*?)\.(?:\d+\.)?(?P<kind>dump|maps)(?:\.gz|\.bz2|\.xz|\.zst|\.bin)?$")
TABLE = ".N.txt"


class Run:
    """One run's folder.

    Parameters
    ----------
    folder : str or Path
        The folder: dumps ``NAME.STEP.dump`` or ``NAME.dump`` (maybe .gz, .bz2, .xz, .zst, .bin), maps made by the run
        ``NAME.STEP.maps``, the table ``NAME.N.txt``, the log ``NAME.log`` and ``command.txt``, as far as they are there.
    name : str, optional
        What the files' names begin with; needed only where several runs share the folder.
    dt : float, optional
        Step (s) for dumps that hold no time; by default that of the table, where all steps are alike.
    density : float, optional
        Density of the primary particles (kg/m³), over what the run tells.

    Raises
    ------
    InputError
        If the folder holds no run.
    ArgumentError
        If it holds several and none is chosen, or not the chosen one.

    Examples
    --------
    >>> run = Run("case1")
    >>> run.name, len(run), run.times.tolist(), run.seed
    ('case1', 2, [0.0, 0.01], '7')
    >>> run.primary.words
    'primary particles of 100 µm and 2000 kg/m³ (case1.log)'
    >>> run.at(0.01).diameter.max() > 0
    np.True_
    >>> run.at(0.02)
    Traceback (most recent call last):
    clusterdem.errors.ArgumentError: time: no frame within 0.0002 s of 0.02 s; the nearest is at 0.01 s
    """

    def __init__(
        self, folder: str | Path, name: str | None = None, *, dt: float | None = None, density: float | None = None
    ) -> None:
        self.path = Path(folder)
        if not self.path.is_dir():
            raise InputError(folder, "must be the folder of a run")
        files: dict[str, dict[str, list[Path]]] = {}
        for file in self.path.iterdir():
            if found := FILE.match(file.name):
                files.setdefault(found["name"], {}).setdefault(found["kind"], []).append(file)
            elif file.name.endswith(TABLE) and not file.name.startswith("."):
                files.setdefault(file.name.removesuffix(TABLE), {})
        if not files:
            raise InputError(folder, "holds no dump file (NAME.STEP.dump, maybe .gz, .bz2, .xz, .zst or .bin)")
        if name is None and len(files) > 1:
            rule = f"must be chosen: {folder} holds several runs ({', '.join(sorted(files))})"
            raise ArgumentError("name", rule)
        self.name = name if name is not None else next(iter(files))
        if self.name not in files:
            rule = f"must be among {', '.join(sorted(files))}: {folder} holds no file {self.name}.*.dump"
            raise ArgumentError("name", rule)
        self.dumps = natural_order(files[self.name].get("dump", []))
        self.maps = natural_order(files[self.name].get("maps", []))
        self.density = density
        self._dt = dt

    @classmethod
    def of_dumps(cls, dumps: Collection[str | Path], *, dt: float | None = None, density: float | None = None) -> Run:
        """A run of some dump files, whatever they are called: of one or of several, in natural order of their names.

        Parameters
        ----------
        dumps : collection of str or Path
            The files. The table and the log are looked for in the folder of the first, by the name that all begin with; of files that begin
            differently there is no table.
        dt, density
            As of a folder.

        Raises
        ------
        InputError
            If there is no file, or one does not exist.
        """
        files = natural_order(dumps)
        for file in files:
            if not file.is_file():
                raise InputError(file, "must be the folder of a run, or a dump file")
        if not files:
            raise InputError("", "must be the folder of a run, or dump files")
        names = {found["name"] if (found := FILE.match(file.name)) else file.name for file in files}
        run = cls.__new__(cls)
        run.path = files[0].parent
        run.name = names.pop() if len(names) == 1 else os.path.commonprefix(sorted(names)).rstrip("._-") or "dumps"
        run.dumps, run.maps, run.density, run._dt = files, [], density, dt
        return run

    def __repr__(self) -> str:
        return f"Run({str(self.path)!r}, {self.name!r})"

    def __len__(self) -> int:
        return len(self.heads)

    def __iter__(self) -> Iterator[Frame]:
        return self.frames()

    def frames(self, columns: Collection[str] | None = None) -> Iterator[Frame]:
        """All frames in order, empty ones too; ``columns`` as in :func:`clusterdem.read_file`."""
        before: Frame | None = None
        for path in self.dumps:
            for frame in read_file(path, columns, dt=self.dt, density=self.density):
                if before is None or is_later(before, frame):
                    before = frame.head
                    yield frame

    @cached_property
    def heads(self) -> list[Frame]:
        """The frames without their clusters: step, time, box and place, in order."""
        found: list[Frame] = []
        for path in self.dumps:
            for head in read_file(path, dt=self.dt, density=self.density, rows=False):
                if not found or is_later(found[-1], head):
                    found.append(head)
        return found

    @property
    def steps(self) -> list[int]:
        """Steps of the frames."""
        return [head.step for head in self.heads]

    @property
    def times(self) -> Floats:
        """Times of the frames (s), shape (F,); NaN where nothing tells."""
        return np.array([head.time for head in self.heads])

    def at(self, time: float, columns: Collection[str] | None = None) -> Frame:
        """The frame nearest to a time (s), within the tolerance of :mod:`clusterdem.times`.

        Raises
        ------
        ArgumentError
            If there is none, or no frame has a time.
        """
        return self.frame(self.heads[self.at_number(time)], columns)

    def at_number(self, time: float) -> int:
        """Number of the frame that :meth:`at` gives, from 0 on.

        Raises
        ------
        ArgumentError
            As there.
        """
        number = nearest(self.times, time)
        if number is None:
            if not len(self) or np.isnan(self.times).all():
                raise ArgumentError("time", "the run's frames hold no time: give dt")
            closest = self.times[np.nanargmin(np.abs(self.times - time))]
            within = tolerance_at(self.times, time)
            raise ArgumentError(
                "time", f"no frame within {within:g} s of {time:g} s; the nearest is at {float(closest):g} s"
            )
        return number

    def frame(self, head: Frame, columns: Collection[str] | None = None) -> Frame:
        """The frame of a head, read again."""
        again = read_file(head.path, columns, dt=self.dt, density=self.density)
        return next(frame for frame in again if frame.step == head.step)

    @cached_property
    def dt(self) -> float | None:
        """Step (s) for dumps without times: the one given, or the table's, where all its steps are alike."""
        if self._dt is not None or self.series is None or not {"step", "time"} <= set(self.series):
            return self._dt
        moved = self.series["step"] > 0
        each = self.series["time"][moved] / self.series["step"][moved]
        alike = len(each) and np.ptp(each) <= 1e-6 * each[-1] and each[-1] > 0
        return float(each[-1]) if alike else None

    @property
    def box(self) -> Box:
        """The box of all frames.

        Raises
        ------
        InputError
            If it changes, or there is no frame.
        """
        if not self.heads:
            raise InputError(self.path, "holds no frame of clusters, and so no box")
        for head in self.heads[1:]:
            check_same_box(self.heads[0], head, "box tells of")
        return self.heads[0].box

    @cached_property
    def series(self) -> dict[str, Floats] | None:
        """The engine's table over time; None where it is not there. See :func:`clusterdem.io.series.read_series`."""
        path = self.path / f"{self.name}{TABLE}"
        return read_series(path) if path.is_file() else None

    def flow(self, step: int) -> Flow | None:
        """Particles fed and left up to a step, where the table has a row of it."""
        if self.series is None or not {"step", "fed", "left"} <= set(self.series):
            return None
        rows = np.flatnonzero(self.series["step"] == step)
        if not len(rows):
            return None
        return Flow(*(int(self.series[name][rows[-1]]) for name in ("fed", "left")))

    @cached_property
    def log(self) -> EngineLog:
        """The engine's log, NAME.log or log.lammps; empty where neither is there."""
        for name in (f"{self.name}.log", "log.lammps"):
            if (self.path / name).is_file():
                return read_log(self.path / name)
        return EngineLog()

    @cached_property
    def time_step(self) -> tuple[float, float] | None:
        """Smallest and largest time step (s); None where nothing tells.

        Of the log's column ``Dt``; else means over the intervals between the table's rows, else between frames.
        """
        tables = [table["Dt"] for table in self.log.thermo if "Dt" in table]
        if not tables and self.series is not None and {"step", "time"} <= set(self.series):
            tables = [_mean_steps(self.series["step"], self.series["time"])]
        if not tables or not sum(map(len, tables)):
            tables = [_mean_steps(np.array(self.steps, dtype=float), self.times)]
        every = np.concatenate(tables)
        every = every[every > 0]
        return (float(every.min()), float(every.max())) if len(every) else None

    def numbers_at(self, step: int) -> dict[str, float]:
        """Numbers of the whole run at a step: columns of the table over time and of the thermo output, and two more.

        ``dt`` is the mean time step (s) since the frame before, NaN in the first; ``core_seconds`` is what the whole run took, by the log.
        """
        found = self.log.at(step)
        if self.series is not None and "step" in self.series:
            for row in np.flatnonzero(self.series["step"] == step)[-1:]:
                found |= {name: float(values[row]) for name, values in self.series.items()}
        number = self.steps.index(step) if step in self.steps else 0
        if number:
            before, here = self.heads[number - 1], self.heads[number]
            found["dt"] = (here.time - before.time) / (here.step - before.step)
        else:
            found["dt"] = float("nan")
        return found | {"core_seconds": self.log.core_seconds if self.log.steps else float("nan")}

    @property
    def command(self) -> str | None:
        """The command that ran, from ``command.txt``."""
        path = self.path / "command.txt"
        return path.read_text(encoding="utf-8", errors="replace").strip() if path.is_file() else None

    @cached_property
    def title(self) -> str:
        """The first line of the table, in which the inputs write their settings."""
        path = self.path / f"{self.name}{TABLE}"
        if not path.is_file():
            return ""
        with open(path, encoding="utf-8", errors="replace") as file:
            first = file.readline()
        return first[1:].strip() if first.startswith("#") and not first.split()[1:2] == ["step"] else ""

    @cached_property
    def settings(self) -> dict[str, str]:
        """Settings by name, as they really ran: the table's title, else the command line, else the log."""
        settings = dict(self.log.variables)
        try:
            words = shlex.split(self.command or "")
        except ValueError:  # a quote without its other end
            words = []
        for word, name, value in zip(words, words[1:], words[2:]):
            if word in ("-var", "-v", "--var"):
                settings[name] = value
        settings |= self.log.filled
        return settings | dict(re.findall(r"(\w+)=([^,\s]+)", self.title))

    @property
    def seed(self) -> str | None:
        """The seed that really ran."""
        return self.settings.get("seed")

    @cached_property
    def primary(self) -> Primary | None:
        """The primary particles: those of the given density, else those of the log, else those that the dumps' columns tell."""
        if self.density is not None:
            return Primary.of_density(self.density)
        for path in (*self.dumps[:1], *self.maps[:1]):
            if (found := primary_beside(path)) is not None:
                return found
        frame = next((frame for frame in self.frames(("n", "type")) if len(frame)), None)
        return None if frame is None or frame.particles.source == "assumed" else frame.particles

    def to_universe(self, shift: bool = True) -> MDAnalysis.Universe:
        """All frames as one MDAnalysis Universe; see :func:`clusterdem.io.universe.run_universe`."""
        from .io.universe import run_universe

        return run_universe(list(self.frames()), shift)


def _mean_steps(steps: Floats, times: Floats) -> Floats:
    """Mean time step of every interval between rows that steps lie between."""
    moved = np.diff(steps) > 0
    return np.diff(times)[moved] / np.diff(steps)[moved]
