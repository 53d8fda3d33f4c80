"""In LIGGGHTS, too: particles and momentum are kept, the run is the same on any number of ranks and after a restart."""

import numpy as np
import pytest
from clusterdem import read_file
from lammps_run import D_P, RHO_P
from lammps_run import run as run_lammps
from liggghts_run import (
    LIBRARY,
    needs_liggghts,
    pair_liggghts,
    run_liggghts,
    start_liggghts,
    write_data,
    write_liggghts,
)
from scenes import BREAKUPS, MERGES, busy

pytestmark = needs_liggghts

CONTACT = pair_liggghts(1e4, "history", 0.33)
FIXES = (
    "fix move all nve\nfix fall all gravity 9.81 vector 0 0 -1\n"
    "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 fluctuation 3 0 3 {fluctuation} 5 plane xz\n"
    "fix size all cluster/breakmerge 5 1e-4 2000 drag drag K 0.5 merge 0.2 {options}\ntimestep 2e-6\n"
)
TABLE = "fix table all ave/time 1 1 10 " + " ".join(f"f_size[{k}]" for k in range(1, 12)) + " file out.txt\n"
CELLS, OWN = "cell 8 1 8 4e-4", "own 4e-4"


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """300 clusters, in contact with others now and then, as LAMMPS leaves them after 500 steps."""
    folder = tmp_path_factory.mktemp("state")
    frame = run_lammps(folder, busy(steps=500)).dump()
    x, v = (np.array([frame[c + axis] for axis in "xyz"]).T for c in ("", "v"))
    write_data(folder / "clusters.data", np.rint(frame["f_size[1]"]).astype(int), x, v)
    return str(folder / "clusters.data")


def script(data, steps=300, fluctuation=CELLS, options=""):
    fixes = FIXES.format(fluctuation=fluctuation, options=options)
    return start_liggghts(CONTACT, data) + fixes + TABLE + f"run {steps}\n" + write_liggghts()


def same(a, b):
    for name in a:
        np.testing.assert_array_equal(a[name], b[name], err_msg=name)


def test_particles_and_sizes_are_kept(tmp_path, data):
    run = run_liggghts(tmp_path, script(data))
    table, frame = run.table(), run.dump()
    assert table[-1][BREAKUPS] > 20 and table[-1][MERGES] > 20
    n = frame["f_size[1]"]
    assert np.array_equal(n, np.rint(n)) and np.all(table[:, 2] == n.sum())
    np.testing.assert_allclose(frame["diameter"], D_P * np.cbrt(2 * n), rtol=1e-15)
    np.testing.assert_allclose(frame["mass"], n * np.pi / 6 * D_P**3 * RHO_P, rtol=1e-15)
    assert len(np.unique(frame["id"])) == len(n)


def test_momentum_is_kept(tmp_path, data):
    """No gas, no gravity: only contacts and events. Momentum to rounding of its largest sum."""
    fixes = (
        "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 law none\n"
        "fix size all cluster/breakmerge 5 1e-4 2000 drag drag K 0.002 terms mf cc merge 0.2 epsmf 0.1\ntimestep 2e-6\n"
    )
    text = start_liggghts(CONTACT, data) + fixes + TABLE + write_liggghts("first.dump") + "run 300\n" + write_liggghts()
    run = run_liggghts(tmp_path, text)
    assert run.table()[-1][MERGES] > 20
    for axis in ("vx", "vz"):
        first, last = ((f["mass"] * f[axis]) for f in (run.dump("first.dump"), run.dump()))
        assert abs(first.sum() - last.sum()) <= 1e-12 * np.abs(first).sum()


@pytest.mark.parametrize("fluctuation, options", [(CELLS, ""), (OWN, "test end ncc 0 nst cell grid 4 1 4")])
def test_the_same_events_on_two_ranks(tmp_path, data, fluctuation, options):
    """Contacts that cross ranks add up in another order, which 100 steps leave at the level of rounding."""
    one, two = (
        run_liggghts(tmp_path / str(np_), script(data, 100, fluctuation, options), np_).dump() for np_ in (1, 2)
    )
    assert np.array_equal(one["id"], two["id"]) and np.array_equal(one["f_size[1]"], two["f_size[1]"])
    for axis in "xz":
        np.testing.assert_allclose(one[axis], two[axis], rtol=1e-10)


@pytest.mark.parametrize("fluctuation, options", [(CELLS, ""), (OWN, "test end")])
def test_restart(tmp_path, data, fluctuation, options):
    """A run continued from a restart file equals the same run cut at that step, to the bit."""
    fixes = FIXES.format(fluctuation=fluctuation, options=options)
    head = start_liggghts(CONTACT, data)
    cut = run_liggghts(
        tmp_path / "cut", head + fixes + "run 103\nwrite_restart half\nrun 97\n" + write_liggghts()
    ).dump()
    again = head.replace(f"read_data {data}", "read_restart ../cut/half")
    same(cut, run_liggghts(tmp_path / "again", again + fixes + "run 97\n" + write_liggghts()).dump())


def test_clear(tmp_path, data):
    """The styles are there again after `clear`, and the second run is the first."""
    text = script(data, 20)
    run = run_liggghts(tmp_path, text + "clear\n" + text.replace("end.dump", "second.dump"))
    same(run.dump(), run.dump("second.dump"))


def test_gas_profile_from_a_file(tmp_path, data):
    """A profile that is the uniform gas, with a comment and an empty row in the file."""
    (tmp_path / "gas").write_text("# x ux uy uz\n\n0 0 0 2\n0.04 0 0 2 # end\n")
    text = script(data, 20)
    uniform = run_liggghts(tmp_path, text).dump()
    profile = run_liggghts(tmp_path, text.replace("velocity 0 0 2", "profile gas x")).dump()
    same(uniform, profile)


def test_clusterdem_reads_its_dumps(tmp_path, data):
    run = run_liggghts(tmp_path, script(data, 20))
    (frame,) = read_file(run.folder / "end.dump")
    raw = run.dump()
    order = np.argsort(frame["id"])
    for name, column in (("n", "f_size[1]"), ("N_st", "f_size[4]"), ("Re", "f_drag[7]"), ("diameter", "diameter")):
        np.testing.assert_array_equal(frame[name][order], raw[column])


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("drag/cluster 1.2", "drag/cluster -1.2", "Illegal fix drag/cluster rho_g value: -1.2 (must be a number > 0"),
        ("plane xz", "plane xw", "Illegal fix drag/cluster plane value: xw (must be xy | xz | yz)"),
        ("K 0.5", "K 0.5 nonsense", "Unknown fix cluster/breakmerge keyword: nonsense"),
        ("drag drag", "drag gas", "Fix cluster/breakmerge (id size): drag fix ID gas does not exist"),
        ("cutoff 0.011", "cutoff 0.006", "use 'communicate single vel yes cutoff"),
        ("hooke/stiffness", "hertz", "needs a linear contact: pair_style gran model hooke/stiffness"),
        ("merge 0.2", "limits 3 300", "above the upper limit 300"),
    ],
)
def test_errors_in_the_words_of_liggghts(tmp_path, data, old, new, message):
    text = script(data, 0)
    assert old in text
    text = text.replace(old, new)
    if new == "hertz":
        values = {"youngsModulus": "5e6", "poissonsRatio": "0.25"}
        given = "".join(f"fix {k} all property/global {k} peratomtype {v}\n" for k, v in values.items())
        given += "fix e all property/global coefficientRestitution peratomtypepair 1 0.3\n"
        text = text.replace("pair_style", given + "pair_style")
    run = run_liggghts(tmp_path, text, check=False)
    assert run.code != 0 and "ERROR" in run.output and message in run.output


def test_the_library_is_given_by_the_wrapper_alone():
    assert LIBRARY.exists() and b"_ZN9LAMMPS_NS6ModifyC1E" in LIBRARY.read_bytes()
