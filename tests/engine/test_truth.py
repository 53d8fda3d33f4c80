"""The box of bench/truth.py, resolved and as clusters: the same solids in the same places, under the same gas."""

import numpy as np
import pytest
from lammps_run import M_P, ROOT, diameter, run_file
from truth import write_starts

INPUTS = ROOT / "inputs/truth"
PARTICLES, IN_CLUSTER = 1_000, 100


@pytest.fixture(scope="module")
def starts(tmp_path_factory):
    folder = tmp_path_factory.mktemp("starts")
    write_starts(folder, seed=1, particles=PARTICLES, n=IN_CLUSTER)
    return folder


def frames(starts, folder, script, data, **variables):
    """First and last frame of a run of 1 ms."""
    run = run_file(
        folder,
        ["-in", str(INPUTS / f"{script}.in"), "-log", "none"],
        inputs=INPUTS, data=starts / data, tend=1e-3, frame=1e-3, **variables,
    )  # fmt: skip
    return run.dump(f"{script}.00000000.dump"), run.dump(f"{script}.00001000.dump")


def test_clumps_lie_where_clusters_do(starts, tmp_path):
    clumps = frames(starts, tmp_path / "r", "resolved", "clumps.data")[0]
    clusters = frames(starts, tmp_path / "c", "clusters", "clusters.data")[0]
    for frame in (clumps, clusters):
        assert frame["mass"].sum() == pytest.approx(PARTICLES * M_P, rel=1e-9)  # digits of the dump
    box = np.array([0.03, 0.003, 0.06])
    at = np.column_stack([clumps[axis] for axis in "xyz"]).reshape(-1, IN_CLUSTER, 3)
    centres = np.column_stack([clusters[axis] for axis in "xyz"])
    away = at - centres[:, None]
    away -= box * np.round(away / box)
    assert np.abs(away.mean(axis=1)).max() < 1e-10
    assert np.linalg.norm(away, axis=2).max() < 0.5 * diameter(IN_CLUSTER) + 1e-4  # within a particle of its surface
    gaps = np.linalg.norm(away[:, :, None] - away[:, None], axis=3)[:, ~np.eye(IN_CLUSTER, dtype=bool)]
    assert gaps.min() > 1.1e-4  # none touch: 1.14 diameters apart at voidage 0.5


def test_clusters_with_the_drag_of_their_particles_move_as_these(starts, tmp_path):
    """One gust for all: nothing meets, so each body follows the equation of one particle. The runs hold drag
    coefficients over other steps, up to 10 of 1000: some 4e-8 m/s of the 0.02 m/s that the gas and gravity give.
    """
    options = {"gusts": "1 1 1", "seed": 4}
    last = frames(starts, tmp_path / "r", "resolved", "clumps.data", **options)[1]
    exposed = frames(starts, tmp_path / "e", "clusters", "clusters.data", unshielded=1, events="no", **options)[1]
    body = frames(starts, tmp_path / "b", "clusters", "clusters.data", events="no", **options)[1]
    for axis in ("vx", "vz"):
        assert np.ptp(last[axis]) < 1e-9
        assert exposed[axis] == pytest.approx(last[axis][0], abs=1e-6)
        assert np.abs(body[axis] - exposed[axis]).min() > 1e-3


def test_particles_at_random_keep_apart(starts, tmp_path):
    first, last = frames(starts, tmp_path, "resolved", "random.data")
    assert len(first["x"]) == len(last["x"]) == PARTICLES
    at = np.column_stack([first[axis] for axis in "xyz"])
    box = np.array([0.03, 0.003, 0.06])
    for shift in range(1, 40):  # neighbours in x order are the only ones that could overlap
        order = np.argsort(at[:, 0])
        apart = at[np.roll(order, shift)] - at[order]
        apart -= box * np.round(apart / box)
        assert np.linalg.norm(apart, axis=1).min() > 1e-4
