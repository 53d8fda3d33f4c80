"""fix drag/cluster on the real engine."""

import numpy as np
import pytest
from lammps_run import D_P, M_P, clusters, diameter, head, pair, random_clusters, run, write

RHO_G, NU_G = 1.2, 1.53e-5


def one_cluster(drag: str, n: int = 400, v=(0.0, 0.0), steps: int = 0, more: str = "", dt: float = 1e-6) -> str:
    return (
        head()
        + clusters((n, (0.02, 0.02), v))
        + pair()
        + "fix move all nve\n"
        + more
        + f"fix drag all drag/cluster {RHO_G} {NU_G} {drag}\ntimestep {dt}\nrun {steps}\n"
        + write("f_drag[*]")
    )


# C_D of Tran-Cong, Gay & Michaelides (2004) and of the sphere limit, from MODEL.md section 4
TABLE = [
    ("trancong 1 1", 1.0, 27.6000),
    ("trancong 1 1", 100.0, 1.09379),
    ("trancong 1 1", 1000.0, 0.46615),
    ("trancong 0.8 1.1", 1.0, 31.1270),
    ("trancong 0.8 1.1", 100.0, 1.38548),
    ("trancong 0.8 1.1", 1000.0, 0.61216),
    ("stokes", 0.5, 48.0),
]


@pytest.mark.parametrize("law, re, c_d", TABLE)
def test_force_on_a_resting_cluster(tmp_path, law, re, c_d):
    d = diameter(400)
    u = re * NU_G / d
    row = run(tmp_path, one_cluster(f"velocity 0 0 {u!r} law {law}")).dump()
    force = c_d * np.pi / 8 * RHO_G * d**2 * u**2
    # the reference values are given to 5 or 6 digits
    assert row["f_drag[6]"][0] == pytest.approx(force, rel=1e-5)
    assert row["f_drag[7]"][0] == pytest.approx(re, rel=1e-12)
    assert row["fz"][0] == row["f_drag[6]"][0]
    assert row["f_drag[8]"][0] == pytest.approx(400 * M_P * u / force, rel=1e-5)


def test_table_meets_the_law(tmp_path):
    def force(table):
        script = fluctuating("own frozen 7").replace("velocity 0 0 2", f"velocity 0 0 2 table {table}")
        return run(tmp_path / table, script).dump()["f_drag[6]"]

    assert force("yes") == pytest.approx(force("no"), rel=1e-10)  # the stated bound
    assert not np.array_equal(force("yes"), force("no"))


@pytest.mark.parametrize("dt_over_tau", [1e-3, 1.0, 30.0, 1e4])
def test_exponential_integrator_never_overshoots(tmp_path, dt_over_tau):
    """Stokes drag, so tau is constant. With E = exp(-dt/tau), velocity Verlet takes half a kick at set-up,
    then the slip at half steps shrinks by E each step: u - v(n dt) = u (1 + E)^2 E^(n-1) / 4.
    """
    tau = 400 * M_P / (3 * np.pi * RHO_G * NU_G * diameter(400))
    dt = float(dt_over_tau * tau)
    script = one_cluster("velocity 0 0 2.0 law stokes integrator exponential", steps=0, dt=dt) + (
        "dump d all custom 1 path.dump id vz\ndump_modify d format float %.17g first yes\nrun 20\n"
    )
    # a cluster that moves many boxes per step would be lost: hold it in place, only velocities matter
    script = script.replace("fix move all nve\n", "fix move all nve\nneigh_modify delay 1000 every 1000 check no\n")
    v = np.array([f["vz"][0] for f in run(tmp_path, script).frames("path.dump")])
    assert np.all(v <= 2.0 * (1 + 1e-15)) and np.all(np.diff(v) >= 0)
    e = np.exp(-dt_over_tau)
    assert v[1:] == pytest.approx(2.0 - 0.5 * (1 + e) ** 2 * e ** np.arange(20.0), rel=1e-12)


def test_explicit_integrator_is_the_default_and_overshoots(tmp_path):
    tau = 400 * M_P / (3 * np.pi * RHO_G * NU_G * diameter(400))
    gas = "velocity 0 0 1e-4 law stokes"
    passing = run(tmp_path / "1.5", one_cluster(gas, dt=float(1.5 * tau), steps=2))
    assert passing.dump()["vz"][0] > 1e-4
    unstable = run(tmp_path / "2.1", one_cluster(gas, dt=float(2.1 * tau), steps=2), check=False)
    assert unstable.code != 0 and "is above twice the relaxation time" in unstable.output


def test_plane_leaves_the_third_direction_alone(tmp_path):
    row = run(tmp_path, one_cluster("velocity 1 1 1 law stokes plane xz")).dump()
    assert row["f_drag[4]"][0] == row["f_drag[6]"][0] > 0.0
    assert row["f_drag[5]"][0] == 0.0
    assert row["f_drag[2]"][0] == 1.0  # the gas still blows there


def test_global_vector_is_total_force_and_power(tmp_path):
    script = (
        head() + random_clusters(50) + pair() + "velocity all set 0.1 0 -0.2\nfix move all nve\n"
        "fix drag all drag/cluster 1.2 1.53e-5 velocity 1 0 2 fluctuation 0.5 0 0.5 cell 10 1 10 0.005 3\n"
        'run 0\nprint "$(f_drag[1]:%.17g) $(f_drag[2]:%.17g) $(f_drag[3]:%.17g) $(f_drag[4]:%.17g)" file total.txt\n'
        + write("f_drag[*]")
    )
    r = run(tmp_path, script)
    row, total = r.dump(), np.loadtxt(tmp_path / "total.txt")
    force = np.array([row[f"f_drag[{k}]"] for k in (4, 5, 6)])
    v = np.array([row[k] for k in ("vx", "vy", "vz")])
    assert total[:3] == pytest.approx(force.sum(axis=1), rel=1e-12, abs=1e-20)
    assert total[3] == pytest.approx((force * v).sum(), rel=1e-12)


def test_unshielded_blends_with_single_particles(tmp_path):
    def fz(share: float, n: int) -> float:
        text = f"velocity 0 0 1.0 law schiller/naumann unshielded {share} particle {D_P} 2000"
        return run(tmp_path / f"{share}-{n}", one_cluster(text, n=n)).dump()["f_drag[6]"][0]

    single = np.pi / 8 * RHO_G * NU_G * D_P * 24 * (1 + 0.15 * (D_P / NU_G) ** 0.687)
    assert fz(1.0, 400) == pytest.approx(400 * single, rel=2e-10)  # the table's bound
    assert fz(0.25, 400) == pytest.approx(0.75 * fz(0.0, 400) + 0.25 * 400 * single, rel=2e-10)


def test_profile_is_exact_where_the_gas_is_linear(tmp_path):
    (tmp_path / "gas.txt").write_text("# x ux uy uz\n0 0 0 1\n0.01 0.5 0 2\n0.04 0.5 0 -4\n")
    text = random_clusters(60)
    script = (
        head()
        + text
        + pair()
        + ("fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 profile gas.txt x\nrun 0\n" + write("f_drag[*]"))
    )
    row = run(tmp_path, script).dump()
    assert row["f_drag[3]"] == pytest.approx(np.interp(row["x"], [0, 0.01, 0.04], [1, 2, -4]), abs=1e-13)
    assert row["f_drag[1]"] == pytest.approx(np.interp(row["x"], [0, 0.01, 0.04], [0, 0.5, 0.5]), abs=1e-13)


def test_variables_give_the_gas_velocity(tmp_path):
    script = (
        head()
        + random_clusters(20)
        + pair()
        + (
            "variable a equal 0.5+step\nvariable b atom 3*x-z\nfix move all nve\n"
            "fix drag all drag/cluster 1.2 1.53e-5 velocity v_a 0 v_b\ntimestep 1e-7\nrun 2\n" + write("f_drag[*]")
        )
    )
    row = run(tmp_path, script).dump()
    assert np.all(row["f_drag[1]"] == 2.5)
    assert row["f_drag[3]"] == pytest.approx(3 * row["x"] - row["z"], abs=1e-12)


# ---- fluctuation ----


def fluctuating(text: str, steps: int = 0, newton: str = "on", dt: float = 1e-6) -> str:
    return (
        head(newton=newton)
        + random_clusters(200)
        + pair()
        + (
            f"fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 fluctuation 0.75 0 0.5 {text}\n"
            f"timestep {dt}\nrun {steps}\n" + write("f_drag[*]")
        )
    )


@pytest.mark.parametrize("text", ["cell 10 1 10 0.005 7", "own 0.005 7", "own frozen 7", "cell 10 1 10 frozen 7"])
def test_fluctuation_does_not_depend_on_ranks(tmp_path, text):
    rows = [run(tmp_path / str(n), fluctuating(text, steps=200), n).dump() for n in (1, 2, 4)]
    for other in rows[1:]:
        assert np.array_equal(rows[0]["f_drag[1]"], other["f_drag[1]"])
        assert np.array_equal(rows[0]["f_drag[3]"], other["f_drag[3]"])
    u, w = rows[0]["f_drag[1]"], rows[0]["f_drag[3]"] - 2.0
    assert np.abs(u).max() <= 0.75 and np.abs(w).max() <= 0.5
    assert np.abs(u).max() > 0.6 and np.std(u) == pytest.approx(0.75 / np.sqrt(3), rel=0.2)  # uniform, 100+ draws
    assert np.all(rows[0]["f_drag[2]"] == 0.0)


def test_clusters_in_one_cell_see_one_gas(tmp_path):
    row = run(tmp_path, fluctuating("cell 4 1 4 frozen 7")).dump()
    cell = (row["x"] // 0.01) * 4 + row["z"] // 0.01
    assert len(np.unique(cell)) == len(np.unique(row["f_drag[1]"])) == 16
    for c in np.unique(cell):
        assert len(np.unique(row["f_drag[1]"][cell == c])) == 1


def test_redrawn_at_the_period_and_not_before(tmp_path):
    def u(steps):
        text = fluctuating("own 1e-4 7", steps=steps, dt=1e-6)
        return run(tmp_path / str(steps), text).dump()["f_drag[1]"]

    first, last, redrawn = u(0), u(100), u(101)  # a period includes its end
    assert np.array_equal(first, last)
    assert np.all(first != redrawn)


def test_seed_changes_all(tmp_path):
    a = run(tmp_path / "a", fluctuating("own frozen 7")).dump()["f_drag[1]"]
    b = run(tmp_path / "b", fluctuating("own frozen 8")).dump()["f_drag[1]"]
    assert np.all(a != b)


def refreshed(m: int, steps: int = 400, gusts: str = "cell 4 1 4 1e-4 3") -> str:
    return fluctuating(f"{gusts} refresh {m}", steps)


def test_refresh_of_one_step_changes_nothing(tmp_path):
    each = run(tmp_path / "each", refreshed(1)).dump()
    default = run(tmp_path / "default", refreshed(1).replace(" refresh 1", "")).dump()
    assert all(np.array_equal(each[c], default[c]) for c in each)


def test_held_coefficients_follow_the_velocity(tmp_path):
    """Where the gas changes four times in 400 steps, the change comes up to 9 steps late; where it does not, the error is
    that of the coefficient alone, of the first order in the time for which it is held.
    """
    error = {}
    for gas, gusts in (("gusty", "cell 4 1 4 1e-4 3"), ("steady", "cell 1 1 1 frozen 3")):
        exact = run(tmp_path / gas / "1", refreshed(1, gusts=gusts)).dump()
        change = np.hypot(exact["vx"], exact["vz"]).max()
        for m in (5, 10):
            held = run(tmp_path / gas / str(m), refreshed(m, gusts=gusts)).dump()
            error[gas, m] = np.hypot(held["vx"] - exact["vx"], held["vz"] - exact["vz"]).max() / change
    assert 0 < error["gusty", 10] < 4 * 9 / 400
    assert 0 < error["steady", 10] < 1e-4
    assert error["steady", 5] < 0.6 * error["steady", 10]


def test_refresh_does_not_depend_on_ranks(tmp_path):
    one = run(tmp_path / "1", refreshed(10)).dump()
    many = run(tmp_path / "2", refreshed(10), 2).dump()
    for c in ("x", "z", "vx", "vz"):
        assert np.allclose(one[c], many[c], rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("text", ["own 3e-5 7", "cell 10 1 10 3e-5 7"])
def test_restart_continues_bit_equal(tmp_path, text):
    setup = head() + random_clusters(200) + pair()
    style = f"fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 fluctuation 0.75 0 0.5 {text}\n"
    fixes = "fix move all nve\n" + style + "timestep 1e-6\n"
    whole = run(tmp_path / "whole", setup + fixes + "run 50\nrun 50\n" + write("f_drag[*]")).dump()
    run(tmp_path / "half", setup + fixes + "run 50\nwrite_restart half.restart\n")
    again = (
        "atom_modify map hash sort 0 0\ncomm_modify vel yes cutoff 5.7e-3\nread_restart ../half/half.restart\n"
        "neighbor 0.5e-3 bin\n" + fixes + "run 50\n" + write("f_drag[*]")
    )
    continued = run(tmp_path / "again", again).dump()
    for column in whole:
        assert np.array_equal(whole[column], continued[column]), column
