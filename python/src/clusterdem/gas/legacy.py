"""Legacy VTK files of rectilinear grids: what the engine reads, and no more.

Small enough to be read and written here, so that a file can be made, checked and drawn without VTK; the tests compare
both directions with VTK itself. Format: "VTK File Formats", legacy section, of the VTK user's guide.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..frame import Floats
from ..io.output import atomic
from .field import NAMES, VECTORS, Axes, GasField

TITLE = "clusterdem gas; SI units (m, s, m/s, kg/m^3, m^2/s)"

TYPES = {
    "double": "f8", "float": "f4", "char": "i1", "unsigned_char": "u1", "short": "i2", "unsigned_short": "u2",
    "int": "i4", "unsigned_int": "u4", "long": "i8", "unsigned_long": "u8", "vtktypeint64": "i8", "vtkIdType": "i8",
}  # fmt: skip
COMPONENTS = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9}
MOST_POINTS = 10**9


@dataclass
class LegacyGrid:
    """All that a file holds.

    Parameters
    ----------
    axes : (x, y, z)
        Coordinates of the points.
    points, cells : dict of str to ndarray, shape (n,) or (n, k)
        Arrays at points and in cells, x fastest.
    time : float
        The field ``TIME``; NaN if there is none.
    provenance : str
        The field ``PROVENANCE``: where the gas is from.
    """

    axes: Axes
    points: dict[str, Floats] = field(default_factory=dict)
    cells: dict[str, Floats] = field(default_factory=dict)
    time: float = math.nan
    provenance: str = ""


class _Scanner:
    """Lines and blocks of numbers of a file held in memory."""

    def __init__(self, path: str, data: bytes) -> None:
        self.path, self.data, self.at, self.binary = path, data, 0, False

    def fail(self, rule: str) -> InputError:
        return InputError(self.path, rule, self.data.count(b"\n", 0, self.at) or 1)

    def line(self) -> str:
        """The next line, "" at the end."""
        end = self.data.find(b"\n", self.at)
        end = len(self.data) if end < 0 else end
        text, self.at = self.data[self.at : end], end + 1
        return text.decode("latin-1").strip()

    def words(self) -> list[str]:
        """Words of the next line that is not blank; none at the end."""
        while self.at < len(self.data):
            if words := self.line().split():
                return words
        return []

    def whole(self, word: str) -> int:
        if not word.isdecimal() or int(word) > MOST_POINTS:
            raise self.fail(f"'{word[:20]}' must be a whole number from 0 to {MOST_POINTS:,}")
        return int(word)

    def numbers(self, count: int, kind: str) -> Floats:
        """The next block of numbers, as float64."""
        if kind not in TYPES:
            raise self.fail(f"unknown type '{kind[:20]}' of numbers")
        if self.binary:
            dtype = np.dtype(">" + TYPES[kind])
            if len(self.data) - self.at < count * dtype.itemsize:
                raise self.fail("the file ends inside an array")
            raw: NDArray[np.generic] = np.frombuffer(self.data, dtype, count, self.at)
            self.at += raw.nbytes
            return raw.astype(np.float64)
        found: list[str] = []
        while len(found) < count:
            if self.at >= len(self.data):
                raise self.fail("the file ends inside an array")
            found += self.line().split()
        if len(found) > count:
            raise self.fail(f"{len(found)} numbers where {count} must stand")
        try:
            return np.array(found, np.float64)
        except ValueError:
            raise self.fail("a word that is no number inside an array") from None


def read_legacy(path: str | Path) -> LegacyGrid:
    """Read a legacy VTK file with ``DATASET RECTILINEAR_GRID`` or ``STRUCTURED_POINTS``.

    Parameters
    ----------
    path : str or Path
        The file.
    """
    try:
        scan = _Scanner(str(path), Path(path).read_bytes())
    except OSError as error:
        raise InputError(path, f"cannot be read: {error.strerror or error}") from error
    if not scan.line().startswith("# vtk DataFile Version"):
        raise scan.fail("no legacy VTK file: the first line must be '# vtk DataFile Version 3.0'")
    scan.line()  # the title
    encoding = scan.line().upper()
    if encoding not in ("ASCII", "BINARY"):
        raise scan.fail("the third line must be ASCII or BINARY")
    scan.binary = encoding == "BINARY"
    dataset = scan.words()
    if dataset not in (["DATASET", "RECTILINEAR_GRID"], ["DATASET", "STRUCTURED_POINTS"]):
        raise scan.fail("must be DATASET RECTILINEAR_GRID or STRUCTURED_POINTS; clusterdem gas make resamples others")
    return _Body(scan).read()


class _Body:
    """What follows the line DATASET, in whatever order it comes."""

    def __init__(self, scan: _Scanner) -> None:
        self.scan = scan
        self.size: list[int] = []
        self.axes: dict[str, Floats] = {}
        self.uniform: dict[str, Floats] = {}
        self.time = math.nan
        self.provenance = ""
        self.arrays: dict[str, dict[str, Floats]] = {"POINT_DATA": {}, "CELL_DATA": {}}

    def read(self) -> LegacyGrid:
        here: dict[str, Floats] | None = None  # where the arrays belong that follow
        count, scan = 0, self.scan
        while words := scan.words():
            key = words[0].upper()
            if key in self.arrays and len(words) == 2:
                here, count = self.arrays[key], self._count(key, scan.whole(words[1]))
            elif key == "FIELD" and len(words) == 3:
                self._fields(scan.whole(words[2]), here, count)
            elif here is not None and key in COMPONENTS and len(words) == 3:
                here[unquote(words[1])] = self._array(count, COMPONENTS[key], words[2])
            elif here is not None and key == "SCALARS" and len(words) in (3, 4):
                self._scalars(here, count, words)
            elif here is not None and key == "LOOKUP_TABLE" and len(words) == 3:
                scan.numbers(4 * scan.whole(words[2]), "unsigned_char" if scan.binary else "float")
            else:
                self._geometry(key, words)
        if not any(self.arrays.values()):  # with one, DIMENSIONS are no larger than what the file holds
            raise scan.fail("has no array velocity, nor any other")
        return LegacyGrid(
            self._points(), self.arrays["POINT_DATA"], self.arrays["CELL_DATA"], self.time, self.provenance
        )

    def _geometry(self, key: str, words: list[str]) -> None:
        scan = self.scan
        if key == "DIMENSIONS" and len(words) == 4:
            self.size = [scan.whole(word) for word in words[1:]]
            if min(self.size) < 1 or math.prod(self.size) > MOST_POINTS:
                raise scan.fail(f"DIMENSIONS must be 1 or more, and not more than {MOST_POINTS:,} points in all")
        elif key in ("X_COORDINATES", "Y_COORDINATES", "Z_COORDINATES") and len(words) == 3:
            self.axes[key[0].lower()] = scan.numbers(scan.whole(words[1]), words[2])
        elif key in ("ORIGIN", "SPACING", "ASPECT_RATIO") and len(words) == 4:
            try:
                self.uniform["ORIGIN" if key == "ORIGIN" else "SPACING"] = np.array(words[1:], np.float64)
            except ValueError:
                raise scan.fail(f"{key} must be three numbers") from None
        elif key == "METADATA":  # names of components, information keys: up to a blank line
            while scan.at < len(scan.data) and scan.line():
                pass
        else:
            raise scan.fail(f"a line that begins with '{words[0][:20]}' cannot stand here")

    def _count(self, key: str, count: int) -> int:
        n = [max(k - (key == "CELL_DATA"), 1) for k in self.size]
        if not self.size or count != math.prod(n):
            raise self.scan.fail(f"{key} {count} does not fit DIMENSIONS {' '.join(map(str, self.size))}")
        return count

    def _array(self, count: int, components: int, kind: str) -> Floats:
        values = self.scan.numbers(count * components, kind)
        return values if components == 1 else values.reshape(count, components)

    def _scalars(self, here: dict[str, Floats], count: int, words: list[str]) -> None:
        before = self.scan.at
        if self.scan.words()[:1] != ["LOOKUP_TABLE"]:
            self.scan.at = before
        components = self.scan.whole(words[3]) if len(words) == 4 else 1
        here[unquote(words[1])] = self._array(count, components, words[2])

    def _fields(self, number: int, here: dict[str, Floats] | None, count: int) -> None:
        """A block of arrays, each with its own size: field data, or further arrays of the points."""
        for _ in range(number):
            words = self.scan.words()
            if words[:1] == ["METADATA"]:
                self._geometry("METADATA", words)
                words = self.scan.words()
            if len(words) != 4:
                raise self.scan.fail("an array of FIELD needs a line 'name components tuples type'")
            name, components, tuples = unquote(words[0]), self.scan.whole(words[1]), self.scan.whole(words[2])
            if here is not None and tuples != count:
                raise self.scan.fail(f"array {name} must have {count} tuples, one for each point or cell, not {tuples}")
            if words[3] in ("string", "bit", "variant"):
                raise self.scan.fail(f"array {name} of type {words[3]} cannot be read")
            values = self._array(tuples, components, words[3])
            if here is not None:
                here[name] = values
            elif name == "TIME" and values.size:
                self.time = float(values.flat[0])
            elif name == "PROVENANCE" and words[3] == "unsigned_char":
                self.provenance = values.astype(np.uint8).tobytes().decode("utf-8", errors="replace").strip()

    def _points(self) -> Axes:
        if not self.size:
            raise self.scan.fail("has no line DIMENSIONS")
        if self.uniform:
            origin, spacing = (self.uniform.get(k, np.full(3, d)) for k, d in (("ORIGIN", 0.0), ("SPACING", 1.0)))
            x, y, z = (
                float(o) + float(h) * np.arange(n, dtype=np.float64) for o, h, n in zip(origin, spacing, self.size)
            )
            return (x, y, z)
        for axis, n in zip("xyz", self.size):
            if axis not in self.axes or self.axes[axis].size != n:
                raise self.scan.fail(f"needs {axis.upper()}_COORDINATES with {n} numbers, as DIMENSIONS says")
        return (self.axes["x"], self.axes["y"], self.axes["z"])


def read_field(path: str | Path) -> GasField:
    """Read a gas field file; arrays of other names are passed over, as the engine does.

    Parameters
    ----------
    path : str or Path
        The file.
    """
    grid = read_legacy(path)
    shape = tuple(axis.size for axis in reversed(grid.axes))
    arrays = {}
    for name in NAMES:
        if name not in grid.points:
            continue
        values = grid.points[name]
        wanted = 3 if name in VECTORS else 1
        if values.size != math.prod(shape) * wanted:
            raise InputError(path, f"array {name} must have {wanted} component{'s' * (wanted > 1)} at each point")
        arrays[name] = np.moveaxis(values.reshape(*shape, wanted), (0, 1, 2), (2, 1, 0)).copy()
        if name not in VECTORS:
            arrays[name] = arrays[name][..., 0]
    if "velocity" not in arrays:
        found = ", ".join(grid.points) or "none"
        hint = "; cells have one: clusterdem gas make puts it at points" if "velocity" in grid.cells else ""
        raise InputError(path, f"has no array velocity at its points (arrays there: {found}){hint}")
    solid = None
    if "solid" in grid.points and grid.points["solid"].size == math.prod(shape):
        solid = np.moveaxis(grid.points["solid"].reshape(shape), (0, 1, 2), (2, 1, 0)) != 0
    return GasField(grid.axes, arrays, grid.time, str(path), solid, grid.provenance)


def write_field(path: str | Path, gas: GasField, ascii: bool = False) -> Path:
    """Write a gas field file.

    Parameters
    ----------
    path : str or Path
        The file.
    gas : GasField
        The field.
    ascii : bool
        Numbers as text (with all their digits) instead of binary.
    """
    blocks: list[tuple[str, NDArray[Any] | None]] = []
    beside: list[tuple[str, NDArray[Any] | None]] = []
    if not math.isnan(gas.time):
        beside += [("TIME 1 1 double\n", np.array([gas.time]))]
    if gas.provenance:
        # of bytes, not of type string, which the engine does not know; so the text stands in binary files as it is
        text = np.frombuffer(f"\n{gas.provenance}\n".encode(), np.uint8)
        beside += [(f"PROVENANCE {text.size} 1 unsigned_char\n", text)]
    if beside:
        blocks += [(f"FIELD FieldData {len(beside)}\n", None), *beside]
    blocks += [("DIMENSIONS {} {} {}\n".format(*gas.shape), None)]
    blocks += [(f"{a}_COORDINATES {axis.size} double\n", axis) for a, axis in zip("XYZ", gas.axes)]
    blocks += [(f"POINT_DATA {math.prod(gas.shape)}\n", None)]
    for name, values in gas.arrays.items():
        head = f"VECTORS {name} double\n" if name in VECTORS else f"SCALARS {name} double 1\nLOOKUP_TABLE default\n"
        blocks += [(head, np.moveaxis(values, (0, 1, 2), (2, 1, 0)))]
    if gas.solid is not None:
        solid = np.moveaxis(gas.solid.astype(np.uint8), (0, 1, 2), (2, 1, 0))
        blocks += [("SCALARS solid unsigned_char 1\nLOOKUP_TABLE default\n", solid)]
    with atomic(path) as name_to_write, open(name_to_write, "wb") as file:
        file.write(f"# vtk DataFile Version 3.0\n{TITLE}\n{'ASCII' if ascii else 'BINARY'}\n".encode())
        file.write(b"DATASET RECTILINEAR_GRID\n")
        for head, numbers in blocks:
            file.write(head.encode())
            if numbers is None:
                continue
            if ascii:
                file.write(("\n".join(map(repr, numbers.ravel().tolist())) + "\n").encode())
            else:
                kind = numbers.dtype if numbers.dtype == np.uint8 else ">f8"
                file.write(np.ascontiguousarray(numbers, kind).tobytes() + b"\n")
    return Path(path)
