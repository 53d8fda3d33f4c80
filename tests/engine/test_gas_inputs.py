"""The inputs with gas from files: gusts as the file has them, refused where a scene has a gas of its own."""

from __future__ import annotations

import numpy as np
import pytest
from clusterdem.gas.field import GasField
from clusterdem.gas.legacy import read_field, write_field
from lammps_run import ROOT, run_file

INPUTS = ROOT / "inputs"


def uniform(path, amplitude=None):
    """Gas at 2 m/s upward everywhere, with amplitudes of its own or without."""
    axes = (np.array([0.0, 0.3]), np.zeros(1), np.array([0.0, 0.6]))
    arrays = {"velocity": np.broadcast_to([0.0, 0.0, 2.0], (2, 1, 2, 3)).copy()}
    if amplitude is not None:
        arrays["fluctuation"] = np.full((2, 1, 2, 3), amplitude)
    return write_field(path, GasField(axes, arrays))


def gas_of_case1(folder, field, **variables):
    """Gas that the clusters of case 1 see at its start, shape (N, 2): along x and z."""
    arguments = ["-in", str(INPUTS / "case1.in"), "-log", "case1.log"]
    done = run_file(
        folder, arguments, 1, inputs=INPUTS, tend=2e-5, setting="fast", height=0.05, field=field, **variables
    )
    frame = done.dump("case1.00000000.dump")
    return np.stack([frame["ug_x"], frame["ug_z"]], axis=1)


@pytest.mark.parametrize(
    "amplitude, words, wanted",
    [(None, {}, 0.0), (0.4, {}, 0.4), (None, {"amplitude": 0.3}, 0.3), (0.4, {"amplitude": 0.5}, 0.2)],
    ids=["none", "of the file", "given", "factor"],
)
def test_gusts_with_a_field(tmp_path, amplitude, words, wanted):
    """None where the file has no amplitude and none is given; a factor of 1 on that of the file."""
    uniform(tmp_path / "gas.0.vtk", amplitude)
    gusts = gas_of_case1(tmp_path, "gas.0.vtk edge z clamp", **words) - [0, 2]
    assert np.abs(gusts).max() <= wanted + 1e-12
    # uniform in ± the amplitude, in 60 cells and more
    assert np.abs(gusts).max() >= 0.9 * wanted
    assert not list(tmp_path.glob("*.amplitude"))


@pytest.mark.parametrize("name", ["riser", "feed", "box3d", "two_densities", "jet"])
def test_scenes_with_their_own_gas_refuse_a_field(tmp_path, name):
    arguments = ["-in", str(INPUTS / f"{name}.in"), "-log", "log"]
    done = run_file(tmp_path, arguments, 1, check=False, inputs=INPUTS, field="gas.vtk")
    assert done.code != 0
    assert f"ERROR: -var field gas.vtk: the scene {name} has a gas of its own and takes no field" in done.output


def test_duct(tmp_path):
    """Its gas is that of the file: at rest at both walls, 1.5 m²/s through each section, what the solver conserved."""
    gas = read_field(INPUTS / "duct.vtk")
    assert np.all(gas["velocity"][[0, -1]] == 0)
    flux = np.trapezoid(gas["velocity"][:, 0, :, 2], gas.axes[0], axis=0)
    np.testing.assert_allclose(flux, 1.5, rtol=2e-3)
    assert "source: build/verify-gas/chan, time 144" in gas.provenance
    arguments = ["-in", str(INPUTS / "duct.in"), "-log", "log"]
    done = run_file(tmp_path, arguments, 1, inputs=INPUTS, clusters=300, tend=2e-6, amplitude=0)
    frame = done.dump("duct.00000000.dump")
    from scipy.interpolate import RegularGridInterpolator

    between = RegularGridInterpolator((gas.axes[0], gas.axes[2]), gas["velocity"][:, 0])
    wanted = between(np.stack([frame["x"], frame["z"]], axis=1))
    np.testing.assert_allclose(np.stack([frame["ug_x"], frame["ug_z"]], axis=1), wanted[:, [0, 2]], atol=1e-7)
