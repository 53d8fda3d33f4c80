"""fix cluster/breakmerge on the real engine: single events, readings, limits."""

import numpy as np
import pytest
from lammps_run import D_P, M_P, RHO_P, clusters, diameter, head, pair, random_clusters, run, write

NU_G, RHO_G, G = 1.53e-5, 1.2, 9.81
COLUMNS = [f"f_size[{k}]" for k in range(1, 7)]


def k_for(n_l: float, gas=(0.0, 2.0), v=(0.0, 0.0)) -> float:
    """K that makes l the diameter of n_l particles where N_st (Stokes drag on primary particles) acts alone."""
    u, w = np.array(gas), np.array(v)
    b = 3 * np.pi * RHO_G * NU_G * D_P
    return float(diameter(n_l) * b * (u - w) @ u / M_P)


def scene(rows: str, size: str, steps: int = 1, gas: str = "velocity 0 0 2", fixes: str = "", dt: float = 1e-12, **box):
    """Frozen in time (dt = 1e-12 s), so that an event alone changes the state."""
    return (
        head(**box)
        + rows
        + pair()
        + "fix move all nve\n"
        + f"fix drag all drag/cluster {RHO_G} {NU_G} {gas} law stokes\n"
        + fixes
        + f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag {size}\n"
        + f'timestep {dt}\nfix table all ave/time 1 1 1 f_size[*] mode scalar file out.txt format " %.17g"\n'
        + f"run {steps}\n"
        + write("xu", "zu", *COLUMNS)
    )


def gaps(row: dict, box=(0.04, 0.04)) -> np.ndarray:
    """Gaps between all pairs, nearest images."""
    d = [row[c][:, None] - row[c][None, :] for c in ("x", "z")]
    d = [e - length * np.round(e / length) for e, length in zip(d, box)]
    gap = np.hypot(*d) - 0.5 * (row["diameter"][:, None] + row["diameter"][None, :])
    return gap[np.triu_indices(len(gap), 1)]


@pytest.mark.parametrize("place", [(0.02, 0.02), (1e-4, 0.02), (0.0399, 3e-4)])
@pytest.mark.parametrize(
    "n, n_l, pieces",
    [(400, 199, [199, 201]), (400, 120, [120] * 3 + [40]), (401, 100, [100] * 3 + [101]), (50, 3, [3] * 15 + [5])],
)
def test_one_cluster_breaks_into_the_plan(tmp_path, n, n_l, pieces, place):
    v = (0.3, -0.2)
    script = scene(clusters((n, place, v)), f"K {k_for(n_l + 0.5, v=v)!r} terms st")
    row = run(tmp_path, script).dump()
    assert sorted(row["f_size[1]"].astype(int)) == sorted(pieces)
    assert row["mass"] == pytest.approx(row["f_size[1]"] * M_P, rel=1e-15)
    assert row["diameter"] == pytest.approx([diameter(k) for k in row["f_size[1]"]], rel=1e-15)
    # momentum and centre of mass to rounding of coordinates of order 0.04
    assert row["vx"] == pytest.approx(v[0], abs=1e-11) and row["vz"] == pytest.approx(v[1], abs=1e-9)  # dt a
    assert (row["mass"] * row["xu"]).sum() / row["mass"].sum() == pytest.approx(place[0], abs=1e-11)
    assert (row["mass"] * row["zu"]).sum() / row["mass"].sum() == pytest.approx(place[1], abs=1e-11)
    assert np.all(row["y"] == 0.0015)
    assert gaps(row).min() >= 0.0
    assert np.all(row["id"] == np.arange(1, len(pieces) + 1))  # the parent is the first piece


def test_hysteresis(tmp_path):
    for h, count in ((0.26, 1), (0.25, 2)):
        script = scene(clusters((400, (0.02, 0.02), (0, 0))), f"K {k_for(202)!r} terms st hysteresis {h}")
        # d/l = (400/202)^(1/3) = 1.2558
        assert len(run(tmp_path / str(h), script).dump()["id"]) == count


def test_fragments_find_room_among_neighbours(tmp_path):
    """Every cluster of a crowded box breaks; nobody overlaps a newborn, and no energy is put in."""
    script = scene(random_clusters(250), f"K {k_for(60.5)!r} terms st", steps=30)
    r = run(tmp_path, script)
    row, table = r.dump(), r.table()
    assert gaps(row).min() >= 0.0
    assert table[-1, 3] > 100 and table[-1, 8] == 0.0  # breakups; energy put in
    assert row["f_size[1]"].sum() == 250 * 400


def test_large_breaks_go_in_stages(tmp_path):
    script = scene(clusters((2000, (0.02, 0.02), (0, 0))), f"K {k_for(3)!r} terms st claim 2e-3", steps=1)
    row = run(tmp_path / "one", script).dump()
    assert 1 < len(row["id"]) < 60 and row["f_size[1]"].sum() == 2000
    reach = np.hypot(row["x"] - 0.02, row["z"] - 0.02) + 0.5 * row["diameter"]
    assert reach.max() <= 2e-3
    row = run(tmp_path / "many", script.replace("run 1\n", "run 200\n")).dump()
    # time stands still here: those in the middle of the crowd wait for room
    assert row["f_size[1]"].sum() == 2000 and len(row["id"]) > 100 and gaps(row).min() >= 0.0


def test_walls_hold_fragments_in(tmp_path):
    """Clusters break all over a box with walls in x: no fragment is born beyond one."""
    text = scene(random_clusters(200), f"K {k_for(60.5)!r} terms st", steps=20)
    text = text.replace("boundary     p f p", "boundary     f f p").replace(
        "plane block EDGE EDGE", "plane block 6e-4 0.0394"
    )
    r = run(tmp_path, text)
    row = r.dump()
    assert r.table()[-1, 3] > 80
    assert (row["x"] - 0.5 * row["diameter"]).min() >= 0.0 and (row["x"] + 0.5 * row["diameter"]).max() <= 0.04


TOUCH = 0.999  # of the sum of radii


def two(n1=400, n2=300, v1=(1.0, 0.0), v2=(1.0, 0.0), x=0.02):
    gap = TOUCH * 0.5 * (diameter(n1) + diameter(n2))
    return clusters((n1, (x, 0.02), v1), (n2, ((x + gap) % 0.04, 0.02), v2)), gap


@pytest.mark.parametrize("x", [0.02, 0.0397])
def test_two_clusters_merge(tmp_path, x):
    rows, gap = two(v1=(1.0, 0.004), v2=(1.0, 0.0), x=x)
    r = run(tmp_path, scene(rows, "K 1 terms mf"))
    row, table = r.dump(), r.table()
    assert list(row["id"]) == [1] and list(row["f_size[1]"]) == [700]
    assert (row["xu"][0] - x) % 0.04 == pytest.approx(300 / 700 * gap, abs=1e-12)
    assert row["vz"][0] == pytest.approx(400 / 700 * 0.004, abs=1e-9)
    assert row["vx"][0] == pytest.approx(1.0, abs=1e-9)
    assert row["mass"][0] == pytest.approx(700 * M_P, rel=1e-15)
    assert table[-1, 1:5].tolist() == [1, 700, 0, 1]
    lost = 0.5 * M_P * 400 * 300 / 700 * 0.004**2
    assert table[-1, 7] == pytest.approx(lost, rel=1e-6)


@pytest.mark.parametrize(
    "what, rows, size",
    [
        ("too fast", two(v2=(1.0, 0.011))[0], "K 1 terms mf"),
        ("slow partner", two(v1=(1.0, 0.0), v2=(0.0, 0.0))[0], "K 1 terms mf"),
        ("too many", two(1200, 801)[0], "K 1 terms mf"),
        ("larger than l", two(400, 300)[0], f"K {k_for(699, gas=(0, 2), v=(1, 0))!r} terms st"),
        ("off", two()[0], "K 1 terms mf merge no"),
        (
            "apart",
            clusters((400, (0.02, 0.02), (1, 0)), (400, (0.02 + 1.001 * diameter(400), 0.02), (1, 0))),
            "K 1 terms mf",
        ),
    ],
)
def test_no_merge(tmp_path, what, rows, size):
    assert len(run(tmp_path, scene(rows, size)).dump()["id"]) == 2, what


def test_the_largest_size_can_be_reached(tmp_path):
    assert run(tmp_path, scene(two(1200, 800)[0], "K 1 terms mf")).dump()["f_size[1]"].tolist() == [2000]


def test_merge_tolerance(tmp_path):
    rows = two(v2=(1.0, 0.4))[0]
    assert len(run(tmp_path, scene(rows, "K 1 terms mf merge 0.5")).dump()["id"]) == 1


def test_refused_merge_may_break(tmp_path):
    rows = two(1500, 900)[0]
    assert len(run(tmp_path / "leave", scene(rows, "K 1 terms mf refused leave")).dump()["id"]) == 2
    # 2000 and 400 particles two diameters apart reach 3.1 mm from their centre of mass
    r = run(tmp_path / "break", scene(rows, "K 1 terms mf refused break claim 4e-3", ghost=9e-3))
    row = r.dump()
    assert sorted(row["f_size[1]"]) == [400, 2000]
    assert gaps(row).min() >= 0.0
    x, gap = 0.02, two(1500, 900)[1]
    assert (row["mass"] * row["xu"]).sum() / row["mass"].sum() == pytest.approx(x + 900 / 2400 * gap, abs=1e-12)
    assert r.table()[-1, 1:6].tolist() == [2, 2400, 1, 1, 2]  # clusters = 2 + born - breakups - merges


def test_best_partner_wins(tmp_path):
    """Three in a row: the middle one merges with the one that moves more alike."""
    d = diameter(100)
    rows = clusters(
        (100, (0.02, 0.02), (1, 0.006)),
        (100, (0.02 + TOUCH * d, 0.02), (1, 0)),
        (100, (0.02 + 2 * TOUCH * d, 0.02), (1, 0.003)),
    )
    row = run(tmp_path, scene(rows, "K 1 terms mf")).dump()
    assert row["id"].tolist() == [1, 2] and row["f_size[1]"].tolist() == [100, 200]


def test_merge_that_would_press_into_a_third_waits(tmp_path):
    rows, gap = two(400, 400)
    third = f"create_atoms 1 single {0.02 + gap / 2!r} 0.0015 {0.02 + 0.8e-3!r}\nset atom 3 diameter {diameter(100)!r}\nset atom 3 density 1000.0\nset atom 3 vx -1.0\n"
    r = run(tmp_path / "near", scene(rows + third, "K 1 terms mf"))
    assert len(r.dump()["id"]) == 3 and r.table()[-1, 6] == 1  # deferred
    r = run(tmp_path / "far", scene((rows + third).replace(repr(0.02 + 0.8e-3), repr(0.02 + 0.9e-3)), "K 1 terms mf"))
    assert len(r.dump()["id"]) == 2 and r.table()[-1, 8] == 0.0


# ---- readings, against the formulas of MODEL.md section 2 ----


def stokes(d):
    return 3 * np.pi * RHO_G * NU_G * d


def measured(tmp_path, size, count=120):
    script = (
        head()
        + random_clusters(count)
        + pair()
        + "variable u atom random(-4,4,77)\nvariable w atom random(-4,4,78)\nvelocity all set v_u 0.0 v_w\nfix move all nve\n"
        + f"fix drag all drag/cluster {RHO_G} {NU_G} velocity 0.5 0 2 law stokes fluctuation 0.7 0 0.7 cell 7 1 7 frozen 3\n"
        + f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag {size}\nrun 0\n"
        + write("f_drag[*]", *COLUMNS)
    )
    row = run(tmp_path, script).dump()
    assert np.abs(row["vz"]).max() > 1e-3
    return row


U_MF = 6.46e-3


@pytest.mark.parametrize("nst", ["particle", "cluster", "cell"])
def test_n_st(tmp_path, nst):
    row = measured(tmp_path, f"K 1 terms st nst {nst} grid 4 1 4")
    u = np.array([row["f_drag[1]"], row["f_drag[3]"]])
    slip = u - np.array([row["vx"], row["vz"]])
    single = stokes(D_P) * (slip * u).sum(axis=0) / M_P
    own = stokes(row["diameter"]) * (slip * u).sum(axis=0) / row["mass"]
    cell = (row["x"] // 0.01).astype(int) * 4 + (row["z"] // 0.01).astype(int)
    total = np.bincount(cell, own * row["mass"]) / np.maximum(np.bincount(cell, row["mass"]), 1e-30)
    expected = {"particle": single, "cluster": own, "cell": total[cell]}[nst]
    assert row["f_size[4]"] == pytest.approx(expected, rel=1e-11)
    assert np.all(row["f_size[5]"] == 0) and np.all(row["f_size[6]"] == 0)
    assert row["f_size[4]"].min() < 0.0 or nst == "cell"  # signed


@pytest.mark.parametrize("nsmf, c", [("emms", 0.4), ("paper", 1.0)])
@pytest.mark.parametrize("up", ["own", "cell", "superficial"])
def test_n_smf(tmp_path, nsmf, c, up):
    row = measured(tmp_path, f"K 1 terms mf nsmf {nsmf} up {up} epsmf 0.4 umf 0.01 grid 4 1 4 gravity 9.7 z")
    cell = (row["x"] // 0.01).astype(int) * 4 + (row["z"] // 0.01).astype(int)
    mass = np.bincount(cell, row["mass"], 16)
    mean = (np.bincount(cell, row["mass"] * np.abs(row["vz"]), 16) / np.maximum(mass, 1e-30))[cell]
    fraction = (mass / RHO_P / (0.01 * 0.003 * 0.01))[cell]
    speed = {"own": np.abs(row["vz"]), "cell": mean, "superficial": fraction * mean}[up]
    assert row["f_size[6]"] == pytest.approx((0.01 + c * speed / 0.6) * 9.7, rel=1e-11)
    assert np.all(row["f_size[3]"] == pytest.approx(diameter(2000)))  # E_in* < 0: the upper limit


def test_wen_yu_and_k_emms(tmp_path):
    row = measured(tmp_path, "K emms 0.01 terms st mf")
    n_smf = row["f_size[6]"]
    u_mf = (n_smf / G - np.abs(row["vz"]))[0]
    assert u_mf == pytest.approx(U_MF, abs=5e-6)  # 6.46 mm/s, as published
    k = D_P * (0.01 / 0.0003 - (u_mf + 0.5 * 0.01 / 0.5)) * G
    e = row["f_size[4]"] - n_smf
    lo, hi = diameter(3), diameter(2000)
    expected = np.where(e > 0, np.clip(k / np.where(e > 0, e, 1.0), lo, hi), hi)
    assert row["f_size[3]"] == pytest.approx(expected, rel=1e-9)
    assert 5 < np.count_nonzero((expected > lo) & (expected < hi))


@pytest.mark.parametrize(
    "test, at_once, later", [("always", True, True), ("contact", False, False), ("end", False, False)]
)
def test_which_clusters_are_tested(tmp_path, test, at_once, later):
    """A touching pair (1, 2) that parts, and one alone (3), all above (1 + h) l."""
    rows, _ = two(400, 400, v1=(-1.0, 0.0), v2=(1.0, 0.0))
    rows += (
        f"create_atoms 1 single 0.005 0.0015 0.005\nset atom 3 diameter {diameter(400)!r}\nset atom 3 density 1000.0\n"
    )
    size = f"K {k_for(100)!r} terms st merge no test {test}"
    first = run(tmp_path / "first", scene(rows, size))  # the pair still touches
    last = run(tmp_path / "last", scene(rows, size, steps=30, dt=1e-7))  # it has parted
    for result, alone in ((first, at_once), (last, later)):
        assert (result.dump()["f_size[1]"][2] < 400) == alone
    assert last.dump()["f_size[1]"][:2].min() < 400  # one may wait for the other's fragments to leave
    assert (first.table()[-1, 3] == 0) == (test == "end")


def test_without_breaks_or_merges_nothing_happens(tmp_path):
    r = run(tmp_path, scene(two()[0], f"K {k_for(50)!r} terms st break no merge no", steps=5))
    assert len(r.dump()["id"]) == 2 and r.table()[-1, 3:7].tolist() == [0, 0, 0, 0]


def test_space_instead_of_a_plane(tmp_path):
    """Plane none: fragments fill a lattice in space."""
    rows = f"create_atoms 1 single 0.01 0.01 0.01\nset atom 1 diameter {diameter(2000)!r}\nset atom 1 density 1000.0\n"
    script = scene(rows, f"K {k_for(50.5)!r} terms st plane none").replace("boundary     p f p", "boundary p p p")
    script = script.replace("0 0.003 0 0.04", "0 0.02 0 0.04")
    row = run(tmp_path, script).dump()
    assert len(row["id"]) == 40 and np.unique(np.round(row["y"], 9)).size > 3
    p = np.array([row[c] for c in "xyz"])
    gap = np.sqrt(((p[:, :, None] - p[:, None, :]) ** 2).sum(axis=0)) - row["diameter"][0]
    assert gap[np.triu_indices(40, 1)].min() >= 0.0
    assert p.mean(axis=1) == pytest.approx([0.01, 0.01, 0.01], abs=1e-12)


def test_newborns_draw_a_fluctuation_of_their_own(tmp_path):
    gas = "velocity 0 0 2 fluctuation 0.1 0 0.1 own frozen 5"
    before = run(
        tmp_path / "a",
        scene(clusters((400, (0.02, 0.02), (0, 0))), "K 100 terms st", gas=gas, steps=0).replace(
            write("xu", "zu", *COLUMNS), write("f_drag[*]")
        ),
    ).dump()["f_drag[1]"]
    row = run(
        tmp_path / "b",
        scene(clusters((400, (0.02, 0.02), (0, 0))), f"K {k_for(50)!r} terms st", gas=gas).replace(
            write("xu", "zu", *COLUMNS), write("f_drag[*]")
        ),
    ).dump()
    u = np.append(row["f_drag[1]"], before)
    assert len(u) > 5 and len(np.unique(u)) == len(u)


def test_atom_map_is_switched_on_by_the_fix(tmp_path):
    script = scene(two()[0], "K 1 terms mf").replace("atom_modify  map hash sort 0 0", "atom_modify  sort 0 0")
    assert run(tmp_path, script, 2).dump()["f_size[1]"].tolist() == [700]
