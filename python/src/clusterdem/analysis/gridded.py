"""Maps that the engine made while it ran: sums over the clusters of each cell, as inputs/maps.in writes them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..errors import ArgumentError, InputError
from ..frame import Floats, Frame, Words
from ..io.binary import is_binary
from ..io.header import Header, read_header
from ..io.rows import parse_rows
from ..io.streams import open_lines
from ..primary import ASSUMED, Primary, primary_beside
from .grid import Grid, Maps

COLUMNS = ("mass_density", "number_density", "diameter", "momentum_x", "momentum_z", "energy")
"""Mass and number of clusters per volume (kg/m³, 1/m³); per cluster diameter (m), m·v_x, m·v_z (kg·m/s), m·(v_x² + v_z²) (J)."""


def is_gridded(path: str | Path) -> bool:
    """Whether the first frame of a dump holds cells, not clusters; not if it cannot be read."""
    if is_binary(path):
        return False
    try:
        with open_lines(path) as source:
            header = read_header(source)
    except InputError:
        return False
    return header is not None and header.cells is not None


def read_gridded(path: str | Path, density: float | None = None) -> Iterator[tuple[Frame, Grid, Maps]]:
    """The maps of one file, a frame at a time.

    Parameters
    ----------
    path : str or Path
        A text dump of LAMMPS' style grid with the columns :data:`COLUMNS`, one cell along y.
    density : float, optional
        Density of the primary particles (kg/m³); by default what the run's log beside the file tells.

    Yields
    ------
    (Frame, Grid, Maps)
        Step, time and box of the frame, without clusters; its grid; the maps as :func:`clusterdem.grid.maps_of` names them.

    Raises
    ------
    InputError
        If a column is missing, there are several cells along y, or a number is none.
    ArgumentError
        If the run has kinds of particles of several densities: a cell's mass does not tell them apart.
    """
    if density is not None:
        primary = Primary.of_density(density)
    else:
        primary = primary_beside(Path(path)) or Primary.of_density(ASSUMED, "assumed")
    if primary.density is None:
        raise ArgumentError("density", f"maps made by the run do not tell {primary.words} apart: give one for all")
    with open_lines(path) as source:
        while (header := read_header(source)) is not None:
            if header.cells is None:
                raise InputError(path, "clusters here, cells before: give one kind of dump", header.line)
            missing = [name for name in COLUMNS if name not in header.names]
            if missing:
                rule = f"maps need the columns {' '.join(COLUMNS)}, as inputs/maps.in writes them; missing: {' '.join(missing)}"
                raise InputError(path, rule, header.names_line)
            nx, ny, nz = header.cells
            if ny != 1:
                raise InputError(path, f"maps have one cell along y, not {ny}", header.names_line)
            block = source.read_until(b"ITEM:", header.count)
            wanted = [header.names.index(name) for name in COLUMNS]
            rows = parse_rows(block, header.count, header.names, wanted, str(path), header.names_line + 1)
            grid = Grid(header.box, nx, nz)
            yield _head(header, path, primary), grid, _maps(dict(zip(COLUMNS, _numbers(rows))), grid, primary.density)


def _numbers(rows: list[Floats | Words]) -> list[Floats]:
    return [row.astype(np.float64) for row in rows]


def _head(header: Header, path: str | Path, primary: Primary) -> Frame:
    nothing = {name: np.empty(0) for name in ("mass", "diameter")}
    return Frame(
        header.step, header.time, header.box, nothing, str(path), header.line, header.names_line + 1, primary=primary
    )


def _maps(rows: dict[str, Floats], grid: Grid, density_p: float) -> Maps:
    # x runs fastest in the file
    cells = {name: values.reshape(grid.nz, grid.nx).T for name, values in rows.items()}
    density, number = cells["mass_density"], cells["number_density"]
    there = density > 0

    def per_mass(name: str) -> Floats:
        mean: Floats = np.divide(cells[name] * number, density, out=np.full(grid.shape, np.nan), where=there)
        return mean

    vx, vz = per_mass("momentum_x"), per_mass("momentum_z")
    # (the rounding of a difference can be below zero)
    temperature = np.maximum(per_mass("energy") - vx**2 - vz**2, 0.0) / 2
    return {
        "mass": density * grid.cell_volume,
        "fraction": density / density_p,
        "number_density": number,
        "mean_diameter": np.where(there, cells["diameter"], np.nan),
        "velocity_x": vx,
        "velocity_z": vz,
        "temperature": np.where(number * grid.cell_volume > 1.5, temperature, np.nan),
    }
