"""VTK XML files that ParaView opens: clusters as points, maps as images, and a series over time."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Mapping
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from ..analysis.grid import Grid
from ..frame import Floats, Frame
from .output import write_text

TYPES = {"f": "Float64", "i": "Int64"}


def _array(name: str, values: NDArray[np.generic]) -> str:
    """One data array, inline base64 behind a UInt64 byte count."""
    values = np.ascontiguousarray(values)
    raw = np.uint64(values.nbytes).tobytes() + values.tobytes()
    parts = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    kind = TYPES[values.dtype.kind]
    return f'<DataArray type="{kind}" Name={quoteattr(name)}{parts} format="binary">{base64.b64encode(raw).decode()}</DataArray>\n'


def _file(kind: str, body: str) -> str:
    return (
        '<?xml version="1.0"?>\n'
        f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n{body}</VTKFile>\n'
    )


def write_points(path: str | Path, frame: Frame) -> Path:
    """Clusters as a .vtp file: a vertex each, with diameter, mass, velocity and whatever else the frame has.

    Parameters
    ----------
    path : str or Path
        The file.
    frame : Frame
        The clusters.
    """
    count = len(frame)
    y = frame["y"] if "y" in frame else np.full(count, (frame.box.lo[1] + frame.box.hi[1]) / 2)
    data = ""
    velocity = ["vx", "vy", "vz"]
    if all(name in frame for name in velocity):
        data += _array("v", np.stack([frame[name] for name in velocity], axis=1))
    for name, values in frame.columns.items():
        if name in ("x", "y", "z", *velocity):
            continue
        whole = name in ("id", "n", "type")
        data += _array(name, np.rint(values).astype(np.int64) if whole else values)
    index = np.arange(count, dtype=np.int64)
    body = (
        f"<PolyData>\n<FieldData>{_array('TimeValue', np.array([frame.time]))}</FieldData>\n"
        f'<Piece NumberOfPoints="{count}" NumberOfVerts="{count}">\n'
        f'<PointData Scalars="diameter">\n{data}</PointData>\n'
        f"<Points>\n{_array('Points', np.stack([frame.x, y, frame.z], axis=1))}</Points>\n"
        f"<Verts>\n{_array('connectivity', index)}{_array('offsets', index + 1)}</Verts>\n"
        "</Piece>\n</PolyData>\n"
    )
    return write_text(path, _file("PolyData", body))


def write_image(path: str | Path, maps: Mapping[str, Floats], grid: Grid, time: float) -> Path:
    """Maps as cell data of a .vti image, one cell thick in y.

    Parameters
    ----------
    path : str or Path
        The file.
    maps : mapping of str to ndarray, shape (nx, nz)
        As :func:`clusterdem.grid.maps_of` gives them.
    grid : Grid
        The grid.
    time : float
        Time (s).
    """
    (dx, dz), (x, y, z) = grid.spacing, grid.box.lo
    extent = f"0 {grid.nx} 0 1 0 {grid.nz}"
    data = "".join(_array(name, values.T.ravel()) for name, values in maps.items())
    body = (
        f'<ImageData WholeExtent="{extent}" Origin="{x!r} {y!r} {z!r}" Spacing="{dx!r} {grid.box.lengths[1]!r} {dz!r}">\n'
        f"<FieldData>{_array('TimeValue', np.array([time]))}</FieldData>\n"
        f'<Piece Extent="{extent}">\n<CellData Scalars="fraction">\n{data}</CellData>\n</Piece>\n</ImageData>\n'
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
