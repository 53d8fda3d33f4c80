"""ParaView's lists of files with their times: ``NAME.vtk.series`` and its kin."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..errors import InputError
from .meshes import read_meshes, wished
from .openfoam import Times
from .sources import Source


def read_series(path: Path, times: Times) -> Iterator[Source]:
    """Each file of a list, in the order of their times.

    Format: JSON, ``{"files": [{"name": "gas_1.vtk", "time": 0.5}, …]}``, names as seen from the list's folder.
    """
    try:
        files = json.loads(path.read_text(encoding="utf-8-sig"))["files"]
        of_time = {float(file["time"]): path.parent / str(file["name"]) for file in files}
    except OSError as error:
        raise InputError(path, f"cannot be read: {error.strerror or error}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(path, 'must be JSON with "files", each with its "name" and "time"') from error
    if not of_time or not all(map(math.isfinite, of_time)):
        raise InputError(path, 'must have "files", each with a finite "time"')
    for time in wished(path, np.array(sorted(of_time)), times):
        if not of_time[time].exists():
            raise InputError(path, f"names {of_time[time].name}, which does not exist")
        for source in read_meshes(of_time[time], ""):
            source.time = time
            yield source
