"""Options that several parts of ``clusterdem gas`` share."""

from __future__ import annotations

import argparse
import glob
import re
import sys
from collections.abc import Sequence
from pathlib import Path

from ...errors import InputError
from ...frame import Box
from ...gas.checks import Finding
from ...gas.legacy import TITLE
from ...io.header import read_header
from ...io.streams import open_lines


def add_box(parser: argparse.ArgumentParser, help: str) -> None:
    """A box by hand, and where it repeats."""
    parser.add_argument(
        "--box",
        type=float,
        nargs="+",
        metavar="LENGTH",
        help=f"x0 x1 [y0 y1] z0 z1 (m; small negative numbers as -0.0001): {help}",
    )
    parser.add_argument(
        "--periodic", default="", metavar="AXES", help="axes along which the box repeats, such as xz (default none)"
    )


def checked_box(options: argparse.Namespace) -> list[float] | None:
    """The box of the options, in ascending pairs."""
    if set(options.periodic) - set("xyz"):
        raise InputError("--periodic", f"must be letters among x, y, z, not {options.periodic}")
    if options.box is None:
        return None
    numbers = [float(v) for v in options.box]
    if len(numbers) not in (4, 6):
        raise InputError("--box", f"needs 4 or 6 lengths (x0 x1 [y0 y1] z0 z1), not {len(numbers)}")
    for low, high in zip(numbers[::2], numbers[1::2]):
        if not low < high:
            raise InputError("--box", f"needs each lower bound below its upper one, not {low:g} and {high:g}")
    return numbers


def box_of(numbers: Sequence[float], periodic: str) -> Box:
    """A box of 4 or 6 lengths; y of no matter where it is not given."""
    x0, x1, y0, y1, z0, z1 = numbers if len(numbers) == 6 else (*numbers[:2], 0.0, 0.0, *numbers[2:])
    return Box((x0, y0, z0), (x1, y1, z1), ("x" in periodic, "y" in periodic or len(numbers) == 4, "z" in periodic))


def box_of_dump(path: Path) -> Box:
    """The box of the first frame of a dump."""
    with open_lines(path) as source:
        header = read_header(source)
    if header is None:
        raise InputError(path, "holds no frame")
    return header.box


FRAME = re.compile(r"\.\d{4,}$")


def remove_old_frames(path: Path) -> int:
    """Remove the frames that an earlier series left beside ``path``, so that ``field gas.*.vtk`` finds one series.

    Files that this program did not write stay.
    """
    count = 0
    for old in sorted(path.parent.glob(f"{glob.escape(path.stem)}.*{path.suffix}")):
        if not FRAME.fullmatch(old.stem[len(path.stem) :]):
            continue
        with open(old, "rb") as file:
            ours = file.read(200).splitlines()[1:2] == [TITLE.encode()]
        if ours:
            old.unlink()
            count += 1
    return count


def numbered(path: Path, number: int) -> Path:
    """Of ``gas.vtk`` ``gas.0003.vtk``."""
    return path.with_name(f"{path.stem}.{number:04d}{path.suffix}")


def warn(findings: Sequence[Finding]) -> None:
    """Print warnings and notes to stderr, one line for each kind."""
    mild = [finding for finding in findings if finding.level != "error"]
    kinds = dict.fromkeys(finding.kind or str(finding) for finding in mild)
    for kind in kinds:
        same = [finding for finding in mild if (finding.kind or str(finding)) == kind]
        more = f" (and {len(same) - 1} more files)" if len(same) > 1 else ""
        print(f"{same[0]}{more}", file=sys.stderr)
