"""Gusts that last as long as their eddies, and gusts whose cells or clusters do not all change at once."""

import numpy as np
import pytest
from gas_files import write_field
from lammps_run import diameter, head, pair, random_clusters, run, write
from scipy.stats import kstest

RANKS = (1, 2, 4)
AXES = [np.array([0.0, 0.04]), np.array([0.0015]), np.array([0.0, 0.04])]
DRAG = "fix drag all drag/cluster 1.2 1.53e-5 field {}/gas.vtk edge x clamp {} law {} fluctuation 1 0 1 {}\n"


def still(tmp_path, gusts, steps=400, field=None, law="none", wind=(0.0, 0.0, 0.0), more="", every=1):
    """200 clusters that nothing moves, and the gas that they see on each step, dt 1 us."""
    write_field(tmp_path / "gas.vtk", AXES, list(wind), **(field or {}))
    return (
        head()
        + random_clusters(200)
        + pair()
        + "fix move all nve\n"
        + DRAG.format(tmp_path, more, law, gusts)
        + f"dump gas all custom {every} gas.dump id x z f_drag[1] f_drag[3]\ndump_modify gas sort id format float %.17g\n"
        + f"timestep 1e-6\nrun {steps}\n"
    )


def seen(r):
    """Place and gas [frame, cluster]."""
    frames = r.frames("gas.dump")
    return frames[0]["x"], np.array([f["f_drag[1]"] for f in frames]), np.array([f["f_drag[3]"] for f in frames])


def changes(u):
    return np.diff(u, axis=0) != 0


def lifetime(x):
    """From 20 to 100 us across the box."""
    return 2e-5 + 2e-3 * x


@pytest.mark.parametrize("np_", RANKS)
def test_each_cluster_has_the_lifetime_of_its_place(tmp_path, np_):
    """Gust k lasts to (k + 1) T, included: at step n there have been ceil(n dt/T) - 1 changes."""
    field = {"period": lambda x, y, z: lifetime(x)}
    x, u, w = seen(run(tmp_path / "run", still(tmp_path, "own field 3", field=field), np_))
    steps = np.arange(len(u))[:, None]
    expected = np.maximum(np.ceil(steps * 1e-6 / lifetime(x) - 1e-6) - 1, 0)
    assert np.array_equal(np.cumsum(changes(u), axis=0), expected[1:])
    assert np.array_equal(changes(u), changes(w))
    drawn = u[:1].tolist()[0] + u[1:][changes(u)].tolist()
    assert len(drawn) > 1000 and kstest(drawn, "uniform", args=(-1, 2)).pvalue > 0.01


def test_the_amplitude_is_that_of_the_file(tmp_path):
    field = {"period": lambda x, y, z: lifetime(x), "fluctuation": lambda x, y, z: (50 * x, 0 * x, 3 + 0 * x)}
    x, u, w = seen(run(tmp_path / "run", still(tmp_path, "own field 3", field=field)))
    plain, u1, w1 = seen(run(tmp_path / "plain", still(tmp_path, "own field 3", field={"period": field["period"]})))
    assert np.allclose(u, 50 * x * u1, rtol=1e-12) and np.allclose(w, 3 * w1, rtol=1e-12)


def test_what_happens_between_two_looks_is_not_lost(tmp_path):
    """With refresh 50 the gas is looked at each 50 steps, where it is that of a look at each step."""
    field = {"period": lambda x, y, z: lifetime(x)}
    for gusts in ("own field 3", "own field 3 exponential", "own field 3 stagger"):
        rows = {}
        for m in (1, 50):
            text = still(tmp_path, gusts, field=field, more=f"refresh {m}", every=50)
            rows[m] = seen(run(tmp_path / gusts.replace(" ", "-") / str(m), text))[1]
        assert np.array_equal(rows[1], rows[50])
        assert len(np.unique(rows[1][:, 0])) > 4


def test_a_crossed_eddy_ends_sooner(tmp_path):
    """Clusters at rest in a wind of (3, 0, 4) m/s leave an eddy of 0.25 mm after 50 us; where the eddy itself lasts 20 us
    to 100 us the shorter holds. Amplitudes of 1e-6 of the wind change that by 1e-6.
    """
    small = {"fluctuation": lambda x, y, z: (5e-6 + 0 * x, 0 * x, 5e-6 + 0 * x)}
    field = {"period": lambda x, y, z: lifetime(x), "eddy_size": 2.503e-4} | small
    x, u, _ = seen(run(tmp_path / "run", still(tmp_path, "own field 3", field=field, wind=(3.0, 0.0, 4.0))))
    steps = np.arange(len(u))[:, None]
    expected = np.maximum(np.ceil(steps * 1e-6 / np.minimum(lifetime(x), 2.503e-4 / 5)) - 1, 0)
    assert np.mean(lifetime(x) > 5.006e-5) > 0.4
    assert np.array_equal(np.cumsum(changes(u), axis=0), expected[1:])


def test_exponential_lifetimes(tmp_path):
    """Gusts of a mean of 100 us: in 1600 us of 200 clusters 3200 of them, whose lengths in steps go as exp(-t/T)."""
    field = {"period": 1e-4}
    _, u, _ = seen(run(tmp_path / "run", still(tmp_path, "own field 3 exponential", field=field, steps=1600)))
    count = changes(u).sum()
    # as seen on whole steps: a step of 1 us shows one change or none
    assert count == pytest.approx(200 * 1600 * (1 - np.exp(-0.01)), rel=4 / np.sqrt(3200))
    gaps = np.concatenate([np.diff(np.flatnonzero(c)) for c in changes(u).T])
    for t in (20, 100, 250):
        share = np.exp(-t / 100)
        assert np.mean(gaps > t) == pytest.approx(share, abs=4 * np.sqrt(share / len(gaps)) + 0.03)


@pytest.mark.parametrize(
    "gusts, units",
    [("cell 16 1 16 1e-4 3 stagger", "cells"), ("own 1e-4 3 stagger", "clusters"), ("own field 3 stagger", "clusters")],
)
@pytest.mark.parametrize("np_", (1, 2))
def test_staggered_gusts_do_not_change_at_once(tmp_path, gusts, units, np_):
    """Each changes once per period of 100 steps, at a phase of its own, uniform."""
    _, u, w = seen(run(tmp_path / "run", still(tmp_path, gusts, field={"period": 1e-4}, steps=300), np_))
    own = u if units == "clusters" else np.unique(u, axis=1)
    when = [np.flatnonzero(c) for c in changes(own).T]
    assert all(len(k) == 3 and np.all(np.diff(k) == 100) for k in when)
    assert kstest([k[0] for k in when], "uniform", args=(0, 100)).pvalue > 0.01
    without = seen(
        run(
            tmp_path / "at once", still(tmp_path, gusts.replace(" stagger", ""), field={"period": 1e-4}, steps=300), np_
        )
    )[1]
    assert set(np.flatnonzero(changes(without).any(axis=1))) == {100, 200}


@pytest.mark.parametrize("np_", RANKS)
@pytest.mark.parametrize("gusts", ["own field 3", "own field 3 exponential stagger", "cell 8 1 8 3e-5 3 stagger"])
def test_a_restart_goes_on_to_the_last_bit(tmp_path, gusts, np_):
    """Moving clusters that a wind drags; eddies whose size counts."""
    field = {
        "period": lambda x, y, z: lifetime(x),
        "eddy_size": 1e-4,
        "fluctuation": lambda x, y, z: (30 + 0 * x, 0 * x, 900 * x),
    }
    write_field(tmp_path / "gas.vtk", AXES, [0, 0, 2.0], **field)
    setup = head() + random_clusters(200) + pair()
    fixes = "fix move all nve\n" + DRAG.format(tmp_path, "plane xz", "stokes", gusts) + "timestep 1e-6\n"
    whole = run(tmp_path / "whole", setup + fixes + "run 150\nrun 150\n" + write("f_drag[*]"), np_).dump()
    run(tmp_path / "half", setup + fixes + "run 150\nwrite_restart half.restart\n", np_)
    again = (
        "atom_modify map hash sort 0 0\ncomm_modify vel yes cutoff 5.7e-3\nread_restart ../half/half.restart\n"
        "neighbor 0.5e-3 bin\n" + fixes + "run 150\n" + write("f_drag[*]")
    )
    continued = run(tmp_path / "again", again, np_).dump()
    for column in whole:
        assert np.array_equal(whole[column], continued[column]), column
    one = run(tmp_path / "one", setup + fixes + "run 150\nrun 150\n" + write("f_drag[*]")).dump()
    assert np.allclose(one["vx"], whole["vx"], rtol=1e-9, atol=1e-12) and np.abs(one["vx"]).max() > 1e-4


def test_a_restart_file_without_clocks_is_read(tmp_path):
    """Eddies are taken to have begun at time 0; one with clocks, by gusts that have none."""
    write_field(tmp_path / "gas.vtk", AXES, [0, 0, 0], period=2e-5)
    setup = head() + random_clusters(200) + pair() + "fix move all nve\n"
    words = {"clocks": "own field 3", "none": "own 2e-5 3"}
    gas = {}
    for written, gusts in words.items():
        fixes = DRAG.format(tmp_path, "", "none", gusts) + "timestep 1e-6\n"
        run(tmp_path / written, setup + fixes + "run 150\nwrite_restart half.restart\n")
        for read, other in words.items():
            again = (
                f"atom_modify map hash sort 0 0\ncomm_modify vel yes cutoff 5.7e-3\nread_restart ../{written}/half.restart\n"
                "neighbor 0.5e-3 bin\nfix move all nve\n" + DRAG.format(tmp_path, "", "none", other) + "run 50\n"
            )
            gas[written, read] = run(tmp_path / (written + read), again + write("f_drag[*]")).dump()["f_drag[1]"]
    # period 7 gives draw 0, gust 7 in both: one number from one key
    reference = gas["none", "none"]
    assert len(np.unique(reference)) == 200 and all(np.array_equal(reference, other) for other in gas.values())


@pytest.mark.parametrize("np_", (1, 2))
def test_fragments_begin_eddies_of_their_own(tmp_path, np_):
    """A cluster of 400 breaks into 133 at step 10, a tenth of an eddy's lifetime: each piece draws, the one that keeps the
    parent's ID as well, and its gust ends 100 steps after that, not with the parent's.
    """
    write_field(tmp_path / "gas.vtk", AXES, [0, 0, 6.0], period=1e-4)
    script = (
        head()
        + f"create_atoms 1 single 0.02 0.0015 0.02\nset type 1 diameter {diameter(400)!r} density 1000\n"
        + pair()
        + "fix move all nve\n"
        + DRAG.format(tmp_path, "", "trancong 0.8 1.1", "own field 3")
        + "fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 0.02 merge no\n"
        + "dump gas all custom 1 gas.dump id x z f_drag[1] f_drag[3]\ndump_modify gas sort id format float %.17g\n"
        + "timestep 1e-6\nrun 300\n"
    )
    frames = run(tmp_path / "run", script, np_).frames("gas.dump")
    assert [len(f["id"]) for f in (frames[9], frames[11], frames[-1])] == [1, 133, 133]
    u = np.array([f["f_drag[1]"] for f in frames[11:]])
    assert len(np.unique(u[0])) == 133 and frames[9]["f_drag[1]"][0] not in u[0]
    # seen first when the gas is asked for after the birth, at step 10 or 11
    for column in changes(u).T:
        assert np.diff(np.flatnonzero(column)).tolist() == [100] and np.flatnonzero(column)[0] + 12 in (111, 112)


@pytest.mark.parametrize(
    "gusts, said",
    [
        ("cell 4 1 4 field 3", "fluctuation PERIOD value: field (must be frozen or a time > 0)"),
        ("own often 3", "fluctuation PERIOD value: often (must be frozen, field or a time > 0)"),
        ("own frozen 3 stagger", "fluctuation option value: stagger (must be left out where PERIOD is frozen)"),
        ("own 1e-4 3 exponential", "fluctuation option value: exponential (must be left out unless PERIOD is field)"),
        (
            "own field 3",
            "Fix drag/cluster drag: fluctuation PERIOD field needs the keyword field, with an array period [time] in its file",
        ),
    ],
)
def test_bad_words(tmp_path, gusts, said):
    r = run(tmp_path / "run", still(tmp_path, gusts, steps=0), check=False)
    assert r.code != 0 and said in " ".join(r.output.split())


@pytest.mark.parametrize("array", ["period", "eddy_size"])
def test_lifetimes_and_sizes_must_be_positive(tmp_path, array):
    field = {"period": 1e-4, array: lambda x, y, z: np.where(x > 0.02, 0.0, 1e-4)}
    r = run(tmp_path / "run", still(tmp_path, "own field 3", field=field), check=False)
    assert f"array {array} is 0 at point 1 0 0" in r.output and "must be finite and > 0" in r.output
    assert run(tmp_path / "unused", still(tmp_path, "own 1e-4 3", field=field, steps=0)).code == 0
