"""Two kinds of primary particles in one fix cluster/breakmerge: an atom type each."""

import numpy as np
import pytest
import scenes
from lammps_run import D_P, M_P, RHO_P, diameter, head, pair, run, write

HEAVY = 5000.0  # density of the other particles [kg/m^3]
FINE = 0.8e-4  # their diameter, where it differs [m]
KIND = f" kind 2 {D_P} {HEAVY}"


def box(**options) -> str:
    return head(**options).replace("create_box   1 box", "create_box   2 box")


def crowd() -> str:
    """300 clusters of 400 particles, every other one heavy."""
    return (
        box()
        + "region plane block EDGE EDGE 0.0015 0.0015 EDGE EDGE\n"
        + f"create_atoms 1 random 300 1 plane overlap {diameter(400)!r} maxtry 10000\nreset_atoms id sort yes\n"
        + "variable heavy atom id%2==0\ngroup heavy variable heavy\nset group heavy type 2\n"
        + f"set group all diameter {diameter(400)!r}\nset type 1 density 1000\nset type 2 density {HEAVY / 2}\n"
        + pair()
        + "variable u atom 0.4*sin(79190*x+104729*z)\nvariable w atom 2+0.4*sin(61379*x-94321*z)\nvelocity all set v_u 0 v_w\n"
    )


END = write("type", "f_size[1]", "f_size[4]", "f_size[6]")


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("kinds")
    script = crowd() + scenes.fixes(options=KIND) + scenes.outputs() + "run 1000\n" + END
    return {n: run(folder / str(n), script, n) for n in (1, 2)}


@pytest.mark.parametrize("np_", [1, 2])
def test_particles_of_each_kind_are_conserved(runs, np_):
    row, last = runs[np_].dump(), runs[np_].table()[-1]
    assert last[scenes.BREAKUPS] > 50 and last[scenes.MERGES] > 5
    for kind, density in ((1, RHO_P), (2, HEAVY)):
        ours = row["type"] == kind
        n = row["f_size[1]"][ours]
        assert n.sum() == 150 * 400
        assert row["mass"][ours] == pytest.approx(n * M_P * density / RHO_P, rel=1e-13)
        assert row["diameter"][ours] == pytest.approx(D_P * np.cbrt(2 * n), rel=1e-13)


def test_the_same_on_two_ranks(runs):
    counts = slice(1, 7)
    assert np.array_equal(runs[1].table()[:, counts], runs[2].table()[:, counts])
    assert np.array_equal(runs[1].dump()["id"], runs[2].dump()["id"])


def test_restart(tmp_path):
    script = crowd() + scenes.fixes(options=KIND) + scenes.outputs()
    whole = run(tmp_path / "whole", script + "run 301\nwrite_restart half.restart\nrun 300\n" + END)
    again = run(tmp_path / "again", scenes.again("../whole/half.restart", options=KIND) + "run 300\n" + END)
    assert all(np.array_equal(whole.dump()[c], again.dump()[c]) for c in whole.dump())


def pair_of(kinds: tuple[int, int], d_p=(D_P, D_P), rho=(RHO_P, HEAVY)) -> str:
    """Two clusters of 300 particles in contact, at one velocity."""
    d = [diameter(300) * d_p[k - 1] / D_P for k in kinds]
    text = ""
    for i, kind in enumerate(kinds):
        x = 0.02 + i * 0.499 * (d[0] + d[1])
        text += (
            f"create_atoms {kind} single {x!r} 0.0015 0.02\n"
            f"set atom {i + 1} diameter {d[i]!r} density {rho[kind - 1] / 2}\nset atom {i + 1} vz 1.0\n"
        )
    return text


@pytest.mark.parametrize("kinds, left", [((1, 1), 1), ((2, 2), 1), ((1, 2), 2)])
def test_kinds_do_not_merge_with_each_other(tmp_path, kinds, left):
    script = (
        box() + pair_of(kinds) + pair() + "fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 1\n"
        f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag K 1 terms mf{KIND}\ntimestep 1e-12\nrun 1\n" + END
    )
    row = run(tmp_path, script).dump()
    assert len(row["id"]) == left and row["f_size[1]"].sum() == 600


def test_powers_of_each_kind(tmp_path):
    """N_st of a primary particle goes with 1/(rho_p d_p^2) in Stokes' drag, U_mf by Wen & Yu with its Archimedes number."""
    d_p, rho, g, nu, rho_g = (D_P, FINE), (RHO_P, HEAVY), 9.81, 1.53e-5, 1.2
    script = (
        box() + pair_of((1, 2), d_p, rho) + pair() + "fix move all nve\n"
        f"fix drag all drag/cluster {rho_g} {nu} velocity 0 0 2 law stokes\n"
        f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag K 1 kind 2 {FINE} {HEAVY} break no merge no\nrun 0\n"
        + END
    )
    row = run(tmp_path, script).dump()
    for k in (0, 1):
        n_st = 18 * nu * rho_g / (rho[k] * d_p[k] ** 2) * (2 - 1) * 2
        assert row["f_size[4]"][k] == pytest.approx(n_st, rel=1e-10)
        archimedes = g * d_p[k] ** 3 * (rho[k] - rho_g) / (rho_g * nu**2)
        u_mf = nu / d_p[k] * (np.sqrt(33.7**2 + 0.0408 * archimedes) - 33.7)
        assert row["f_size[6]"][k] == pytest.approx((u_mf + 1.0) * g, rel=1e-10)  # eps_mf U_p/(1 - eps_mf) = |V_z|
        assert row["f_size[1]"][k] == 300


@pytest.mark.parametrize(
    "drag, size, message",
    [
        ("", "kind 3 1e-4 2000", "kind TYPE value: 3 (must be an atom type from 1 to 2)"),
        ("", "kind 2 1e-4 2000 kind 2 1e-4 3000", "kind TYPE value: 2 (must be a type that has no kind yet)"),
        ("", "kind 2 0 2000", "kind d_p value: 0 (must be a number > 0 [length])"),
        ("", "kind 2 1e-4", "missing kind rho_p"),
        ("", "kind 2 1e-4 3000 up superficial grid 1 1 1", "up superficial knows one density of primary particles only"),
        ("", "", "does not fit its 750"),  # without its kind a heavy cluster has 750 particles, of another diameter
        ("", "kind 2 2e-4 5000", "which is 37.50 primary particles, not a whole number"),  # 300 of 1e-4 m are 37.5 of 2e-4 m
        ("unshielded 0.5", "kind 2 1e-4 5000", "knows one kind of primary particle only"),
    ],
)  # fmt: skip
def test_refusals(tmp_path, drag, size, message):
    script = (
        box()
        + pair_of((1, 2))
        + pair()
        + f"fix move all nve\nfix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 {drag}\n"
        f"fix size all cluster/breakmerge 1 {D_P} {RHO_P} drag drag K 1 {size}\nrun 0\n"
    )
    r = run(tmp_path, script, check=False)
    assert r.code != 0 and message in r.output, r.output[-900:]
