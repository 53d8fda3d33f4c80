"""Damaged files, before VTK falls over them: sizes that a file cannot hold, cells of points that there are not."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError

HEAD = 100_000
"""Bytes of a file in which its sizes stand."""
MOST_POINTS = 2_000_000_000
MOST_POINTS_PER_BYTE = 1000
"""More than any compression makes of points that differ."""


def check_sizes(path: Path) -> None:
    """Refuse a VTK file, legacy or XML, that declares more points than its bytes can be."""
    if not path.suffix.startswith((".vt", ".pvt")):
        return
    with open(path, "rb") as file:
        head = file.read(HEAD).decode("latin-1")
    counts = [int(n) for n in re.findall(r'NumberOf(?:Points|Cells)="(-?\d+)"', head)]
    counts += [int(n) for n in re.findall(r"^\s*(?:POINTS|CELLS|POINT_DATA|CELL_DATA)\s+(-?\d+)", head, re.MULTILINE)]
    for extent in re.findall(r'Extent="([-\d\s]+)"', head):
        ends = [int(word) for word in extent.split()]
        counts.append(math.prod(max(b - a + 1, 0) for a, b in zip(ends[::2], ends[1::2])))
    for dimensions in re.findall(r"^\s*DIMENSIONS\s+(\d+)\s+(\d+)\s+(\d+)", head, re.MULTILINE):
        counts.append(math.prod(map(int, dimensions)))
    size = path.stat().st_size
    for count in counts:
        if count < 0 or count > MOST_POINTS or count > MOST_POINTS_PER_BYTE * size:
            raise InputError(path, f"declares {count:,} points or cells, but holds {size:,} bytes")


HEADING = re.compile(
    rb"^[ \t]*(?:(POINT_DATA|CELL_DATA|POINTS|CELL_TYPES|[XYZ]_COORDINATES|CELLS)[ \t]+(\d+)[ \t]*(\d*)[ \t]*\w*"
    rb"|(OFFSETS|CONNECTIVITY)[ \t]+\w+|(VECTORS|NORMALS|TENSORS)[ \t]+(\S+)[ \t]+\w+"
    rb"|SCALARS[ \t]+(\S+)[ \t]+\w+[ \t]*(\d*)|(\S+)[ \t]+(\d+)[ \t]+(\d+)[ \t]+(?:float|double|int|long|vtktypeint64))"
    rb"[ \t]*\r?$",
    re.MULTILINE,
)
"""Headings of blocks of numbers in legacy VTK files."""


def check_text(path: Path) -> None:
    """Refuse a legacy VTK file in text that ends within a block of numbers: VTK takes what memory holds for the rest."""
    with open(path, "rb") as file:
        head = file.read(400)
    if path.suffix != ".vtk" or not re.match(rb"# vtk DataFile[^\n]*\n[^\n]*\n\s*ASCII", head):
        return
    data = path.read_bytes()
    rows, cells, last, wanted, name = 0, (0, 0), 0, 0, ""
    for match in HEADING.finditer(data):
        block, count, more, part, vector, of_vector, scalar, parts, field, each, tuples = (
            text.decode("latin-1") if text is not None else "" for text in match.groups()
        )
        last = match.end()
        if block in ("POINT_DATA", "CELL_DATA"):
            rows, wanted = int(count), 0
        elif block == "CELLS":
            cells, wanted, name = (int(count), int(more or 0)), int(more or 0), block
        elif block:
            wanted, name = int(count) * (3 if block == "POINTS" else 1), block
        elif part:
            wanted, name = cells[part == "CONNECTIVITY"], part
        elif vector:
            wanted, name = rows * (9 if vector == "TENSORS" else 3), of_vector
        elif scalar:
            wanted, name = rows * int(parts or 1), scalar
        else:
            wanted, name = int(each) * int(tuples), field
    text = re.sub(rb"\s*LOOKUP_TABLE\s+\S+", b"", data[last:], count=1)
    found = len(text.split(None, wanted)) if wanted else 0
    if found < wanted:
        raise InputError(path, f"is cut short: {name} declares {wanted:,} values, but holds {found:,}")


def check_cells(path: Path, data: Any) -> None:
    """Refuse a mesh with cells of points that it has not."""
    leaves = [data]
    if hasattr(data, "recursive_iterator"):
        leaves = [leaf for leaf in data.recursive_iterator() if leaf is not None]
    for mesh in leaves:
        if not hasattr(mesh, "cell_connectivity") or not mesh.n_cells:
            continue
        corners = np.asarray(mesh.cell_connectivity)
        wrong = np.flatnonzero((corners < 0) | (corners >= mesh.n_points))
        if wrong.size:
            rule = f"a cell has the point {corners[wrong[0]]}, but there are {mesh.n_points}, from 0 on"
            raise InputError(path, rule)
        offsets = np.asarray(mesh.cell_offsets)
        if np.any(np.diff(offsets) < 0) or offsets[-1] != corners.size:
            raise InputError(path, f"its cells have {corners.size} corners in all, but the last ends at {offsets[-1]}")
