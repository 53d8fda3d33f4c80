"""Results of OpenFOAM v1912 (tests/outside/openfoam/recorded): every layout of a case, walls, polyhedra, wedges.

What OpenFOAM's own sampling gives at the same points stands beside them; `./run verify-gas` compares whole cases.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from cfd_files import Block, linear, write_openfoam
from clusterdem.gas.foam_dictionary import boundary_field, of_patch, patch_kinds
from clusterdem.gas.legacy import read_field
from clusterdem.gas.meshes import read_meshes

pytest.importorskip("pyvista")

RECORDED = Path(__file__).parents[1] / "outside" / "openfoam" / "recorded"
UP = ("--axes", "x,-z,y")
FINE = ("--grid", 61, 121)


def copy(folder, name):
    return Path(shutil.copytree(RECORDED / name, folder / name))


def make(command, case, out, *words):
    code, told, err = command("gas", "make", case, "-o", out, *words)
    assert code == 0, err
    return [read_field(path) for path in told.split()], err


def refused(command, case, *words):
    code, _, err = command("gas", "make", case, "-o", case / "g.vtk", *words)
    assert code == 2 and len([line for line in err.splitlines() if "note" not in line]) == 1, err
    return err


def reference():
    rows = np.loadtxt(RECORDED / "chan_sampled.txt")
    return rows[:, :3], rows[:, 3:6], rows[:, 6]


@pytest.mark.parametrize("layout", ["whole", "processors", "collated"])
def test_openfoams_own_sampling(layout):
    """At 150 points, 50 of them in the cells along a wall, in cells of 25 × 30 mm: within 1 % of the inlet's 5 m/s.

    But in the cells at the ends of the walls: where inlet and wall meet, OpenFOAM takes the mean of both, and the wall
    would let half of the gas through; here the wall holds.
    """
    (source,) = read_meshes(RECORDED / f"chan_{layout}", "")
    points, velocity, energy = reference()
    found = source.sample(points, ["U", "k"])
    x, y, _ = points.T
    corner = ((x < 0.025) | (x > 0.275)) & ((y < 0.03) | (y > 0.57))
    apart = np.linalg.norm(found["U"] - velocity, axis=1)[~corner]
    assert len(apart) > 130 and np.sqrt(np.mean(apart**2)) < 0.015 and apart.max() < 0.05
    assert np.abs(found["k"] - energy).max() < 0.1 * energy.max()


@pytest.mark.parametrize("layout", ["processors", "collated"])
def test_cases_that_are_not_reconstructed(tmp_path, command, layout):
    """Their latest time is taken, not the start that lies in the case's own folder; no seam where the ranks met.

    The run on two ranks stopped an iteration before that on one: 0.1 % of the velocity.
    """
    (gas,), err = make(command, copy(tmp_path, f"chan_{layout}"), tmp_path / "g.vtk", *UP, *FINE)
    assert "not reconstructed" in err and ", time 158" in gas.provenance
    (whole,), _ = make(command, RECORDED / "chan_whole", tmp_path / "w.vtk", *UP, *FINE)
    np.testing.assert_allclose(gas["velocity"], whole["velocity"], atol=5e-3)


@pytest.mark.parametrize("name, ranks", [("processors2", 2), ("processors4_0-1", 2)])
def test_collated_folders(tmp_path, command, name, ranks):
    """A folder for all ranks, or one for some of them, as OpenFOAM writes with several file servers."""
    case = copy(tmp_path, "chan_collated")
    (case / "processors2").rename(case / name)
    (gas,), _ = make(command, case, tmp_path / "g.vtk", *UP, "--grid", 13, 21)
    assert gas.speed[6, 0, 10] == pytest.approx(5.0, abs=0.15)


def test_a_time_that_some_ranks_lack(tmp_path, command):
    """A run that was ended while it wrote: the latest time that all have."""
    case = copy(tmp_path, "chan_processors")
    shutil.rmtree(case / "processor1" / "158")
    (gas,), _ = make(command, case, tmp_path / "g.vtk", *UP, "--grid", 13, 21)
    assert ", time 100" in gas.provenance and gas.solid is None
    assert "has no time 158; it has 0, 100" in refused(command, case, *UP, "--grid", 3, 3, "--time", 158)


def test_regions(tmp_path, command):
    case = copy(tmp_path, "chan_whole")
    (case / "constant" / "air").mkdir()
    (case / "constant" / "polyMesh").rename(case / "constant" / "air" / "polyMesh")
    assert "has meshes of regions (air), which are not read: foamToVTK" in refused(command, case)


@pytest.mark.parametrize("kind", ["symmetryPlane", "cyclic", "patch"])
def test_one_cell_thick_between_other_patches(tmp_path, command, kind):
    """Nothing is known at the front and the back but that the gas does not pass: a plane all the same."""
    case = copy(tmp_path, "chan_whole")
    path = case / "constant" / "polyMesh" / "boundary"
    path.write_text(re.sub(r"type(\s+)empty;", rf"type\1{kind};", path.read_text()))
    (case / "159" / "U").write_text((case / "159" / "U").read_text().replace("type            empty;", f"type {kind};"))
    (gas,), _ = make(command, case, tmp_path / "g.vtk", *UP, "--box", 0, 0.3, -1, 1, 0, 0.6, "--grid", 13, 4, 21)
    (whole,), _ = make(command, RECORDED / "chan_whole", tmp_path / "w.vtk", *UP, "--grid", 13, 21)
    np.testing.assert_allclose(gas["velocity"], whole["velocity"], atol=1e-6)


def test_collated_file_cut_short(tmp_path, command):
    case = copy(tmp_path, "chan_collated")
    path = case / "processors2" / "158" / "U"
    path.write_bytes(path.read_bytes()[:-3000])
    assert "cut short" in refused(command, case, *UP, "--grid", 3, 3)


def test_steady_cases(tmp_path, command):
    """Iterations are no seconds: one file of the latest state without a time; others when they are asked for."""
    case = copy(tmp_path, "chan_whole")
    (gas,), _ = make(command, case, tmp_path / "g.vtk", *UP, "--grid", 13, 21)
    assert np.isnan(gas.time) and ", time 159" in gas.provenance
    (latest,), _ = make(command, case, tmp_path / "g.vtk", *UP, "--grid", 13, 21, "--time", "latest")
    np.testing.assert_array_equal(gas["velocity"], latest["velocity"])
    (start,), _ = make(command, case, tmp_path / "g.vtk", *UP, "--grid", 13, 21, "--time", 0)
    # uniform but at the walls, where U is 0
    np.testing.assert_allclose(start["velocity"][1:-1, 0, :, 2], 5, atol=1e-6)
    frames, err = make(command, case, tmp_path / "g.vtk", *UP, "--grid", 13, 21, "--time", "all")
    assert [frame.time for frame in frames] == [0, 100, 159] and "iterations, not seconds" in err
    assert "has no time 7; it has 0, 100, 159" in refused(command, case, *UP, "--grid", 3, 3, "--time", 7)
    assert "must be latest, all, or times (s), not last" in refused(command, case, "--time", "last")


def test_time_0_only_when_asked(tmp_path, command):
    block = Block()
    u = linear(block.centres)
    case = write_openfoam(tmp_path / "case", block, {t: {"U": (1 + t) * u} for t in (0, 0.5, 1.5)})
    frames, _ = make(command, case, tmp_path / "g.vtk", "--grid", 3, 3)
    assert [frame.time for frame in frames] == [0.5, 1.5]
    (last,), _ = make(command, case, tmp_path / "h.vtk", "--grid", 3, 3, "--time", "latest")
    assert last.time == 1.5
    shutil.rmtree(case / "0.5")
    shutil.rmtree(case / "1.5")
    assert "holds no time but 0, the start of the run" in refused(command, case, "--grid", 3, 3)
    (gas,), _ = make(command, case, tmp_path / "g.vtk", "--grid", 3, 3, "--time", 0)
    assert gas.time == 0


def test_walls_have_the_value_of_the_file(tmp_path, command):
    """At walls, where U says noSlip, the gas stands still; at the inlet it has the inlet's 5 m/s."""
    (gas,), err = make(command, RECORDED / "chan_whole", tmp_path / "g.vtk", *UP, *FINE, "--energy", "k")
    assert "slips" not in err
    np.testing.assert_allclose(gas["velocity"][[0, -1]], 0, atol=1e-6)
    np.testing.assert_allclose(gas["velocity"][7:-7, 0, 0], np.broadcast_to([0, 0, 5], (47, 3)), atol=1e-6)
    assert gas["fluctuation"].min() > 0.3  # √(2k), k 0.0625 and more


def test_eddies_beside_solids(tmp_path, command):
    """Where nothing moves the lifetime of eddies is still above zero, as the engine asks: in solids, and where k is 0."""
    block = Block((6, 2, 6))
    k = np.where(block.centres[:, 0] < 0.1, 0.0, 1.5)
    fields = {"U": linear(block.centres), "k": k, "epsilon": np.full(len(k), 30.0)}
    case = write_openfoam(tmp_path / "case", block, {1.0: fields})
    words = ("--grid", 7, 7, "--energy", "k", "--dissipation", "epsilon", "--box", -0.1, 0.3, 0, 0.6, "--fill", "rest")
    (gas,), _ = make(command, case, tmp_path / "g.vtk", *words)
    assert gas["period"].min() > 0 and gas["eddy_size"].min() > 0
    np.testing.assert_allclose(gas["period"][-1], 0.015, rtol=1e-6)
    assert np.all(gas["fluctuation"][0] == 0)


def test_flux_of_the_cells(tmp_path, command):
    """5 m/s through 0.3 m in each section, which is what the solver conserves; between walls at rest, linear interpolation
    has less.
    """
    (gas,), err = make(command, RECORDED / "chan_whole", tmp_path / "g.vtk", *UP, *FINE)
    assert "warning: flux through the ends of the grid" in err
    assert np.trapezoid(gas["velocity"][:, 0, 60, 2], gas.axes[0]) == pytest.approx(1.435, abs=0.015)
    (gas,), _ = make(command, RECORDED / "chan_whole", tmp_path / "g.vtk", *UP, *FINE, "--keep-flux")
    flux = np.trapezoid(gas["velocity"][:, 0, :, 2], gas.axes[0], axis=0)
    np.testing.assert_allclose(flux, 1.5, rtol=0.01)
    np.testing.assert_allclose(gas["velocity"][[0, -1]], 0, atol=1e-6)


def with_condition(case, condition):
    """The walls of a synthetic case get another condition."""
    for path in case.glob("[0-9]*/U"):
        path.write_text(path.read_text().replace("type zeroGradient;", condition))
    return case


@pytest.mark.parametrize(
    "condition, wall",
    [
        ("type noSlip;", [0, 0, 0]),
        ("type fixedValue; value uniform (0 0 3);", [0, 0, 3]),
        ("type movingWallVelocity; value uniform (0 0 0.5);", [0, 0, 0.5]),
        ("type slip;", [0, 2, 5]),
        ("type zeroGradient;", [1, 2, 5]),
    ],
)
def test_conditions_at_walls(tmp_path, command, condition, wall):
    """Of a uniform flow (1, 2, 5) m/s at the middle of the side x = 0."""
    block = Block((6, 3, 9))
    flow = np.tile([1.0, 2.0, 5.0], (len(block.centres), 1))
    case = with_condition(write_openfoam(tmp_path / "case", block, {1.0: {"U": flow}}), condition)
    (source,) = read_meshes(case, "")
    places = np.array([[0, 0.05, 0.3], [0.15, 0.05, 0.3]])
    np.testing.assert_allclose(source.sample(places, ["U"])["U"], [wall, [1, 2, 5]], atol=1e-6)
    code, _, err = command("gas", "make", case, "-o", tmp_path / "g.vtk", "--grid", 7, 10, "--wall", "noslip")
    assert code == 0 and "slips" not in err, err
    np.testing.assert_allclose(read_field(tmp_path / "g.vtk")["velocity"][0], 0, atol=1e-12)
    command("gas", "make", case, "-o", tmp_path / "g.vtk", "--grid", 7, 10)
    code, _, err = command("gas", "make", case, "-o", tmp_path / "g.vtk", "--grid", 7, 10)
    assert ("--wall noslip lets it stick" in err) == ("zeroGradient" in condition)


def test_channel_profile():
    """Means over cells of w = 1 − (2x/W − 1)² between walls at rest: an error of the second order, walls included.

    The mean over a cell of width h is h²/(3 W²) below the value at its centre; linear interpolation adds up to h²/(2 W²)
    in between, and the two add at the walls: 1.4 h²/W² is allowed.
    """
    import tempfile

    for n in (6, 12, 24):
        with tempfile.TemporaryDirectory() as folder:
            block = Block((n, 3, 4))
            width = 0.3
            h = width / n
            x = block.centres[:, 0]
            w = 1 - (2 * x / width - 1) ** 2 - (h / width) ** 2 / 3
            flow = np.stack([0 * x, 0 * x, w], axis=1)
            case = with_condition(write_openfoam(Path(folder) / "case", block, {1.0: {"U": flow}}), "type noSlip;")
            (source,) = read_meshes(case, "")
        places = np.stack([np.linspace(0, width, 301), np.full(301, 0.05), np.full(301, 0.3)], axis=1)
        found = source.sample(places, ["U"])["U"][:, 2]
        exact = 1 - (2 * places[:, 0] / width - 1) ** 2
        assert np.abs(found - exact).max() < 1.4 * (h / width) ** 2 + 1e-6, n
        np.testing.assert_allclose(found[[0, -1]], 0, atol=1e-6)


def test_positive_stays_positive():
    """K that falls 100 times from cell to cell: a straight line would go below zero at the points between and at walls."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        block = Block((6, 2, 6))
        k = 10.0 ** (-2 * np.round(block.centres[:, 0] / 0.05 - 0.5))
        fields = {"U": linear(block.centres), "k": k, "rho": k + 1e-12}
        (source,) = read_meshes(write_openfoam(Path(folder) / "case", block, {1.0: fields}), "")
    places = np.random.default_rng(2).uniform(0, 1, (5000, 3)) * [0.3, 0.1, 0.6]
    places[:500, 0] = 0.3
    found = source.sample(places, ["k", "rho"])
    assert found["k"].min() >= 0.99e-10 and found["rho"].min() >= 0.99e-10


def field_of(values):
    """A field file, zeroGradient at all patches but those that the mesh itself decides."""
    rows = "\n".join("({:.12g} {:.12g} {:.12g})".format(*row) for row in values)
    return (
        "FoamFile { version 2.0; format ascii; class volVectorField; object U; }\ndimensions [0 1 -1 0 0 0 0];\n"
        f"internalField nonuniform List<vector>\n{len(values)}\n(\n{rows}\n)\n;\n"
        'boundaryField { "(front|back)" { type wedge; } axis { type empty; } ".*" { type zeroGradient; } }\n'
    )


def centres_of(case):
    """Centres of the cells as OpenFOAM wrote them."""
    text = (case / "0" / "C").read_text()
    text = text[text.index("internalField") :]
    count = int(re.search(r"List<vector>\s*(\d+)", text).group(1))
    return np.array(re.findall(r"\((\S+) (\S+) (\S+)\)", text)[:count], float)


@pytest.mark.parametrize("name, cells", [("hanging", 116), ("dual", 218)])
def test_polyhedra(tmp_path, name, cells):
    """Cells with hanging nodes, and the dual of those: a linear field is exact at every point, within float32."""
    case = copy(tmp_path, name)
    centres = centres_of(case)
    assert len(centres) == cells
    (case / "1").mkdir()
    (case / "1" / "U").write_text(field_of(linear(centres)))
    (source,) = read_meshes(case, "latest")
    np.testing.assert_allclose(source.points, centres, atol=1e-7)
    places = np.random.default_rng(4).uniform([0, 0, 0], [0.3, 0.12, 0.6], (20000, 3))
    places = np.concatenate([places, source.facets.points])
    found = source.sample(places, ["U"])["U"]
    inside = np.isfinite(found[:, 0])
    assert 0.75 < inside.mean() < 0.85 and inside[20000:].all()  # the box is cut slantwise
    np.testing.assert_allclose(found[inside], linear(places[inside]), atol=2e-6)


def test_one_cell_thick(tmp_path, command):
    """Between empty patches the gas is uniform along y, wherever the box has it."""
    words = (*UP, "--box", 0, 0.3, -1, 1, 0, 0.6, "--grid", 13, 4, 21)
    (gas,), _ = make(command, RECORDED / "chan_whole", tmp_path / "g.vtk", *words)
    assert gas.shape == (13, 1, 21)
    err = refused(command, copy(tmp_path, "chan_whole"), "--grid", 3, 3)
    assert "lies in a plane of constant z; if its y is upward, turn it: --axes x,-z,y" in err


@pytest.mark.parametrize("degrees", [0, 2.5, 40])
def test_wedge(tmp_path, command, degrees):
    """A body of revolution whose flow is linear in radius and height, with swirl: (0.3 r, 2 − 4 s, 5 r) is met all round.

    Also by a wedge that lies elsewhere round its axis.
    """
    case = copy(tmp_path, "wedge")
    centres = centres_of(case)
    c, d = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    turn = np.array([[c, 0, d], [0, 1, 0], [-d, 0, c]])
    mesh = case / "constant" / "polyMesh" / "points"
    head, _, body = mesh.read_text().partition("\n(\n")
    points = np.array(re.findall(r"\((\S+) (\S+) (\S+)\)", body), float) @ turn.T
    mesh.write_text(head + "\n(\n" + "\n".join("({:.15g} {:.15g} {:.15g})".format(*p) for p in points) + "\n)\n")
    r, s = centres[:, 0], centres[:, 1]
    (case / "1").mkdir()
    # the swirl turns from x to z's negative: y is the axis
    (case / "1" / "U").write_text(field_of(np.stack([0.3 * r, 2 - 4 * s, -5 * r], axis=1) @ turn.T))
    words = (*UP, "--grid", 9, 9, 7, "--time", "latest")
    (gas,), err = make(command, case, tmp_path / "g.vtk", *words)
    x, y, z = np.meshgrid(*gas.axes, indexing="ij")
    np.testing.assert_allclose([gas.axes[0][0], gas.axes[1][-1], gas.axes[2][-1]], [-0.05, 0.05, 0.3], atol=1e-4)
    inside = np.hypot(x, y) < 0.049
    np.testing.assert_array_equal(gas.solid, np.hypot(x, y) > 0.0501)
    # radial outwards; swirl along (−y, x) of the box, whose y is the case's −z
    wanted = np.stack([0.3 * x - 5 * y, 0.3 * y + 5 * x, 2 - 4 * z], axis=-1)
    np.testing.assert_allclose(gas["velocity"][inside], wanted[inside], atol=1e-4)
    assert f"{(np.hypot(x, y) > 0.0501).sum()} of {x.size} points lie in solids" in err


def test_dictionaries(tmp_path):
    """Comments, patterns, groups, binary lists: what a condition is found by, in OpenFOAM's order."""
    path = tmp_path / "U"
    blob = np.arange(6, dtype="<f8").tobytes() + b"}{)(;"
    path.write_bytes(
        b'FoamFile { version 2.0; format binary; arch "LSB;label=32;scalar=64"; class volVectorField; object U; }\n'
        b"internalField uniform (0 0 0);\nboundaryField\n{\n // a comment }\n /* and { another */\n"
        b"  inlet { type fixedValue; value nonuniform List<vector> 2(" + blob[:48] + b"); }\n"
        b'  ".*Wall" { type slip; }\n  "upper.*" { type noSlip; }\n  wall { type zeroGradient; }\n}\n'
    )
    found = boundary_field(path)
    assert found["inlet"] == {"type": "fixedValue", "value": "nonuniform"}
    assert of_patch(found, "inlet", ("patch",))["type"] == "fixedValue"
    assert of_patch(found, "upperWall", ("patch",))["type"] == "noSlip"  # the last pattern that fits
    assert of_patch(found, "lowerWall", ("patch",))["type"] == "slip"
    assert of_patch(found, "upperWall", ("wall",))["type"] == "zeroGradient"  # a group goes before patterns
    assert of_patch(found, "outlet", ("patch",)) == {}
    boundary = tmp_path / "boundary"
    boundary.write_text("2\n(\n inlet { type patch; inGroups 1(in); nFaces 4; }\n walls { type wall; nFaces 2; }\n)\n")
    assert patch_kinds(boundary) == {"inlet": ("patch", ("in", "patch")), "walls": ("wall", ("wall",))}
