"""pair gran/cluster: Eqs. (3) and (4) on the engine, against LAMMPS' own granular pair where they agree."""

import itertools

import numpy as np
import pytest
from lammps_run import CUTOFF, clusters, head, pair, random_clusters, run, write

STOCK = pair("hooke 10.0 0.3 tangential linear_nohistory 0.0 0.0 damping coeff_restitution")


def gran(options: str = "", mu: float = 0.33, cutoff: float = CUTOFF, e: float = 0.3) -> str:
    return f"pair_style gran/cluster 10.0 {e} {mu} {options} cutoff {cutoff}\npair_coeff * *\n"


def crowd(contact: str, steps: int = 1000, newton: str = "on", atom_style: str = "sphere", count: int = 500) -> str:
    """Hundreds of clusters of two sizes that collide; nothing but contacts acts."""
    small = "group half id <> 1 200\nset group half diameter 5e-4\nset group half density 1000.0\n"
    stir = "variable u atom 0.5*sin(79190*x+104729*z)\nvariable w atom 0.5*sin(61379*x-94321*z)\nvelocity all set v_u 0 v_w\n"
    move = "sphere" if atom_style == "sphere" else ""
    return (
        head(newton=newton).replace("atom_style   sphere", f"atom_style   {atom_style}") + random_clusters(count)
        + small + contact + stir + f"fix move all nve{'/sphere' if move else ''}\ntimestep 2e-6\nthermo 100\n"
        + "thermo_style custom step ke pe press\nthermo_modify lost error format float %.16g\n"
        + f"run {steps}\n" + write()
    )


def state(result) -> np.ndarray:
    end = result.dump()
    return np.stack([end[c] for c in ("x", "z", "vx", "vz", "fx", "fz")])


def assert_close(a: np.ndarray, b: np.ndarray, rel: float) -> None:
    """Every row within rel of its own largest value: a row is one quantity of all clusters."""
    for x, y in zip(a, b, strict=True):
        assert np.abs(x - y).max() <= rel * np.abs(y).max()


@pytest.mark.parametrize("newton", ["on", "off"])
def test_equals_granular_hooke_without_friction(tmp_path, newton):
    """1e-12 after one force evaluation and after 200 steps of collisions, which round differently."""
    for steps in (0, 200):
        stock = run(tmp_path / f"stock{steps}", crowd(STOCK, steps, newton))
        ours = run(tmp_path / f"ours{steps}", crowd(gran("tangential none"), steps, newton))
        assert np.abs(state(stock)[4:]).max() > 0 or steps == 0
        assert_close(state(ours), state(stock), 1e-12) if np.abs(state(stock)[4:]).max() else None


@pytest.mark.parametrize("options", ["tangential none", "", "tangential linear", "direction velocity"])
def test_same_on_any_ranks_and_newton(tmp_path, options):
    """Sums of forces are added in another order: 1e-9 after 300 steps of a system that amplifies rounding."""
    one = state(run(tmp_path / "1", crowd(gran(options), 300)))
    for ranks, newton in itertools.product((1, 2, 4), ("on", "off")):
        if (ranks, newton) == (1, "on"):
            continue
        many = state(run(tmp_path / f"{ranks}{newton}", crowd(gran(options), 300, newton), ranks))
        assert_close(many, one, 1e-9)
