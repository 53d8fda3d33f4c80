"""Gas field files: what is written is what VTK reads, and what VTK writes is read; bad files end in one line."""

from __future__ import annotations

import math

import numpy as np
import pytest
from clusterdem.errors import InputError
from clusterdem.gas.field import GasField
from clusterdem.gas.legacy import TITLE, read_field, read_legacy, write_field
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

pv = pytest.importorskip("pyvista")


def random_field(shape=(4, 1, 5), time=0.25, seed=1, names=("velocity", "fluctuation", "density", "viscosity")):
    rng = np.random.default_rng(seed)
    axes = tuple(np.cumsum(rng.uniform(0.1, 1, n)) for n in shape)
    parts = {"velocity": (3,), "fluctuation": (3,), "density": (), "viscosity": ()}
    return GasField(axes, {name: rng.uniform(0.1, 2, (*shape, *parts[name])) for name in names}, time)


def flat(values):
    """In the file's order, x fastest."""
    return np.moveaxis(values, (0, 1, 2), (2, 1, 0)).reshape(-1, *values.shape[3:])


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    shape=st.tuples(*[st.integers(1, 4)] * 3),
    time=st.one_of(st.just(math.nan), st.floats(0, 1e3)),
    seed=st.integers(0, 99),
    ascii=st.booleans(),
)
def test_written_and_read_is_the_same_to_the_bit(tmp_path, shape, time, seed, ascii):
    gas = random_field(shape, time, seed)
    back = read_field(write_field(tmp_path / "gas.vtk", gas, ascii))
    assert back.arrays.keys() == gas.arrays.keys()
    np.testing.assert_array_equal(back.time, gas.time)
    for ours, theirs in zip((*gas.axes, *gas.arrays.values()), (*back.axes, *back.arrays.values())):
        np.testing.assert_array_equal(ours, theirs)


@pytest.mark.parametrize("ascii", [False, True])
def test_vtk_reads_ours(tmp_path, ascii):
    gas = random_field()
    path = write_field(tmp_path / "gas.vtk", gas, ascii)
    grid = pv.read(path)
    assert isinstance(grid, pv.RectilinearGrid) and grid.field_data["TIME"][0] == gas.time
    for ours, theirs in zip(gas.axes, (grid.x, grid.y, grid.z)):
        np.testing.assert_array_equal(ours, theirs)
    for name, values in gas.arrays.items():
        np.testing.assert_array_equal(grid.point_data[name], flat(values))
    assert path.read_bytes().split(b"\n")[1].decode() == TITLE


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize("version", [42, 51])
@pytest.mark.parametrize("kind", ["double", "float"])
def test_ours_reads_vtk(tmp_path, binary, version, kind):
    """Also what it puts between: METADATA, names of components, FIELD, other arrays, cells' values, colour tables."""
    from vtkmodules.vtkIOLegacy import vtkRectilinearGridWriter

    gas = random_field((3, 2, 4))
    grid = pv.RectilinearGrid(*(axis.astype("f8" if kind == "double" else "f4") for axis in gas.axes))
    grid.point_data["pressure in Pa"] = np.arange(24)
    for name, values in gas.arrays.items():
        grid.point_data[name] = flat(values).astype("f8" if kind == "double" else "f4")
    grid.point_data.GetAbstractArray("velocity").SetComponentName(0, "along x")
    grid.cell_data["of cells"] = np.ones(6)
    grid.field_data["TIME"] = [0.25]
    grid.point_data.active_scalars_name = "density"
    writer = vtkRectilinearGridWriter()
    writer.SetFileName(str(tmp_path / "vtk.vtk"))
    writer.SetInputData(grid)
    writer.SetFileVersion(version)
    (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
    assert writer.Write() == 1
    back = read_field(tmp_path / "vtk.vtk")
    tolerance = 0 if binary and kind == "double" else 1e-5  # VTK writes a float with 6 digits as text
    assert back.time == 0.25
    for name, values in gas.arrays.items():
        np.testing.assert_allclose(back[name], values, rtol=tolerance)
    for ours, theirs in zip(gas.axes, back.axes):
        np.testing.assert_allclose(theirs, ours, rtol=tolerance)


def test_structured_points(tmp_path):
    image = pv.ImageData(dimensions=(3, 1, 4), spacing=(0.1, 1.0, 0.2), origin=(1, 2, 3))
    image.point_data["velocity"] = np.arange(36.0).reshape(12, 3)
    image.save(tmp_path / "image.vtk")
    gas = read_field(tmp_path / "image.vtk")
    np.testing.assert_allclose(gas.axes[0], [1, 1.1, 1.2])
    np.testing.assert_allclose(gas.axes[2], [3, 3.2, 3.4, 3.6])
    np.testing.assert_array_equal(gas["velocity"][1, 0, 2], [21, 22, 23])  # point 1 + 3 * 2
    assert math.isnan(gas.time)


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data(), ascii=st.booleans())
def test_a_spoilt_file_is_refused_or_read_never_worse(tmp_path, data, ascii):
    """Cut anywhere, or with some bytes changed: the package's error, or a field of the right shape."""
    path = write_field(tmp_path / "gas.vtk", random_field((2, 1, 2)), ascii)
    raw = bytearray(path.read_bytes())
    raw = raw[: data.draw(st.integers(0, len(raw)))]
    for _ in range(data.draw(st.integers(0, 3))):
        if raw:
            raw[data.draw(st.integers(0, len(raw) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(raw)
    try:
        gas = read_field(path)
    except InputError as error:
        assert str(path) in str(error)
    else:
        assert gas["velocity"].shape == (*gas.shape, 3)


HEAD = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 2 1 1\n"
AXES = "X_COORDINATES 2 double\n0 1\nY_COORDINATES 1 double\n0\nZ_COORDINATES 1 double\n0\n"
DATA = "POINT_DATA 2\nVECTORS velocity double\n1 2 3 4 5 6\n"


@pytest.mark.parametrize(
    "text, words",
    [
        ("solid block\n", "no legacy VTK file"),
        (HEAD.replace("RECTILINEAR_GRID", "POLYDATA"), "RECTILINEAR_GRID or STRUCTURED_POINTS"),
        (HEAD.replace("ASCII", "XML"), "third line must be ASCII or BINARY"),
        (HEAD + AXES, "no array velocity"),
        (
            HEAD.replace("RECTILINEAR_GRID\nDIMENSIONS 2", "STRUCTURED_POINTS\nDIMENSIONS 1000000000"),
            "no array velocity",
        ),
        (HEAD + AXES + "POINT_DATA 2\nFIELD more 1\nvelocity 3 1 double\n1 2 3\n", "must have 2 tuples"),
        (HEAD + AXES + "POINT_DATA 3\n", "POINT_DATA 3 does not fit DIMENSIONS 2 1 1"),
        (HEAD + AXES + "POINT_DATA 2\nSCALARS velocity double 1\nLOOKUP_TABLE default\n1 2\n", "3 components"),
        (HEAD + AXES + "POINT_DATA 2\nVECTORS velocity double\n1 2 3\n", "ends inside an array"),
        (HEAD + AXES + "POINT_DATA 2\nVECTORS velocity double\n1 2 3 4 five 6\n", "no number"),
        (HEAD + AXES + "POINT_DATA 2\nVECTORS velocity double\n1 2 3 4 5 6 7\n", "7 numbers where 6 must stand"),
        (HEAD + AXES + "POINT_DATA 2\nVECTORS velocity long_double\n", "unknown type"),
        (HEAD + AXES + "CELL_DATA 1\nVECTORS velocity double\n1 2 3\n", "cells have one"),
        (HEAD + AXES.replace("X_COORDINATES 2 double\n0 1", "") + DATA, "needs X_COORDINATES with 2 numbers"),
        (HEAD.replace("2 1 1", "2 0 1"), "DIMENSIONS must be 1 or more"),
    ],
)
def test_bad_files(tmp_path, command, text, words):
    path = tmp_path / "bad.vtk"
    path.write_text(text)
    code, _, err = command("gas", "check", path)
    assert code == 2 and words in err and "bad.vtk" in err and len(err.splitlines()) == 1


def test_no_file(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        read_legacy(tmp_path / "none.vtk")
