"""What must be conserved, and what must not: totals of each frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..frame import Frame


@dataclass(frozen=True)
class Totals:
    """Totals of one frame.

    Parameters
    ----------
    clusters : int
        Clusters.
    particles : int or None
        Primary particles, where the dump has a column n.
    mass : float
        Mass (kg).
    momentum_x, momentum_z : float
        Momentum (kg m/s), NaN where velocities are unknown; gas and gravity change it.
    kinetic : float
        Kinetic energy (J), NaN where velocities are unknown.
    """

    clusters: int
    particles: int | None
    mass: float
    momentum_x: float
    momentum_z: float
    kinetic: float


def totals_of(frame: Frame) -> Totals:
    """Totals of a frame."""
    particles = int(np.rint(frame["n"]).sum()) if "n" in frame else None
    if "vx" in frame and "vz" in frame:
        px, pz = (float((frame.mass * frame[v]).sum()) for v in ("vx", "vz"))
        squares = sum(frame[v] ** 2 for v in ("vx", "vy", "vz") if v in frame)
        kinetic = float((frame.mass * squares).sum() / 2)
    else:
        px = pz = kinetic = float("nan")
    return Totals(len(frame), particles, float(frame.mass.sum()), px, pz, kinetic)


def statements(totals: Sequence[Totals]) -> list[str]:
    """Whether mass and particles stayed, in words."""
    mass = max(abs(t.mass / totals[0].mass - 1) for t in totals)
    said = [
        f"Mass: largest change {mass:.1e} of the first frame's ({'conserved' if mass < 1e-9 else 'NOT conserved'})."
    ]
    counts = {t.particles for t in totals if t.particles is not None}
    if len(counts) == 1:
        said.append(f"Primary particles: {counts.pop():,} in every frame (conserved exactly).")
    elif counts:
        said.append(f"Primary particles: from {min(counts):,} to {max(counts):,} (NOT conserved).")
    else:
        said.append("Primary particles: the dump has no column n.")
    return said
