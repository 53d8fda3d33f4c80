"""Gas fields of the files that CFD programs export: names, units, lists, parts, groups; linear fields exact from each."""

from __future__ import annotations

import json
import subprocess
import sys

import numpy as np
import pytest
from cfd_files import LENGTHS, Block, linear, write_fluent, write_fluent_channel, write_openfoam
from clusterdem.gas.legacy import read_field, write_field
from clusterdem.gas.quantities import plain
from test_gas_make import hexahedra, image, points_of, tetrahedra

pv = pytest.importorskip("pyvista")


def made(command, out, *words):
    code, told, err = command("gas", "make", *words, "-o", out)
    assert code == 0, err
    return [read_field(path) for path in told.split()], err


def table(path, heading, columns, mark=","):
    rows = [mark.join(map(repr, row)) for row in np.concatenate(columns, axis=1).tolist()]
    path.write_text("\n".join([heading, *rows]) + "\n")
    return path


def exact(gas, tolerance=2e-6):
    np.testing.assert_allclose(gas["velocity"].reshape(-1, 3), linear(points_of(gas)), atol=tolerance)


HEADINGS = {
    "U_g of MFiX": ("x,y,z,Gas_Velocity_X,Gas_Velocity_Y,Gas_Velocity_Z", ","),
    "components with units": ("X (m),Y (m),Z (m),u (m/s),v (m/s),w (m/s)", ","),
    "STAR-CCM+": ('"Velocity[i] (m/s)","Velocity[j] (m/s)","Velocity[k] (m/s)","X (m)","Y (m)","Z (m)"', ","),
    "COMSOL": ("% x                 y               z               u (m/s)           v (m/s)          w (m/s)", " "),
    "CFX": ("X [ m ], Y [ m ], Z [ m ], Velocity u [ m s^-1 ], Velocity v [ m s^-1 ], Velocity w [ m s^-1 ]", ","),
    "U_g, V_g, W_g": ("x,y,z,U_g,V_g,W_g", ","),
    "vectors of ParaView": ("Points_0,Points_1,Points_2,Gas Velocity_0,Gas Velocity_1,Gas Velocity_2", ","),
    "Ux": ("x;y;z;Ux;Uy;Uz", ";"),
}


@pytest.mark.parametrize("kind", HEADINGS)
def test_headings(tmp_path, command, kind):
    heading, mark = HEADINGS[kind]
    points = Block().points
    columns = [points, linear(points)]
    if kind == "STAR-CCM+":
        columns.reverse()
    path = table(tmp_path / "a.csv", heading, columns, mark)
    if kind == "COMSOL":
        path.write_text("% Model:              duct.mph\n% Nodes:              189\n" + path.read_text())
    (gas,), _ = made(command, tmp_path / "g.vtk", path, "--grid", 5, 3, 6)
    exact(gas)


@pytest.mark.parametrize(
    "name, wanted",
    [
        ("Velocity[i] (m/s)", "velocity[i]"),
        ("Gas_Velocity", "gasvelocity"),
        ("U_g", "ug"),
        ("u (m/s)", "u"),
        ("X [ m ]", "x"),
        ("x-coordinate", "xcoordinate"),
        ("Points:0", "points0"),
        ("spf.U (m/s)", "spfu"),
    ],
)
def test_plain_names(name, wanted):
    assert plain(name) == wanted


@pytest.mark.parametrize("name", ["Gas_Velocity", "U_g", "Velocity (m/s)", "U.gas", "gas velocity", "UMean"])
def test_names_of_vectors(tmp_path, command, name):
    grid = image(Block())
    grid.point_data[name] = grid.point_data["U"]
    del grid.point_data["U"]
    grid.save(tmp_path / "a.vti")
    (gas,), _ = made(command, tmp_path / "g.vtk", tmp_path / "a.vti")
    exact(gas, 1e-12)


def test_units_of_headings(tmp_path, command):
    """Lengths in mm, velocities in cm/s, as the heading says; an option that says otherwise is refused."""
    points = Block().points
    heading = "X (mm),Y (mm),Z (mm),u (cm/s),v (cm/s),w (cm/s)"
    path = table(tmp_path / "a.csv", heading, [1e3 * points, 1e2 * linear(points)])
    (gas,), _ = made(command, tmp_path / "g.vtk", path)
    np.testing.assert_allclose([axis[-1] for axis in gas.axes], LENGTHS, rtol=1e-12)
    exact(gas, 1e-12)
    for words, rule in (
        (("--length-unit", "m"), "--length-unit: m, but"),
        (("--velocity-unit", "m/s"), "--velocity-unit: m/s, but"),
    ):
        code, _, err = command("gas", "make", path, "-o", tmp_path / "h.vtk", *words)
        assert code == 2 and rule in err and "leave the option out" in err


def test_velocity_without_dimensions(tmp_path, command):
    """Times the reference velocity; √(2k) with it, since k is in its square."""
    grid = image(Block())
    grid.point_data["k"] = np.full(grid.n_points, 0.02)
    grid.save(tmp_path / "a.vti")
    (gas,), _ = made(command, tmp_path / "g.vtk", tmp_path / "a.vti", "--velocity-scale", 7.5, "--energy", "k")
    np.testing.assert_allclose(gas["velocity"].reshape(-1, 3), 7.5 * linear(points_of(gas)), rtol=1e-12)
    np.testing.assert_allclose(gas["fluctuation"], 7.5 * 0.2, rtol=1e-12)


@pytest.mark.parametrize("rate", ["--dissipation", "--omega"])
def test_eddies(tmp_path, command, rate):
    """K = 1.5 m²/s², ε = 30 m²/s³ (ω = ε/(0.09 k)): a lifetime of 0.3 k/ε = 15 ms, a size of 0.09^¾ k^1.5/ε = 10.06 mm."""
    grid = image(Block())
    grid.point_data["k"] = np.full(grid.n_points, 1.5)
    grid.point_data["rate"] = np.full(grid.n_points, 30.0 if rate == "--dissipation" else 30.0 / (0.09 * 1.5))
    grid.save(tmp_path / "a.vti")
    (gas,), _ = made(command, tmp_path / "g.vtk", tmp_path / "a.vti", "--energy", "k", rate, "rate")
    np.testing.assert_allclose(gas["period"], 0.015, rtol=1e-12)
    np.testing.assert_allclose(gas["eddy_size"], 0.164317 * 1.5**1.5 / 30, rtol=1e-5)
    (gas,), _ = made(command, tmp_path / "g.vtk", tmp_path / "a.vti", "--energy", "k", rate, "rate", "--lifetime", 1)
    np.testing.assert_allclose(gas["period"], 0.05, rtol=1e-12)
    make = ("gas", "make", tmp_path / "a.vti", "-o", tmp_path / "h.vtk", rate, "rate")
    assert f"{rate}: needs --energy" in command(*make)[2]
    assert f"{rate}: must have its unit" in command(*make, "--energy", "k", "--velocity-scale", 2)[2]


def test_list_of_files(tmp_path, command):
    """ParaView's list gives the times, whatever the names and their order."""
    names = {0.5: "b.vti", 2.0: "a.vti"}
    for time, name in names.items():
        grid = image(Block())
        grid.point_data["U"] = grid.point_data["U"] * time
        grid.save(tmp_path / name)
    listed = [{"name": name, "time": time} for time, name in sorted(names.items(), reverse=True)]
    path = tmp_path / "run.vti.series"
    path.write_text(json.dumps({"file-series-version": "1.0", "files": listed}))
    frames, _ = made(command, tmp_path / "g.vtk", path)
    assert [gas.time for gas in frames] == [0.5, 2.0]
    for gas in frames:
        np.testing.assert_allclose(gas["velocity"].reshape(-1, 3), gas.time * linear(points_of(gas)), atol=1e-12)
    (last,), _ = made(command, tmp_path / "h.vtk", path, "--time", "latest")
    assert last.time == 2.0
    code, _, err = command("gas", "make", path, "-o", tmp_path / "h.vtk", "--time", 1)
    assert code == 2 and "has no time 1 s; it has 0.5, 2" in err
    path.write_text('{"files": [{"name": "c.vti", "time": 1}]}')
    code, _, err = command("gas", "make", path, "-o", tmp_path / "h.vtk")
    assert code == 2 and "names c.vti, which does not exist" in err
    path.write_text("[]")
    code, _, err = command("gas", "make", path, "-o", tmp_path / "h.vtk")
    assert code == 2 and 'must be JSON with "files"' in err


def test_openfoams_sets_and_surfaces(tmp_path, command):
    """Sets in format raw have no heading but their name; surfaces have one of their own."""
    points = Block().points
    rows = np.concatenate([points, linear(points)], axis=1)
    np.savetxt(tmp_path / "grid_U.xy", rows, "%.17g", delimiter="\t")
    np.savetxt(tmp_path / "grid_k_p.xy", np.concatenate([points, rows[:, 3:5]], axis=1), "%.17g")
    np.savetxt(tmp_path / "U_mid.raw", rows, "%.17g", header=" U  POINT_DATA 189\n  x  y  z  U_x  U_y  U_z")
    for name in ("grid_U.xy", "U_mid.raw"):
        (gas,), _ = made(command, tmp_path / "g.vtk", tmp_path / name)
        exact(gas, 1e-12)
    (gas,), _ = made(
        command, tmp_path / "g.vtk", tmp_path / "grid_U.xy", tmp_path / "grid_k_p.xy", "--join", "--density", "3"
    )
    exact(gas, 1e-12)
    np.savetxt(tmp_path / "line_U.xy", rows[:, 1:], "%.9g")  # without one of the coordinates
    code, _, err = command("gas", "make", tmp_path / "line_U.xy", "-o", tmp_path / "g.vtk")
    assert code == 2 and "axis xyz" in err


def test_parts_of_one_time(tmp_path, command):
    """Arrays in a file each, and a file for each half of the domain, whose common points stand in both."""
    points = Block().points
    u = linear(points)
    for k, name in enumerate("uvw"):
        table(tmp_path / f"{name}.csv", f"x,y,z,{name}", [points, u[:, k : k + 1]])
    parts = [tmp_path / f"{name}.csv" for name in "uvw"]
    (gas,), _ = made(command, tmp_path / "g.vtk", *parts, "--join")
    exact(gas, 1e-12)
    for k, half in enumerate((points[:, 0] < 0.16, points[:, 0] > 0.14)):
        table(tmp_path / f"half{k}.csv", "x,y,z,u,v,w", [points[half], u[half]])
    halves = [tmp_path / f"half{k}.csv" for k in (0, 1)]
    (gas,), _ = made(command, tmp_path / "g.vtk", *halves, "--join", "--time", 3)
    exact(gas, 1e-12)
    assert gas.time == 3 and gas.shape == (7, 3, 9)
    code, _, err = command("gas", "make", *halves, "-o", tmp_path / "g.vtk")
    assert code == 2 and "--join, if all are parts of one" in err
    code, _, err = command("gas", "make", parts[0], halves[0], "-o", tmp_path / "g.vtk", "--join")
    assert code == 2 and "neither the same points nor the same arrays" in err


@pytest.mark.parametrize("name", ["cloud.vtp", "cloud.vtk", "cloud.vtu"])
def test_clouds_of_points(tmp_path, command, name):
    """Points without cells, and with a vertex for each, are joined."""
    rng = np.random.default_rng(3)
    points = np.concatenate([np.array(list(np.ndindex(2, 2, 2))) * LENGTHS, rng.random((400, 3)) * LENGTHS])
    cloud = pv.PolyData(points)
    cloud.point_data["U"] = linear(points)
    (cloud.cast_to_unstructured_grid() if name.endswith("vtu") else cloud).save(tmp_path / name)
    (gas,), _ = made(command, tmp_path / "g.vtk", tmp_path / name, "--grid", 5, 3, 6)
    exact(gas, 1e-5)


def test_xdmf_without_time(tmp_path):
    """A grid that has no time gives one frame; what the library says of it is not shown."""
    mesh = tetrahedra(Block())
    cells = mesh.cells_dict[10]

    def item(rows, kind):
        text = "\n".join(" ".join(map(str, row)) for row in rows.tolist())
        size = f'Dimensions="{rows.shape[0]} {rows.shape[1]}" NumberType="{kind}" Precision="8" Format="XML"'
        return f"<DataItem {size}>\n{text}\n</DataItem>"

    (tmp_path / "a.xdmf").write_text(
        '<?xml version="1.0" ?>\n<Xdmf Version="2.0"><Domain><Grid Name="gas" GridType="Uniform">\n'
        f'<Topology TopologyType="Tetrahedron" NumberOfElements="{len(cells)}">{item(cells, "Int")}</Topology>\n'
        f'<Geometry GeometryType="XYZ">{item(np.asarray(mesh.points), "Float")}</Geometry>\n'
        f'<Attribute Name="U" AttributeType="Vector" Center="Node">{item(np.asarray(mesh["U"]), "Float")}</Attribute>\n'
        "</Grid></Domain></Xdmf>\n"
    )
    words = ("gas", "make", "a.xdmf", "-o", "g.vtk", "--grid", "5", "3", "6")
    done = subprocess.run([sys.executable, "-m", "clusterdem", *words], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout == "g.vtk\n"
    assert all(line.startswith("a.xdmf: warning: the flux") for line in done.stderr.splitlines()), done.stderr
    gas = read_field(tmp_path / "g.vtk")
    exact(gas)
    assert np.isnan(gas.time)


def msh(points, triangles, tetrahedra, u):
    """Gmsh's format 2.2 in text, with groups of names and numbers."""

    def lines(rows):
        return "\n".join(" ".join(map(str, row)) for row in rows)

    cells = [(2, 2, 1, 1, *(k + 1 for k in cell)) for cell in triangles.tolist()]
    cells += [(4, 2, 2, 1, *(k + 1 for k in cell)) for cell in tetrahedra.tolist()]
    return (
        '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 "walls"\n3 2 "gas"\n$EndPhysicalNames\n'
        f"$Nodes\n{len(points)}\n{lines((k + 1, *p) for k, p in enumerate(points.tolist()))}\n$EndNodes\n"
        f"$Elements\n{len(cells)}\n{lines((k + 1, *c) for k, c in enumerate(cells))}\n$EndElements\n"
        f'$NodeData\n1\n"U"\n1\n0.0\n3\n0\n3\n{len(points)}\n'
        f"{lines((k + 1, *v) for k, v in enumerate(u.tolist()))}\n$EndNodeData\n"
    )


def test_groups_of_gmsh(tmp_path, command):
    """A mesh with its walls as a group of triangles: they are no gas."""
    mesh = tetrahedra(Block())
    outside = mesh.extract_surface(algorithm=None, pass_pointid=True)
    walls = outside.point_data["vtkOriginalPointIds"][outside.regular_faces]
    (tmp_path / "a.msh").write_text(msh(mesh.points, walls, mesh.cells_dict[10], mesh["U"]))
    (gas,), err = made(command, tmp_path / "g.vtk", tmp_path / "a.msh", "--grid", 5, 3, 6)
    exact(gas)
    assert "Warning" not in err


def test_patches_of_vtk(tmp_path, command):
    """A multi-block file with the surface's own values, as OpenFOAM's foamToVTK writes: they hold at the walls."""
    mesh = hexahedra(Block())
    mesh.clear_data()
    mesh.cell_data["U"] = np.tile([1.0, 2.0, 5.0], (mesh.n_cells, 1))
    surface = mesh.extract_surface(algorithm=None, pass_pointid=False, pass_cellid=False)
    surface.clear_data()
    surface.cell_data["U"] = np.zeros((surface.n_cells, 3))
    pv.MultiBlock({"internal": mesh, "boundary": pv.MultiBlock({"walls": surface})}).save(tmp_path / "a.vtm")
    (gas,), err = made(command, tmp_path / "g.vtk", tmp_path / "a.vtm", "--grid", 7, 3, 9)
    np.testing.assert_allclose(gas["velocity"][[0, -1]], 0, atol=1e-12)
    np.testing.assert_allclose(gas["velocity"][3, 1, 4], [1, 2, 5], atol=1e-12)


def test_walls_of_fluent(tmp_path, command):
    """A Fluent case names its walls, but holds nothing at them: told, and at rest when asked for."""
    block = Block()
    u = linear(block.centres)
    case = write_fluent(tmp_path / "block.cas", block, {111: u[:, 0], 112: u[:, 1], 113: u[:, 2]})
    (gas,), err = made(command, tmp_path / "g.vtk", case, "--grid", 7, 5, 9)
    assert "has no velocity at its walls (wall" in err and "--wall noslip" in err
    exact(gas)
    (gas,), err = made(command, tmp_path / "g.vtk", case, "--grid", 7, 5, 9, "--wall", "noslip")
    assert "slips" not in err
    for k in range(3):
        np.testing.assert_allclose(np.take(gas["velocity"], [0, -1], k), 0, atol=1e-6)


def test_walls_of_a_plane_fluent_case(tmp_path, command):
    """Walls at both sides, in the corner cells too, and none at inlet and outlet; 5 m/s in between."""
    case = write_fluent_channel(tmp_path / "channel.cas")
    words = ("--axes", "x,-z,y", "--grid", 13, 17, "--wall", "noslip")
    (gas,), _ = made(command, tmp_path / "g.vtk", case, *words)
    np.testing.assert_allclose(gas["velocity"][[0, -1]], 0, atol=1e-5)
    np.testing.assert_allclose(gas["velocity"][1:-1, 0, [0, 8, 16], 2], 5, atol=1e-5)


def test_no_slip_needs_walls(tmp_path, command):
    image(Block()).save(tmp_path / "a.vti")
    code, _, err = command("gas", "make", tmp_path / "a.vti", "-o", tmp_path / "g.vtk", "--wall", "noslip")
    assert code == 2 and "--wall: noslip:" in err and "does not tell which of its faces are walls" in err


def test_start_and_old_frames(tmp_path, command):
    """A series that begins at 12.3 s is moved to 0; frames of an earlier, longer series do not stay among the new ones."""
    block = Block()
    u = linear(block.centres)
    case = write_openfoam(tmp_path / "case", block, {t: {"U": t * u} for t in (12.3, 12.4, 12.5)})
    made(command, tmp_path / "g.vtk", case, "--grid", 3, 3)
    (tmp_path / "g.0007.vtk").write_text("# vtk DataFile Version 3.0\nof another program\n")
    (tmp_path / "g.left.vtk").write_text("by hand")
    frames, _ = made(command, tmp_path / "g.vtk", case, "--grid", 3, 3, "--time", 12.3, 12.5, "--start", 0)
    np.testing.assert_allclose([gas.time for gas in frames], [0, 0.2], atol=1e-12)
    assert "source time: 12.5" in frames[1].provenance and "time in this file (s): 0.2" in frames[1].provenance
    left = sorted(path.name for path in tmp_path.glob("g.*.vtk"))
    assert left == ["g.0000.vtk", "g.0001.vtk", "g.0007.vtk", "g.left.vtk"]
    image(block).save(tmp_path / "a.vti")
    code, _, err = command("gas", "make", tmp_path / "a.vti", "-o", tmp_path / "h.vtk", "--start", 0)
    assert code == 2 and "--start: needs the time of" in err


def test_mirror(tmp_path, command):
    """A quarter of a channel mirrored at its lowest x and its highest y: even along, odd across."""
    quarter = image(Block())
    x, y, _ = quarter.points.T
    quarter.point_data["U"] = np.stack([2 * x, 3 * (0.1 - y), 1 + x + (0.1 - y)], axis=1)
    quarter.save(tmp_path / "a.vti")
    words = ("--mirror", "x-", "y+", "--grid", 13, 5, 9)
    (gas,), _ = made(command, tmp_path / "g.vtk", tmp_path / "a.vti", *words)
    x, y, _ = points_of(gas).T
    np.testing.assert_allclose([gas.axes[0][0], gas.axes[0][-1], gas.axes[1][-1]], [-0.3, 0.3, 0.2], atol=1e-12)
    wanted = np.stack([2 * x, 3 * (0.1 - y), 1 + np.abs(x) + np.abs(0.1 - y)], axis=1)
    np.testing.assert_allclose(gas["velocity"].reshape(-1, 3), wanted, atol=1e-9)
    code, _, err = command("gas", "make", tmp_path / "a.vti", "-o", tmp_path / "g.vtk", "--mirror", "left")
    assert code == 2 and "--mirror: must be ends of INPUT such as x-" in err


def test_revolve(tmp_path, command):
    """A plane (x, r = y) of a tool that solves round the x axis, three arrays of components, with swirl."""
    x, r = (a.ravel() for a in np.meshgrid(np.linspace(0, 0.6, 7), np.linspace(0, 0.1, 5)))
    columns = np.stack([x, r, 1 + x, 0.5 * r, 2 * r], axis=1)
    path = table(tmp_path / "a.csv", "x,y,x-velocity,y-velocity,z-velocity", [columns])
    words = ("--revolve", "x", "--axes", "y,z,x", "--grid", 9, 9, 7)
    (gas,), _ = made(command, tmp_path / "g.vtk", path, *words)
    x, y, z = np.meshgrid(*gas.axes, indexing="ij")
    np.testing.assert_allclose([gas.axes[0][0], gas.axes[1][-1], gas.axes[2][-1]], [-0.1, 0.1, 0.6], atol=1e-12)
    inside = np.hypot(x, y) <= 0.1
    wanted = np.stack([0.5 * x - 2 * y, 0.5 * y + 2 * x, 1 + z], axis=-1)
    np.testing.assert_allclose(gas["velocity"][inside], wanted[inside], atol=1e-9)
    assert np.all(gas["velocity"][~inside] == 0)


def test_flux_is_kept(tmp_path, command):
    """A parabola between walls, on a grid of 5 points: the flux falls short by 1/16, and is corrected on request.

    The trapezoidal rule on n intervals gives 2/3 (1 − 1/n²) of a parabola's maximum times the width.
    """
    x, z = (a.ravel() for a in np.meshgrid(np.linspace(0, 0.3, 121), np.linspace(0, 0.6, 4)))
    w = 1 - (2 * x / 0.3 - 1) ** 2
    path = table(tmp_path / "a.csv", "x,z,u,w", [np.stack([x, z, 0 * w, w], axis=1)])
    (gas,), err = made(command, tmp_path / "g.vtk", path, "--grid", 5, 4)
    flux = np.trapezoid(gas["velocity"][:, 0, :, 2], gas.axes[0], axis=0)
    np.testing.assert_allclose(flux, 0.2 * (1 - 1 / 16), rtol=1e-9)
    assert "warning: flux through the ends of the grid" in err and "0.1875 for 0.19" in err and "--keep-flux" in err
    (gas,), err = made(command, tmp_path / "g.vtk", path, "--grid", 5, 4, "--keep-flux")
    flux = np.trapezoid(gas["velocity"][:, 0, :, 2], gas.axes[0], axis=0)
    # the source is asked on 128 intervals
    np.testing.assert_allclose(flux, 0.2 * (1 - 1 / 128**2), rtol=2e-4)
    np.testing.assert_array_equal(gas["velocity"][[0, -1]], 0)


def test_divergence_warning_by_sections(tmp_path, command):
    """One line for a series; none for a conserving flow in a channel, whose wall layers the grid does not resolve."""
    x, z = (a.ravel() for a in np.meshgrid(np.linspace(0, 0.3, 41), np.linspace(0, 0.6, 41)))
    w = np.where((x < 0.004) | (x > 0.296), 0.0, 5.0)
    for name, gain in (("a", 0.0), ("b", 0.5), ("c", 0.5)):
        table(tmp_path / f"{name}.csv", "x,z,u,w", [np.stack([x, z, 0 * w, w * (1 + gain * z / 0.6)], axis=1)])
    _, err = made(command, tmp_path / "g.vtk", tmp_path / "a.csv")
    assert err == ""
    _, err = made(command, tmp_path / "g.vtk", tmp_path / "b.csv", tmp_path / "c.csv", "--time", 0, 1)
    # from 1 to 1.5 of the inflow, over the largest
    assert len(err.splitlines()) == 1 and "changes by 33.3 % of the largest, most at z = 0.6 m" in err
    assert "(and 1 more files)" in err


def test_provenance(tmp_path, command):
    """The file keeps source, time, mapping and units; the check shows it; it reads the same from text and binary."""
    case = write_openfoam(tmp_path / "case", Block(), {2.5: {"U": linear(Block().centres)}})
    texts = []
    for words in ((), ("--ascii",)):
        words = ("--grid", 3, 3, "--axes", "x,-z,y", "--length-unit", "cm", "--shift", 1, 0, 2, *words)
        (gas,), _ = made(command, tmp_path / "g.vtk", case, *words)
        texts.append(gas.provenance)
        assert command("gas", "check", tmp_path / "g.vtk")[1].count("source time: 2.5") == 1
    assert texts[0] == texts[1]
    for line in (
        f"source: {case}, time 2.5",
        "axes (of this file = of the source): x = x, y = -z, z = y",
        "lengths: times 0.01, shifted by 1 0 2 m",
        "velocity: U, times 1",
        "units: m, s, m/s, kg/m^3, m^2/s",
    ):
        assert line in texts[0].splitlines()
    grid = pv.read(tmp_path / "g.vtk")
    assert "velocity" in grid.point_data and grid.field_data["PROVENANCE"].tobytes().decode().strip() == texts[0]
    write_field(tmp_path / "h.vtk", gas)
    assert read_field(tmp_path / "h.vtk").provenance == texts[0]
