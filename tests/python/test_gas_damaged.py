"""CFD files that are damaged: one line that says what is wrong, no crash, nothing written, nothing made up."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from cfd_files import Block
from test_gas_make import hexahedra, image

pv = pytest.importorskip("pyvista")


def text_file(folder, kind="unstructured"):
    """A legacy VTK file in text."""
    mesh = hexahedra(Block()) if kind == "unstructured" else image(Block()).cast_to_structured_grid()
    mesh.save(folder / "whole.vtk", binary=False)
    return (folder / "whole.vtk").read_bytes()


def cut_in_array(folder):
    data = text_file(folder)
    return data[: data.rindex(b"U ") + 400]


def cut_in_points(folder):
    data = text_file(folder)
    return data[: data.index(b"POINTS") + 500]


def cut_in_cells(folder):
    data = text_file(folder)
    return data[: data.index(b"CONNECTIVITY") + 100]


def cut_xml(folder):
    hexahedra(Block()).save(folder / "whole.vtu")
    return (folder / "whole.vtu").read_bytes()[:3000]


def point_that_is_not_there(folder):
    cells = "<Cells>" + "".join(
        f'<DataArray type="{kind}" Name="{name}" format="ascii">{text}</DataArray>'
        for kind, name, text in (
            ("Int64", "connectivity", "0 1 2 99999999"),
            ("Int64", "offsets", "4"),
            ("UInt8", "types", "10"),
        )
    )
    numbers = '<DataArray type="Float64" NumberOfComponents="3" format="ascii"'
    return (
        '<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid>'
        f'<Piece NumberOfPoints="4" NumberOfCells="1"><PointData>{numbers} Name="velocity">{"0 " * 12}</DataArray></PointData>'
        f"<Points>{numbers}>0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>{cells}</Cells></Piece></UnstructuredGrid></VTKFile>"
    ).encode()


def too_large(folder):
    extent = "0 100000 0 100000 0 100000"
    return (
        f'<?xml version="1.0"?><VTKFile type="ImageData" version="1.0"><ImageData WholeExtent="{extent}" Origin="0 0 0" '
        f'Spacing="1 1 1"><Piece Extent="{extent}"><PointData><DataArray type="Float64" Name="velocity" NumberOfComponents="3" '
        'format="ascii">0</DataArray></PointData></Piece></ImageData></VTKFile>'
    ).encode()


@pytest.mark.parametrize(
    "name, make, rule",
    [
        ("a.vtk", cut_in_array, "is cut short: U declares 567 values, but holds "),
        ("a.vtk", cut_in_points, "is cut short: POINTS declares 567 values, but holds "),
        ("a.vtk", cut_in_cells, "is cut short: CONNECTIVITY declares 768 values, but holds "),
        ("a.vtu", cut_xml, "VTK found no mesh in it: Error parsing XML"),
        ("a.vtu", point_that_is_not_there, "a cell has the point 99999999, but there are 4, from 0 on"),
        ("a.vti", too_large, "declares 1,000,030,000,300,001 points or cells, but holds "),
        ("a.xdmf", lambda _: b'<?xml version="1.0"?><Xdmf><Domain/></Xdmf>', "holds no grid"),
        ("a.msh", lambda _: b"junk", "cannot be read"),
        ("a.case", lambda _: b"FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: none.geo\n", "VTK found no mesh in it"),
    ],
)
def test_damaged_files(tmp_path, name, make, rule):
    """In a process of its own: VTK writes past Python's streams, and would end the process by a signal."""
    (tmp_path / name).write_bytes(make(tmp_path))
    words = ("gas", "make", name, "-o", "g.vtk", "--grid", "5", "5")
    done = subprocess.run(
        [sys.executable, "-m", "clusterdem", *words], cwd=tmp_path, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 2 and done.stdout == ""
    assert len(done.stderr.splitlines()) == 1 and f"{name}: {rule}" in done.stderr, done.stderr
    assert not (tmp_path / "g.vtk").exists()


@pytest.mark.parametrize("kind", ["unstructured", "structured"])
def test_whole_text_files(tmp_path, command, kind):
    """Those that are not cut are read."""
    text_file(tmp_path, kind)
    assert command("gas", "make", tmp_path / "whole.vtk", "-o", tmp_path / "g.vtk", "--grid", 5, 5)[0] == 0
    assert np.isfinite(pv.read(tmp_path / "g.vtk")["velocity"]).all()
