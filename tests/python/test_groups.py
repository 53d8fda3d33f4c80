"""Connected groups against a plain loop over all pairs with a union–find of its own."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from clusterdem import ArgumentError, groups_of
from clusterdem.frame import Box, Frame
from synthetic import SKEW, rows_of, skew_frame, write_skew_run


def plain_groups(frame, gap):
    """Members of each group, as sets of cluster numbers."""
    parent = list(range(len(frame)))

    def root(i):
        while parent[i] != i:
            i = parent[i]
        return i

    for i, j in itertools.combinations(range(len(frame)), 2):
        square = 0.0
        for axis, length, periodic in zip("xyz", frame.box.lengths, frame.box.periodic, strict=True):
            apart = abs(float(frame[axis][i]) - float(frame[axis][j]))
            square += (min(apart, length - apart) if periodic else apart) ** 2
        if math.sqrt(square) <= (float(frame.diameter[i]) + float(frame.diameter[j])) / 2 + gap:
            parent[root(i)] = root(j)
    found = {}
    for i in range(len(frame)):
        found.setdefault(root(i), set()).add(i)
    return list(found.values())


def plain_extent(frame, members, axis, points=20_000):
    """Reach along an axis by marking points of it; across a side that repeats the longest unmarked stretch is left out."""
    low, length = frame.box.lo[axis], frame.box.lengths[axis]
    intervals = [
        (float(frame["xyz"[axis]][i] - frame.diameter[i] / 2), float(frame["xyz"[axis]][i] + frame.diameter[i] / 2))
        for i in members
    ]
    if not frame.box.periodic[axis]:
        return max(b for _, b in intervals) - min(a for a, _ in intervals), 1e-12
    at = (np.arange(points) + 0.5) * length / points
    marked = np.zeros(points, bool)
    for begin, end in intervals:
        for image in (-1, 0, 1):
            marked |= (at >= begin - low + image * length) & (at <= end - low + image * length)
    if marked.all():
        return length, 1e-12
    longest = stretch = 0
    for free in np.tile(~marked, 2):
        stretch = stretch + 1 if free else 0
        longest = max(longest, stretch)
    return length - longest * length / points, 2.1 * length / points


@pytest.mark.parametrize(
    "periodic", [(True, False, False), (False, True, True), (False, False, False), (True, True, True)]
)
@pytest.mark.parametrize("gap", [0.0, 1.3e-3, 1.5e-2])
@pytest.mark.parametrize("count", [150, 1, 0])
def test_groups(periodic, gap, count):
    frame = skew_frame(count, box=Box(SKEW.lo, SKEW.hi, periodic))
    found = groups_of(frame, gap)
    expected = plain_groups(frame, gap)
    mine = [set(np.flatnonzero(found.member == g).tolist()) for g in range(len(found.clusters))]
    assert sorted(map(sorted, mine)) == sorted(map(sorted, expected))
    assert found.clusters.tolist() == sorted((len(group) for group in expected), reverse=True)
    for number, members in enumerate(mine):
        assert found.mass[number] == pytest.approx(sum(float(frame.mass[i]) for i in members), rel=1e-12)
        if len(members) > 1 or number < 3:
            for axis in range(3):
                reach, tolerance = plain_extent(frame, members, axis)
                assert found.extent[number, axis] == pytest.approx(reach, abs=tolerance)
    assert found.mass.sum() == pytest.approx(frame.mass.sum(), rel=1e-12)
    if count > 1 and gap == 1.5e-2:
        assert found.clusters[0] > 10 and len(found.clusters) > 10  # neither all nor none


def spheres(box, rows):
    x, y, z, diameter, mass = np.array(rows, float).T
    return Frame(0, 0.0, box, {"x": x, "y": y, "z": z, "diameter": diameter, "mass": mass})


def test_a_chain_across_the_side_that_repeats():
    """0.9, 1.9 and 0.3 of a side of 2: from 0.65 over the border to 0.45 + 2, but not the one across y, which does not repeat."""
    rows = [
        (0.9, 0.5, 1, 0.5, 1),
        (1.4, 0.5, 1, 0.5, 2),
        (1.9, 0.5, 1, 0.5, 4),
        (0.3, 0.5, 1, 0.3, 8),
        (1.0, 3.9, 1, 0.9, 16),
    ]
    box = Box((0, 0, 0), (2, 4, 3), (True, False, True))
    found = groups_of(spheres(box, rows))
    assert found.clusters.tolist() == [4, 1] and found.mass.tolist() == [15, 16]
    assert found.extent[0] == pytest.approx([1.8, 0.5, 0.5]) and found.extent[1] == pytest.approx([0.9, 0.9, 0.9])
    found = groups_of(spheres(Box(box.lo, box.hi, (False, False, True)), rows))
    assert found.clusters.tolist() == [3, 1, 1] and found.mass.tolist() == [7, 16, 8]
    assert found.extent[0] == pytest.approx([1.5, 0.5, 0.5])


def test_a_group_all_around_reaches_as_far_as_the_side():
    rows = [(0.25 * i, 0.5, 0.5, 0.26, 1) for i in range(8)]
    found = groups_of(spheres(Box((0, 0, 0), (2, 1, 1)), rows))
    assert found.clusters.tolist() == [8] and found.extent[0] == pytest.approx([2, 0.26, 0.26])
    large = groups_of(spheres(Box((0, 0, 0), (2, 1, 1)), [(0.4, 0.5, 0.5, 1.5, 1)]))  # larger than the box is wide
    assert large.extent[0] == pytest.approx([1.5, 1, 1])


def test_touching_and_the_gap():
    box = Box((0, 0, 0), (2, 1, 1), (False, False, False))
    pair = [(0.5, 0.5, 0.5, 0.2, 1), (0.5 + 0.3, 0.5, 0.5, 0.4, 1)]
    assert groups_of(spheres(box, pair)).clusters.tolist() == [2]
    pair[1] = (0.5 + 0.31, 0.5, 0.5, 0.4, 1)
    assert groups_of(spheres(box, pair)).clusters.tolist() == [1, 1]
    assert groups_of(spheres(box, pair), 0.0101).clusters.tolist() == [2]
    assert groups_of(spheres(box, pair), 0.0099).clusters.tolist() == [1, 1]
    for gap in (-1.0, math.nan, math.inf):
        with pytest.raises(ArgumentError, match="gap: must be 0 or more"):
            groups_of(spheres(box, pair), gap)


def test_sizes_a_thousand_times_apart():
    """Dust around one large sphere: the dust at its surface belongs to it, the rest to nobody."""
    rng = np.random.default_rng(5)
    direction = rng.normal(size=(4000, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    distance = np.where(np.arange(4000) < 40, 0.50015, 0.7)[:, None]
    rows = [(0, 0, 0, 1.0, 1.0), *((*p, 1e-3, 1e-9) for p in direction * distance)]
    box = Box((-1, -1, -1), (1, 1, 1), (False, False, False))
    found = groups_of(spheres(box, rows))
    assert set(np.flatnonzero(found.member == 0)) >= set(range(41))
    assert found.clusters[0] == 41 and found.mass[0] == pytest.approx(1 + 40e-9, rel=1e-12)


def test_the_command(tmp_path, command):
    dumps, frames = write_skew_run(tmp_path, [120, 0, 1, 90])
    code, out, err = command("groups", *dumps, "--gap", "4000", "--out", tmp_path / "g")
    assert (code, err) == (0, "") and "groups.png" in out
    summary, groups = rows_of(tmp_path / "g/summary.csv"), rows_of(tmp_path / "g/groups.csv")
    assert len(summary) == 4
    for frame, row in zip(frames, summary, strict=True):
        expected = [members for members in plain_groups(frame, 4e-3) if len(members) > 1]
        mine = [g for g in groups if g["step"] == frame.step]
        assert sorted(g["clusters"] for g in mine) == sorted(map(len, expected))
        assert (row["clusters"], row["groups"]) == (len(frame), len(expected))
        inside = [i for members in expected for i in members]
        mass = float(frame.mass[inside].sum()) if inside else 0.0
        assert sum(g["mass"] for g in mine) == pytest.approx(mass, rel=1e-12)
        assert row["in_groups_percent"] == pytest.approx(100 * len(inside) / max(len(frame), 1))
        assert row["mass_in_groups_percent"] == pytest.approx(100 * mass / frame.mass.sum() if len(frame) else 0)
        assert row["largest"] == max(map(len, expected), default=min(len(frame), 1))
        if mine:
            assert [row[k] for k in ("extent_x", "extent_y", "extent_z")] == [
                mine[0][k] for k in ("extent_x", "extent_y", "extent_z")
            ]
            assert row["largest_mass"] == mine[0]["mass"] and mine[0]["group"] == 1
    code, _, err = command("groups", *dumps, "--gap", "-5", "--out", tmp_path / "n")
    assert code == 2 and "--gap: must be 0 µm or more, not -5" in err
