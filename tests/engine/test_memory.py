"""Whose memory is it: what is kept per cluster stays with its cluster when clusters vanish, come, or change places in
the engine's arrays, and nothing is written beside them. `./run sanitize` runs this with an engine that watches.
"""

import gzip
from pathlib import Path

import numpy as np
import pytest
from lammps_run import D_P, M_P, RHO_P, Run, clusters, diameter, head, pair, run
from test_fix_cluster_breakmerge import NU_G, RHO_G, TOUCH, k_for

LENGTH = 0.04  # of the box in x and z [m]
V = (1.0, 0.0)  # of all clusters [m/s]; alike, so that those which touch merge
STOKES = 3 * np.pi * RHO_G * NU_G  # drag over diameter and slip [Pa s]
GAP = float(TOUCH * diameter(300))  # between the centres of two clusters of 300 that touch [m]


# ---- dump_modify sort id: the engine keeps a shortcut from the start of the run, for as long as N is the same ----


def columns_of(path: Path) -> dict[str, list[float]]:
    from clusterdem import read_file

    (frame,) = read_file(path)
    return {"id": frame["id"].tolist(), "x": frame["x"].tolist()}


def atom_rows(path: Path) -> dict[str, list[float]]:
    text = gzip.open(path, "rt").read() if path.suffix == ".gz" else path.read_text()
    rows = np.array([line.split() for line in text.partition("ITEM: ATOMS id type xs ys zs\n")[2].splitlines()], float)
    return {"id": rows[:, 0].tolist(), "x": (rows[:, 2] * LENGTH).tolist()}


def cfg_rows(path: Path) -> dict[str, list[float]]:
    """Rows of five numbers, xs ys zs id x, among lines of other lengths and the words of the header."""
    words = [line.split() for line in path.read_text().splitlines()]
    rows = np.array([row for row in words if len(row) == 5 and "=" not in row], float)
    return {"id": rows[:, 3].tolist(), "x": rows[:, 4].tolist()}


def xyz_rows(path: Path) -> dict[str, list[float]]:
    return {"x": [float(line.split()[1]) for line in path.read_text().splitlines()[2:]]}


READERS = {
    "custom 1 frame.*.dump id x z diameter mass": columns_of,
    "custom 1 frame.*.bin id x z diameter mass": columns_of,
    "custom/gz 1 frame.*.dump.gz id x z diameter mass": columns_of,
    "custom/zstd 1 frame.*.dump.zst id x z diameter mass": columns_of,
    "atom 1 frame.*.dump": atom_rows,
    "atom/gz 1 frame.*.dump.gz": atom_rows,
    "cfg 1 frame.*.cfg mass type xs ys zs id x": cfg_rows,
    "xyz 1 frame.*.xyz": xyz_rows,
}


def one_merge_and_one_break() -> str:
    """1 stays, 2 and 3 merge, 4 breaks into 4 and 5: four before, four after, but no ID 3."""
    return clusters(
        (300, (0.005, 0.02), V), (300, (0.02, 0.005), V), (300, (0.02 + GAP, 0.005), V), (1600, (0.03, 0.03), V)
    )


def events(options: str) -> str:
    """Frozen in time (dt = 1e-12 s), so that an event alone changes the state."""
    return (
        "fix move all nve\n"
        f"fix drag all drag/cluster {RHO_G} {NU_G} velocity 0 0 2 law stokes\n"
        f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag {options}\n"
        "timestep 1e-12\n"
    )


@pytest.mark.parametrize("np_", [1, 2])
@pytest.mark.parametrize("dump", READERS)
def test_sorted_dump_of_as_many_clusters_under_other_ids(tmp_path, dump, np_):
    script = (
        head()
        + one_merge_and_one_break()
        + pair()
        + events(f"K {k_for(799.5, v=V)!r} terms st")
        + f"dump d all {dump}\ndump_modify d sort id\nrun 1\n"
        + "write_dump all custom end.dump id x mass f_size[1] modify format float %.17g\n"
    )
    r = run(tmp_path, script, np_)
    end = r.dump()
    assert end["id"].tolist() == [1, 2, 4, 5] and end["f_size[1]"].tolist() == [300, 600, 799, 801]
    name = dump.split()[2].replace("*", "1")
    seen = READERS[dump](tmp_path / name)
    assert seen.get("id", [1, 2, 4, 5]) == [1, 2, 4, 5]
    assert seen["x"] == pytest.approx(end["x"].tolist(), rel=1e-5)  # %g has six digits


# ---- the columns of fix drag/cluster ----

FLYING = 25.0  # m/s: past half a skin in ten steps, through a rank's part of the box in some hundred


def flying(count: int = 40) -> str:
    """Clusters of 10 to 400 particles that fly any way, through each other."""
    rng = np.random.default_rng(11)
    places, ways = rng.uniform(0, 0.04, (count, 2)), rng.uniform(-FLYING, FLYING, (count, 2))
    sizes = np.linspace(10, 400, count).astype(int)
    return clusters(*[(int(n), tuple(map(float, x)), tuple(map(float, v))) for n, x, v in zip(sizes, places, ways)])


def with_memory(base: str = "1+0.1*id") -> str:
    """The gas at a cluster is `base` and half of what it was at the same cluster one step ago."""
    return (
        f"variable w atom {base}+0.5*f_drag[3]\nfix drag all drag/cluster {RHO_G} {NU_G} velocity 0 0 v_w law stokes\n"
    )


EVERY_FRAME = (
    "dump all all custom 1 all.dump id type x z vx vz radius mass f_drag[3] f_drag[4] f_drag[6]\n"
    "dump_modify all format float %.17g\n"
)


def assert_own_gas(r: Run, frames: list[dict], ids=None) -> None:
    """w(0) = a, w(t) = a + w(t-1) / 2 with a = 1 + 0.1 ID: w(t) = a (2 - 2^-t); and the drag is of just that gas."""
    for step, row in enumerate(frames):
        own = np.isin(row["id"], ids) if ids is not None else np.ones(len(row["id"]), bool)
        w = (1 + 0.1 * row["id"]) * (2 - 0.5**step)
        np.testing.assert_allclose(row["f_drag[3]"][own], w[own], rtol=1e-12, err_msg=f"step {step}")
        b = STOKES * 2 * row["radius"]
        np.testing.assert_allclose(row["f_drag[6]"], b * (row["f_drag[3]"] - row["vz"]), rtol=1e-12)
        np.testing.assert_allclose(row["f_drag[4]"], -b * row["vx"], rtol=1e-12)


@pytest.mark.parametrize("np_", [1, 2, 4])
def test_drag_columns_go_with_clusters_to_other_ranks(tmp_path, np_):
    """Velocities stay as they are (nve/noforce), so the drag follows from what the dump shows."""
    script = head() + flying() + pair() + "fix move all nve/noforce\n" + with_memory() + EVERY_FRAME
    r = run(tmp_path, script + "timestep 1e-6\nrun 200\n", np_)
    assert_own_gas(r, r.frames("all.dump"))


@pytest.mark.parametrize("np_", [1, 2])
def test_drag_columns_go_with_clusters_that_take_the_place_of_others(tmp_path, np_):
    """1 and 2 merge; the last in the arrays moves to where 2 was."""
    rows = clusters(
        (300, (0.01, 0.01), V), (300, (0.01 + GAP, 0.01), V), (500, (0.01, 0.015), V), (50, (0.012, 0.015), V)
    )
    size = f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag K 1 terms mf\n"
    script = head() + rows + pair() + "fix move all nve/noforce\n" + with_memory() + size + EVERY_FRAME
    r = run(tmp_path, script + "timestep 1e-12\nrun 3\n", np_)
    frames = r.frames("all.dump")
    assert frames[-1]["id"].tolist() == [1, 3, 4]
    assert_own_gas(r, frames, ids=[3, 4])


DRAG_COLUMNS = [f"f_drag[{k}]" for k in range(1, 9)]
WRITE_DRAG = "write_dump all custom {} id x z f_drag[*] f_size[*] modify sort id format float %.17g\n"


def before_and_after(folder, change: str, np_: int) -> tuple[dict, dict]:
    """Columns after a run, and again after a command that changes which clusters there are or whose rank they are on."""
    script = (
        head()
        + flying()
        + pair()
        + "fix move all nve/noforce\n"
        + f"variable w atom 1+x/0.04\nfix drag all drag/cluster {RHO_G} {NU_G} velocity 0.5 0 v_w law stokes\n"
        + f"fix size all cluster/breakmerge 1000 {D_P} {RHO_P} drag drag K 1 break no merge no\n"
        + "timestep 1e-6\nrun 10\n"
        + WRITE_DRAG.format("before.dump")
        + change
        + WRITE_DRAG.format("after.dump")
    )
    r = run(folder, script, np_)
    return r.dump("before.dump"), r.dump("after.dump")


@pytest.mark.parametrize(
    "np_, change",
    [
        (1, "region c block 0 0.02 INF INF INF INF\ndelete_atoms region c compress no\n"),
        (2, "region c block 0 0.02 INF INF INF INF\ndelete_atoms region c compress no\n"),
        (2, "displace_atoms all move 0.017 0 0.011 units box\n"),
        (2, "balance 1.0 z 0.3\n"),
    ],
    ids=["delete_atoms 1", "delete_atoms 2", "displace_atoms 2", "balance 2"],
)
def test_drag_columns_between_runs(tmp_path, np_, change):
    before, after = before_and_after(tmp_path, change, np_)
    order = np.searchsorted(before["id"], after["id"])
    assert np.array_equal(before["id"][order], after["id"]) and len(order) > 10
    for name in [*DRAG_COLUMNS, "f_size[1]", "f_size[2]", "f_size[3]"]:
        assert np.array_equal(after[name], before[name][order]), name


def test_drag_columns_of_clusters_that_were_created_between_runs(tmp_path):
    """More than the engine's arrays had room for: 0 until drag acts on them, as for all that has no drag yet."""
    created = 20000  # the engine makes room for 16384 at a time
    script = (
        head()
        + flying()
        + pair()
        + f"fix move all nve\nfix drag all drag/cluster {RHO_G} {NU_G} velocity 0.5 0 2 law stokes\n"
        + "timestep 1e-6\nrun 1\nwrite_dump all custom before.dump id f_drag[*] modify sort id format float %.17g\n"
        + f"create_atoms 1 random {created} 5 NULL\n"
        + "write_dump all custom after.dump id f_drag[*] modify sort id format float %.17g\n"
    )
    r = run(tmp_path, script)
    before, after = r.dump("before.dump"), r.dump("after.dump")
    old = len(before["id"])
    assert len(after["id"]) == old + created
    for name in DRAG_COLUMNS:
        assert np.array_equal(after[name][:old], before[name]), name
        assert not after[name][old:].any(), name


def test_mean_drag_as_a_feedback_while_births_outgrow_the_arrays(tmp_path):
    """A variable looks at the drag columns of this very step's newborns, beyond the 16384 that there was room for."""
    count, n = 1500, 400
    d = float(diameter(n))
    script = (
        head(x=0.3, z=0.3)
        + f"region plane block 0 0.3 0.0015 0.0015 0 0.3\ncreate_atoms 1 random {count} 77 plane overlap {d!r} maxtry 1000\n"
        + f"reset_atoms id sort yes\nset type 1 diameter {d!r}\nset type 1 density 1000.0\n"
        + pair()
        + "fix move all nve\n"
        + f"fix drag all drag/cluster {RHO_G} {NU_G} velocity 0 0 v_w plane xz law stokes\n"
        + "compute sum all reduce sum f_drag[6]\nvariable w equal 2.0+0.0*c_sum\n"
        + f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag K {k_for(20.5)!r} terms st merge no\n"
        + 'fix out all ave/time 1 1 1 c_sum f_drag[3] f_size[1] f_size[2] mode scalar file out.txt format " %.17g"\n'
        + "timestep 1e-9\nrun 12\nwrite_dump all custom end.dump id vz radius f_drag[6] modify format float %.17g\n"
    )
    r = run(tmp_path, script)
    table = r.table()
    assert table[-1, 3] > 16384 and np.all(table[:, 4] == count * n)
    np.testing.assert_allclose(table[:, 1], table[:, 2], rtol=1e-12)  # the rows add up to the fix's own total


# ---- what a gas variable may ask for ----


@pytest.mark.parametrize("checks", [False, True])
@pytest.mark.parametrize("np_", [1, 2])
def test_gas_that_follows_the_total_drag(tmp_path, np_, checks):
    """A controller: w(t) = 2 - F(t-1) / (2 C), where F(t) = C w(t) on clusters at rest, so w(t) = 2 - w(t-1) / 2.
    What the fix shows after a step must be the drag of that step.
    """
    sizes = (400, 300)
    c = STOKES * sum(float(diameter(n)) for n in sizes)
    script = (
        head()
        + clusters((sizes[0], (0.01, 0.01), (0, 0)), (sizes[1], (0.03, 0.02), (0, 0)))
        + pair()
        + "fix move all nve/noforce\n"
        + f"variable w equal 2.0-0.5*f_drag[3]/{c!r}\n"
        + f"fix drag all drag/cluster {RHO_G} {NU_G} velocity 0 0 v_w law stokes\n"
        + (
            f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag K 1 terms st break no merge no\n"
            if checks
            else ""
        )
        + "compute rows all reduce sum f_drag[6]\ncompute gas all reduce max f_drag[3]\n"
        + 'fix out all ave/time 1 1 1 f_drag[3] c_rows c_gas mode scalar file out.txt format " %.17g"\n'
        + "timestep 1e-6\nrun 6\n"
    )
    table = run(tmp_path, script, np_).table()
    w = [2.0]  # F is 0 before the first step
    for _ in range(6):
        w.append(2.0 - 0.5 * w[-1])
    assert table[:, 3] == pytest.approx(w[-len(table) :], rel=1e-12)
    assert table[:, 1] == pytest.approx(c * table[:, 3], rel=1e-12)
    assert table[:, 2] == pytest.approx(table[:, 1], rel=1e-12)


@pytest.mark.parametrize("np_", [1, 2])
def test_gas_from_chunks_of_the_box_is_each_clusters_own(tmp_path, np_):
    """The gas follows from the mass in a quarter of the box, which no event changes.

    `compute chunk/atom` remembers for a whole step, by place in the engine's arrays, who is in which quarter. In the
    first quarter 1 and 2 merge; a fragment of the third takes the place of 2.
    """
    pairing = [(300, (0.005, 0.01), V), (300, (0.005 + GAP, 0.01), V)]
    breaking = [(1600, (0.025, 0.03), V)]
    others = [(40 + 10 * k, (0.006 + 0.01 * (k % 4), 0.003 + 0.001 * k), V) for k in range(8)]
    third = 1600 + sum(n for n, (x, _), _ in others if 0.02 < x < 0.03)
    k = k_for(799.5, gas=(0, 1 + third * M_P / 1e-5), v=V)  # what holds 1600 breaks, no more
    script = (
        head()
        + clusters(*pairing, *breaking, *others)
        + pair()
        + "compute quarter all chunk/atom bin/1d x 0.0 0.01 units box\ncompute m all property/atom mass\n"
        + "compute sum all reduce/chunk quarter sum c_m\ncompute mine all chunk/spread/atom quarter c_sum\n"
        + "variable w atom 1+c_mine/1e-5\nfix move all nve/noforce\n"
        + f"fix drag all drag/cluster {RHO_G} {NU_G} velocity 0 0 v_w law stokes\n"
        + f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag K {k!r} terms st\n"
        + "dump all all custom 1 all.dump id x mass f_drag[3]\ndump_modify all format float %.17g\n"
        + "timestep 1e-12\nrun 3\n"
    )
    r = run(tmp_path, script, np_)
    frames = r.frames("all.dump")
    assert frames[-1]["id"].tolist() == [1, *range(3, 13)]  # 2 went, 12 came
    for step, row in enumerate(frames):
        quarter = np.floor(row["x"] / 0.01).astype(int)
        mass = np.bincount(quarter, weights=row["mass"], minlength=4)
        np.testing.assert_allclose(row["f_drag[3]"], 1 + mass[quarter] / 1e-5, rtol=1e-12, err_msg=f"step {step}")
