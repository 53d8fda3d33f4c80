"""Which frame belongs to a time: the nearest, within a tolerance, the same rule wherever frames are matched."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .frame import Floats

TOLERANCE = 0.01
"""Share of the time asked for, or of the interval between frames where that is more, within which a frame counts."""


def tolerance_at(times: Floats | Sequence[float], wanted: float) -> float:
    """How far a frame may be from a time (s)."""
    gaps = np.diff(np.sort(np.asarray(times, float)))
    interval = float(np.median(gaps)) if len(gaps) else 0.0
    return TOLERANCE * max(abs(wanted), interval)


def same_times(mine: Floats | Sequence[float], theirs: Floats | Sequence[float]) -> bool:
    """Whether two runs have the same frames: as many, each nearest to its own counterpart.

    Examples
    --------
    >>> same_times([0.01, 0.02], [0.01001, 0.02001]), same_times([0.01, 0.02], [0.01, 0.03])
    (True, False)
    """
    return len(mine) == len(theirs) and all(nearest(mine, time) == number for number, time in enumerate(theirs))


def nearest(times: Floats | Sequence[float], wanted: float) -> int | None:
    """Number of the frame at a time.

    Parameters
    ----------
    times : sequence of float
        Times of the frames (s).
    wanted : float
        The time (s).

    Returns
    -------
    int or None
        The nearest frame; None if it is farther than :data:`TOLERANCE` allows, or there is none with a time.

    Examples
    --------
    >>> nearest([0.0, 0.00995, 0.02], 0.01), nearest([0.0, 0.01, 0.02], 0.03)
    (1, None)
    """
    distance = np.abs(np.asarray(times, float) - wanted)
    if not len(distance) or np.isnan(distance).all():
        return None
    number = int(np.nanargmin(distance))
    return number if distance[number] <= tolerance_at(times, wanted) * (1 + 1e-9) else None
