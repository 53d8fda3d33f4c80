"""Runs the cases with OpenFOAM, makes gas fields of them by every route, and compares with OpenFOAM's own sampling.

usage: verify_gas.py FOLDER      cases go to FOLDER; the table goes into python/src/clusterdem/gas/README.md

OpenFOAM's values are those of its interpolation `cellPointFace`, in the plane midway between the sides of a case one cell
thick. Points beside a wall are those in the cells along it; cells in which a wall meets an inlet or outlet are left out:
there OpenFOAM takes the mean of both, and the wall lets half of the gas through.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator
from datetime import date
from pathlib import Path

import numpy as np
from clusterdem.cli import main as clusterdem
from clusterdem.gas.cells import CellSource
from clusterdem.gas.legacy import read_field
from clusterdem.gas.meshes import read_meshes
from clusterdem.gas.quantities import Recipe
from clusterdem.gas.revolve import Completed
from clusterdem.gas.series import read_series
from clusterdem.gas.sources import Source
from clusterdem.gas.tables import read_table
from openfoam_runs import HEAD, HERE, sampled, set_up, solve, tool
from scipy.interpolate import RegularGridInterpolator

PAGE = HERE.parents[2] / "python" / "src" / "clusterdem" / "gas" / "README.md"
BEGIN, END = "<!-- measured: written by ./run verify-gas -->", "<!-- end of what was measured -->"
COUNT = 200
"""Points in the flow and points beside walls, of each case."""
# axes of the box, spacing of the grid (m), middle of the case along z (m)
CASES = {
    "chan": ("x,-z,y", 0.005, 0.005),
    "step": ("y,z,x", 0.0005, 0.0),
    "cyl2": ("x,-z,y", 0.001, 0.0),
    "wedge": ("x,-z,y", 0.001, 0.0),
}
LIMITS = {"flow": 0.02, "wall": 0.05}
"""r.m.s. difference from OpenFOAM over the highest speed that counts as passed, asked at the points themselves."""


TOLD = {("wedge", "wall")}
"""Not judged: at points where a wall meets the sides of a wedge OpenFOAM takes the mean of both, and slips."""


def flat_part(source: Source) -> CellSource:
    inner = source.inner if isinstance(source, Completed) else source
    assert isinstance(inner, CellSource)
    return inner


def points_of(source: Source, middle: float) -> dict[str, np.ndarray]:
    """Points anywhere in the flow, and in the cells along walls, by the cells' numbers of patches."""
    plane = flat_part(source)
    kinds = np.zeros((2, plane.facets.cells), bool)  # has a wall, has another patch
    for patch in plane.patches:
        if patch.kind in ("wall", "patch") and len(patch.faces):
            kinds[int(patch.kind != "wall"), plane.facets.cell[plane.facets_of(patch)]] = True
    rng = np.random.default_rng(18)
    low, high = plane.bounds
    places = rng.uniform(low, high, (200_000, 3))
    _, cell = plane._found(places, {})
    places[:, 2] = middle
    wall, other = kinds[:, np.maximum(cell, 0)]
    inside = cell >= 0
    return {"flow": places[inside & ~wall & ~other][:COUNT], "wall": places[inside & wall & ~other][:COUNT]}


def asked(source: Source, points: np.ndarray) -> np.ndarray:
    """Velocity of a source at points in its own axes."""
    names = Recipe().velocity_names(source.path, source.arrays)
    if len(names) == 1:
        return source.sample(points, names)[names[0]]
    found = source.sample(points, [name for name in names if name != "0"])
    zero = np.zeros(len(points))
    return np.stack([found.get(name, zero) for name in names], axis=1)


def through_a_grid(path: Path, points: np.ndarray, axes: str, folder: Path, spacing: float) -> np.ndarray:
    """Velocity at points by way of a field file, in which the engine interpolates linearly; in the case's own axes."""
    out = folder / "grid.vtk"
    grid = ("--axes", axes, "--spacing", f"{spacing}", f"{spacing}", "--time", "latest")
    assert clusterdem(["gas", "make", str(path), "-o", str(out), *grid]) == 0
    gas = read_field(out)
    order = [("xyz".index(word[-1]), -1 if word[0] == "-" else 1) for word in axes.split(",")]
    box = np.stack([sign * points[:, k] for k, sign in order], axis=1)
    between = RegularGridInterpolator(
        (gas.axes[0], gas.axes[2]), gas["velocity"][:, 0], bounds_error=False, fill_value=None
    )
    found = between(box[:, [0, 2]])
    own = np.empty_like(found)
    for part, (k, sign) in enumerate(order):
        own[:, k] = sign * found[:, part]
    return own


def routes(case: Path) -> Iterator[tuple[str, Path]]:
    """Every form in which a case can be had."""
    yield "OpenFOAM, its folder", case
    tool(case, "foamToVTK", "-latestTime")
    (listed,) = (case / "VTK").glob("*.vtm.series")
    yield "foamToVTK, .vtm.series", listed
    (inside,) = (case / "VTK").glob("*/internal.vtu")
    yield "foamToVTK, internal.vtu alone", inside
    tool(case, "foamToEnsight", "-latestTime")
    (ensight,) = (case / "EnSight").glob("*.case")
    yield "foamToEnsight, .case", ensight


def cutting_plane(case: Path, middle: float) -> Path:
    """A surface in format raw, sampled by OpenFOAM at the corners of its triangles."""
    (case / "system" / "cut").write_text(
        HEAD.format("cut")
        + "type surfaces; libs (sampling); writeControl writeTime; interpolationScheme cellPointFace;\n"
        "surfaceFormat raw; fields (U); surfaces ( mid { type cuttingPlane; planeType pointAndNormal; interpolate true;\n"
        f"pointAndNormalDict {{ point (0 0 {middle}); normal (0 0 1); }} }} );\n"
    )
    tool(case, "postProcess", "-latestTime", "-func", "cut")
    (path,) = (case / "postProcessing" / "cut").glob("*/U_mid.raw")
    return path


def opened(path: Path) -> Source:
    if path.suffix == ".raw":
        return read_table(path)
    read = read_series if path.suffix == ".series" else read_meshes
    return list(read(path, "latest"))[-1]


def in_parallel(folder: Path, layout: str, points: dict[str, np.ndarray]) -> tuple[Path, dict[str, np.ndarray]]:
    """The channel on two ranks, and OpenFOAM's values after `reconstructPar` of a copy."""
    case = set_up("chan", folder / layout)
    solve(case, layout)
    whole = Path(shutil.copytree(case, folder / layout / "reconstructed"))
    words = ("-fileHandler", "collated") if layout == "collated" else ()
    tool(whole, "reconstructPar", "-latestTime", *words)
    return case, {kind: sampled(whole, places)["U"] for kind, places in points.items()}


def row(name: str, route: str, errors: dict[str, np.ndarray], grid: dict[str, np.ndarray], speed: float) -> str:
    cells = [name, route]
    for kind in ("flow", "wall"):
        e = errors[kind]
        cells += [f"{100 * np.sqrt(np.nanmean(e**2)) / speed:.2f}", f"{100 * np.nanmax(e) / speed:.1f}"]
        cells.append(f"{100 * np.sqrt(np.nanmean(grid[kind] ** 2)) / speed:.2f}" if kind in grid else "–")
    return "| " + " | ".join(cells) + " |"


def compared(name: str, route: str, path: Path, points, reference, folder: Path) -> tuple[str, bool]:
    """A row of the table, and whether the errors are within their limits."""
    axes, spacing, _ = CASES[name]
    speed = max(float(np.nanmax(np.linalg.norm(values, axis=1))) for values in reference.values())
    source = opened(path)
    errors, grid = {}, {}
    for kind, places in points.items():
        errors[kind] = np.linalg.norm(asked(source, places) - reference[kind], axis=1)
        grid[kind] = np.linalg.norm(through_a_grid(path, places, axes, folder, spacing) - reference[kind], axis=1)
    judged = [kind for kind in errors if (name, kind) not in TOLD]
    passed = all(np.sqrt(np.mean(errors[kind] ** 2)) < LIMITS[kind] * speed for kind in judged)
    text = row(name, route, errors, grid, speed)
    print(text, flush=True)
    return text, passed


def linear(points: np.ndarray) -> np.ndarray:
    x, y, z = points.T
    return np.stack([1 + 2 * x - 3 * y + 0.5 * z, -1 + z + x, 2 * x + y - 4 * z + 3], axis=1)


def polyhedra(name: str, folder: Path) -> tuple[str, bool]:
    """A linear velocity in polyhedral cells, at 20,000 points."""
    case = set_up(name, folder)
    tool(case, "postProcess", "-func", "writeCellCentres", "-time", "0")
    (case / "1").mkdir()
    text = (case / "0" / "C").read_text()
    body = text[text.index("(", text.index("internalField")) + 1 :]
    centres = np.array([line.strip("()").split() for line in body.split("\n)")[0].strip().splitlines()], float)
    rows = "\n".join("({:.12g} {:.12g} {:.12g})".format(*u) for u in linear(centres))
    (case / "1" / "U").write_text(
        HEAD.format("U").replace("dictionary", "volVectorField")
        + f"dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform List<vector> {len(centres)}\n(\n{rows}\n)\n;\n"
        + "boundaryField { walls { type zeroGradient; } }\n"
    )
    (source,) = read_meshes(case, "latest")
    places = np.random.default_rng(4).uniform([0, 0, 0], [0.3, 0.12, 0.6], (20_000, 3))
    found = asked(source, places)
    inside = np.isfinite(found[:, 0])
    most = float(np.abs(found - linear(places))[inside].max())
    return (
        f"| {name} | {len(centres)} cells, linear velocity up to 4 m/s | {inside.sum():,} | {most:.1e} |",
        most < 2e-6,
    )


def main(folder: Path) -> int:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    rows, solids, good = [], [], True
    for name, (_, _, middle) in CASES.items():
        case = set_up(name, folder)
        solve(case)
        points = points_of(opened(case), middle)
        reference = {kind: sampled(case, places)["U"] for kind, places in points.items()}
        for route, path in routes(case):
            if name == "wedge" and path != case:
                continue  # only the case itself tells that it is a wedge
            text, passed = compared(name, route, path, points, reference, folder)
            rows.append(text)
            good &= passed
        text, passed = compared(
            name, "surface .raw of a cutting plane", cutting_plane(case, middle), points, reference, folder
        )
        rows.append(text)
        if name == "chan":
            for layout in ("processors", "collated"):
                path, own = in_parallel(folder, layout, points)
                text, passed = compared(name, f"OpenFOAM, {layout}, 2 ranks", path, points, own, folder)
                rows.append(text)
                good &= passed
    for name in ("hanging", "dual"):
        text, passed = polyhedra(name, folder)
        solids.append(text)
        good &= passed
    table = [
        f"{date.today().day} {date.today():%b %Y}, `./run verify-gas`, OpenFOAM v1912:",
        "",
        "| case | route | flow: r.m.s. | most | on a grid | wall cells: r.m.s. | most | on a grid |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
        *rows,
        "",
        "| polyhedra | | points | largest error (m/s) |",
        "| --- | --- | --- | --- |",
        *solids,
    ]
    print("\n".join(table))
    before, _, rest = PAGE.read_text().partition(BEGIN)
    after = rest.partition(END)[2]
    PAGE.write_text(before + BEGIN + "\n" + "\n".join(table) + "\n" + END + after)
    print("all within their limits" if good else "SOME ARE BEYOND THEIR LIMITS")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
