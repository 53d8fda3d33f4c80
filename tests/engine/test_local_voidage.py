"""Drag laws whose voidage is that of the cell around a cluster."""

import numpy as np
import pytest
from lammps_run import M_P, clusters, diameter, head, pair, run, write

RANKS = (1, 2, 4)
CELLS = (15, 1, 9)
BOX = (0.04, 0.003, 0.04)
RHO, NU = 1.2, 1.53e-5
PLACES = np.random.default_rng(4).uniform(0.001, 0.039, (150, 2)) ** 3 / 0.039**2
SIZES = np.random.default_rng(5).choice([3, 400, 2000, 2000], 150)


def scene(law, more="", fix_more="", group="all", velocity="velocity 0 0 2"):
    """150 clusters of three sizes, denser towards one corner, overlapping or not: nothing but drag acts."""
    places = [(int(n), (float(x), float(z)), (0.0, 0.0)) for n, (x, z) in zip(SIZES, PLACES, strict=True)]
    return (
        head()
        + clusters(*places)
        + "pair_style zero 1.6e-3\npair_coeff * *\nfix move all nve\n"
        + more
        + f"fix drag {group} drag/cluster {RHO} {NU} {velocity} law {law} {fix_more}\n"
    )


def volumes(row):
    """Sum of pi/6 d^3 in the cell of each cluster, over the volume of a cell."""
    index = np.stack([np.floor(row["x"] / BOX[0] * CELLS[0]), np.floor(row["z"] / BOX[2] * CELLS[2])]).astype(int)
    total = np.zeros((CELLS[0], CELLS[2]))
    np.add.at(total, tuple(index), np.pi / 6 * row["diameter"] ** 3)
    return total[tuple(index)] / (np.prod(BOX) / np.prod(CELLS))


def schiller_naumann(re):
    return np.maximum(24 * (1 + 0.15 * re**0.687), 0.44 * re)


def wen_yu(re, eps):
    """C_D Re from the force per particle V_p beta u/eps_s of the two-fluid model, model A (Gidaspow 1994)."""
    return schiller_naumann(eps * re) * eps**-2.65


def gidaspow(re, eps):
    return np.where(eps >= 0.8, wen_yu(re, eps), 200 * (1 - eps) / eps + 7 / 3 * re)


def di_felice(re, eps):
    re = eps * re
    chi = 3.7 - 0.65 * np.exp(-0.5 * (1.5 - np.log10(re)) ** 2)
    return (0.63 + 4.8 / np.sqrt(re)) ** 2 * re * eps ** (1 - chi)


LAWS = {"wen/yu": wen_yu, "gidaspow": gidaspow, "difelice": di_felice}


@pytest.mark.parametrize("np_", RANKS)
@pytest.mark.parametrize("law", LAWS)
def test_force_at_the_voidage_of_the_cell(tmp_path, law, np_):
    row = run(tmp_path, scene(f"{law} cells 15 1 9") + "run 0\n" + write("f_drag[*]"), np_).dump()
    eps = 1 - volumes(row)
    assert eps.min() < 0.8 < eps.max()
    assert row["f_drag[9]"] == pytest.approx(eps, rel=1e-12)
    re = 2.0 * row["diameter"] / NU
    force = np.pi / 8 * RHO * NU * row["diameter"] * LAWS[law](re, eps) * 2.0
    assert row["fz"] == pytest.approx(force, rel=1e-12)


def test_pressure_gradient(tmp_path):
    """Model B: the force of model A over the voidage, cells or a constant."""
    for words, eps in (("cells 15 1 9", None), ("0.7", 0.7)):
        row = {}
        for pressure in ("no", "yes"):
            script = scene(f"wen/yu {words}", fix_more=f"pressure {pressure}") + "run 0\n" + write()
            row[pressure] = run(tmp_path / words.replace(" ", "-") / pressure, script).dump()
        expected = 1 - volumes(row["no"]) if eps is None else eps
        assert row["no"]["fz"] / row["yes"]["fz"] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("np_", RANKS)
def test_what_else_has_a_diameter_counts(tmp_path, np_):
    """Clusters that the fix does not drag take room, too."""
    script = scene("wen/yu cells 15 1 9", "group some id <= 70\n", group="some") + "run 0\n" + write("f_drag[*]")
    row = run(tmp_path, script, np_).dump()
    some = row["id"] <= 70
    assert row["f_drag[9]"][some] == pytest.approx(1 - volumes(row)[some], rel=1e-12)
    assert np.all(row["f_drag[9]"][~some] == 0) and np.all(row["fz"][~some] == 0)


@pytest.mark.parametrize("refresh", [1, 7])
@pytest.mark.parametrize("np_", (2, 4))
def test_moving_clusters_on_any_ranks(tmp_path, np_, refresh):
    """Clusters cross cells, ranks and the periodic sides; fix balance moves the borders of the ranks."""
    words = {"velocity": "velocity 30 0 2 fluctuation 20 0 2 cell 4 1 4 frozen 3", "fix_more": f"refresh {refresh}"}
    script = scene("wen/yu cells 15 1 9", "fix even all balance 20 1.0 shift x 5 1.1\n", **words)
    script += "timestep 2e-5\nrun 140\n" + write("f_drag[*]")
    one, many = run(tmp_path / "1", script).dump(), run(tmp_path / "n", script, np_).dump()
    for column in ("x", "z", "vx", "vz", "f_drag[9]"):
        assert np.allclose(one[column], many[column], rtol=1e-9, atol=1e-13), column
    moved = np.abs(one["vx"]).max() * 140 * 2e-5
    assert moved > 1e-4
    assert one["f_drag[9]"] == pytest.approx(1 - volumes(one), rel=1e-9)  # step 140 = 7 * 20 is a refresh


def test_a_cell_that_is_overfull_is_cut_off_at_the_closest_packing(tmp_path):
    places = [(2000, (0.002 + 1e-5 * k, 0.002), (0.0, 0.0)) for k in range(30)]
    script = head() + clusters(*places) + "pair_style zero 1.6e-3\npair_coeff * *\nfix move all nve\n"
    script += f"fix drag all drag/cluster {RHO} {NU} velocity 0 0 2 law wen/yu cells 10 1 10\nrun 0\n" + write(
        "f_drag[*]"
    )
    row = run(tmp_path, script).dump()
    assert 30 * np.pi / 6 * diameter(2000) ** 3 > 0.9 * np.prod(BOX) / 100
    assert row["f_drag[9]"] == pytest.approx(np.full(30, 1 - np.pi / np.sqrt(18)), rel=1e-12)


def test_the_size_law_takes_the_same_voidage(tmp_path):
    """N_st = n F u/m of one particle of 100 um: nst particle, at the voidage of the cell."""
    script = scene("wen/yu cells 15 1 9").replace("pair_style zero 1.6e-3\npair_coeff * *\n", pair())
    script += (
        "fix size all cluster/breakmerge 10 1e-4 2000 drag drag nst particle K 1.0 break no merge no\nrun 0\nrun 0\n"
    )
    row = run(tmp_path, script + write("f_size[4]")).dump()
    eps = 1 - volumes(row)
    force = np.pi / 8 * RHO * NU * 1e-4 * wen_yu(2.0 * 1e-4 / NU, eps) * 2.0
    assert row["f_size[4]"] == pytest.approx(force * 2.0 / M_P, rel=1e-9)


def test_the_last_law_holds(tmp_path):
    one = run(tmp_path / "1", scene("wen/yu cells 15 1 9 law wen/yu 0.8") + "run 0\n" + write()).dump()
    two = run(tmp_path / "2", scene("wen/yu 0.8") + "run 0\n" + write()).dump()
    assert np.array_equal(one["fz"], two["fz"])


@pytest.mark.parametrize(
    "law, said",
    [
        ("wen/yu cells 0 1 1", "law cells value: 0 (must be an integer from 1 to"),
        ("wen/yu cells 1000 1000 1000", "law cells value: 1000 (must be at most 100000000 cells in all)"),
        ("gidaspow cells 3 1", "missing law cells"),
        ("difelice 1.5", "law difelice voidage value: 1.5 (must be a number > 0 and <= 1, or cells nx ny nz)"),
        (
            "stokes pressure yes",
            "Fix drag/cluster drag: pressure yes needs a law with a voidage, which law stokes has not",
        ),
        ("trancong 0.8 cells", "law trancong dA/dn value: cells (must be a number > 0 and <= 10)"),
    ],
)
def test_bad_words(tmp_path, law, said):
    r = run(tmp_path, scene(law) + "run 0\n", check=False)
    assert r.code != 0 and said in " ".join(r.output.split())
