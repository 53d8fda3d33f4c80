"""pair gran/cluster: Eqs. (3) and (4) on the engine, against LAMMPS' own granular pair where they agree."""

import itertools
import re

import numpy as np
import pytest
from lammps_run import CUTOFF, clusters, diameter, head, pair, random_clusters, run, write

STOCK = pair("hooke 10.0 0.3 tangential linear_nohistory 0.0 0.0 damping coeff_restitution")


def gran(options: str = "", mu: float = 0.33, cutoff: float = CUTOFF, e: float = 0.3) -> str:
    return f"pair_style gran/cluster 10.0 {e} {mu} {options} cutoff {cutoff}\npair_coeff * *\n"


def crowd(contact: str, steps: int = 1000, newton: str = "on", atom_style: str = "sphere", count: int = 500) -> str:
    """Hundreds of clusters of two sizes that collide; nothing but contacts acts."""
    small = f"group half id <> 1 200\nset group half diameter {diameter(60)!r}\nset group half density 1000.0\n"
    stir = "variable u atom 0.5*sin(79190*x+104729*z)\nvariable w atom 0.5*sin(61379*x-94321*z)\nvelocity all set v_u 0 v_w\n"
    move = "sphere" if atom_style == "sphere" else ""
    return (
        head(newton=newton).replace("atom_style   sphere", f"atom_style   {atom_style}")
        + random_clusters(count)
        + small
        + contact
        + stir
        + f"fix move all nve{'/sphere' if move else ''}\ntimestep 2e-6\nthermo 100\n"
        + "thermo_style custom step ke pe press\nthermo_modify lost error format float %.16g\n"
        + f"run {steps}\n"
        + write()
    )


def state(result) -> np.ndarray:
    end = result.dump()
    return np.stack([end[c] for c in ("x", "z", "vx", "vz", "fx", "fz")])


def assert_close(a: np.ndarray, b: np.ndarray, rel: float) -> None:
    """Every row within rel of its own largest value: a row is one quantity of all clusters."""
    for x, y in zip(a, b, strict=True):
        assert np.abs(y).max() > 0
        assert np.abs(x - y).max() <= rel * np.abs(y).max()


@pytest.mark.parametrize("newton", ["on", "off"])
def test_equals_granular_hooke_without_friction(tmp_path, newton):
    """1e-12 after 200 steps of collisions."""
    stock = run(tmp_path / "stock", crowd(STOCK, 200, newton))
    ours = run(tmp_path / "ours", crowd(gran("tangential none"), 200, newton))
    assert_close(state(ours), state(stock), 1e-12)


@pytest.mark.parametrize("options", ["tangential none", "", "tangential linear", "direction velocity"])
def test_same_on_any_ranks_and_newton(tmp_path, options):
    """Sums of forces are added in another order: 1e-9 after 300 steps of a system that amplifies rounding."""
    one = state(run(tmp_path / "1", crowd(gran(options), 300)))
    for ranks, newton in itertools.product((1, 2, 4), ("on", "off")):
        if (ranks, newton) == (1, "on"):
            continue
        many = state(run(tmp_path / f"{ranks}{newton}", crowd(gran(options), 300, newton), ranks))
        assert_close(many, one, 1e-9)


def test_without_rotation_nothing_of_it_exists(tmp_path):
    """atom_style cluster has no omega, no torque; frictionless motion is that of atom_style sphere, bit for bit."""
    sphere = run(tmp_path / "sphere", crowd(gran("tangential none")))
    lean = run(tmp_path / "lean", crowd(gran("tangential none"), atom_style="cluster"))
    assert np.array_equal(state(sphere), state(lean))
    refused = crowd(gran()).replace("atom_style   sphere", "atom_style   cluster")  # with nve/sphere
    r = run(tmp_path / "refused", refused, check=False)
    assert r.code != 0 and "omega" in r.output


def test_friction_without_rotation_acts_on_centres(tmp_path):
    """Where spheres do not turn (plain nve) their friction is that of atom_style cluster."""
    fixed = crowd(gran()).replace("nve/sphere", "nve")
    lean = crowd(gran(), atom_style="cluster")
    a, b = state(run(tmp_path / "a", fixed)), state(run(tmp_path / "b", lean))
    assert np.array_equal(a, b)
    assert not np.array_equal(b, state(run(tmp_path / "c", crowd(gran("tangential none"), atom_style="cluster"))))


def test_data_file_of_atom_style_cluster(tmp_path):
    script = crowd(gran(), 50, atom_style="cluster") + "write_data out.data nocoeff\n"
    end = run(tmp_path, script).dump()
    again = (
        "units si\natom_style cluster\natom_modify map hash\nboundary p f p\ncomm_modify vel yes cutoff 5.7e-3\n"
        "read_data out.data\n" + gran() + "fix move all nve\nrun 0\n" + write(name="again.dump")
    )
    read = run(tmp_path, again).dump("again.dump")
    assert np.array_equal(read["id"], end["id"])
    for c in ("x", "vz", "diameter", "mass"):
        assert np.allclose(read[c], end[c], rtol=1e-14)


OBLIQUE = head(newton="on").replace("boundary     p f p", "boundary p p p") + clusters(
    (400, (0.0195, 0.02), (0.5, 0.0)), (200, (0.0203, 0.0203), (-0.5, 0.0))
)


def sliding(contact: str, steps: int, dt: float = 1e-6) -> str:
    return (
        OBLIQUE + contact + f"fix move all nve/sphere\ntimestep {dt}\n"
        "thermo_style custom step ke pe\nthermo 1\nthermo_modify lost error\n"
        "dump d all custom 1 d.dump id x y z vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz radius mass\n"
        f"dump_modify d sort id format float %.17g\nrun {steps}\n"
    )


@pytest.mark.parametrize("direction", ["displacement", "velocity"])
@pytest.mark.parametrize("tangential", ["md", "linear"])
def test_forces_of_an_oblique_impact(tmp_path, tangential, direction):
    """Every step against Eqs. (3) and (4) written down here once more, in two dimensions: 1e-9, sums of 300 steps."""
    k_n, e, mu, nu = 10.0, 0.3, 0.33, 0.25
    r = run(tmp_path, sliding(gran(f"tangential {tangential} delta_max poisson {nu} direction {direction}"), 300))
    frames = r.frames("d.dump")
    zeta = -np.log(e) / np.hypot(np.pi, np.log(e))
    displacement, touched, slid = 0.0, 0, 0
    dt = 1e-6
    for before, f in itertools.pairwise(frames):
        x = np.array([f["x"][0] - f["x"][1], f["z"][0] - f["z"][1]])
        dist = np.hypot(*x)
        overlap = f["radius"].sum() - dist
        if overlap <= 0:
            displacement = 0.0
            assert np.abs(f["fx"]).max() == 0.0
            continue
        touched += 1
        n = x / dist
        # velocities at half of the step, as the engine has them when it computes forces
        half = {c: before[c] + 0.5 * dt * before[g] / before["mass"] for c, g in (("vx", "fx"), ("vz", "fz"))}
        inertia = 0.4 * before["mass"] * before["radius"] ** 2
        spin = before["omegay"] + 0.5 * dt * before["tqy"] / inertia
        v = np.array([half["vx"][0] - half["vx"][1], half["vz"][0] - half["vz"][1]])
        t = np.array([n[1], -n[0]])  # omega_y turns n into t: (omega_y e_y) x n = omega_y (n_z, -n_x)
        arm = f["radius"] - 0.5 * overlap
        v_n, v_t = v @ n, v @ t - (arm * spin).sum()
        m = f["mass"][0] * f["mass"][1] / f["mass"].sum()
        eta = 2 * zeta * np.sqrt(m * k_n)
        f_n = k_n * overlap - eta * v_n
        limit = mu * abs(f_n)
        displacement += v_t * dt
        if tangential == "md":
            most = mu * (2 - nu) / (2 * (1 - nu)) * overlap
            spring = limit * (1 - (1 - min(abs(displacement), most) / most) ** 1.5)
            displacement = np.sign(displacement) * min(abs(displacement), most)
            along = np.sign(v_t) if direction == "velocity" else np.sign(displacement)
            f_t = -spring * along - eta * v_t
        else:
            k_t = 2 * (1 - nu) / (2 - nu) * k_n
            f_t = -k_t * displacement - eta * v_t
            displacement = np.sign(displacement) * min(abs(displacement), limit / k_t)
        if abs(f_t) > limit:
            slid += 1
            f_t = np.sign(f_t) * limit
        force = f_n * n + f_t * t
        scale = np.abs(f["fx"]).max() + np.abs(f["fz"]).max()
        assert np.abs(force - [f["fx"][0], f["fz"][0]]).max() <= 1e-9 * scale
        torque = -arm * f_t  # both turn the same way
        assert np.abs(torque - f["tqy"]).max() <= 1e-9 * np.abs(torque).max() + 1e-20
    assert touched > 50 and 0 < slid < touched


def test_energy_of_springs_is_the_potential_energy(tmp_path):
    """Elastic and without friction: kinetic + potential is constant to the scheme's error, (dt omega)^2/8 = 3e-5 of
    the energy; single() gives the same energy as compute().
    """
    contact = "pair_style gran/cluster 10 1 0 cutoff 1.5876e-3\npair_coeff * *\n"
    script = sliding(contact, 200, 5e-6) + "compute e all pair/local eng\ncompute s all reduce sum c_e inputs local\n"
    script = script.replace("thermo_style custom step ke pe", "thermo_style custom step ke pe").replace(
        "run 200", "run 40"
    )
    script += "thermo_style custom step ke pe c_s\nrun 0\n"
    r = run(tmp_path, script)
    lines = [line.split() for line in r.output.splitlines() if re.fullmatch(r"\s*\d+(\s+[-+.e\d]+){2,3}\s*", line)]
    ke_pe = np.array([[float(w) for w in line[1:3]] for line in lines[:41]])
    assert ke_pe[:, 1].max() > 0.1 * ke_pe[0].sum()
    assert np.abs(ke_pe.sum(axis=1) - ke_pe[0].sum()).max() <= 5e-3 * ke_pe[0].sum()
    assert float(lines[-1][2]) > 0 and float(lines[-1][3]) == pytest.approx(float(lines[-1][2]), rel=1e-6)


def test_restart_keeps_settings_and_contact_history(tmp_path):
    """Bit-equal to a run cut at the same step; the law comes out of the file."""
    options = "tangential md delta_max kt 7.5 direction displacement"
    whole = run(tmp_path, crowd(gran(options), 400).replace("run 400", "run 200\nwrite_restart half.restart\nrun 200"))
    resumed = (
        "atom_modify map hash sort 0 0\ncomm_modify vel yes cutoff 5.7e-3\nread_restart half.restart\nneighbor 0.5e-3 bin\n"
        "fix move all nve/sphere\ntimestep 2e-6\nthermo_modify lost error\nrun 200\n" + write(name="resumed.dump")
    )
    a, b = whole.dump(), run(tmp_path, resumed).dump("resumed.dump")
    for c in a:
        assert np.array_equal(a[c], b[c]), c


def test_size_law_takes_contacts_as_the_pair_met_them(tmp_path):
    """N_cc noted by the pair while it computes is that of the walk over the lists, for contacts of one step before:
    within what a step of 2e-8 s changes.
    """
    size = "fix size all cluster/breakmerge {} 1e-4 2000 K 1 terms cc break no merge no\n"
    values = {}
    for name, contact in (("noted", gran("tangential none")), ("walked", STOCK)):
        script = crowd(contact, 150).replace(write(), "")
        script += "timestep 2e-8\n" + size.format(4) + "run 50\n" + write("f_size[5]")
        values[name] = run(tmp_path / name, script).dump()["f_size[5]"]
    assert np.count_nonzero(values["noted"]) > 20
    assert np.array_equal(values["noted"] > 0, values["walked"] > 0)
    assert np.allclose(values["noted"], values["walked"], rtol=0.05, atol=1e-3 * values["walked"].max())


@pytest.mark.parametrize(
    "style, words",
    [
        ("gran/cluster", ["missing k_n"]),
        ("gran/cluster 0 0.3 0.3", ["k_n value: 0", "> 0", "force/length"]),
        ("gran/cluster 10 1.1 0.3", ["e value: 1.1", "from 0 to 1"]),
        ("gran/cluster 10 0.3 -1", ["mu value: -1"]),
        ("gran/cluster 10 0.3 0.3 tangential hertz", ["tangential value: hertz", "md | linear | none"]),
        ("gran/cluster 10 0.3 0.3 delta_max poisson 0.6", ["delta_max poisson NU value: 0.6", "<= 0.5"]),
        ("gran/cluster 10 0.3 0.3 delta_max kt", ["missing delta_max kt K_T"]),
        ("gran/cluster 10 0.3 0.3 cutoff -1", ["cutoff D_MAX value: -1"]),
        ("gran/cluster 10 0.3 0.3 cut 1", ["Unknown pair_style gran/cluster keyword: cut"]),
    ],
)
def test_bad_input_is_named(tmp_path, style, words):
    r = run(tmp_path, head() + random_clusters(3) + f"pair_style {style}\n", check=False)
    assert r.code != 0
    for word in words:
        assert word in r.output
    if "missing" not in words[0]:
        line, caret = r.output.split("Last input line: ")[1].splitlines()[:2]
        assert caret.strip() == "^" * len(caret.strip())


def test_clusters_at_one_point_stop_the_run(tmp_path):
    two = clusters((400, (0.02, 0.02), (0.0, 0.0)), (400, (0.02, 0.02), (0.0, 0.0)))
    r = run(tmp_path, head() + two + gran() + "fix move all nve\nrun 5\n", check=False)
    assert r.code != 0 and "clusters 1 and 2 is not finite at step 0" in r.output


def test_merged_clusters_need_the_cutoff(tmp_path):
    """Without it they would overlap without a force: refused by name of the remedy."""
    script = crowd(gran().replace(f" cutoff {CUTOFF}", ""), 0).replace(write(), "")
    script += "fix size all cluster/breakmerge 4 1e-4 2000 K 1 terms cc\nrun 0\n"
    r = run(tmp_path, script, check=False)
    assert r.code != 0 and "pair_style gran/cluster" in r.output and "cutoff" in r.output
