"""Energy of contacts by each pair style's own law, entry 10 of fix cluster/timestep, against closed forms; bonds that hold
beyond touching are contacts.
"""

import numpy as np
import pytest
from lammps_run import CUTOFF, clusters, diameter, head, run, write

R1, R2 = 0.5 * float(diameter(400)), 0.5 * float(diameter(150))
REDUCED = R1 * R2 / (R1 + R2)
OVERLAP = 6.3e-6
E, NU = 1.709e5, 0.25
STIFF = E / (1 - NU**2) / 2  # effective modulus of two alike
PLAIN = "tangential linear_nohistory 0 0 damping viscoelastic"
OVERLAY = f"pair_style hybrid/overlay {{}} zero {CUTOFF}\npair_coeff * * {{}}\npair_coeff * * zero\n"


def granular(law: str) -> str:
    return f"pair_style granular\npair_coeff * * {law} cutoff {CUTOFF}\n"


def dmt(overlap: float, gamma: float) -> float:
    """4/3 E* sqrt(R) x^(3/2) - 4 pi gamma R, integrated from touching."""
    return 8 / 15 * STIFF * np.sqrt(REDUCED) * overlap**2.5 - 4 * np.pi * gamma * REDUCED * overlap


def jkr(overlap: float, gamma: float) -> float:
    """Johnson, Kendall & Roberts (1971) by the contact radius a, from the largest pull on, where LAMMPS' contacts end."""
    a = np.geomspace(1e-7, 1e-3, 10)  # brackets

    def depth(a):
        return a**2 / REDUCED - 2 * np.sqrt(np.pi * gamma * a / STIFF)

    def stored(a):
        return (
            8 / 15 * STIFF * a**5 / REDUCED**2
            - 8 / 3 * np.sqrt(np.pi * gamma * STIFF) * a**3.5 / REDUCED
            + 2 * np.pi * gamma * a**2
        )

    least = np.cbrt(9 * np.pi * gamma * REDUCED**2 / (4 * STIFF))
    lo, hi = least, a[-1]
    for _ in range(200):
        lo, hi = (0.5 * (lo + hi), hi) if depth(0.5 * (lo + hi)) < overlap else (lo, 0.5 * (lo + hi))
    return float(stored(lo) - stored(least))


HERTZ = 2 / 5 * np.sqrt(REDUCED) * OVERLAP**2.5
LAWS = {
    "gran/cluster": (
        f"pair_style gran/cluster 10.0 0.3 0.33 cutoff {CUTOFF}\npair_coeff * *\n",
        5.0 * OVERLAP**2,
        1e-9,
    ),
    "hooke": (granular(f"hooke 10.0 0.3 {PLAIN}"), 5.0 * OVERLAP**2, 1e-9),
    "hertz": (granular(f"hertz 1e5 50.0 {PLAIN}"), 1e5 * HERTZ, 1e-9),
    "hertz/material": (granular(f"hertz/material {E} 0.3 {NU} {PLAIN}"), 4 / 3 * STIFF * HERTZ, 1e-9),
    "dmt": (granular(f"dmt {E} 0.3 {NU} 0.02 {PLAIN}"), dmt(OVERLAP, 0.02), 1e-9),
    "jkr": (granular(f"jkr {E} 0.3 {NU} 0.002 {PLAIN}"), jkr(OVERLAP, 0.002), 1e-7),
    "gran/hooke": (OVERLAY.format("gran/hooke 10.0 8.57 1000.0 500.0 0.33 1", "gran/hooke"), 5.0 * OVERLAP**2, 1e-9),
    "gran/hooke/history": (
        OVERLAY.format("gran/hooke/history 10.0 8.57 1000.0 500.0 0.33 1", "gran/hooke/history"),
        5.0 * OVERLAP**2,
        1e-9,
    ),
    "gran/hertz/history": (
        OVERLAY.format("gran/hertz/history 1e5 8e4 1e6 5e5 0.33 1", "gran/hertz/history"),
        1e5 * HERTZ,
        1e-9,
    ),
}
CONTROL = "fix dt all cluster/timestep 1e-7 energy off contact off\n"


def box(ranks: int, newton: str = "on") -> str:
    """The clusters of two() are on different ranks where there are two."""
    return head(newton=newton).replace("create_box", f"processors {ranks} 1 1\ncreate_box")


def two(overlap: float, v: float = 0.0) -> str:
    """Clusters of 400 and 150 particles on both sides of the middle of the box, one above the other's height."""
    distance = float(R1 + R2 - overlap)
    return clusters((400, (0.02 - 0.6 * distance, 0.02), (v, 0.0)), (150, (0.02 + 0.4 * distance, 0.02), (-v, 0.0)))


def energy(r) -> float:
    return float(next(line for line in r.output.splitlines() if line.startswith("STORED")).split()[1])


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "on"), (2, "off")])
@pytest.mark.parametrize("law", LAWS)
def test_energy_of_a_contact(tmp_path, law, ranks, newton):
    """Damping plays no part: the clusters approach each other. Positions are rounded to 1e-18 m beside an overlap of 6e-6 m."""
    contact, expected, tolerance = LAWS[law]
    script = (
        box(ranks, newton)
        + two(OVERLAP, 0.3)
        + contact
        + CONTROL
        + 'fix move all nve/sphere\nrun 0\nprint "STORED $(f_dt[10]:%.17g)"\n'
    )
    r = run(tmp_path, script, ranks)
    assert expected != 0
    assert energy(r) == pytest.approx(expected, rel=tolerance, abs=0)


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_bond_stretched_beyond_touching_is_a_contact(tmp_path, ranks):
    """JKR: made in touch, then pulled apart to half of where it ends. Its energy is counted, and the two merge; the same two
    that never touched hold nothing and do not.
    """
    gamma = 0.02
    end = np.cbrt(3 * np.pi**2 / 16) * np.cbrt(REDUCED * (gamma / STIFF) ** 2)
    stretched = two(-0.5 * end)
    x1, x2 = (float(line.split()[3]) for line in stretched.splitlines() if line.startswith("create_atoms"))
    fixes = CONTROL + (
        "fix move all nve\nfix size all cluster/breakmerge 1 1e-4 2000 terms mf umf 0.006 K 1.0 break no merge 0.1\n"
        "timestep 1e-8\n"
    )
    pull = f"set atom 1 x {x1!r}\nset atom 2 x {x2!r}\nrun 0\n"
    end_of_it = 'print "STORED $(f_dt[10]:%.17g)"\nset group all vx 0.2\nrun 3\nprint "LEFT $(atoms)"\n'
    contact = granular(f"jkr {E} 0.3 {NU} {gamma} {PLAIN}").replace(str(CUTOFF), "1.7e-3")

    def go(folder, bodies, text):
        return run(tmp_path / folder, box(ranks) + bodies + contact + fixes + text, ranks)

    bonded = go("bonded", two(1e-6), "run 0\n" + pull + end_of_it)
    apart = go("apart", stretched, "run 0\n" + end_of_it)
    assert energy(bonded) == pytest.approx(jkr(-0.5 * end, gamma), rel=1e-7, abs=0)
    assert energy(bonded) < 0
    assert "LEFT 1" in bonded.output
    assert energy(apart) == 0.0
    assert "LEFT 2" in apart.output


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_stretched_bond_is_in_n_cc(tmp_path, ranks):
    """The power of its force, of JKR at half of the way to where it ends and without damping, as for any contact."""
    gamma, speed = 0.02, -0.1
    end = np.cbrt(3 * np.pi**2 / 16) * np.cbrt(REDUCED * (gamma / STIFF) ** 2)
    x1, x2 = (float(line.split()[3]) for line in two(-0.5 * end).splitlines() if line.startswith("create_atoms"))
    contact = granular(f"jkr {E} 0.0 {NU} {gamma} {PLAIN}").replace(str(CUTOFF), "1.7e-3")
    script = (
        box(ranks)
        + two(1e-6)
        + contact
        + "fix move all nve\nfix size all cluster/breakmerge 1 1e-4 2000 K 1 terms cc ncc 0.7 break no merge no\nrun 0\n"
        + f"set atom 1 x {x1!r} vx {speed!r}\nset atom 2 x {x2!r}\nrun 0\n"
        + write("f_size[5]")
    )
    row = run(tmp_path, script, ranks).dump()
    step = 1e-4 * end
    force = (jkr(-0.5 * end + step, gamma) - jkr(-0.5 * end - step, gamma)) / (2 * step)
    assert force < 0
    assert row["fx"] == pytest.approx([-force, force], rel=1e-5, abs=0)
    assert row["f_size[5]"] == pytest.approx(0.7 * abs(force * speed) / row["mass"], rel=1e-5, abs=0)


SPRING = 85.7
ROOT = float(np.sqrt(REDUCED * OVERLAP))  # contact radius
TANGENTIAL = {
    "gran/cluster": (
        f"pair_style gran/cluster 300.0 1.0 100.0 tangential linear delta_max kt {SPRING} cutoff {CUTOFF}\npair_coeff * *\n",
        SPRING,
    ),
    "linear_history": (
        granular(f"hooke 300.0 0.0 tangential linear_history {SPRING} 0.0 100.0 damping velocity"),
        SPRING,
    ),
    "mindlin": (granular("hertz 1e7 0.0 tangential mindlin 4e6 0.0 100.0 damping velocity"), 4e6 * ROOT),
    "mindlin/force": (granular("hertz 1e7 0.0 tangential mindlin/force 4e6 0.0 100.0 damping velocity"), 4e6 * ROOT),
    "gran/hooke/history": (
        OVERLAY.format(f"gran/hooke/history 300.0 {SPRING} 0.0 0.0 100.0 0", "gran/hooke/history"),
        SPRING,
    ),
    "gran/hertz/history": (
        OVERLAY.format("gran/hertz/history 1e7 4e6 0.0 0.0 100.0 0", "gran/hertz/history"),
        4e6 * ROOT,
    ),
}


@pytest.mark.parametrize("law", TANGENTIAL)
def test_tangential_spring_is_counted(tmp_path, law):
    """Started anew after one step of tangential motion, without and with the history of that step: the difference is
    1/2 k_t (v dt)^2, to the share by which the first half step's forces change v (1 %).
    """
    v, dt = 0.02, 1e-7
    contact, stiffness = TANGENTIAL[law]
    body = two(OVERLAP).replace("vx 0.0 vz 0.0", f"vx 0.0 vz {v!r}", 1)

    def go(folder: str, mu: str) -> float:
        script = (
            head()
            + body
            + contact.replace("100.0", mu)
            + f"fix dt all cluster/timestep {dt!r} energy off contact off\nfix move all nve\ntimestep {dt!r}\n"
            + 'run 1\nprint "STORED $(f_dt[10]:%.17g)"\n'
        )
        return energy(run(tmp_path / folder, script))

    slid = v * dt
    assert go("held", "100.0") - go("free", "0.0") == pytest.approx(0.5 * stiffness * slid**2, rel=1e-2, abs=0)


def test_a_law_with_memory_is_refused(tmp_path):
    contact = granular("mdr 1e6 0.3 1e5 0.0 0.5 0.9 tangential linear_nohistory 0 0 damping none")
    newer = run(tmp_path / "words", head() + two(OVERLAP) + contact + "run 0\n", check=False)
    if "Must specify damping" in newer.output:  # as a LAMMPS after 4 Feb 2025 wants it
        contact = contact.replace("damping none", "damping mdr 1")
    r = run(tmp_path, head() + two(OVERLAP) + contact + CONTROL + "fix move all nve/sphere\nrun 0\n", check=False)
    assert r.code != 0 and "remembers" in r.output
