"""What the engine's log tells: version, input, ranks, time by phase, warnings."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..frame import Floats

PHASE = re.compile(r"^(\w+)\s*\|[^|]*\|([^|]*)\|[^|]*\|[^|]*\|[^|]*$")
LOOP = re.compile(r"^Loop time of ([0-9.eE+-]+) on (\d+) procs for (\d+) steps with (\d+) atoms")
CPU_USE = re.compile(r"^([0-9.]+)% CPU use with")
VARIABLE = re.compile(r"^variable\s+(\w+)\s+(?:index|equal|string|getenv|internal)\s+(.+?)\s*$")


@dataclass
class EngineLog:
    """The engine's own account of a run.

    Parameters
    ----------
    version : str
        First line, such as ``LAMMPS (4 Feb 2025)``.
    phases : dict of str to float
        Seconds by phase, summed over the runs of the log (average over ranks).
    loop : float
        Seconds in the time loop; ``steps``, ``ranks`` and ``wall`` (as printed) beside.
    core_seconds : float
        Loop time x ranks x the share of it that they computed (LAMMPS' "CPU use"; 1 where the log does not say).
    warnings : list of str
        Lines that begin with WARNING or ERROR.
    script : list of str
        The input as the log echoes it.
    variables : dict of str to str
        Variables of the input, as they are defined there: the command line may have set them before.
    filled : dict of str to str
        Values that really ran, where the log echoes a line before and after a variable is filled in.
    thermo : list of dict of str to ndarray, shape (T,)
        Thermo output by column, a table for every run of the log; half-written rows are left out.
    """

    version: str = ""
    phases: dict[str, float] = field(default_factory=dict)
    loop: float = 0.0
    core_seconds: float = 0.0
    steps: int = 0
    ranks: int = 0
    wall: str = ""
    warnings: list[str] = field(default_factory=list)
    script: list[str] = field(default_factory=list)
    variables: dict[str, str] = field(default_factory=dict)
    filled: dict[str, str] = field(default_factory=dict)
    thermo: list[dict[str, Floats]] = field(default_factory=list)

    def at(self, step: int) -> dict[str, float]:
        """The thermo output at a step; that of the last run that printed it."""
        found: dict[str, float] = {}
        for table in self.thermo:
            for row in np.flatnonzero(table["Step"] == step):
                found |= {name: float(values[row]) for name, values in table.items()}
        return found


def read_log(path: str | Path) -> EngineLog:
    """Read a LAMMPS or LIGGGHTS log; what it does not hold stays empty.

    Parameters
    ----------
    path : str or Path
        The file.
    """
    try:
        text = Path(path).read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise InputError(path, f"cannot be read: {error.strerror}") from error
    log = EngineLog()
    in_table = False
    last = 0.0  # core-seconds of the latest loop
    names: list[str] = []
    rows: list[list[float]] = []

    def end_table() -> None:
        if rows:
            log.thermo.append(dict(zip(names, np.array(rows).T)))
        rows.clear()

    lines = text.splitlines()
    log.filled = _filled(lines)
    for line in lines:
        words = line.split()
        if not log.version and line.startswith(("LAMMPS (", "LIGGGHTS")):
            log.version = line.strip()
        elif loop := LOOP.match(line):
            in_table = False
            log.loop += float(loop[1])
            log.ranks, log.steps = int(loop[2]), log.steps + int(loop[3])
            last = float(loop[1]) * log.ranks
            log.core_seconds += last
        elif use := CPU_USE.match(line):
            log.core_seconds -= last * (1 - float(use[1]) / 100)
        elif phase := PHASE.match(line):
            try:
                log.phases[phase[1]] = log.phases.get(phase[1], 0.0) + float(phase[2])
            except ValueError:
                pass
        elif line.startswith("Total wall time:"):
            log.wall = line.split(":", 1)[1].strip()
        elif line.startswith(("WARNING", "ERROR")):
            log.warnings.append(line.strip())
        elif words[:1] == ["Step"]:
            end_table()
            in_table, names = True, words
        elif in_table and len(words) == len(names) and (row := _row(words)) is not None:
            rows.append(row)
        elif not in_table and (variable := VARIABLE.match(line)):
            log.variables[variable[1]] = variable[2]
            log.script.append(line.rstrip())
        elif not in_table and re.match(r"[a-z_]+(\s|$)", line):
            log.script.append(line.rstrip())
    end_table()
    return log


def _row(words: list[str]) -> list[float] | None:
    try:
        return [float(word) for word in words]
    except ValueError:
        return None


REFERENCE = re.compile(r"\$\{(\w+)\}|\$([A-Za-z])")


def _filled(lines: list[str]) -> dict[str, str]:
    """Values of variables, from pairs of lines: one with ``${name}``, the next with its value in that place."""
    values: dict[str, str] = {}
    for before, after in zip(lines, lines[1:]):
        found = REFERENCE.search(before)
        if found is None or not after.startswith(before[: found.start()]):
            continue
        rest = after[found.start() :]
        follows = re.split(r"[$#]", before[found.end() :])[0].rstrip()
        end = rest.find(follows) if follows else len(rest.rstrip()) if found.end() == len(before.rstrip()) else -1
        if end > 0:
            values[found[1] or found[2]] = rest[:end].strip()
    return values
