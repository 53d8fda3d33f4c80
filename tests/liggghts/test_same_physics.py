"""LAMMPS and LIGGGHTS from one state: the same drag, the same size law, the same events."""

import numpy as np
import pytest
from clusterdem.io.start import write_start
from lammps_run import ROOT, run_file
from lammps_run import run as run_lammps
from liggghts_run import agree, in_both, needs_liggghts, run_liggghts, write_data
from scenes import BREAKUPS, MERGES, busy

pytestmark = needs_liggghts

MOTION = "fix move all nve\nfix fall all gravity 9.81 vector 0 0 -1\ntimestep 2e-6\n"
DRAG = (
    "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 fluctuation 3 0 3 cell 8 1 8 4e-4 5 plane xz "
    "unshielded 0.1 particle 1e-4 2000\n"
)
TABLE = "fix table all ave/time 1 1 1 " + " ".join(f"f_size[{k}]" for k in range(1, 12)) + " file out.txt\n"


def size(options: str = "", k: float = 0.5) -> str:
    return f"fix size all cluster/breakmerge 1 1e-4 2000 drag drag K {k} merge 0.2 {options}\n"


@pytest.fixture(scope="module")
def state(tmp_path_factory):
    """A crowded state of many sizes, some clusters in contact: a folder with clusters.data."""
    folder = tmp_path_factory.mktemp("state")
    frame = run_lammps(folder, busy(steps=1000)).dump()
    x, v = (np.array([frame[c + axis] for axis in "xyz"]).T for c in ("", "v"))
    write_data(folder / "clusters.data", np.rint(frame["f_size[1]"]).astype(int), x, v)
    return folder


@pytest.mark.parametrize(
    "k, options",
    [
        (0.5, ""),
        (0.005, "nst cell up cell grid 6 1 6"),
        (0.005, "nst cluster nsmf paper up superficial grid 6 1 6"),
    ],
)
def test_the_same_state_gives_the_same_drag_and_size_law(state, k, options):
    """Pure functions of the state; sums over a cell's clusters in another order are worth some rounding."""
    script = MOTION + DRAG + size("ncc 0 " + options, k) + "run 0\n"
    lammps, liggghts = (run.dump() for run in in_both(state, script))
    assert len(lammps["id"]) > 300 and np.array_equal(lammps["id"], liggghts["id"])
    for column in [f"f_drag[{k}]" for k in range(1, 9)] + [f"f_size[{k}]" for k in (1, 3, 4, 6)]:
        agree(lammps, liggghts, column, 1e-12)
    assert len(np.unique(lammps["f_size[3]"])) > 10  # the law, not its limits


def test_contact_power_is_that_of_the_forces(state):
    """Both take the forces of the start, with the same velocities."""
    lammps, liggghts = (run.dump() for run in in_both(state, MOTION + DRAG + size("ncc 1") + "run 0\n"))
    assert np.count_nonzero(lammps["f_size[5]"]) > 10
    agree(lammps, liggghts, "f_size[5]", 1e-9)  # stored forces: overlaps are differences of positions


def test_the_same_breaks_and_merges(state):
    """First at once, then for 60 steps, over which elastic contacts spread differences of rounding little."""
    for steps, tolerance in ((1, 1e-12), (60, 1e-9)):
        a, b = in_both(state, MOTION + DRAG + size("ncc 0") + TABLE + f"run {steps}\n")
        lammps, liggghts = a.dump(), b.dump()
        assert np.array_equal(lammps["id"], liggghts["id"]) and np.array_equal(
            lammps["f_size[1]"], liggghts["f_size[1]"]
        )
        for column in ("x", "y", "z", "vx", "vy", "vz", "diameter", "mass"):
            agree(lammps, liggghts, column, tolerance)
        ours, theirs = a.table(), b.table()
        assert ours[-1][BREAKUPS] > 0 and ours[-1][MERGES] > 0
        np.testing.assert_array_equal(ours[:, : MERGES + 1], theirs[:, : MERGES + 1])  # six digits of counts below 1e6


def test_the_cases_start_alike(tmp_path):
    """Case 1 in both engines from one file of `clusterdem start`: the same clusters after 100 steps of 1 us, before any
    contact. Frames of LIGGGHTS have six digits.
    """
    start = write_start(tmp_path / "start.data", 5000, 400, (0.3, 0.003, 0.6), seed=1)
    arguments = {"inputs": ROOT / "inputs", "start_file": start, "tend": 1e-4}
    text = (ROOT / "inputs" / "liggghts" / "case1.in").read_text()
    values = "".join(f"variable {name} index {value}\n" for name, value in arguments.items())
    theirs = run_liggghts(tmp_path / "liggghts", values + text).dump("case1.00000100.dump")
    ours = run_file(tmp_path / "lammps", ["-in", str(ROOT / "inputs" / "case1.in")], **arguments).dump(
        "case1.00000100.dump"
    )
    assert len(ours["id"]) > 5500 and np.array_equal(ours["id"], theirs["id"])
    assert np.array_equal(ours["n"], theirs["f_size[1]"])
    np.testing.assert_allclose(ours["z"], theirs["z"], rtol=1e-5)


def test_case_1_grows_alike(tmp_path):
    """Case 1 to 0.02 s, setting fast. Runs part once clusters have met: numbers within 2 %, the share of each size class
    within 2 points, which is about the spread between seeds there (1.7 % of N, bench/trade.md).
    """
    start = write_start(tmp_path / "start.data", 5000, 400, (0.3, 0.003, 0.6), seed=1)
    arguments = {"inputs": ROOT / "inputs", "start_file": start, "tend": 0.02, "setting": "fast"}
    text = (ROOT / "inputs" / "liggghts" / "case1.in").read_text()
    values = "".join(f"variable {name} index {value}\n" for name, value in arguments.items())
    theirs = run_liggghts(tmp_path / "liggghts", values + text)
    ours = run_file(tmp_path / "lammps", ["-in", str(ROOT / "inputs" / "case1.in")], **arguments)
    for step in (2000, 4000):
        a, b = (run.dump(f"case1.{step:08d}.dump")["diameter"] for run in (ours, theirs))
        assert len(b) == pytest.approx(len(a), rel=0.02) and len(a) > 8000
        shares = [np.histogram(d, [0, 3e-4, 6e-4, 9e-4, 1])[0] / len(d) for d in (a, b)]
        np.testing.assert_allclose(*shares, atol=0.02)


@pytest.mark.parametrize("reading", "ABCE")
def test_the_readings_are_those_of_lammps(reading):
    """LIGGGHTS needs files of its own, in which only what it cannot replace is written out."""
    ours = (ROOT / "inputs" / f"reading_{reading}.in").read_text()
    theirs = (ROOT / "inputs" / "liggghts" / f"reading_{reading}.in").read_text()
    ours = ours.replace("${cells_x} 1 ${cells_z}", "30 1 30").replace('"${case} == case1"', '"${u_g} == 2"')
    assert ours == theirs
