"""Gas fields that `clusterdem gas` makes of CFD results, in the engine: what clusters see is what the CFD run had."""

from __future__ import annotations

import numpy as np
import pytest
from cfd_files import LENGTHS, Block, linear, write_openfoam
from clusterdem.cli import main
from clusterdem.gas.field import GasField
from clusterdem.gas.legacy import write_field
from lammps_run import run

pytest.importorskip("pyvista")

SCENE = f"""
units        si
atom_style   sphere
boundary     {{sides}}
comm_modify  vel yes
region       box block 0 {LENGTHS[0]} 0 {LENGTHS[1]} 0 {LENGTHS[2]}
create_box   1 box
create_atoms 1 random 300 7 NULL
set          group all diameter 1e-3
set          group all density 1000.0
pair_style   zero 2e-3
pair_coeff   * *
neighbor     1e-3 bin
fix          drag all drag/cluster 1.2 1.53e-5 field {{field}} {{gusts}}
fix          still all move linear 0 0 0
timestep     0.01
run          {{steps}}
write_dump   all custom end.dump id x y z f_drag[1] f_drag[2] f_drag[3] modify sort id format float %.17g
"""


def scene(field, steps=0, gusts="", sides="f f f"):
    return SCENE.format(field=field, steps=steps, gusts=gusts, sides=sides)


def seen(folder, field, steps=0, ranks=1, gusts=""):
    """Places of the clusters and the gas velocity there."""
    end = run(folder, scene(field, steps, gusts), ranks).dump()
    return (np.stack([end[c] for c in names], axis=1) for names in ("xyz", [f"f_drag[{k}]" for k in (1, 2, 3)]))


def test_openfoam_series(tmp_path):
    """A case whose velocity is linear in place and time, on two ranks: exact but for float32, in which VTK reads it."""
    block = Block()
    u = linear(block.centres)
    case = write_openfoam(tmp_path / "case", block, {t: {"U": (1 + t) * u} for t in (0.0, 0.5, 1.0)})
    assert (
        main(["gas", "make", str(case), "-o", str(tmp_path / "gas.vtk"), "--grid", "5", "4", "6", "--time", "all"]) == 0
    )
    for steps in (0, 30):
        places, gas = seen(tmp_path / f"run{steps}", "../gas.*.vtk", steps, ranks=2)
        np.testing.assert_allclose(gas, (1 + 0.01 * steps) * linear(places), atol=2e-5)


@pytest.mark.parametrize("steps, share", [(10, 0.25), (35, 0.25 + 0.3 * 0.75), (60, 1.0)])
def test_between_frames(tmp_path, steps, share):
    """A quarter of a velocity at the first frame and all of it 0.3 s later: linear in between, and these two hold before and
    after. The series begins at 12.2 s, and at 0.26 s in the run.
    """
    block = Block()
    u = linear(block.centres)
    values = {12.2: 0.25, 12.5: 1.0}
    case = write_openfoam(tmp_path / "case", block, {t: {"U": share * u} for t, share in values.items()})
    words = ["--grid", "5", "4", "6", "--start", "0.26"]
    assert main(["gas", "make", str(case), "-o", str(tmp_path / "gas.vtk"), *words]) == 0
    places, gas = seen(tmp_path / "run", "../gas.*.vtk", steps)
    np.testing.assert_allclose(gas, share * linear(places), atol=2e-5)


def test_all_arrays(tmp_path):
    """Fluctuation from k: r.m.s. √(2k/3) in each component over the clusters."""
    block = Block()
    count = len(block.centres)
    fields = {"U": linear(block.centres), "k": np.full(count, 1.5), "rho": np.full(count, 1.2)}
    case = write_openfoam(tmp_path / "case", block, {1.0: fields})
    words = ["--grid", "4", "4", "4", "--energy", "k", "--density", "rho", "--dynamic-viscosity", "1.8e-5"]
    assert main(["gas", "make", str(case), "-o", str(tmp_path / "gas.vtk"), *words]) == 0
    places, gas = seen(tmp_path / "run", "../gas.vtk", gusts="fluctuation 1 1 1 own frozen 7")
    gust = gas - linear(places)
    # uniform in ±√3 m/s; the r.m.s. of 300 draws scatters by 2.6 %: four times that
    assert np.abs(gust).max() < np.sqrt(3) * (1 + 1e-5)
    np.testing.assert_allclose(np.sqrt(np.mean(gust**2, axis=0)), 1.0, rtol=0.105)


def made(folder, x=(0.0, 0.1, 0.2, 0.3), names=("gas.vtk",), times=(0.0,), spoil=None):
    """Files of a gas that differs from plane to plane along x, the last as the first."""
    axes = (np.array(x), np.zeros(1), np.linspace(0, LENGTHS[2], 5))
    for name, time in zip(names, times):
        velocity = np.ones((len(x), 1, 5, 3))
        velocity[1:-1] += 1
        gas = GasField(axes, {"velocity": velocity, "density": np.full((len(x), 1, 5), 1.2)}, time)
        if spoil:
            gas.arrays[spoil[0]][spoil[1]] = spoil[2]
        write_field(folder / name, gas)


SERIES = ("gas.0.vtk", "gas.1.vtk")


@pytest.mark.parametrize(
    "sides, options, fields, fits",
    [
        ("f f f", "", {}, True),
        ("f f f", "", {"x": (0.05, 0.15, 0.25)}, True),
        ("f f f", "", {"x": (0.0, 0.05, 0.1)}, False),
        ("f f f", "edge x clamp", {"x": (0.0, 0.05, 0.1)}, True),
        ("p f f", "", {}, True),
        ("p f f", "", {"x": (0.0, 0.1, 0.2)}, True),
        ("p f f", "", {"x": (-0.15, -0.05, 0.05, 0.15)}, False),
        ("p f f", "edge x periodic", {"x": (-0.15, -0.05, 0.05, 0.15)}, True),
        ("p f f", "", {"x": (0.0, 0.1, 0.2, 0.4)}, False),
        ("p f f", "", {"spoil": ("velocity", (3, 0, 2, 2), 3.0)}, False),
        ("p f f", "edge x clamp", {"spoil": ("velocity", (3, 0, 2, 2), 3.0)}, True),
        ("f f f", "", {"spoil": ("velocity", (1, 0, 2, 0), np.nan)}, False),
        ("f f f", "", {"spoil": ("density", (1, 0, 2), 0.0)}, False),
        ("f f f", "", {"names": SERIES, "times": (0.0, 1.0)}, True),
        ("f f f", "", {"names": SERIES, "times": (0.0, np.nan)}, False),
        ("f f f", "", {"names": SERIES, "times": (1.0, 1.0)}, False),
    ],
)
def test_check_refuses_what_the_engine_refuses(tmp_path, sides, options, fields, fits):
    """And nothing else, by the same edge rules."""
    made(tmp_path, **fields)
    files = [str(tmp_path / name) for name in fields.get("names", ("gas.vtk",))]
    box = [str(end) for length in LENGTHS for end in (0, length)]
    words = ["--box", *box, "--periodic", "x" if sides[0] == "p" else ""]
    words += ["--edge", *options.split()[1:]] if options else []
    checked = main(["gas", "check", *files, *words])
    word = "../gas.*.vtk" if len(files) > 1 else "../gas.vtk"
    done = run(tmp_path / "run", scene(f"{word} {options}", sides=sides), check=False)
    assert (checked == 0, done.code == 0) == (fits, fits), done.output[-1000:]
