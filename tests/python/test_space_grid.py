"""Grids in space: maps against plain loops, and VTK files read back by pyvista."""

from __future__ import annotations

import math

import numpy as np
import pytest
from clusterdem import ArgumentError, SpaceGrid, maps_of
from clusterdem.frame import Box
from synthetic import SKEW, skew_frame, write_skew_run

SHAPE = (3, 2, 5)
WIDE = Box(SKEW.lo, SKEW.hi, (False, True, True))


def plain_maps(frame, shape):
    """Every map of cells in space, a loop over cells and clusters."""
    box = frame.box
    cell = []
    for i in range(len(frame)):
        place = [float(frame[axis][i]) for axis in "xyz"]
        cell.append(
            tuple(
                int((p - low) / length * k) for p, low, length, k in zip(place, box.lo, box.lengths, shape, strict=True)
            )
        )
    volume = math.prod(box.lengths) / math.prod(shape)
    found = {
        name: np.full(shape, math.nan)
        for name in ("mean_diameter", "temperature", "velocity_x", "velocity_y", "velocity_z")
    }
    found |= {name: np.zeros(shape) for name in ("mass", "fraction", "number_density")}
    for index in np.ndindex(shape):
        inside = [i for i in range(len(frame)) if cell[i] == index]
        mass = sum(float(frame.mass[i]) for i in inside)
        found["mass"][index] = mass
        found["fraction"][index] = mass / 2500 / volume
        found["number_density"][index] = len(inside) / volume
        if not inside:
            continue
        found["mean_diameter"][index] = sum(float(frame.diameter[i]) for i in inside) / len(inside)
        squares = 0.0
        for axis in "xyz":
            mean = sum(float(frame.mass[i] * frame[f"v{axis}"][i]) for i in inside) / mass
            found[f"velocity_{axis}"][index] = mean
            squares += sum(float(frame.mass[i]) * (float(frame[f"v{axis}"][i]) - mean) ** 2 for i in inside) / mass
        if len(inside) > 1:
            found["temperature"][index] = squares / 3
    return found


@pytest.mark.parametrize("box", [SKEW, WIDE])
@pytest.mark.parametrize("count", [200, 1, 0])
@pytest.mark.parametrize("shape", [SHAPE, (30, 13, 250)])
def test_maps_in_space(box, count, shape):
    """The second shape has cells of 4 mm, in which clusters of up to 7.8 mm lie whole, by their centres."""
    frame = skew_frame(count, box=box).with_density(2500)
    found = maps_of(frame, SpaceGrid(box, shape))
    if shape != SHAPE:
        assert not count or frame.diameter.max() > 1.5 * max(SpaceGrid(box, shape).spacing) or count == 1
    else:
        for name, expected in plain_maps(frame, shape).items():
            np.testing.assert_allclose(found[name], expected, rtol=1e-10, atol=1e-15, err_msg=name)
    assert set(found) == set(plain_maps(skew_frame(0), (1, 1, 1)))
    assert found["mass"].sum() == pytest.approx(frame.mass.sum(), rel=1e-12)
    volume = SpaceGrid(box, shape).cell_volume
    assert found["fraction"].sum() * volume == pytest.approx(frame.mass.sum() / 2500, rel=1e-12)
    for axis in "xyz":
        momentum = np.nansum(found["mass"] * found[f"velocity_{axis}"])
        assert momentum == pytest.approx((frame.mass * frame[f"v{axis}"]).sum(), rel=1e-10)


def test_a_slab_of_one_cell_is_the_map_of_the_plane():
    from clusterdem import Grid

    frame = skew_frame(200).with_density(2500)
    space, plane = maps_of(frame, SpaceGrid(SKEW, (4, 1, 6))), maps_of(frame, Grid(SKEW, 4, 6))
    for name in ("mass", "fraction", "mean_diameter", "velocity_x", "velocity_z"):
        np.testing.assert_allclose(space[name][:, 0, :], plane[name], rtol=1e-12, err_msg=name)


def test_vtk_in_space_is_read_back(tmp_path, command):
    pyvista = pytest.importorskip("pyvista")
    dumps, frames = write_skew_run(tmp_path, [150, 0, 1])
    code, out, err = command("vtk", *dumps, "--grid", *SHAPE, "--rho", "2500", "--out", tmp_path / "v")
    assert (code, err) == (0, "") and out.count("maps.") == 4
    for frame in frames:
        image = pyvista.read(tmp_path / f"v/maps.{frame.step:010d}.vti")
        assert image.dimensions == (4, 3, 6)
        assert image.bounds == pytest.approx((-0.05, 0.07, 0.2, 0.25, -0.3, 0.7))
        assert float(image.field_data["TimeValue"][0]) == frame.time
        expected = plain_maps(frame, SHAPE)
        velocity = np.stack([expected.pop(f"velocity_{axis}") for axis in "xyz"], axis=-1)
        expected["velocity"] = velocity
        assert set(image.cell_data) == set(expected)
        # by the place of each cell's centre, not by any order
        centres = image.cell_centers().points
        for point, number in zip(centres, range(image.n_cells), strict=True):
            index = tuple(
                int((p - low) / length * k)
                for p, low, length, k in zip(point, SKEW.lo, SKEW.lengths, SHAPE, strict=True)
            )
            for name, values in expected.items():
                np.testing.assert_allclose(
                    image.cell_data[name][number], values[index], rtol=1e-10, atol=1e-15, err_msg=name
                )
        assert image.cell_data["mass"].sum() == pytest.approx(frame.mass.sum(), rel=1e-12)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--grid", "3"), "--grid: must be two numbers of cells, in a plane, or three, in space, not 3"),
        (("--grid", "3", "2", "1", "4"), "in space, not 3 2 1 4"),
        (("--grid", "3", "0", "5"), "--grid: needs at least one cell along x, y and z, not 3 x 0 x 5"),
        (("--grid", "3000", "3000", "3000"), "--grid: 3000 x 3000 x 3000 cells are more than 10,000,000"),
        (("--grid", "3", "2", "5", "--plane", "xy"), "--plane: is for two numbers of cells: 3 2 5 are cells in space"),
        (
            ("--grid", "3", "2", "5", "--deposit", "overlap"),
            "--deposit: must be nearest for cells in space, not overlap",
        ),
        (("--grid", "3", "2", "3000"), "narrower than the smallest cluster"),
    ],
)
def test_cells_that_cannot_be(words, said, tmp_path, command):
    dumps, _ = write_skew_run(tmp_path, [5])
    code, _, err = command("vtk", *dumps, *words, "--out", tmp_path / "out")
    assert code == 2 and said in err


def test_methods_of_cells_in_space():
    with pytest.raises(ArgumentError, match="method: must be nearest for cells in space, not overlap"):
        maps_of(skew_frame(3), SpaceGrid(SKEW, (1, 1, 1)), "overlap")
