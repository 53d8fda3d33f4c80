"""Mass flow through a plane: constructed motion with known flow, random motion against loops, what events do to IDs."""

from __future__ import annotations

import math

import numpy as np
import pytest
from clusterdem import ArgumentError, Box, InputError, Section, crossings, slab_flow
from clusterdem.analysis.flow import farthest
from clusterdem.frame import Frame
from synthetic import SKEW, SKEW_NAMES, rows_of, skew_frame, write_dump, write_skew_run

AROUND = Box(SKEW.lo, SKEW.hi, (True, True, True))


def plain_slab(frame, axis, place, thickness):
    number = "xyz".index(axis)
    up = down = 0.0
    for i in range(len(frame)):
        images = (-1, 0, 1) if frame.box.periodic[number] else (0,)
        position = float(frame[axis][i])
        inside = any(
            -thickness / 2 <= position + image * frame.box.lengths[number] - place < thickness / 2 for image in images
        )
        if inside:
            momentum = float(frame.mass[i]) * float(frame[f"v{axis}"][i])
            up, down = up + max(momentum, 0) / thickness, down + min(momentum, 0) / thickness
    return up, down


@pytest.mark.parametrize("box", [SKEW, AROUND])
@pytest.mark.parametrize(("axis", "place", "thickness"), [("x", -0.01, 0.03), ("y", 0.22, 0.013), ("z", -0.1, 0.2)])
@pytest.mark.parametrize("count", [300, 1, 0])
def test_slab(box, axis, place, thickness, count):
    frame = skew_frame(count, box=box)
    found = slab_flow(frame, Section(axis, place), thickness)
    up, down = plain_slab(frame, axis, place, thickness)
    assert (found.up, found.down) == pytest.approx((up, down), rel=1e-11)
    assert found.net == pytest.approx(up + down, rel=1e-11) and (count < 300 or up > 0 > down or axis == "x")


def test_slab_across_the_side_that_repeats():
    frame = skew_frame(300, box=AROUND)
    for place in (-0.3, 0.7, 0.65):
        found = slab_flow(frame, Section("z", place), 0.3)
        assert (found.up, found.down) == pytest.approx(plain_slab(frame, "z", place, 0.3), rel=1e-11)


def test_slabs_side_by_side_hold_all_momentum():
    for box in (SKEW, AROUND):
        frame = skew_frame(300, box=box)
        flows = [slab_flow(frame, Section("z", -0.3 + 0.1 * (i + 0.5)), 0.1).net for i in range(10)]
        assert sum(flows) * 0.1 == pytest.approx((frame.mass * frame["vz"]).sum(), rel=1e-11)


def moved(frame, time, shift=1.0):
    """The frame a time later, every cluster gone on with its velocity, across sides that repeat, in another order."""
    columns = {name: values[::-1].copy() for name, values in frame.columns.items()}
    for axis, low, length, periodic in zip("xyz", frame.box.lo, frame.box.lengths, frame.box.periodic, strict=True):
        columns[axis] = columns[axis] + shift * columns[f"v{axis}"] * time
        if periodic:
            columns[axis] = low + (columns[axis] - low) % length
    return Frame(frame.step + 1, frame.time + time, frame.box, columns)


@pytest.mark.parametrize("box", [SKEW, AROUND])
@pytest.mark.parametrize(("axis", "place"), [("x", -0.01), ("y", 0.22), ("z", 0.1), ("z", -0.29), ("x", 0.069)])
def test_crossings(box, axis, place):
    """The true path of each cluster, images of the plane and all, tells which went through."""
    before = skew_frame(300, box=box)
    after = moved(before, 0.01)
    number = "xyz".index(axis)
    up = down = 0.0
    counts = [0, 0]
    for i in range(300):
        start = float(before[axis][i])
        end = start + float(before[f"v{axis}"][i]) * 0.01
        for image in (-1, 0, 1) if box.periodic[number] else (0,):
            at = place + image * box.lengths[number]
            if start < at <= end:
                up, counts[0] = up + float(before.mass[i]), counts[0] + 1
            if end < at <= start:
                down, counts[1] = down - float(before.mass[i]), counts[1] + 1
    found = crossings(before, after, Section(axis, place))
    assert [found.clusters_up, found.clusters_down] == counts
    assert (found.flow.up, found.flow.down) == pytest.approx((up / 0.01, down / 0.01), rel=1e-9)
    assert found.unmatched == pytest.approx(0, abs=1e-12)


def test_in_a_closed_box_the_net_flow_is_what_the_part_above_gains():
    before = skew_frame(300, box=Box(SKEW.lo, SKEW.hi, (False, False, False)))
    after = moved(before, 0.02)
    found = crossings(before, after, Section("z", -0.1))
    gained = after.mass[after.z >= -0.1].sum() - before.mass[before.z >= -0.1].sum()
    assert found.flow.net * 0.02 == pytest.approx(gained, rel=1e-9) and found.clusters_down > 0


def test_a_uniform_stream_has_the_flow_rho_u_a_by_both():
    """20,000 clusters at 2 m/s all around: M u / L, to the chance of what is in the slab or goes through (1 % and 3 %)."""
    rng = np.random.default_rng(9)
    columns = {axis: rng.random(20_000) for axis in "xyz"} | {"id": np.arange(20_000.0), "vz": np.full(20_000, 2.0)}
    columns |= {
        "vx": np.zeros(20_000),
        "vy": np.zeros(20_000),
        "mass": np.full(20_000, 1e-4),
        "diameter": np.full(20_000, 1e-3),
    }
    before = Frame(0, 0.0, Box((0, 0, 0), (1, 1, 1)), columns)
    assert slab_flow(before, Section("z", 0.9), 0.5).net == pytest.approx(4.0, rel=0.04)
    assert crossings(before, moved(before, 0.1), Section("z", 0.05)).flow.net == pytest.approx(4.0, rel=0.06)
    assert farthest(before, moved(before, 0.1), Section("z", 0.05)) == pytest.approx(0.2)


def few(rows, time=0.0):
    number, z, mass = np.array(rows, float).reshape(-1, 3).T
    columns = {"id": number, "x": np.zeros(len(z)), "z": z, "mass": mass, "diameter": np.full(len(z), 0.1)}
    return Frame(0, time, Box((0, 0, 0), (1, 1, 1), (True, True, False)), columns)


@pytest.mark.parametrize(
    ("before", "after", "up", "unmatched"),
    [
        # the first piece keeps the ID: all of the mass counts, not that of one piece
        ([(1, 0.4, 6)], [(1, 0.6, 3), (9, 0.62, 3)], 6, 0),
        # the merged cluster keeps the lower ID: the partner's mass goes with it, and its ID is gone
        ([(1, 0.4, 2), (2, 0.45, 6)], [(1, 0.6, 8)], 8, 6 / 8),
        # what left, and what came in, is of no frame's before or after
        ([(1, 0.4, 2), (2, 0.9, 1)], [(1, 0.45, 2), (3, 0.6, 5)], 0, 1 / 3),
        ([], [(1, 0.6, 2)], 0, 0),
        ([(1, 0.4, 2)], [], 0, 1),
        # on the plane is above it
        ([(1, 0.4, 2)], [(1, 0.5, 2)], 2, 0),
        ([(1, 0.5, 2)], [(1, 0.6, 2)], 0, 0),
    ],
)
def test_what_events_do_to_the_ids(before, after, up, unmatched):
    found = crossings(few(before), few(after, 0.5), Section("z", 0.5))
    assert (found.flow.up, found.flow.down) == (up / 0.5, 0) and found.unmatched == pytest.approx(unmatched)


def test_what_is_refused():
    one, later = few([(1, 0.4, 2)]), few([(1, 0.6, 2)], 0.1)
    for call, said in (
        (lambda: Section("w", 0.1), "axis: must be x, y or z, not w"),
        (lambda: crossings(one, later, Section("z", 1.5)), r"at: must lie in the box, z = 0 to 1 m, not at 1.5 m"),
        (lambda: crossings(later, one, Section("z", 0.5)), "time: must be known and rise, not go from 0.1 s to 0 s"),
        (lambda: slab_flow(one, Section("z", 0.5), 0.0), "slab: must be above 0 and at most the box' 1 m, not 0 m"),
        (
            lambda: slab_flow(one, Section("z", 0.1), 0.3),
            "slab: of 0.3 m about 0.1 m must lie in the box, 0 to 1 m along z",
        ),
    ):
        with pytest.raises(ArgumentError, match=said):
            call()
    with pytest.raises(InputError, match="no column vz, from which the flow follows"):
        slab_flow(one, Section("z", 0.5), 0.1)
    del later.columns["id"]
    with pytest.raises(InputError, match="no column id, by which clusters are known again"):
        crossings(one, later, Section("z", 0.5))


@pytest.mark.parametrize("axis", "xz")
def test_the_command(axis, tmp_path, command):
    """Frames 10, 10, 20 and 10 ms apart; averages weigh the crossings by their intervals."""
    frames = [skew_frame(200)]
    for time in (0.01, 0.01, 0.02, 0.01):
        frames.append(moved(frames[-1], time))
    dumps = [write_dump(tmp_path / f"a.{i}.dump", frame, SKEW_NAMES) for i, frame in enumerate(frames)]
    words = ("--axis", axis, "--at", "0.02", "--slab", "0.03", "--average", "2", "--out", tmp_path / "f")
    code, out, err = command("flow", *dumps, *words)
    assert (code, err) == (0, "") and "crossed_net" in out and (tmp_path / "f/flow.png").stat().st_size > 1000
    rows = rows_of(tmp_path / "f/flow.csv")
    passed = [crossings(a, b, Section(axis, 0.02)) for a, b in zip(frames, frames[1:], strict=False)]
    for i, (frame, row) in enumerate(zip(frames, rows, strict=True)):
        up, down = plain_slab(frame, axis, 0.02, 0.03)
        assert (row["slab_up"], row["slab_down"], row["slab_net"]) == pytest.approx((up, down, up + down), rel=1e-9)
        assert row["crossed_up"] == pytest.approx(passed[i - 1].flow.up if i else math.nan, rel=1e-9, nan_ok=True)
        assert row["crossed_down"] == pytest.approx(passed[i - 1].flow.down if i else math.nan, rel=1e-9, nan_ok=True)
        assert row["crossed_net"] == pytest.approx(passed[i - 1].flow.net if i else math.nan, rel=1e-9, nan_ok=True)
        assert row["clusters_up"] == (passed[i - 1].clusters_up if i else 0)
        assert row["unmatched_percent"] == pytest.approx(0 if i else math.nan, abs=1e-10, nan_ok=True)
    with open(tmp_path / "f/average.csv") as file:
        found = {line.split(",")[0]: tuple(map(float, line.split(",")[1:])) for line in file.readlines()[1:]}
    slab = [row["slab_net"] for row in rows]
    # five frames in two blocks: three and two
    blocks = np.array([np.mean(slab[:3]), np.mean(slab[3:])])
    error = math.sqrt(2 * (0.6**2 * (blocks[0] - np.mean(slab)) ** 2 + 0.4**2 * (blocks[1] - np.mean(slab)) ** 2))
    assert found["slab_net"] == pytest.approx((np.mean(slab), error), rel=1e-9)
    masses = [one.flow.up * time for one, time in zip(passed, (0.01, 0.01, 0.02, 0.01), strict=True)]
    assert found["crossed_up"][0] == pytest.approx(sum(masses) / 0.05, rel=1e-9)


def test_the_default_plane_and_slab(tmp_path, command):
    dumps, frames = write_skew_run(tmp_path, [100, 0, 1])
    assert command("flow", *dumps, "--out", tmp_path / "f")[0] == 0
    rows = rows_of(tmp_path / "f/flow.csv")
    for frame, row in zip(frames, rows, strict=True):
        assert row["slab_net"] == pytest.approx(sum(plain_slab(frame, "z", 0.2, 1 / 30)), rel=1e-9)


def test_frames_too_far_apart_are_told(tmp_path, command):
    frames = [skew_frame(50, box=AROUND)]
    frames.append(moved(frames[0], 0.5))
    dumps = [write_dump(tmp_path / f"a.{i}.dump", frame, SKEW_NAMES) for i, frame in enumerate(frames)]
    code, _, err = command("flow", *dumps, "--out", tmp_path / "f")
    assert code == 0 and "farther than half the box: which way they crossed cannot be told" in err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--at", "0.71"), "--at: must lie in the box, z = -0.3 to 0.7 m, not at 0.71 m"),
        (("--slab", "-1"), "--slab: must be above 0 and at most the box' 1 m, not -1 m"),
        (("--at", "0.69", "--slab", "0.1"), "--slab: of 0.1 m about 0.69 m must lie in the box, -0.3 to 0.7 m along z"),
        (("--average", "1"), "--average: needs 2 blocks or more, not 1"),
        (("--axis", "w"), "--axis"),
    ],
)
def test_words_that_cannot_be(words, said, tmp_path, command):
    dumps, _ = write_skew_run(tmp_path, [5, 6])
    code, _, err = command("flow", *dumps, *words, "--out", tmp_path / "out")
    assert code == 2 and said in err


def test_dumps_without_times_or_ids(tmp_path, command):
    frames = [skew_frame(5), moved(skew_frame(5), 0.01)]
    timeless = [write_dump(tmp_path / f"t.{i}.dump", f, SKEW_NAMES, time=False) for i, f in enumerate(frames)]
    code, _, err = command("flow", *timeless, "--out", tmp_path / "t")
    assert code == 2 and "holds no time, which a flow needs: give --dt" in err
    assert command("flow", *timeless, "--dt", "0.01", "--out", tmp_path / "t")[0] == 0
    nameless = [write_dump(tmp_path / f"n.{i}.dump", f, SKEW_NAMES[1:]) for i, f in enumerate(frames)]
    code, _, err = command("flow", *nameless, "--out", tmp_path / "n")
    assert code == 2 and "no column id, by which clusters are known again" in err
