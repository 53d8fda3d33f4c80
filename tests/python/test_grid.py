"""Deposition and maps."""

from __future__ import annotations

import numpy as np
import pytest
from clusterdem import ArgumentError, Box, Grid, InputError, deposit, maps_of
from clusterdem.analysis.grid import check_resolution
from clusterdem.analysis.overlap import cap, edge_volume
from hypothesis import given, settings
from hypothesis import strategies as st
from synthetic import BOX, random_frame


@pytest.mark.parametrize("method", ["nearest", "overlap"])
@pytest.mark.parametrize("shape", [(1, 1), (30, 30), (7, 13), (60, 120)])
@pytest.mark.parametrize("periodic", [(True, False, True), (False, False, False)])
def test_mass_on_the_grid_is_the_mass_of_the_clusters(method, shape, periodic):
    box = Box(BOX.lo, BOX.hi, periodic)
    frame = random_frame(20_000, box=box)
    maps = maps_of(frame, Grid(box, *shape), method)
    assert maps["mass"].sum() == pytest.approx(frame.mass.sum(), rel=1e-12)
    assert maps["number_density"].sum() * Grid(box, *shape).cell_volume == pytest.approx(len(frame), rel=1e-12)


@settings(max_examples=200, deadline=None)
@given(
    x=st.floats(0, 0.3, exclude_max=True),
    z=st.floats(0, 0.6, exclude_max=True),
    d=st.floats(1e-4, 1e-2),
    nx=st.integers(1, 40),
    nz=st.integers(1, 40),
)
def test_overlap_shares_of_any_sphere_sum_to_one(x, z, d, nx, nz):
    shares = deposit(Grid(BOX, nx, nz), np.array([x]), np.array([z]), np.array([d]), "overlap")
    assert shares.weight.min() >= 0
    assert shares.weight.sum() == pytest.approx(1.0, rel=1e-14)


def test_edge_volume_of_known_pieces():
    a = np.array([0.0, -1.0, 0.3, -2.0, 0.9, -0.3])
    b = np.array([0.0, -1.0, -1.0, -2.0, 0.9, 0.99])
    sphere = 4 * np.pi / 3
    expected = [sphere / 4, sphere, float(cap(np.array(0.3))), sphere, 0.0, None]
    got = edge_volume(a, b)
    for value, target in zip(got, expected):
        if target is not None:
            assert value == pytest.approx(target, abs=1e-14)


def test_edge_volume_agrees_with_quadrature():
    rng = np.random.default_rng(3)
    nodes, weights = np.polynomial.legendre.leggauss(400)
    for a, b in rng.uniform(-1, 1, (50, 2)):
        x = a + (1 - a) * (nodes + 1) / 2
        c2 = 1 - x * x
        c = np.sqrt(c2)
        q = np.clip(b, -c, c)
        area = c2 * np.arccos(q / c) - q * np.sqrt(np.maximum(c2 - q * q, 0))
        assert edge_volume(np.array(a), np.array(b)) == pytest.approx((weights * area).sum() * (1 - a) / 2, abs=1e-5)


def test_overlap_splits_a_cluster_on_a_border_in_half_and_wraps():
    grid = Grid(BOX, 30, 30)
    shares = deposit(grid, np.array([0.0]), np.array([0.01]), np.array([1e-3]), "overlap")
    mass = shares.total()
    assert mass[0, 0] == pytest.approx(0.5) and mass[-1, 0] == pytest.approx(0.5)


def test_one_cluster_gives_its_own_values():
    frame = random_frame(1)
    grid = Grid(BOX, 3, 3)
    maps = maps_of(frame, grid)
    cell = np.unravel_index(np.argmax(maps["mass"]), grid.shape)
    assert maps["velocity_z"][cell] == pytest.approx(frame["vz"][0])
    assert maps["mean_diameter"][cell] == pytest.approx(frame.diameter[0])
    assert maps["fraction"][cell] == pytest.approx(frame["n"][0] * np.pi / 6 * 1e-12 / grid.cell_volume)
    assert np.isnan(maps["temperature"]).all() and np.isnan(maps["mean_diameter"]).sum() == 8


def test_temperature_of_a_maxwellian():
    frame = random_frame(200_000)
    maps = maps_of(frame, Grid(BOX, 2, 2))
    assert maps["temperature"] == pytest.approx((0.3**2 + 0.4**2) / 2, rel=0.02)


def test_fraction_of_the_papers_start():
    """2.0e6 particles of 100 µm in 0.3 x 0.003 x 0.6 m are 0.194 %."""
    frame = random_frame(5000)
    n = np.full(5000, 400.0)
    columns = dict(frame.columns, n=n, mass=n * np.pi / 6 * 1e-12 * 2000, diameter=1e-4 * np.cbrt(2 * n))
    maps = maps_of(type(frame)(0, 0.0, BOX, columns), Grid(BOX, 30, 30))
    assert maps["fraction"].mean() == pytest.approx(0.00194, rel=2e-3)


def test_grids_that_make_no_sense_are_refused():
    for shape in ((0, 3), (3, -1), (10**5, 10**5)):
        with pytest.raises(ArgumentError, match="^shape: "):
            Grid(BOX, *shape)
    with pytest.raises(InputError, match="narrower than the smallest cluster"):
        check_resolution(random_frame(), Grid(BOX, 3000, 10))
