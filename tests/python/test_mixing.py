"""Lacey's index: states of which it is known, and random ones against plain loops."""

from __future__ import annotations

import math

import numpy as np
import pytest
from clusterdem import ArgumentError, lacey
from synthetic import SKEW, rows_of, write_skew_run


def plain_lacey(kinds, cells):
    """(share, cells, per cell, variance, index) by loops."""
    count = len(kinds)
    if not count:
        return math.nan, 0, math.nan, math.nan, math.nan
    p = sum(kinds) / count
    occupied = sorted(set(cells))
    variance = 0.0
    for one in occupied:
        inside = [kind for kind, cell in zip(kinds, cells, strict=True) if cell == one]
        variance += len(inside) / count * (sum(inside) / len(inside) - p) ** 2
    n = count / len(occupied)
    low, high = p * (1 - p) / n, p * (1 - p)
    return p, len(occupied), n, variance, (high - variance) / (high - low) if high > low else math.nan


def of(cells):
    """Cells of (ones, zeros) as kinds and cell numbers, 3 apart."""
    kinds = [kind for ones, zeros in cells for kind in [True] * ones + [False] * zeros]
    where = [3 * number for number, (ones, zeros) in enumerate(cells) for _ in range(ones + zeros)]
    return np.array(kinds), np.array(where)


def test_known_states():
    assert lacey(*of([(4, 0), (0, 4), (4, 0), (0, 4)])).index == 0  # segregated, four a cell
    assert lacey(*of([(7, 0), (0, 2), (0, 1)])).index == pytest.approx(0, abs=1e-14)  # whatever they hold
    # quarters and three quarters of four clusters: the variance 1/16 is that of chance, p (1 - p) / n = 1/16
    found = lacey(*of([(1, 3), (3, 1), (3, 1), (1, 3)]))
    assert (found.variance, found.random, found.segregated, found.index) == (1 / 16, 1 / 16, 1 / 4, 1)
    # all alike is better than chance: 1 / (1 - 1/n)
    assert lacey(*of([(2, 4)] * 5)).index == pytest.approx(1 / (1 - 1 / 6), rel=1e-12)


def test_by_chance_it_is_one():
    """40,000 clusters on 900 cells, a third of them of the kind: the variance is off by about √(2/900) = 5 %, the index by 5 %/43."""
    rng = np.random.default_rng(6)
    cell = rng.integers(0, 900, 40_000)
    found = lacey(rng.random(40_000) < 1 / 3, cell)
    assert found.index == pytest.approx(1, abs=4 * math.sqrt(2 / 900) / 43)
    assert found.per_cell == pytest.approx(40_000 / 900)


def test_where_there_is_no_index():
    assert math.isnan(lacey(np.array([True, True]), np.array([0, 1])).index)  # one kind
    assert math.isnan(lacey(np.array([True, False]), np.array([0, 1])).index)  # one a cell
    nothing = lacey(np.empty(0, bool), np.empty(0, np.int64))
    assert nothing.cells == 0 and math.isnan(nothing.index) and math.isnan(nothing.share)
    with pytest.raises(ArgumentError, match="of_kind: must say it of each cluster: 2 for 3"):
        lacey(np.array([True, False]), np.array([0, 1, 2]))


def cells_of(frame, shape, axes):
    found = []
    for i in range(len(frame)):
        index = 0
        for axis, k in zip(axes, shape, strict=True):
            number = "xyz".index(axis)
            index = index * k + int((float(frame[axis][i]) - SKEW.lo[number]) / SKEW.lengths[number] * k)
        found.append(index)
    return found


@pytest.mark.parametrize(
    ("words", "kind"),
    [
        (("--type", "1", "3"), lambda frame: np.isin(frame["type"], (1, 3))),
        (("--type", "2"), lambda frame: frame["type"] == 2),
        (("--above", "diameter", "4.1e-3"), lambda frame: frame.diameter > 4.1e-3),
        (("--above", "vy", "-0.2"), lambda frame: frame["vy"] > -0.2),
        (("--above", "n", "30"), lambda frame: frame["n"] > 30),  # some have 30
    ],
)
@pytest.mark.parametrize(("shape", "plane"), [((4, 3), "yx"), ((2, 3, 4), "xyz")])
def test_the_command(words, kind, shape, plane, tmp_path, command):
    dumps, frames = write_skew_run(tmp_path, [150, 0, 1, 90])
    more = () if plane == "xyz" else ("--plane", plane)
    code, out, err = command("mixing", *dumps, *words, "--grid", *shape, *more, "--out", tmp_path / "m")
    assert (code, err) == (0, "") and (tmp_path / "m/mixing.png").stat().st_size > 1000 and "mixing.png" in out
    rows = rows_of(tmp_path / "m/mixing.csv")
    for frame, row in zip(frames, rows, strict=True):
        p, cells, n, variance, index = plain_lacey([bool(k) for k in kind(frame)], cells_of(frame, shape, plane))
        assert row["cells"] == cells and row["step"] == frame.step
        for name, value in (("share", p), ("per_cell", n), ("variance", variance), ("index", index)):
            assert row[name] == pytest.approx(value, rel=1e-10, nan_ok=True), name
        assert row["segregated"] == pytest.approx(p * (1 - p), nan_ok=True)
        assert row["random"] == pytest.approx(p * (1 - p) / n, nan_ok=True)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), "one of the arguments --type --above is required"),
        (("--type", "1", "--above", "mass", "1"), "not allowed with"),
        (("--type", "9"), "--type: type 9 holds of every cluster or of none"),
        (("--above", "mass", "-1"), "--above: mass > -1 holds of every cluster or of none"),
        (("--above", "mass", "much"), "--above: needs a column and a number, not mass much"),
        (("--above", "colour", "1"), "no column colour of numbers, which tells the kinds apart"),
        (("--type", "1", "--grid", "4"), "--grid: must be two numbers of cells"),
    ],
)
def test_kinds_that_cannot_be(words, said, tmp_path, command):
    dumps, _ = write_skew_run(tmp_path, [20])
    code, _, err = command("mixing", *dumps, *words, "--out", tmp_path / "out")
    assert code == 2 and said in err
