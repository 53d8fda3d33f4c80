"""Temperature, charge and columns of a user's own through breakups and merges: values by hand, sums to rounding."""

import numpy as np
import pytest
from lammps_run import M_P, clusters, diameter, head, pair, random_clusters, run, write
from test_fix_cluster_breakmerge import k_for

RANKS = (1, 2, 4)
E_SPIN = 30  # column of out.txt
OUT = 'fix table all ave/time 1 1 1 f_size[*] mode scalar file out.txt format " %.17g"\n'
COLUMNS = "fix own all property/atom temperature heatflow d_mean d_split d_sum d_plain i_label d2_pair 2\n"
RULES = "carry d_mean mean carry d_split split carry d_sum sum carry i_label copy carry d2_pair split"
SHOW = "d_mean d_split d_sum d_plain i_label d2_pair[1] d2_pair[2]".split()


def values(atom: int, temperature: float, x: float) -> str:
    """Columns of one atom, each another multiple of x."""
    return (
        f"set atom {atom} temperature {temperature} d_mean {x} d_split {2 * x} d_sum {3 * x} d_plain {4 * x} i_label {int(10 * x)} "
        f"d2_pair[1] {5 * x} d2_pair[2] {6 * x}\n"
    )


def script(rows: str, columns: str, size: str, law: str = "law none", steps: int = 1, style: str = "sphere") -> str:
    return (
        head().replace("atom_style   sphere", f"atom_style   {style}")
        + rows
        + columns
        + pair()
        + "fix move all nve\n"
        + f"fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 {law}\n"
        + f"fix size all cluster/breakmerge 1 1e-4 2000 drag drag {size}\ntimestep 1e-12\n{OUT}"
        + f"compute t all property/atom temperature\nrun {steps}\n"
        + write("c_t", "f_size[1]", *SHOW)
    )


@pytest.mark.parametrize("np_", RANKS)
@pytest.mark.parametrize("place", [(0.02, 0.02), (1e-4, 0.0399)])
def test_a_breakup(tmp_path, place, np_):
    rows = clusters((400, place, (0.0, 0.0)))
    text = script(rows, COLUMNS + values(1, 350.0, 0.7), f"K {k_for(120.5)!r} terms st merge no {RULES}", "law stokes")
    row = run(tmp_path, text, np_).dump()
    n = row["f_size[1]"]
    assert sorted(n) == [40, 120, 120, 120]
    assert np.all(row["c_t"] == 350.0) and np.all(row["d_mean"] == 0.7) and np.all(row["d_sum"] == 3 * 0.7)
    assert np.all(row["d_plain"] == 4 * 0.7) and np.all(row["i_label"] == 7)
    for column, whole in (("d_split", 1.4), ("d2_pair[1]", 3.5), ("d2_pair[2]", 4.2)):
        assert row[column] == pytest.approx(whole * n / 400, rel=1e-14)
        assert row[column].sum() == pytest.approx(whole, rel=1e-15)


@pytest.mark.parametrize("np_", RANKS)
@pytest.mark.parametrize("x", [0.0200, 0.0398])  # within, and across ranks and the periodic side
def test_a_merge(tmp_path, x, np_):
    """100 particles of 300 K and 60 of 400 K: 337.5 K. The lower ID leads, wherever it is."""
    gap = 0.499 * (diameter(100) + diameter(60))
    rows = clusters((60, ((x + gap) % 0.04, 0.02), (0.0, 1.0)), (100, (x, 0.02), (0.0, 1.0)))
    text = script(
        rows, COLUMNS + values(1, 400.0, 0.5) + values(2, 300.0, 1.3), f"K 1e6 terms mf umf 0.01 break no {RULES}"
    )
    row = run(tmp_path, text, np_).dump()
    assert list(row["id"]) == [1] and row["f_size[1]"] == [160]
    expected = {
        "c_t": 337.5,
        "d_mean": (60 * 0.5 + 100 * 1.3) / 160,
        "d_split": 2 * 1.8,
        "d_sum": 3 * 1.8,
        "d_plain": 4 * 0.5,
        "i_label": 5,
        "d2_pair[1]": 5 * 1.8,
        "d2_pair[2]": 6 * 1.8,
    }
    for column, value in expected.items():
        assert row[column][0] == pytest.approx(value, rel=1e-14), column


def test_a_refused_merge_that_breaks_divides_what_both_had(tmp_path):
    gap = 0.499 * 2 * diameter(100)
    rows = clusters((100, (0.02, 0.02), (0.0, 1.0)), (100, (0.02 + gap, 0.02), (0.0, 1.0)))
    # stable at 80: neither breaks (h = 0.26: above 160), both together do
    gas = k_for(80.5, gas=(0.0, 2.0), v=(0.0, 1.0))
    text = script(
        rows,
        COLUMNS + values(1, 400.0, 0.5) + values(2, 300.0, 1.3),
        f"K {gas!r} terms st refused break {RULES}",
        "law stokes",
    )
    row = run(tmp_path, text).dump()
    n = row["f_size[1]"]
    assert sorted(n) == [40, 80, 80]
    assert row["c_t"] == pytest.approx([350.0] * 3, rel=1e-14)
    assert row["d_split"] == pytest.approx(2 * 1.8 * n / 200, rel=1e-14)


def crowd(style: str, columns: str, total: str, ranks: int) -> str:
    """Breaks and merges in a gusty crowd; sums printed by the engine."""
    return (
        head().replace("atom_style   sphere", f"atom_style   {style}")
        + random_clusters(200, seed=3)
        + columns
        + pair()
        + "variable u atom 0.4*sin(79190*x+104729*z)\nvariable w atom 2+0.4*sin(61379*x-94321*z)\nvelocity all set v_u 0 v_w\n"
        + "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 fluctuation 3 0 3 cell 8 1 8 4e-4 5 plane xz\n"
        + "fix size all cluster/breakmerge 5 1e-4 2000 drag drag K 0.1 merge 0.2\ntimestep 2e-6\n"
        + f"{total}compute sum all reduce sum v_each\nvariable sum equal c_sum\n"
        + 'fix table all ave/time 50 1 50 f_size[*] v_sum mode scalar file out.txt format " %.17g"\nrun 600\n'
    )


@pytest.mark.parametrize("np_", RANKS)
def test_heat_and_charge_of_a_crowd_stay(tmp_path, np_):
    heat = "fix own all property/atom temperature heatflow\nvariable t atom 300+50*sin(7919*x)\nset group all temperature v_t\n"
    table = run(
        tmp_path / "heat",
        crowd("sphere", heat, "compute t all property/atom temperature\nvariable each atom mass*c_t\n", np_),
        np_,
    ).table()
    assert table[-1, 3] > 100 and table[-1, 4] > 3  # breakups, merges
    assert table[:, -1] == pytest.approx(table[0, -1], rel=1e-13)
    charge = "variable c atom 1e-6*(1+0.5*sin(7919*x))\nset group all charge v_c\n"
    table = run(tmp_path / "charge", crowd("hybrid sphere charge", charge, "variable each atom q\n", np_), np_).table()
    assert table[-1, 3] > 100 and table[-1, 4] > 3
    assert table[:, -1] == pytest.approx(table[0, -1], rel=1e-13)


@pytest.mark.parametrize("np_", RANKS)
def test_sums_and_labels_go_through_a_restart(tmp_path, np_):
    """Halfway to a file and on, on any ranks: heat, charge and a divided column stay, labels are those of the first ancestors."""
    columns = (
        "fix own all property/atom temperature heatflow d_split i_label\nvariable t atom 300+50*sin(7919*x)\n"
        "variable c atom 1e-6*(1+0.5*sin(7919*x))\nvariable label atom 7*id\n"
    )
    values = "set group all temperature v_t\nset group all charge v_c\nset group all d_split v_c\nset group all i_label v_label\n"
    kept = "fix first all store/state 0 id\n"
    sums = (
        "compute t all property/atom temperature d_split q i_label\nvariable heat atom mass*c_t[1]\n"
        "variable wrong atom abs(c_t[4]-7*f_first)\ncompute sum all reduce sum v_heat c_t[2] c_t[3] v_wrong\n"
    )
    rows = "".join(f"variable s{k} equal c_sum[{k}]\n" for k in (1, 2, 3, 4))
    table = (
        "fix table all ave/time 50 1 50 f_size[1] f_size[3] f_size[4] v_s1 v_s2 v_s3 v_s4 mode scalar file out.txt"
        ' format " %.17g"\n'
    )
    script = crowd("hybrid sphere charge", columns + values + kept, "variable each atom q\n", np_)
    start, fixes = (
        script[: script.index("pair_style")],
        script[script.index("fix move") : script.index("variable each")],
    )
    fixes = fixes.replace("merge 0.2", "merge 0.2 carry d_split split")
    motion = script[script.index("variable u") : script.index("fix move")]
    run(tmp_path, start + pair() + motion + fixes + sums + rows + table + "run 300\nwrite_restart half.restart\n")
    before = np.loadtxt(tmp_path / "out.txt")
    again = (
        "read_restart half.restart\ncomm_modify vel yes cutoff 5.7e-3\nneighbor 0.5e-3 bin\n"
        + columns.splitlines()[0]
        + f"\n{kept}{pair()}{fixes}{sums}{rows}{table}run 300\n"
    )
    after = run(tmp_path, again, np_).table()
    assert after[-1, 2] > before[-1, 2] > 100 and after[-1, 3] > before[-1, 3] > 0  # breakups, merges
    for column in (4, 5, 6):
        assert after[:, column] == pytest.approx(before[0, column], rel=1e-13)
    assert np.all(before[:, 7] == 0) and np.all(after[:, 7] == 0)


@pytest.mark.parametrize(
    "carry, words",
    [
        ("carry d_none mean", "carry d_none: there is no such value per atom"),
        ("carry i_mean mean", "carry i_mean: there is no such value per atom"),
        ("carry i_label split", "carry i_label: an integer can be copied, not divided, summed up or averaged"),
        ("carry d_mean most", "carry rule value: most (must be copy | split | mean | sum)"),
        ("carry d_mean mean carry d_mean sum", "carry NAME value: d_mean (must be a value that has no rule yet)"),
    ],
)
def test_bad_words(tmp_path, carry, words):
    rows = clusters((400, (0.02, 0.02), (0.0, 0.0)))
    r = run(tmp_path, script(rows, COLUMNS, f"K 1.0 terms mf umf 0.01 {carry}"), check=False)
    assert r.code != 0 and words in r.output


# ---- spin


@pytest.mark.parametrize("np_", (1, 2))
def test_spin_energy_that_a_breakup_gives_up(tmp_path, np_):
    """Fragments turn as the parent did; 1/2 I omega^2 of each, I = 2/5 m r^2, is less in sum: n^(5/3) is."""
    omega = 300.0
    rows = clusters((400, (0.02, 0.02), (0.0, 0.0))) + f"set atom 1 omega 0 {omega} 0\n"
    text = script(rows, COLUMNS, f"K {k_for(120.5)!r} terms st merge no", "law stokes")
    table = run(tmp_path, text, np_).table()

    def energy(n):
        return 0.5 * 0.4 * n * M_P * (0.5 * diameter(n)) ** 2 * omega**2

    assert table[-1, E_SPIN] == pytest.approx(energy(400) - 3 * energy(120) - energy(40), rel=1e-9)


def test_spin_energy_that_a_merge_gives_up(tmp_path):
    """Both spins are kept as angular momentum: I omega of the merged sphere is the sum."""
    n, omegas = (60, 100), (200.0, -50.0)
    gap = 0.499 * (diameter(60) + diameter(100))
    rows = clusters((60, (0.02, 0.02), (0.0, 1.0)), (100, (0.02 + gap, 0.02), (0.0, 1.0)))
    rows += "".join(f"set atom {k + 1} omega 0 {w} 0\n" for k, w in enumerate(omegas))
    table = run(tmp_path, script(rows, COLUMNS, "K 1e6 terms mf umf 0.01 break no")).table()
    inertia = [0.4 * k * M_P * (0.5 * diameter(k)) ** 2 for k in (*n, 160)]
    spin = inertia[0] * omegas[0] + inertia[1] * omegas[1]
    before = 0.5 * sum(i * w**2 for i, w in zip(inertia, omegas))
    assert table[-1, 4] == 1
    assert table[-1, E_SPIN] == pytest.approx(before - 0.5 * spin**2 / inertia[2], rel=1e-6)  # friction over 1e-12 s
