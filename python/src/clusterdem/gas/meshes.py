"""CFD results on meshes, read by VTK through pyvista (and meshio, where pyvista leaves a format to it)."""

from __future__ import annotations

import io
import math
import warnings
from collections.abc import Iterable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import KDTree

from ..errors import InputError
from ..frame import Floats
from .cells import CellSource, Patch
from .facets import Facets, Ints, facets_of, is_linear
from .flattened import one_layer
from .openfoam import Conditions, FoamCase, Times
from .soundness import check_cells, check_sizes, check_text
from .sources import ROUNDING, Source, cell_grid, from_points, grid_source
from .zones import faces_of_zones

TIME_NAMES = ("TIME", "TimeValue", "time", "Time")


def pyvista() -> Any:
    """The module pyvista, which takes a second to import, or a clear error where it is missing."""
    try:
        import pyvista
    except ImportError as error:
        rule = "needs pyvista, which is not installed: pip install 'clusterdem[gas]' (or ./run setup)"
        raise InputError("clusterdem gas make", f"this kind of file {rule} ({error})") from error
    return pyvista


@dataclass(frozen=True)
class Block:
    """A patch as VTK gives it.

    Parameters
    ----------
    name, kind : str
        Its name, and "wall", "wedge", "empty" and so on; "" of a zone of which VTK gives the cells behind the faces.
    mesh : pyvista.DataSet
        Its faces with their values, or those cells.
    """

    name: str
    kind: str
    mesh: Any


def numbers(data: Any) -> dict[str, Floats]:
    """The arrays of numbers of cells or of points."""
    return {name: np.array(v, np.float64) for name, v in data.items() if v.dtype.kind in "fiu"}


@dataclass(eq=False)
class MeshSource(Source):
    """Values at the points of an unstructured mesh; VTK finds the cell of each place and interpolates in it.

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


def read_meshes(path: Path, times: Times) -> Iterator[Source]:
    """Each time of a file or OpenFOAM case as a source; of those with several times only the wished ones."""
    if path.is_dir() or path.suffix == ".foam":
        yield from _read_openfoam(path if path.is_dir() else path.parent, times)
        return
    reader = _reader(path)
    have = np.asarray(getattr(reader, "time_values", ()), np.float64)
    if not have.size:
        yield _source(path, _whole(path, reader), math.nan)
        return
    for time in wished(path, have, times):
        reader.set_active_time_value(time)
        yield _source(path, _whole(path, reader), time)


def _whole(path: Path, reader: Any) -> Any:
    data = _quietly(path, reader.read)
    check_cells(path, data)
    return data


def wished(path: Path, have: Floats, times: Times) -> list[float]:
    """Those of the times of a file that are asked for; all without a wish."""
    if isinstance(times, str):
        return [float(t) for t in (have[-1:] if times == "latest" else have)]
    found = []
    for time in times:
        at = int(np.argmin(np.abs(have - time)))
        if not math.isclose(have[at], time, rel_tol=1e-6, abs_tol=1e-12):
            listed = ", ".join(f"{t:.9g}" for t in have[:20])
            raise InputError(path, f"has no time {time:.9g} s; it has {listed}{' …' * (have.size > 20)}")
        found.append(float(have[at]))
    return found


def _quietly(path: Path, work: Any) -> Any:
    """Run a reader; what VTK cannot read becomes one error, what it says beside becomes nothing."""
    from vtkmodules.vtkCommonCore import vtkLogger

    catcher = pyvista().VtkErrorCatcher(raise_errors=False, send_to_logging=False, emit_warnings=False)
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        with catcher, redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # meshio prints, pyvista warns
            done = work()
    except InputError:
        raise
    except Exception as error:  # pyvista, VTK and meshio raise whatever they like
        raise InputError(path, f"cannot be read: {str(error).strip() or type(error).__name__}") from error
    except SystemExit as error:  # meshio, of what it does not know
        raise InputError(path, "cannot be read: meshio knows no such file") from error
    finally:
        vtkLogger.SetStderrVerbosity(verbosity)
    if path.suffix.startswith((".vt", ".pvt")) and catcher.error_events:
        # VTK goes on with what it has, and leaves the rest as memory was
        said = str(catcher.error_events[0].alert).strip().splitlines()[0].strip()
        whole = getattr(done, "n_points", 0)  # none of a reader that is only made
        raise InputError(path, f"{'is damaged, or cut short' if whole else 'VTK found no mesh in it'}: {said}")
    return done


def _reader(path: Path) -> Any:
    pv = pyvista()
    if not path.exists():
        raise InputError(path, "does not exist")
    check_sizes(path)
    check_text(path)
    if path.suffix == ".msh":  # VTK has no reader for it
        return _Meshio(pv, path)
    if path.suffix in (".xdmf", ".xmf"):
        return _quietly(path, lambda: _Xdmf(pv, path))
    if path.suffix == ".dat" and (case := path.with_suffix(".cas")).exists():  # Fluent: the data beside its case
        path = case
    return _quietly(path, lambda: pv.get_reader(str(path)))


class _Meshio:
    def __init__(self, pv: Any, path: Path) -> None:
        self.pv, self.path = pv, path

    def read(self) -> Any:
        return self.pv.read_meshio(str(self.path))


class _Xdmf:
    """VTK's reader, also of files without a time, at which that of pyvista fails."""

    def __init__(self, pv: Any, path: Path) -> None:
        from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
        from vtkmodules.vtkIOXdmf2 import vtkXdmfReader

        if b"<Grid" not in path.read_bytes():  # asked for it, VTK would end
            raise InputError(path, "holds no grid")
        self.pv, self.reader = pv, vtkXdmfReader()
        self.reader.SetFileName(str(path))
        self.reader.UpdateInformation()
        steps = self.reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
        self.time_values = list(steps or ())

    def set_active_time_value(self, time: float) -> None:
        self.reader.UpdateTimeStep(time)

    def read(self) -> Any:
        self.reader.Update()
        return self.pv.wrap(self.reader.GetOutputDataObject(0))


def _read_openfoam(path: Path, times: Times) -> Iterator[Source]:
    pv, case = pyvista(), FoamCase(path)
    layout, chosen = case.select(times)
    notes = []
    if layout.kind != "whole":
        notes.append(f"taken from {layout.folders[0].name}{' …' * (len(layout.folders) > 1)}: it is not reconstructed")
    if case.steady and len(chosen) > 1:
        notes.append("is steady: its times are iterations, not seconds; leave --time out for its latest state")
    with case.readable(layout, chosen) as folder:
        reader = _quietly(path, lambda: pv.POpenFOAMReader(str(folder / "system" / "controlDict")))
        # VTK's own points from cells are first-order at walls; see reconstruct.py
        reader.cell_to_point_creation = False
        reader.skip_zero_time = False
        reader.case_type = "reconstructed" if layout.kind == "whole" else "decomposed"
        reader.reader.SetUse64BitFloats(True)
        _quietly(path, reader.enable_all_patch_arrays)
        have = np.asarray(reader.time_values, np.float64)
        for time in chosen:
            reader.set_active_time_value(float(have[np.argmin(np.abs(have - time))]))
            blocks = _quietly(path, reader.read)
            first = folder if layout.kind == "whole" else folder / "processor0"
            source = _foam_source(f"{path}, time {time:.9g}", blocks, time, Conditions(first, layout.times[time]))
            source.notes, source.steady = notes, case.steady
            if case.steady and len(chosen) == 1:
                source.time = math.nan
            yield source


def _foam_source(path: str, blocks: Any, time: float, conditions: Conditions) -> Source:
    pv = pyvista()
    inside, patches = [], []
    for name, leaf in blocks.recursive_iterator("items"):
        if leaf is None or not leaf.n_cells:
            continue
        if name == "internalMesh":
            inside.append(leaf)
        elif isinstance(leaf, pv.PolyData):
            kind, _ = conditions.kinds.get(name, ("patch", ()))
            patches.append(Block(name, kind, leaf))
    if not inside:
        raise InputError(path, "VTK found no mesh in it")
    mesh = inside[0] if len(inside) == 1 else pv.MultiBlock(inside).combine()
    if not mesh.cell_data:
        raise InputError(path, "holds a mesh, but no field: run the solver, or another --time")
    return _cells(path, mesh, time, patches, conditions)


def _cells(path: str, mesh: Any, time: float, surfaces: list[Block], conditions: Conditions | None) -> Source:
    """A source that splits its cells; what is known at points of the mesh stays so."""
    facets = facets_of(mesh)
    cells, points = numbers(mesh.cell_data), numbers(mesh.point_data)
    centres = facets.centres()
    tree = KDTree(facets.points)
    if points:
        _, at = KDTree(np.asarray(mesh.points)).query(facets.points)
        points = {name: values[at] for name, values in points.items()}
    not_in_cells = frozenset(set(points) - set(cells))
    if not_in_cells:
        nearest = tree.query(centres)[1]
        cells |= {name: points[name][nearest] for name in not_in_cells}  # for the nearest value alone
    patches = [_patch(block, facets, tree, conditions) for block in surfaces if block.kind]
    zones = {block.name: block.mesh for block in surfaces if not block.kind}
    for name, faces in faces_of_zones(facets, centres, zones).items() if zones else ():
        patches.append(Patch(name, "wall" if name.endswith(":wall") else "patch", faces, {}, lambda _: "open"))
    source = CellSource(
        path, cells, centres, time, facets=facets, patches=patches, at_points=points, not_in_cells=not_in_cells
    )
    return one_layer(source)


def _patch(block: Block, facets: Facets, tree: KDTree, conditions: Conditions | None) -> Patch:
    mesh = block.mesh
    size = float(np.max(np.ptp(facets.points, axis=0)))
    _, at = tree.query(np.asarray(mesh.points), distance_upper_bound=ROUNDING * size)
    faces: list[Ints] = []
    rows = []
    for k, face in enumerate(mesh.regular_faces if mesh.is_all_triangles else mesh.irregular_faces):
        if np.all(at[face] < len(facets.points)):
            faces.append(at[face].astype(np.int64))
            rows.append(k)
    values = {name: v[rows] for name, v in numbers(mesh.cell_data).items()}
    how = {name: "value" if conditions is None else conditions.at(name, block.name) for name in values}
    return Patch(block.name, block.kind, faces, values, lambda name: how.get(name, "open"))


def _source(path: Path, data: Any, time: float) -> Source:
    pv = pyvista()
    surfaces: list[Block] = []
    if isinstance(data, pv.MultiBlock):
        data, surfaces = _joined(path, pv, data)
    if data is None or data.n_points == 0:
        raise InputError(path, "VTK found no mesh in it")
    for name in TIME_NAMES:
        if math.isnan(time) and name in data.field_data:
            time = float(np.asarray(data.field_data[name]).flat[0])
    cells, points = numbers(data.cell_data), numbers(data.point_data)
    if data.max_cell_dimensionality < 2 and points:  # a cloud
        return from_points(str(path), np.asarray(data.points, np.float64), points, time)
    if isinstance(data, pv.ImageData):
        data = data.cast_to_rectilinear_grid()
    if isinstance(data, pv.RectilinearGrid):
        x, y, z = (np.array(axis, np.float64) for axis in (data.x, data.y, data.z))
        if cells and not points:
            return cell_grid(str(path), (x, y, z), cells, time)
        if not cells:
            return grid_source(str(path), (x, y, z), points, time)
    mesh = _highest(data.cast_to_unstructured_grid())
    if not cells and 42 not in mesh.celltypes:
        return MeshSource(str(path), points, np.asarray(mesh.points, np.float64), time, mesh=mesh)
    if not is_linear(mesh):
        mesh = mesh.linear_copy()  # cells of a higher order by their corners
    return _cells(str(path), mesh, time, surfaces, None)


def _highest(mesh: Any) -> Any:
    """Without the cells of fewer dimensions, such as the faces of the groups of a mesh generator."""
    types = np.asarray(mesh.celltypes)
    kinds = {int(kind): _dimension(int(kind)) for kind in np.unique(types)}
    keep = np.isin(types, [kind for kind, size in kinds.items() if size == max(kinds.values())])
    return mesh if keep.all() else mesh.extract_cells(np.flatnonzero(keep))


def _dimension(kind: int) -> int:
    from vtkmodules.vtkCommonDataModel import vtkCellTypeUtilities

    return int(vtkCellTypeUtilities.GetDimension(kind)) if 0 < kind < 100 else -1


def _joined(path: Path, pv: Any, blocks: Any) -> tuple[Any, list[Block]]:
    """The blocks that the gas fills as one mesh without doubled points, and the surfaces beside it."""
    named = [(str(k), leaf) for k, leaf in blocks.recursive_iterator("items") if leaf is not None and leaf.n_cells]
    # Fluent's zones are named NAME:TYPE; VTK's reader gives its walls and inner faces, too, as cells of their own
    fluid = [part for part in named if part[0].endswith(":fluid")]
    gas = fluid or named
    gas = [part for part in gas if len(part[1].cell_data) or len(part[1].point_data)] or gas
    if not gas:
        raise InputError(path, "VTK found no mesh in it")
    most = max(leaf.max_cell_dimensionality for _, leaf in gas)
    leaves = [leaf for _, leaf in gas if leaf.max_cell_dimensionality == most]
    surfaces = [
        Block(name, "wall" if "wall" in name.lower() else "patch", leaf.extract_surface(algorithm=None))
        for name, leaf in named
        if leaf.max_cell_dimensionality == most - 1 == 2
    ]
    inner = (":fluid", ":solid", ":interior")
    surfaces += [Block(name, "", leaf) for name, leaf in named if fluid and not name.endswith(inner)]
    return leaves[0] if len(leaves) == 1 else pv.MultiBlock(leaves).combine(merge_points=True), surfaces
