"""Two groups of runs compared: observables at the times that all runs have."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .analysis.difference import Difference, difference_between
from .errors import ArgumentError, InputError
from .frame import Floats
from .observables import How, columns_of, find
from .run import Run
from .times import nearest, tolerance_at

DEFAULT = (
    "count",
    "mass",
    "mean_diameter",
    "sauter_diameter",
    "size_classes",
    "densest_cell",
    "dispersion",
    "strip_diameter",
)
"""Observables where none are named."""


@dataclass(frozen=True)
class Compared:
    """Observables of two groups of runs.

    Parameters
    ----------
    times : tuple of float
        The times (s), those of the first run.
    parts : dict of str to tuple of str
        Names of each observable's numbers, an empty one where there is one number.
    found : dict of str to tuple of Difference
        The groups' numbers by observable, one entry per time.
    """

    times: tuple[float, ...]
    parts: dict[str, tuple[str, ...]]
    found: dict[str, tuple[Difference, ...]]


def common_times(runs: Sequence[Run], wanted: Sequence[float] | None = None) -> list[float]:
    """Times of the first run (s) that all runs have a frame at, by the rule of :mod:`clusterdem.times`.

    Parameters
    ----------
    runs : sequence of Run
        The runs.
    wanted : sequence of float, optional
        The times asked for (s); by default all.

    Raises
    ------
    InputError
        If a run's frames hold no time.
    ArgumentError
        If a run has no frame at a time that is asked for, or the runs have no time in common.
    """
    for run in runs:
        if not len(run) or np.isnan(run.times).any():
            raise InputError(run.path, "needs frames with times, by which runs are compared: give --dt")
    if wanted is not None:
        for run in runs:
            for time in wanted:
                if nearest(run.times, time) is None:
                    within = tolerance_at(run.times, time)
                    raise ArgumentError("time", f"{run.path} has no frame within {within:g} s of {time:g} s")
        return list(wanted)
    first = runs[0].times.tolist()
    found = [time for time in first if all(nearest(run.times, time) is not None for run in runs)]
    if not found:
        spans = ", ".join(f"{run.path} {run.times.min():g} to {run.times.max():g} s" for run in runs)
        raise ArgumentError("time", f"the runs have no time in common: {spans}")
    return found


def observed(run: Run, times: Sequence[float], names: Sequence[str], how: How) -> dict[str, list[Floats]]:
    """Observables of a run at times (s): by name a row of numbers per time."""
    numbers = [run.at_number(time) for time in times]
    rows: dict[int, dict[str, Floats]] = {}
    for number, frame in enumerate(run.frames(("y", *columns_of(names)))):
        if number in numbers:
            rows[number] = {name: find(name)(frame, how) for name in names}
    return {name: [rows[number][name] for number in numbers] for name in names}


def compare_runs(
    first: Sequence[Run],
    second: Sequence[Run],
    names: Sequence[str] = DEFAULT,
    how: How | None = None,
    times: Sequence[float] | None = None,
) -> Compared:
    """Compare two groups of runs.

    Parameters
    ----------
    first, second : sequence of Run
        The runs of each group, such as one setting with several seeds.
    names : sequence of str
        Observables of :mod:`clusterdem.observables`.
    how : How, optional
        Cells and size classes for all runs; what it leaves open follows from the first run at the first and the last time.
    times : sequence of float, optional
        Times to compare at (s); by default all of the first run that every run has.

    Returns
    -------
    Compared

    Raises
    ------
    ArgumentError
        If a group is empty, there is no such observable, no common time, or a number has no counterpart.
    InputError
        If a run's frames hold no time.

    Examples
    --------
    >>> compared = compare_runs([Run("case1")], [Run("case1")], ["count"])
    >>> compared.times, [one.difference.tolist() for one in compared.found["count"]]
    ((0.0, 0.01), [[0.0], [0.0]])
    """
    runs = [*first, *second]
    for name, group in (("first", first), ("second", second)):
        if not group:
            raise ArgumentError(name, "needs a run or more")
    for name in names:
        find(name)
    at = common_times(runs, times)
    ends = [runs[0].at(time, ()) for time in (at[0], at[-1])]
    how = (how or How()).settled(ends)
    values = [observed(run, at, names, how) for run in runs]
    found: dict[str, tuple[Difference, ...]] = {}
    parts: dict[str, tuple[str, ...]] = {}
    for name in names:
        lengths = {len(row) for one in values for row in one[name]}
        if len(lengths) > 1:
            raise ArgumentError(
                "observe", f"{name} has {' or '.join(map(str, sorted(lengths)))} numbers: boxes or cells differ"
            )
        length = lengths.pop()
        parts[name] = find(name).parts(how) or (("",) if length == 1 else tuple(str(i + 1) for i in range(length)))
        found[name] = tuple(
            difference_between(
                *(np.stack([one[name][i] for one in group]) for group in (values[: len(first)], values[len(first) :]))
            )
            for i in range(len(at))
        )
    return Compared(tuple(at), parts, found)
