"""Velocities of the clusters of a frame: means, variances, granular temperature."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import ArgumentError, InputError
from ..frame import Floats, Frame


@dataclass(frozen=True)
class Moments:
    """Moments of the velocities of one frame.

    Parameters
    ----------
    mean : ndarray, shape (D,)
        Mean along each axis (m/s); NaN without clusters.
    variance : ndarray, shape (D,)
        Variance along each about that mean (m²/s²); NaN of fewer than two clusters.
    temperature : float
        Granular temperature, the mean of the variances (m²/s²).
    """

    mean: Floats
    variance: Floats
    temperature: float


def velocity_moments(frame: Frame, axes: str = "xz", by: str = "number") -> Moments:
    """Mean, variance and granular temperature of all clusters of a frame.

    Parameters
    ----------
    frame : Frame
        The clusters.
    axes : str
        The D axes that count, such as ``xz`` for a flat box or ``xyz``.
    by : {"number", "mass"}
        What a cluster counts: 1, or its mass.

    Returns
    -------
    Moments

    Raises
    ------
    ArgumentError
        If an axis is none or stands twice, or ``by`` is another word.
    InputError
        If the frame holds no such velocity.

    Notes
    -----
    Variances are those of the population that the N clusters are a sample of: by number Σ (v − <v>)² / (N − 1), by masses
    Σ m (v − <v>)² / (M − Σ m² / M) with M = Σ m, which of equal masses is the same. The mean is that of the whole frame, so that
    mean motion that differs from place to place counts as temperature; :func:`clusterdem.maps_of` takes the cell's own.

    Examples
    --------
    >>> from clusterdem import Box
    >>> columns = {"x": [0.1, 0.2], "z": [0.1, 0.2], "mass": [1.0, 3.0], "diameter": [0.1, 0.1], "vx": [1.0, 3.0], "vz": [0.0, 0.0]}
    >>> frame = Frame(0, 0.0, Box((0, 0, 0), (1, 1, 1)), {k: np.array(v) for k, v in columns.items()})
    >>> velocity_moments(frame).temperature, velocity_moments(frame, "x", "mass").mean.tolist()
    (1.0, [2.5])
    """
    velocities = np.stack([velocity_of(frame, axis) for axis in check_axes(axes)])
    if by not in ("number", "mass"):
        raise ArgumentError("by", f"must be number or mass, not {by}")
    weight = np.ones(len(frame)) if by == "number" else frame.mass
    total = float(weight.sum())
    if not total > 0:
        unknown = np.full(len(axes), np.nan)
        return Moments(unknown, unknown, float("nan"))
    mean = velocities @ weight / total
    free = total - float((weight**2).sum()) / total
    squares = (velocities - mean[:, None]) ** 2 @ weight
    variance = squares / free if len(frame) > 1 else np.full(len(axes), np.nan)
    return Moments(mean, variance, float(variance.mean()))


def check_axes(axes: str) -> str:
    """Refuse what are no axes."""
    if not axes or not set(axes) <= set("xyz") or len(set(axes)) != len(axes):
        raise ArgumentError("axes", f"must be some of x, y, z, each once, such as xz, not {axes}")
    return axes


def velocity_of(frame: Frame, axis: str) -> Floats:
    """Velocity along an axis (m/s), shape (N,)."""
    if f"v{axis}" not in frame:
        raise InputError(frame.path or "frame", f"no column v{axis}", frame.line)
    return frame[f"v{axis}"]
