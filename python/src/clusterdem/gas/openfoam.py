"""OpenFOAM cases: which times there are and where, what a patch is, what holds at it."""

from __future__ import annotations

import math
import re
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Literal

from ..errors import InputError
from .foam_dictionary import Entries, boundary_field, foam_file, of_patch, patch_kinds, read_bytes, read_entries

Times = Sequence[float] | Literal["", "latest", "all"]
"""Times that are asked for (s, or iterations of a steady solver); "" for what suits the case."""

COLLATED = re.compile(r"processors(\d+)(?:_(\d+)-(\d+))?")
BLOCK = re.compile(rb"\s*(?://[^\n]*\n\s*)*(\d+)\s*\(")
SLIDING = ("slip", "symmetry", "symmetryPlane", "basicSymmetry")
"""Conditions and patches at which a velocity keeps its part along the face."""
STEADY_SOLVERS = ("simple", "potential", "laplacianFoam")


@dataclass(frozen=True)
class Layout:
    """Where a case keeps its times: in its own folder, in ``processorN``, or collated in ``processorsN``.

    Parameters
    ----------
    kind : {"whole", "processors", "collated"}
        Which of them.
    folders : sequence of Path
        Where the times lie.
    times : mapping of float to str
        Each time (s) and its folder's name.
    """

    kind: str
    folders: Sequence[Path]
    times: dict[float, str]

    @property
    def latest(self) -> float:
        """The last time (s); −inf if there is none."""
        return max(self.times, default=-math.inf)


def _times(folder: Path) -> dict[float, str]:
    found = {}
    for path in folder.iterdir() if folder.is_dir() else ():
        if re.fullmatch(r"\d+(\.\d*)?([eE][+-]?\d+)?", path.name) and path.is_dir():
            if any(child.is_file() for child in path.iterdir()):  # uniform/ alone is no result
                found[float(path.name)] = path.name
    return found


def _common(folders: Sequence[Path]) -> dict[float, str]:
    """Times that all ranks have written: a run that was ended while it wrote has a last one that some lack."""
    times = [_times(folder) for folder in folders]
    return {time: name for time, name in times[0].items() if all(time in other for other in times[1:])}


@dataclass(frozen=True)
class FoamCase:
    """A case's folder.

    Parameters
    ----------
    path : Path
        The folder with ``system/controlDict``.
    """

    path: Path

    def __post_init__(self) -> None:
        if not (self.path / "system" / "controlDict").is_file():
            raise InputError(self.path, "no OpenFOAM case: system/controlDict is missing")

    @cached_property
    def layouts(self) -> list[Layout]:
        """Every place with times and a mesh; the case's own folder first."""
        found = []
        if (self.path / "constant" / "polyMesh").is_dir():
            found.append(Layout("whole", [self.path], _times(self.path)))
        single = sorted(self.path.glob("processor[0-9]*"), key=lambda p: int(re.sub(r"\D", "", p.name) or 0))
        single = [folder for folder in single if re.fullmatch(r"processor\d+", folder.name)]
        if single:
            found.append(Layout("processors", single, _common(single)))
        groups: dict[str, list[Path]] = {}
        for folder in sorted(self.path.glob("processors*")):
            if match := COLLATED.fullmatch(folder.name):
                groups.setdefault(match.group(1), []).append(folder)
        for folders in groups.values():
            found.append(Layout("collated", folders, _common(folders)))
        found = [layout for layout in found if layout.times]
        if not found:
            if regions := [path.parent.name for path in sorted(self.path.glob("constant/*/polyMesh"))]:
                rule = f"has meshes of regions ({', '.join(regions)}), which are not read: foamToVTK -case {self.path} -latestTime"
                raise InputError(self.path, f"{rule} -region {regions[0]}, then its .vtm.series")
            raise InputError(self.path, f"has no mesh or no time in it: blockMesh -case {self.path}, then its solver")
        return found

    @cached_property
    def steady(self) -> bool:
        """Whether its times are iterations: ``ddtSchemes`` of ``system/fvSchemes``, else the solver's name."""
        schemes = self.path / "system" / "fvSchemes"
        if schemes.is_file():
            found = read_entries(schemes).get("ddtSchemes", {})
            schemes_of = found.values() if isinstance(found, dict) else ()
            values = [v.split()[-1] for v in schemes_of if isinstance(v, str) and v.split()]
            values = [v for v in values if v != "none"]
            if values:
                return all(v in ("steadyState", "localEuler", "SLTS") for v in values)
        application = read_entries(self.path / "system" / "controlDict").get("application", "")
        return isinstance(application, str) and any(word in application.lower() for word in STEADY_SOLVERS)

    def select(self, times: Times) -> tuple[Layout, list[float]]:
        """Where to read, and which times; without a wish the latest of a steady case, all but 0 of others."""
        newest = max(self.layouts, key=lambda layout: layout.latest)  # the first of equals: the whole case
        if isinstance(times, str):
            have = sorted(newest.times)
            if times == "all":
                return newest, have
            if have[-1] == 0:
                raise InputError(
                    self.path,
                    "holds no time but 0, the start of the run: run its solver, or say --time 0 to take the start",
                )
            latest = times == "latest" or self.steady
            return newest, have[-1:] if latest else [time for time in have if time != 0]
        for layout in (newest, *self.layouts):
            found = [_nearest(layout.times, time) for time in times]
            if None not in found:
                return layout, [time for time in found if time is not None]
        missing = next(time for time in times if _nearest(newest.times, time) is None)
        unit = "" if self.steady else " s"
        listed = ", ".join(f"{t:.9g}" for t in sorted(newest.times)[:20])
        raise InputError(
            self.path, f"has no time {missing:.9g}{unit}; it has {listed}{' …' * (len(newest.times) > 20)}"
        )

    @contextmanager
    def readable(self, layout: Layout, times: Sequence[float]) -> Iterator[Path]:
        """The folder that VTK can read those times from: the case, or a copy with its collated files taken apart."""
        if layout.kind != "collated":
            yield self.path
            return
        with tempfile.TemporaryDirectory(prefix="clusterdem-") as folder:
            copy = Path(folder)
            shutil.copytree(self.path / "system", copy / "system")
            for collated in layout.folders:
                for name in ("constant", *(layout.times[time] for time in times)):
                    for path in sorted((collated / name).rglob("*")):
                        if path.is_file() and (name != "constant" or "polyMesh" in path.parts):
                            _take_apart(path, collated, copy)
            yield copy


def _nearest(times: dict[float, str], wanted: float) -> float | None:
    best = min(times, key=lambda time: abs(time - wanted))
    return best if math.isclose(best, wanted, rel_tol=1e-6, abs_tol=1e-12) else None


def _take_apart(path: Path, collated: Path, copy: Path) -> None:
    """A collated file, which holds one file per rank, as these files."""
    data = read_bytes(path)
    match = COLLATED.fullmatch(collated.name)
    assert match
    first = int(match.group(2) or 0)
    ranks = int(match.group(3)) - first + 1 if match.group(3) else int(match.group(1))
    name = path.relative_to(collated).with_name(path.name.removesuffix(".gz"))
    if b"decomposedBlockData" not in data[:2000]:  # written by one rank for all
        blocks = [data] * ranks
    else:
        blocks = _blocks(path, data)
        if len(blocks) != ranks:
            raise InputError(path, f"holds the files of {len(blocks)} ranks, not of {ranks}, as its folder's name says")
        head = re.match(rb".*?FoamFile\s*\{[^}]*\}", blocks[0], re.DOTALL)
        if head:  # the first one's header is for all
            blocks = [
                b if k == 0 or b"FoamFile" in b[:2000] else head.group() + b"\n" + b for k, b in enumerate(blocks)
            ]
    for k, block in enumerate(blocks):
        target = copy / f"processor{first + k}" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(block)


def _blocks(path: Path, data: bytes) -> list[bytes]:
    head = re.match(rb".*?FoamFile\s*\{[^}]*\}", data, re.DOTALL)
    found: list[bytes] = []
    at = head.end() if head else 0
    while match := BLOCK.match(data, at):
        end = match.end() + int(match.group(1))
        if data[end : end + 1] != b")":
            raise InputError(
                path, f"rank {len(found)}'s part is cut short: it declares {match.group(1).decode()} bytes"
            )
        found.append(data[match.end() : end])
        at = end + 1
    return found


@dataclass(frozen=True)
class Conditions:
    """What holds at the patches of one time.

    Parameters
    ----------
    folder : Path
        A folder with ``constant/polyMesh/boundary`` and times: a case, or one of its processors.
    time : str
        The time's folder.
    """

    folder: Path
    time: str
    _read: dict[str, Entries] = field(default_factory=dict)

    @cached_property
    def kinds(self) -> dict[str, tuple[str, tuple[str, ...]]]:
        """Each patch's type and groups."""
        path = foam_file(self.folder / "constant" / "polyMesh", "boundary")
        return patch_kinds(path) if path else {}

    def at(self, array: str, patch: str) -> str:
        """How an array goes on to a patch: "value" (the file has it), "slide" (its part along the face), "open"."""
        kind, groups = self.kinds.get(patch, ("patch", ()))
        if kind == "empty":
            return "open"
        if kind in SLIDING:
            return "slide"
        if array not in self._read:
            path = foam_file(self.folder / self.time, array)
            self._read[array] = boundary_field(path) if path else {}
        found = of_patch(self._read[array], patch, groups)
        condition = found.get("type", "")
        if condition in SLIDING:
            return "slide"
        return "value" if condition == "noSlip" or "value" in found else "open"
