"""VTK XML files that ParaView opens: clusters as points, maps as images, and a series over time."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Sequence
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from ..analysis.cells import Cells
from ..analysis.grid import Maps
from ..frame import WHOLE, Floats, Frame
from .output import write_text
from .reader import notes

TYPES = {"f": "Float64", "i": "Int64"}


def _array(name: str, values: NDArray[np.generic], tuples: bool = False) -> str:
    """One data array, inline base64 behind a UInt64 byte count; field data must say how many tuples there are."""
    values = np.ascontiguousarray(values)
    raw = np.uint64(values.nbytes).tobytes() + values.tobytes()
    parts = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    parts += f' NumberOfTuples="{len(values)}"' if tuples else ""
    kind = TYPES[values.dtype.kind]
    return f'<DataArray type="{kind}" Name={quoteattr(name)}{parts} format="binary">{base64.b64encode(raw).decode()}</DataArray>\n'


def _time(time: float) -> str:
    """The time as VTK's readers look for it; nothing where it is not known."""
    if np.isnan(time):
        return ""
    return f"<FieldData>{_array('TimeValue', np.array([time]), True)}</FieldData>\n"


def _file(kind: str, body: str) -> str:
    return (
        '<?xml version="1.0"?>\n'
        f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n{body}</VTKFile>\n'
    )


def vectors_of(names: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Names by what they are parts of: three that end in x, y, z (with a _ before or without) are one vector.

    Examples
    --------
    >>> vectors_of(["vx", "vy", "vz", "mass", "ug_x", "ug_y", "ug_z", "fx"])
    {'v': ('vx', 'vy', 'vz'), 'mass': ('mass',), 'ug': ('ug_x', 'ug_y', 'ug_z'), 'fx': ('fx',)}
    """
    found: dict[str, tuple[str, ...]] = {}
    for name in names:
        stem = name[:-1] if name[-1] in "xyz" and len(name) > 1 else ""
        parts = tuple(stem + axis for axis in "xyz")
        whole = stem.rstrip("_")
        if whole and all(part in names for part in parts) and whole not in names:
            found[whole] = parts
        else:
            found[name] = (name,)
    return found


def write_points(path: str | Path, frame: Frame) -> Path:
    """Clusters as a .vtp file: a vertex each, with diameter, mass, velocity and whatever numbers the frame has.

    Three columns that are one vector (vx vy vz, fd_x fd_y fd_z, …) become one array of three components, v and fd.

    Parameters
    ----------
    path : str or Path
        The file.
    frame : Frame
        The clusters.
    """
    count = len(frame)
    places = ("x", "y", "z")
    data = ""
    for name, parts in vectors_of([name for name in frame.columns if name not in places]).items():
        if len(parts) == 3:
            data += _array(name, np.stack([frame[part] for part in parts], axis=1))
        else:
            values = frame[name]
            data += _array(name, np.rint(values).astype(np.int64) if name in WHOLE else values)
    for name in frame.texts:
        notes.warning("column %s holds words: VTK's files leave it out", name)
    index = np.arange(count, dtype=np.int64)
    body = (
        f"<PolyData>\n{_time(frame.time)}"
        f'<Piece NumberOfPoints="{count}" NumberOfVerts="{count}">\n'
        f'<PointData Scalars="diameter">\n{data}</PointData>\n'
        f"<Points>\n{_array('Points', np.stack([frame[axis] for axis in places], axis=1))}</Points>\n"
        f"<Verts>\n{_array('connectivity', index)}{_array('offsets', index + 1)}</Verts>\n"
        "</Piece>\n</PolyData>\n"
    )
    return write_text(path, _file("PolyData", body))


def write_image(path: str | Path, maps: Maps, grid: Cells, time: float) -> Path:
    """Maps as cell data of a .vti image where they lie, with one cell through the depth of a plane.

    Parameters
    ----------
    path : str or Path
        The file.
    maps : mapping of str to ndarray, of the grid's shape
        As :func:`clusterdem.maps_of` gives them; the velocities become one vector, with 0 across a plane.
    grid : Grid or SpaceGrid
        The grid.
    time : float
        Time (s).
    """
    axes = ["xyz".index(axis) for axis in grid.plane]
    cells, spacing = [1, 1, 1], list(grid.box.lengths)
    for axis, count, width in zip(axes, grid.shape, grid.spacing):
        cells[axis], spacing[axis] = count, width

    def in_order(values: Floats) -> Floats:
        block = values.transpose(np.argsort(axes)).reshape(cells)
        return block.ravel(order="F")  # x runs fastest

    parts = [f"velocity_{axis}" for axis in grid.plane]
    data = "".join(_array(name, in_order(values)) for name, values in maps.items() if name not in parts)
    if all(part in maps for part in parts):
        velocity = np.zeros((grid.count, 3))
        for axis, part in zip(axes, parts):
            velocity[:, axis] = in_order(maps[part])
        data += _array("velocity", velocity)
    extent = " ".join(f"0 {count}" for count in cells)
    origin, widths = (" ".join(repr(float(v)) for v in values) for values in (grid.box.lo, spacing))
    body = (
        f'<ImageData WholeExtent="{extent}" Origin="{origin}" Spacing="{widths}">\n'
        f"{_time(time)}"
        f'<Piece Extent="{extent}">\n<CellData Scalars="{next(iter(maps))}">\n{data}</CellData>\n</Piece>\n</ImageData>\n'
    )
    return write_text(path, _file("ImageData", body))


def write_series(path: str | Path, entries: Iterable[tuple[float, str]]) -> Path:
    """A .pvd file that names the files of a series.

    Parameters
    ----------
    path : str or Path
        The file.
    entries : iterable of (float, str)
        Time (s) and file name, relative to the .pvd file.
    """
    lines = "".join(
        f'<DataSet timestep="{time!r}" group="" part="0" file={quoteattr(name)}/>\n' for time, name in entries
    )
    return write_text(path, _file("Collection", f"<Collection>\n{lines}</Collection>\n"))
