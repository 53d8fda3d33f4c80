"""IDs are unique among all atoms of the system, and what is remembered by ID never meets another pair."""

import numpy as np
import pytest
from lammps_run import clusters, diameter, head, pair, run
from test_fix_cluster_breakmerge import k_for

TRACER = "tracer\n\n1 atoms\n\nCoords\n\n1 0.0 0.0 0.0\n\nTypes\n\n1 2\n\nDiameters\n\n1 2e-4\n\nMasses\n\n1 4.19e-9\n"
DUMP = "write_dump all custom end.dump id type x z modify sort id format float %.17g\n"


@pytest.mark.parametrize("np_", (1, 2, 4))
@pytest.mark.parametrize("order", ["size first", "tracers move"])
def test_tracers_of_another_group_that_come_in(tmp_path, order, np_):
    """Fix deposit counts from the highest ID that it has seen, and knows of no newborns."""
    (tmp_path / "tracer.mol").write_text(TRACER)
    script = (
        head(x=0.06, z=0.06).replace("create_box   1", "create_box   2").replace("0 0.003", "0 0.02")
        + "create_atoms 1 single 0.029 0.01 0.03\ncreate_atoms 1 single 0.039 0.01 0.03\ncreate_atoms 1 single 0.019 0.01 0.03\n"
        + f"set type 1 diameter {diameter(400)!r}\nset type 1 density 1000.0\ngroup clusters type 1\n"
        + pair()
        + "fix move all nve\nfix drag clusters drag/cluster 1.2 1.53e-5 velocity 0 0 2.0\n"
        + "fix size clusters cluster/breakmerge 10 1e-4 2000 drag drag K 0.03 terms st merge no plane xz\n"
        + "molecule tracer tracer.mol\ngroup tracers empty\nregion top block 0.001 0.059 0.001 0.019 0.05 0.058\n"
        + "fix feed tracers deposit 20 0 5 1234 mol tracer region top near 1e-3\n"
        + 'fix table all ave/time 10 1 10 f_size[*] mode scalar file out.txt format " %.17g"\ntimestep 1e-6\nrun 120\n'
        + DUMP
    )
    r = run(tmp_path, script, np_)
    row = r.dump()
    assert (row["type"] == 2).sum() == 20 and r.table()[-1, 3] >= 3  # tracers, breakups
    assert len(np.unique(row["id"])) == len(row["id"]) and row["id"].min() == 1
    assert np.all(row["id"][row["type"] == 2] > 3)


def touching(between: str, test: str = "end") -> str:
    """Two pairs in contact, at rest; the first atom is taken away between two runs."""
    d = diameter(400)
    rows = clusters(
        (400, (0.01, 0.005), (0, 0)),
        (400, (0.01, 0.02), (0, 0)),
        (400, (0.01 + 0.99 * d, 0.02), (0, 0)),
        (400, (0.03, 0.02), (0, 0)),
        (400, (0.03 + 0.99 * d, 0.02), (0, 0)),
    )
    return (
        head()
        + rows
        + pair()
        + "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law stokes\n"
        + f"fix size all cluster/breakmerge 1 1e-4 2000 drag drag K {k_for(100.5)!r} terms st merge no test {test}\ntimestep 1e-12\n"
        + 'fix table all ave/time 1 1 1 f_size[*] mode scalar file out.txt format " %.17g"\nrun 3\n'
        + between
        + "run 3\n"
    )


@pytest.mark.parametrize("np_", (1, 2, 4))
@pytest.mark.parametrize(
    "between",
    ["reset_atoms id sort yes\n", "group one id 1\ndelete_atoms group one compress yes\n"],
    ids=["reset_atoms", "delete_atoms"],
)
def test_new_ids_are_no_ended_contacts(tmp_path, between, np_):
    """With `test end`, contacts are remembered by ID: those that go on under other IDs have not ended."""
    if "delete" not in between:  # IDs in another order than before
        between = "group one id 1\ndelete_atoms group one compress no\n" + between
    r = run(tmp_path, touching(between), np_)
    assert r.table()[-1, 3] == 0  # no breakup
    assert "atoms have other IDs than in the last run" in r.output


AGAIN = "read_restart half.restart\ncomm_modify vel yes cutoff 5.7e-3\nneighbor 0.5e-3 bin\n"
ONE_GOES = "group one id 1\ndelete_atoms group one compress "


def parts_of_touching(goes: str = "") -> tuple[str, str]:
    """The first run with its restart file, and the fixes to go on with."""
    script = touching(goes)
    first = script.rsplit("run 3\n", 1)[0] + "write_restart half.restart\n"
    return first, script[script.index("fix move") : script.index("run 3")]


@pytest.mark.parametrize("np_", (1, 2, 4))
@pytest.mark.parametrize(
    "case", ["reset_atoms, then the fixes", "the fixes, then reset_atoms", "the fixes, then delete_atoms"]
)
def test_new_ids_after_a_restart_are_no_ended_contacts(tmp_path, case, np_):
    """The file holds contacts by the IDs of its time: they have not ended where IDs are given anew before the first run."""
    deletes = "delete_atoms" in case
    first, fixes = parts_of_touching("" if deletes else ONE_GOES + "no\n")
    run(tmp_path, first)
    anew = ONE_GOES + "yes\n" if deletes else "reset_atoms id sort yes\n"
    in_order = anew + fixes if case.endswith("fixes") else fixes + anew
    r = run(tmp_path, AGAIN + pair() + in_order + "run 3\n", np_)
    assert r.table()[-1, 1] == 4 and r.table()[-1, 3] == 0  # clusters, breakups
    # at reset_atoms LAMMPS drops what a file holds for fixes that are not there yet: nothing is remembered, nothing to tell
    assert ("atoms have other IDs than in the last run" in r.output) == case.startswith("the fixes")


@pytest.mark.parametrize("np_", (1, 2))
def test_the_same_ids_after_a_restart_are_no_new_ones(tmp_path, np_):
    """The pair that parts after the restart has ended its contact: what the file holds is still known."""
    first, fixes = parts_of_touching()
    run(tmp_path, first)
    r = run(tmp_path, AGAIN + pair() + fixes + "set atom 3 x 0.005\nrun 3\n", np_)
    assert "other IDs" not in r.output
    assert r.table()[-1, 3] > 0


@pytest.mark.parametrize("np_", (1, 2))
def test_ids_start_over_where_a_restart_is_given_new_ones(tmp_path, np_):
    """The same remedy after a restart: the file's highest ID counts no more. 8 clusters, IDs 5 to 8 left, which become 1 to 4."""
    size = f"fix size all cluster/breakmerge 1 1e-4 2000 drag drag K {k_for(100.5)!r} terms st merge no plane xz\n"
    fixes = (
        "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law stokes\n"
        + size
        + "timestep 1e-12\n"
    )
    rows = clusters((400, (0.01, 0.02), (0, 0)), (400, (0.03, 0.02), (0, 0)))
    first = "run 1\ngroup first id 1:4\ndelete_atoms group first compress no\nwrite_restart half.restart\n"
    run(tmp_path, head() + rows + pair() + fixes + first)
    again = AGAIN + pair() + fixes
    again += f"reset_atoms id sort yes\nset atom 1 diameter {diameter(400)!r} density 1000\nrun 1\n"
    assert list(run(tmp_path, again + DUMP, np_).dump()["id"]) == list(range(1, 8))  # 4 and 3 more, not from 9 on


def test_a_contact_that_ends_still_counts_after_new_ids(tmp_path):
    between = "reset_atoms id sort yes\nrun 2\nset atom 2 x 0.005\n"
    r = run(tmp_path, touching("group one id 1\ndelete_atoms group one compress no\n" + between))
    assert r.table()[-1, 3] > 0


@pytest.mark.parametrize("np_", (1, 2))
def test_ids_start_over_where_a_user_gives_them_anew(tmp_path, np_):
    """The remedy for IDs that run out: reset_atoms id between two runs. Newborns are numbered from there."""
    size = "fix size all cluster/breakmerge 1 1e-4 2000 drag drag K {} terms st merge no plane xz\n"
    script = (
        head()
        + clusters((400, (0.01, 0.02), (0, 0)), (400, (0.03, 0.02), (0, 0)))
        + pair()
        + "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law stokes\n"
        + size.format(k_for(100.5))
        + "timestep 1e-12\nrun 1\ngroup first id 1:4\ndelete_atoms group first compress no\nreset_atoms id sort yes\n"
        + "fix size all cluster/breakmerge 1 1e-4 2000 drag drag K 1e9 terms st merge no plane xz\nrun 0\n"
        + DUMP
    )
    # the same fix goes on: two breakups into four make 8, IDs 1 to 8; four are left and become 1 to 4
    script = script.replace(
        "fix size all cluster/breakmerge 1 1e-4 2000 drag drag K 1e9 terms st merge no plane xz\nrun 0\n",
        f"set atom 1 diameter {repr(diameter(400))} density 1000\nrun 1\n",
    )
    row = run(tmp_path, script, np_).dump()
    assert list(row["id"]) == list(range(1, 8))  # 4 and 3 more, not from 9 on
