"""CFD results on meshes, read by VTK through pyvista (and meshio, where pyvista leaves a format to it)."""

from __future__ import annotations

import io
import math
import warnings
from collections.abc import Iterable, Iterator, Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError
from ..frame import Floats
from .reconstruct import cells_to_points
from .sources import ROUNDING, Source, cell_grid, grid_source

TIME_NAMES = ("TIME", "TimeValue", "time", "Time")


def pyvista() -> Any:
    """The module pyvista, which takes a second to import, or a clear error where it is missing."""
    try:
        import pyvista
    except ImportError as error:
        rule = "needs pyvista, which is not installed: pip install 'clusterdem[gas]' (or ./run setup)"
        raise InputError("clusterdem gas make", f"this kind of file {rule} ({error})") from error
    return pyvista


@dataclass(eq=False)
class MeshSource(Source):
    """Values on an unstructured mesh; VTK finds the cell of each place and interpolates in it.

    Parameters
    ----------
    mesh : pyvista.DataSet
        The mesh.
    """

    mesh: Any = None

    def sample(self, places: Floats, names: Iterable[str]) -> dict[str, Floats]:
        names = list(names)
        bare = self.mesh.copy(deep=False)
        bare.clear_data()
        for name in names:
            bare.point_data[name] = self.arrays[name]
        low, high = self.bounds
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            probe = pyvista().PolyData(self.snapped(places))
            found = probe.sample(bare, tolerance=ROUNDING * float(np.max(high - low)))
        outside = np.asarray(found.point_data["vtkValidPointMask"]) == 0
        result = {}
        for name in names:
            values = np.array(found.point_data[name], np.float64)
            values[outside] = np.nan
            result[name] = values
        return result


def read_meshes(path: Path, times: Sequence[float]) -> Iterator[Source]:
    """Each time of a file or OpenFOAM case as a source; of those with several times only the given ones, if any are."""
    reader = _reader(path)
    if not hasattr(reader, "time_values") or not len(reader.time_values):
        yield _source(path, _quietly(path, reader.read), math.nan)
        return
    have = np.asarray(reader.time_values, np.float64)
    for time in times or have:
        at = int(np.argmin(np.abs(have - time)))
        if not math.isclose(have[at], time, rel_tol=1e-6, abs_tol=1e-12):
            listed = ", ".join(f"{t:.9g}" for t in have[:20])
            raise InputError(path, f"has no time {time:.9g} s; it has {listed}{' …' * (have.size > 20)}")
        reader.set_active_time_value(float(have[at]))
        yield _source(path, _quietly(path, reader.read), float(have[at]))


def _quietly(path: Path, work: Any) -> Any:
    """Run a reader; what VTK cannot read becomes one error, what it says beside becomes nothing."""
    from vtkmodules.vtkCommonCore import vtkObject

    vtkObject.GlobalWarningDisplayOff()
    try:
        with redirect_stdout(io.StringIO()):  # meshio prints
            return work()
    except InputError:
        raise
    except Exception as error:  # pyvista, VTK and meshio raise whatever they like
        raise InputError(path, f"cannot be read: {str(error).strip() or type(error).__name__}") from error
    finally:
        vtkObject.GlobalWarningDisplayOn()


def _reader(path: Path) -> Any:
    pv = pyvista()
    if path.is_dir() or path.suffix == ".foam":
        return _openfoam(pv, path if path.is_dir() else path.parent)
    if not path.exists():
        raise InputError(path, "does not exist")
    if path.suffix == ".msh":  # VTK has no reader for it
        return _Meshio(pv, path)
    if path.suffix == ".dat" and (case := path.with_suffix(".cas")).exists():  # Fluent: the data beside its case
        path = case
    return _quietly(path, lambda: pv.get_reader(str(path)))


class _Meshio:
    def __init__(self, pv: Any, path: Path) -> None:
        self.pv, self.path = pv, path

    def read(self) -> Any:
        return self.pv.read_meshio(str(self.path))


def _openfoam(pv: Any, case: Path) -> Any:
    control = case / "system" / "controlDict"
    if not control.exists():
        raise InputError(case, "no OpenFOAM case: system/controlDict is missing")
    reader = _quietly(case, lambda: pv.POpenFOAMReader(str(control)))
    # VTK's own points from cells are first-order at walls; see reconstruct.py
    reader.cell_to_point_creation = False
    reader.skip_zero_time = False
    split = (case / "processor0").is_dir() and not (case / "constant" / "polyMesh").is_dir()
    reader.case_type = "decomposed" if split else "reconstructed"
    reader.reader.SetUse64BitFloats(True)
    return reader


def _source(path: Path, data: Any, time: float) -> Source:
    pv = pyvista()
    if isinstance(data, pv.MultiBlock):
        data = _joined(path, pv, data)
    if data is None or data.n_points == 0:
        raise InputError(path, "VTK found no mesh in it")
    for name in TIME_NAMES:
        if math.isnan(time) and name in data.field_data:
            time = float(np.asarray(data.field_data[name]).flat[0])
    cells = {name: _numbers(values) for name, values in data.cell_data.items() if values.dtype.kind in "fiu"}
    points = {name: _numbers(values) for name, values in data.point_data.items() if values.dtype.kind in "fiu"}
    if isinstance(data, pv.ImageData):
        data = data.cast_to_rectilinear_grid()
    if isinstance(data, pv.RectilinearGrid):
        x, y, z = (_numbers(axis) for axis in (data.x, data.y, data.z))
        if cells and not points:
            return cell_grid(str(path), (x, y, z), cells, time)
        if not cells:
            return grid_source(str(path), (x, y, z), points, time)
    mesh = data.cast_to_unstructured_grid()
    points.update(_from_cells(path, mesh, {name: v for name, v in cells.items() if name not in points}))
    return MeshSource(str(path), points, np.asarray(mesh.points, np.float64), time, mesh)


def _numbers(values: Any) -> Floats:
    return np.array(values, np.float64)


def _joined(path: Path, pv: Any, blocks: Any) -> Any:
    """The blocks that the gas fills as one mesh without doubled points."""
    named = [(str(k), leaf) for k, leaf in blocks.recursive_iterator("items") if leaf is not None and leaf.n_cells]
    # Fluent's zones are named NAME:TYPE; VTK's reader gives its walls and inner faces, too, as cells of their own
    named = [part for part in named if part[0].endswith(":fluid")] or named
    leaves = [leaf for _, leaf in named]
    leaves = [leaf for leaf in leaves if len(leaf.cell_data) or len(leaf.point_data)] or leaves
    if not leaves:
        raise InputError(path, "VTK found no mesh in it")
    most = max(leaf.max_cell_dimensionality for leaf in leaves)  # the inside of an OpenFOAM case, not its walls
    leaves = [leaf for leaf in leaves if leaf.max_cell_dimensionality == most]
    return leaves[0] if len(leaves) == 1 else pv.MultiBlock(leaves).combine(merge_points=True)


def _from_cells(path: Path, mesh: Any, cells: dict[str, Floats]) -> dict[str, Floats]:
    if not cells:
        return {}
    corners = np.asarray(mesh.cell_connectivity, np.int64)
    owner = np.repeat(np.arange(mesh.n_cells), np.diff(mesh.cell_offsets))
    centres = np.asarray(mesh.cell_centers().points, np.float64)
    found = {}
    for name, values in cells.items():
        flat = values.reshape(mesh.n_cells, -1)
        at_points = cells_to_points(np.asarray(mesh.points, np.float64), centres, owner, corners, flat)
        found[name] = at_points.reshape(-1, *values.shape[1:])
    return found
