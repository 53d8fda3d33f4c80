"""What runs are compared by: of every frame after the start, one row of numbers per observable."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ...frame import Floats, Frame
from ...observables import How, find

DEFAULT = (
    "clusters",
    "mean_diameter",
    "sauter_diameter",
    "size_classes",
    "map",
    "dispersion",
    "lateral_fraction",
    "strip_diameter",
)
"""Observables of a study that names none."""


@dataclass(frozen=True)
class Observed:
    """A run's observables.

    Parameters
    ----------
    times : ndarray, shape (F,)
        Times of its frames after the start (s).
    values : dict of str to ndarray, shape (F, M)
        Numbers by observable; M differs between observables.
    """

    times: Floats
    values: dict[str, Floats]


def observe(frames: Sequence[Frame], names: Sequence[str], how: How) -> Observed:
    """Measure a run.

    Parameters
    ----------
    frames : sequence of Frame
        Its frames; the first is the start, which settings have in common, and is left out.
    names : sequence of str
        Names in the registry :mod:`clusterdem.observables`.
    how : How
        Cells and size classes.

    Raises
    ------
    InputError
        If there is no frame after the start.
    """
    later = frames[1:]
    if not later:
        raise InputError(frames[0].path if frames else "run", "holds no frame after the start")
    values = {name: np.stack([find(name)(frame, how) for frame in later]) for name in names}
    return Observed(np.array([frame.time for frame in later]), values)
