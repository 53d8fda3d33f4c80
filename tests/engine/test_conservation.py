"""2000 steps with hundreds of events: particles exactly, mass and momentum to rounding, on any ranks."""

import numpy as np
import pytest
import scenes
from lammps_run import M_P, run

LAYOUTS = [(1, "on"), (2, "on"), (4, "on"), (1, "off"), (2, "off"), (4, "off")]


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("busy")
    return {(n, newton): run(folder / f"{n}-{newton}", scenes.busy(newton=newton), n) for n, newton in LAYOUTS}


def test_hundreds_of_events(runs):
    last = runs[1, "on"].table()[-1]
    assert last[scenes.BREAKUPS] > 300 and last[scenes.MERGES] > 30


@pytest.mark.parametrize("layout", LAYOUTS)
def test_particles_are_conserved_exactly(runs, layout):
    table, row = runs[layout].table(), runs[layout].dump()
    assert np.all(table[:, scenes.PARTICLES] == 300 * 400)
    assert row["f_size[1]"].sum() == 300 * 400
    assert np.array_equal(row["f_size[1]"], np.round(row["mass"] / M_P))
    born = table[-1, scenes.BORN] - table[-1, scenes.BREAKUPS] - table[-1, scenes.MERGES]
    assert table[-1, scenes.CLUSTERS] == 300 + born == len(row["id"])
    assert row["mass"].sum() == pytest.approx(300 * 400 * M_P, rel=1e-13)
    assert row["f_size[1]"].min() >= 3 and row["f_size[1]"].max() <= 2000
    assert len(np.unique(row["id"])) == len(row["id"])


@pytest.mark.parametrize("layout", LAYOUTS[1:])
def test_the_same_events_on_any_ranks(runs, layout):
    one, other = runs[1, "on"], runs[layout]
    counts = slice(1, 7)  # clusters … deferred, every 50 steps
    assert np.array_equal(one.table()[:, counts], other.table()[:, counts])
    assert np.array_equal(one.dump()["id"], other.dump()["id"])
    assert np.array_equal(one.dump()["f_size[1]"], other.dump()["f_size[1]"])


def test_energy_ledger(runs):
    """Energy only leaves in merges; births put in next to none."""
    row, last = runs[1, "on"].dump(), runs[1, "on"].table()[-1]
    kinetic = 0.5 * (row["mass"] * (row["vx"] ** 2 + row["vz"] ** 2)).sum()
    assert last[scenes.E_LOST] > 0.0
    assert 0.0 <= last[scenes.E_BORN] < 1e-6 * kinetic


@pytest.mark.parametrize("np_", [1, 2])
def test_momentum_is_conserved_by_contacts_breaks_and_merges(tmp_path, np_):
    """No gas drag, no gravity: only contacts and events act, so the total momentum stays."""
    gas = "fix drag all drag/cluster 1.2 1.53e-5 velocity 3 0 5 law none\n"
    script = (
        scenes.start()
        + "fix move all nve\n"
        + gas
        + "fix size all cluster/breakmerge 3 1e-4 2000 drag drag K 0.3 terms cc mf merge 0.2 umf 0.001 epsmf 0 gravity 0.001 z\n"
        "timestep 2e-6\nvariable px equal vcm(all,x)*mass(all)\nvariable pz equal vcm(all,z)*mass(all)\n"
        'fix p all ave/time 1 1 100 v_px v_pz file p.txt format " %.17g"\n'
        + scenes.outputs()
        + "run 4000\n"
        + scenes.final()
    )
    r = run(tmp_path, script, np_)
    last, p = r.table()[-1], r.table("p.txt")
    assert last[scenes.BREAKUPS] > 20 and last[scenes.MERGES] > 5
    scale = 300 * 400 * M_P * 2.0
    # each contact, break and merge rounds at 1e-16 of a cluster's momentum
    assert np.abs(p[:, 1:] - p[0, 1:]).max() < 1e-12 * scale


def test_a_cluster_that_leaves_is_not_hidden_by_events(tmp_path):
    """Events go on while a cluster flies out of a fixed side: the engine must still find it missing."""
    script = scenes.busy(steps=1000).replace("boundary     p f p", "boundary     f f p")
    script = script.replace("fix move all nve\n", "set atom 7 x 0.0399 vx 30.0\nfix move all nve\n")
    r = run(tmp_path, script, check=False)
    assert r.code != 0 and "Lost atoms" in r.output
    assert r.table()[-1, scenes.BREAKUPS] > 0
