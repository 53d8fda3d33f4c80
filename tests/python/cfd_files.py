"""Small CFD results in the formats that solvers write: an OpenFOAM case, a Fluent case; blocks of hexahedra."""

from __future__ import annotations

from pathlib import Path

import numpy as np

LENGTHS = (0.3, 0.1, 0.6)


class Block:
    """Equal hexahedra over a box; points, cells and faces numbered as solvers do."""

    def __init__(self, counts=(6, 2, 8), lengths=LENGTHS, origin=(0, 0, 0)):
        self.counts = counts
        axes = [o + np.linspace(0, length, n + 1) for o, length, n in zip(origin, lengths, counts)]
        self.points = _grid(axes)
        self.centres = _grid([(a[1:] + a[:-1]) / 2 for a in axes])
        self.inner, self.outer = self._faces()

    def point(self, i, j, k):
        nx, ny, _ = self.counts
        return i + (nx + 1) * (j + (ny + 1) * k)

    def cell(self, i, j, k):
        nx, ny, nz = self.counts
        return i + nx * (j + ny * k) if 0 <= i < nx and 0 <= j < ny and 0 <= k < nz else -1

    def _faces(self):
        """(corners, owner, neighbour) inside, sorted by owner and neighbour, and (corners, owner) at the walls."""
        inner, outer = [], []
        for axis in range(3):
            b, c = [(1, 2), (2, 0), (0, 1)][axis]
            for place in np.ndindex(*(n + (k == axis) for k, n in enumerate(self.counts))):
                at, before = list(place), list(place)
                before[axis] -= 1
                corners = []
                for db, dc in ((0, 0), (1, 0), (1, 1), (0, 1)):  # normal along +axis
                    corner = list(place)
                    corner[b] += db
                    corner[c] += dc
                    corners.append(self.point(*corner))
                low, high = self.cell(*before), self.cell(*at)
                if low >= 0 and high >= 0:
                    inner.append((corners, low, high))
                elif low >= 0:
                    outer.append((corners, low))
                else:
                    outer.append((corners[::-1], high))
        return sorted(inner, key=lambda f: f[1:]), sorted(outer, key=lambda f: f[1])


def _grid(axes):
    z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)


def _foam(name, kind, body):
    return f"FoamFile\n{{\n version 2.0;\n format ascii;\n class {kind};\n object {name};\n}}\n{body}\n"


def _list(rows):
    return f"{len(rows)}\n(\n" + "\n".join(rows) + "\n)\n"


def _words(values):
    return [f"({' '.join(repr(float(v)) for v in row)})" if np.ndim(row) else repr(float(row)) for row in values]


def write_openfoam(case: Path, block: Block, times: dict[float, dict[str, np.ndarray]]) -> Path:
    """An OpenFOAM case; ``times`` maps a time to its fields, values in cells."""
    mesh = case / "constant/polyMesh"
    mesh.mkdir(parents=True)
    (case / "system").mkdir()
    control = "application icoFoam; startTime 0; endTime 1; deltaT 0.1; writeFormat ascii;"
    (case / "system/controlDict").write_text(_foam("controlDict", "dictionary", control))
    faces = [f[0] for f in block.inner] + [f[0] for f in block.outer]
    owner = [f[1] for f in block.inner] + [f[1] for f in block.outer]
    (mesh / "points").write_text(_foam("points", "vectorField", _list(_words(block.points))))
    (mesh / "faces").write_text(_foam("faces", "faceList", _list([f"4({' '.join(map(str, f))})" for f in faces])))
    (mesh / "owner").write_text(_foam("owner", "labelList", _list([str(o) for o in owner])))
    neighbour = [str(f[2]) for f in block.inner]
    (mesh / "neighbour").write_text(_foam("neighbour", "labelList", _list(neighbour)))
    patch = f"1\n(\nwalls\n{{\n type wall;\n nFaces {len(block.outer)};\n startFace {len(block.inner)};\n}}\n)\n"
    (mesh / "boundary").write_text(_foam("boundary", "polyBoundaryMesh", patch))
    for time, fields in times.items():
        folder = case / f"{time:g}"
        folder.mkdir()
        for name, values in fields.items():
            kind = "vector" if values.ndim == 2 else "scalar"
            body = (
                "dimensions [0 0 0 0 0 0 0];\n"
                f"internalField nonuniform List<{kind}>\n{_list(_words(values))};\n"
                "boundaryField\n{\n walls\n {\n type zeroGradient;\n }\n}\n"
            )
            kind = kind.capitalize()
            (folder / name).write_text(_foam(name, f"vol{kind}Field", body))
    return case


def write_fluent(path: Path, block: Block, fields: dict[int, np.ndarray]) -> Path:
    """A Fluent case in text, ``path`` (.cas), and its data beside it; fields by number, 111 to 113 for u, v, w."""
    n, m, inner, outer = len(block.points), len(block.centres), block.inner, block.outer
    text = f'(0 "block")\n(2 3)\n(10 (0 1 {n:x} 0 3))\n(10 (1 1 {n:x} 1 3)(\n'
    text += "\n".join(" ".join(repr(float(v)) for v in point) for point in block.points) + "\n))\n"
    text += f"(12 (0 1 {m:x} 0 0))\n(12 (2 1 {m:x} 1 4))\n(13 (0 1 {len(inner) + len(outer):x} 0 0))\n"

    def faces(zone, kind, first, rows):
        lines = [" ".join(f"{v:x}" for v in row) for row in rows]
        return f"(13 ({zone:x} {first:x} {first + len(rows) - 1:x} {kind:x} 4)(\n" + "\n".join(lines) + "\n))\n"

    # Fluent counts from 1, and its normals point from the second cell to the first
    text += faces(3, 2, 1, [[*(p + 1 for p in c[::-1]), low + 1, high + 1] for c, low, high in inner])
    text += faces(4, 3, len(inner) + 1, [[*(p + 1 for p in c[::-1]), cell + 1, 0] for c, cell in outer])
    text += "(45 (2 fluid fluid)())\n(45 (3 interior default-interior)())\n(45 (4 wall wall)())\n"
    path.write_text(text)
    data = '(0 "block")\n'
    for number, values in fields.items():
        data += f"(300 ({number} 2 1 0 0 1 {m})\n(" + "\n".join(repr(float(v)) for v in values) + "\n))\n"
    path.with_suffix(".dat").write_text(data)
    return path


def write_fluent_channel(path: Path, counts=(6, 8), speed=5.0) -> Path:
    """A plane Fluent case: uniform flow along y through 0.3 × 0.6 m between walls, in at y = 0 and out at the other end."""
    nx, ny = counts
    points = [(x, y) for y in np.linspace(0, 0.6, ny + 1).tolist() for x in np.linspace(0, 0.3, nx + 1).tolist()]

    def point(i, j):
        return i + (nx + 1) * j + 1

    def cell(i, j):
        return i + nx * j + 1 if 0 <= i < nx and 0 <= j < ny else 0

    zones: dict[str, list] = {"interior": [], "walls": [], "in": [], "out": []}
    for j in range(ny):
        for i in range(nx + 1):
            zones["interior" if 0 < i < nx else "walls"].append(
                (point(i, j), point(i, j + 1), cell(i - 1, j), cell(i, j))
            )
    for j in range(ny + 1):
        for i in range(nx):
            name = "interior" if 0 < j < ny else "in" if j == 0 else "out"
            zones[name].append((point(i, j), point(i + 1, j), cell(i, j), cell(i, j - 1)))
    cells, faces = nx * ny, sum(map(len, zones.values()))
    text = f'(0 "channel")\n(2 2)\n(10 (0 1 {len(points):x} 0 2))\n(10 (1 1 {len(points):x} 1 2)(\n'
    text += "\n".join(f"{x!r} {y!r}" for x, y in points) + "\n))\n"
    text += f"(12 (0 1 {cells:x} 0 0))\n(12 (2 1 {cells:x} 1 3))\n(13 (0 1 {faces:x} 0 0))\n"
    first = 1
    for zone, (rows, kind) in enumerate(zip(zones.values(), (2, 3, 10, 5)), start=3):
        rows = [row if row[2] else (row[1], row[0], row[3], 0) for row in rows]  # the cell that is there comes first
        lines = "\n".join(" ".join(f"{v:x}" for v in row) for row in rows)
        text += f"(13 ({zone:x} {first:x} {first + len(rows) - 1:x} {kind:x} 2)(\n{lines}\n))\n"
        first += len(rows)
    text += "(45 (2 fluid fluid)())\n(45 (3 interior inside)())\n(45 (4 wall sides)())\n"
    path.write_text(text + "(45 (5 velocity-inlet in-by-the-wall)())\n(45 (6 pressure-outlet out)())\n")
    data = '(0 "channel")\n'
    for number, value in ((111, 0.0), (112, speed)):
        data += f"(300 ({number} 2 1 0 0 1 {cells})\n(" + "\n".join([repr(value)] * cells) + "\n))\n"
    path.with_suffix(".dat").write_text(data)
    return path


def linear(points):
    """A velocity that is linear in the place."""
    x, y, z = np.asarray(points).T
    return np.stack([1 + 2 * x - 3 * y + 0.5 * z, -1 + z + x, 2 * x + y - 4 * z + 3], axis=1)
