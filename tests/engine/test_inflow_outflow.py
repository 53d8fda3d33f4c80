"""Clusters that other commands let in and take out: the particles' balance, the IDs, the order of fixes."""

import re

import numpy as np
import pytest
from lammps_run import M_P, clusters, diameter, head, pair, run, write

FED, LEFT, CLUSTERS_FED, CLUSTERS_LEFT = 25, 26, 27, 28  # entries of the vector; column 0 of its table is the step
SIZES = (100, 400)


def template(n: int) -> str:
    return (
        f"{n} particles\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\n"
        f"Diameters\n\n1 {diameter(n)!r}\n\nMasses\n\n1 {n * M_P!r}\n"
    )


def start(folder) -> str:
    folder.mkdir(parents=True, exist_ok=True)
    for n in SIZES:
        (folder / f"{n}.mol").write_text(template(n))
    return (
        head(x=0.024, z=0.024).replace("boundary     p f p", "boundary     p f f")
        + "molecule sizes 100.mol 400.mol\n"
        + clusters(*((400, (0.002 + 0.002 * k, 0.012), (0.0, 4.0)) for k in range(10)))
        + pair()
    )


MOVE = "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 5 fluctuation 2 0 2 cell 4 1 4 4e-4 5 plane xz\n"
SIZE = "fix size all cluster/breakmerge 5 1e-4 2000 drag drag K 0.2 merge 0.1\n"
FEED = (
    "region inlet block 0 0.024 0.0015 0.0015 0.003 0.005\n"
    "fix feed all deposit 1000000 0 20 5 mol sizes molfrac 0.75 0.25 region inlet near 1.4e-3 attempt 100 vz 4 5\n"
)
DRAIN = "region top block INF INF INF INF 0.021 INF\nfix out all evaporate 50 1000000 top 5\n"
TABLE = (
    'timestep 5e-6\nfix table all ave/time 20 1 20 f_size[*] mode scalar file out.txt format " %.17g"\n'
    "thermo 500\nthermo_modify lost error\n"
)
END = write("f_size[1]")
STEPS = 1000


def open_ended(folder) -> str:
    return start(folder) + MOVE + SIZE + FEED + DRAIN + TABLE


def check_balance(r, began: int) -> None:
    """Integers: as many particles and clusters as there were, came, were born, merged and left."""
    t, row = r.table(), r.dump()
    assert np.array_equal(t[:, 2], began * 400 + t[:, FED] - t[:, LEFT])
    assert np.array_equal(t[:, 1], began + t[:, 5] - t[:, 3] - t[:, 4] + t[:, CLUSTERS_FED] - t[:, CLUSTERS_LEFT])
    assert row["f_size[1]"].sum() == t[-1, 2] and len(row["id"]) == t[-1, 1] == len(np.unique(row["id"]))
    assert np.array_equal(row["f_size[1]"], np.round(row["mass"] / M_P))


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("open")
    return {n: run(folder / str(n), open_ended(folder / str(n)) + f"run {STEPS}\n" + END, n) for n in (1, 2, 4)}


@pytest.mark.parametrize("np_", [1, 2, 4])
def test_balance(runs, np_):
    last = runs[np_].table()[-1]
    assert last[CLUSTERS_FED] == STEPS // 20 and last[CLUSTERS_LEFT] > 50  # every attempt found a place
    assert last[3] > 100 and last[4] > 10  # amid breaks and merges
    check_balance(runs[np_], began=10)


@pytest.mark.parametrize("np_", [2, 4])
def test_the_same_on_any_ranks(runs, np_):
    """IDs too: they hang on places, not on the ranks' order."""
    columns = [1, 2, 3, 4, 5, 6, FED, LEFT, CLUSTERS_FED, CLUSTERS_LEFT]
    assert np.array_equal(runs[1].table()[:, columns], runs[np_].table()[:, columns])
    assert np.array_equal(runs[1].dump()["id"], runs[np_].dump()["id"])


@pytest.mark.parametrize("np_", [1, 2])
def test_over_a_restart(tmp_path, np_):
    """Totals, feed and drain go on; the result is that of the run that was cut, to the bit."""
    script = open_ended(tmp_path / "whole")
    whole = run(tmp_path / "whole", script + "run 601\nwrite_restart half.restart\nrun 399\n" + END, np_)
    again = (
        "atom_modify map hash sort 0 0\ncomm_modify vel yes cutoff 5.7e-3\nread_restart ../whole/half.restart\n"
        "neighbor 0.5e-3 bin\nmolecule sizes ../whole/100.mol ../whole/400.mol\n" + MOVE + SIZE + FEED + DRAIN + TABLE
    )
    continued = run(tmp_path / "again", again + "run 399\n" + END, np_)
    a, b = whole.table()[-1], continued.table()[-1]
    counts = [*range(1, 7), FED, LEFT, CLUSTERS_FED, CLUSTERS_LEFT]
    assert np.array_equal(a[counts], b[counts])
    assert all(np.array_equal(whole.dump()[c], continued.dump()[c]) for c in whole.dump())
    check_balance(continued, began=10)


def test_ids_grow_whatever_the_feed_says(tmp_path):
    """Fix deposit counts up from where it began (id next), fix cluster/breakmerge numbers newborns: without renumbering
    both would give out the same IDs.
    """
    script = open_ended(tmp_path).replace("near 1.4e-3", "id next near 1.4e-3")
    r = run(tmp_path, script + "run 400\n" + write("f_size[1]", name="a.dump") + "run 200\n" + END)
    before, after = r.dump("a.dump")["id"], r.dump()["id"]
    new = np.setdiff1d(after, before)
    assert r.table()[-1, 3] > 10 and len(new) > 10 and new.min() > before.max()
    check_balance(r, began=10)


def hopper(diameters: str) -> str:
    """Clusters poured into a box of three dimensions, onto a floor."""
    return (
        "units si\natom_style sphere\natom_modify map hash sort 0 0\nboundary p p f\ncomm_modify vel yes cutoff 5.7e-3\n"
        "neighbor 0.5e-3 bin\nregion box block 0 0.011 0 0.011 0 0.016\ncreate_box 1 box\n"
        + pair()
        + "fix move all nve/sphere\nfix fall all gravity 9.81 vector 0 0 -1\n"
        "fix floor all wall/gran granular hooke 10 0.3 tangential linear_history 8.57 1.0 0.33 damping coeff_restitution "
        "zplane 0 NULL\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 1\n"
        "fix size all cluster/breakmerge 5 1e-4 2000 drag drag K 0.02 merge 0.1 plane none\n"
        "region hopper block 0 0.011 0 0.011 0.010 0.015\n"
        f"fix feed all pour 60 1 5 region hopper vol 0.1 100 {diameters} vel 0 0 0 0 -1\n" + TABLE + "run 1200\n" + END
    )


@pytest.mark.parametrize("np_", [1, 2])
def test_poured(tmp_path, np_):
    """Fix pour brings a distribution of diameters by itself, in lumps; three-dimensional, on a floor."""
    d = [diameter(n) for n in SIZES]
    r = run(tmp_path, hopper(f"diam poly 2 {d[0]!r} 0.5 {d[1]!r} 0.5 dens 1000 1000"), np_)
    last = r.table()[-1]
    assert last[CLUSTERS_FED] > 20 and last[3] > 0 and last[LEFT] == 0
    check_balance(r, began=0)


def test_a_pour_of_a_range_is_told_the_diameters_that_there_are(tmp_path):
    """D = d_p (n / (1 - voidage))^(1/3), density rho_p (1 - voidage): the same as diameter() and 1000 kg/m^3 here."""
    r = run(tmp_path, hopper("diam range 0.8e-3 1.1e-3 dens 1000 1000"), check=False)
    said = " ".join(r.output.split())
    assert r.code != 0 and "which is" in said and "not a whole number" in said
    match = re.search(
        r"'diam poly N D1 P1 ...', D = (\S+) n\^\(1/3\) for n particles, and 'dens RHO RHO', RHO = (\S+)", said
    )
    assert match and [float(x) for x in match.groups()] == pytest.approx([diameter(1), 1000], rel=1e-9)
    assert "Fix pour feed pours" in said


def test_an_open_side_and_delete_atoms_count_as_left(tmp_path):
    """What crosses a fixed side with `lost ignore`, and what is deleted or added between two runs."""
    script = open_ended(tmp_path).replace(DRAIN, "").replace("lost error", "lost ignore")
    more = (
        "region low block INF INF INF INF 0 0.0015\nregion left block 0 0.012 INF INF 0.006 INF\n"
        "delete_atoms region left compress no\ncreate_atoms 1 single 0.02 0.0015 0.001\n"
        f"set region low diameter {diameter(400)!r} density 1000\n"
    )
    r = run(tmp_path, script + "run 900\n" + more + "run 100\n" + END)
    t = r.table()
    first, again = t[t[:, 0] == 900][0], t[t[:, 0] == 920][0]  # the end of the first run, early in the second
    assert first[CLUSTERS_LEFT] > 10  # through the open side
    assert again[CLUSTERS_LEFT] > first[CLUSTERS_LEFT] + 20
    assert again[CLUSTERS_FED] == first[CLUSTERS_FED] + 2  # one by create_atoms, one by the feed
    check_balance(r, began=10)


@pytest.mark.parametrize("other", ["feed", "out", "even"])
def test_order_of_fixes(tmp_path, other):
    """Fixes that add, delete or migrate clusters before the events are done would pull the ground from under them."""
    fixes = {"feed": FEED, "out": DRAIN, "even": "fix even all balance 100 1.1 shift xz 5 1.1\n"}[other]
    r = run(tmp_path, start(tmp_path) + MOVE + fixes + SIZE + TABLE + "run 0\n", check=False)
    assert r.code != 0 and "Fix cluster/breakmerge size must be defined before fix" in r.output, r.output[-800:]


def test_fed_clusters_are_looked_at(tmp_path):
    """A size that holds no whole number of particles, or more than the limits allow, stops the run where it comes in."""
    script = open_ended(tmp_path)
    (tmp_path / "100.mol").write_text(template(100).replace(repr(100 * M_P), repr(100.5 * M_P)))
    r = run(tmp_path, script + "run 100\n", check=False)
    assert r.code != 0 and "100.50 primary particles, not a whole number" in r.output
    (tmp_path / "100.mol").write_text(template(500))
    r = run(tmp_path, script.replace(SIZE, SIZE.strip() + " limits 3 450\n") + "run 100\n", check=False)
    assert r.code != 0 and "holds 500 primary particles, above the upper limit 450" in r.output, r.output[-800:]
