"""What must be conserved, and what must not: totals of each frame against what was fed and what left."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..frame import Floats, Frame

FULL = 17
"""Significant digits that give a float64 back."""

SAMPLE = 1000


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
        Mass (kg); ``digits`` are those with which single masses are printed.
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
    digits: int = FULL


@dataclass(frozen=True)
class Flow:
    """Primary particles that a run fed and that left it, up to some step."""

    fed: int
    left: int


def totals_of(frame: Frame) -> Totals:
    """Totals of a frame."""
    particles = int(np.rint(frame["n"]).sum()) if "n" in frame else None
    if "vx" in frame and "vz" in frame:
        px, pz = (float((frame.mass * frame[v]).sum()) for v in ("vx", "vz"))
        squares = sum(frame[v] ** 2 for v in ("vx", "vy", "vz") if v in frame)
        kinetic = float((frame.mass * squares).sum() / 2)
    else:
        px = pz = kinetic = float("nan")
    return Totals(len(frame), particles, float(frame.mass.sum()), px, pz, kinetic, printed_digits(frame.mass))


def printed_digits(values: Floats) -> int:
    """Significant digits with which numbers are printed: the fewest that give all (of the first 1000) back.

    Examples
    --------
    >>> printed_digits(np.array([1.25e-6, 3.14159e-6])), printed_digits(np.array([1 / 3]))
    (6, 16)
    """
    sample = values[:SAMPLE].tolist()
    return next((d for d in range(1, FULL) if all(float(f"{v:.{d}g}") == v for v in sample)), FULL)


def statements(totals: Sequence[Totals], flows: Sequence[Flow | None] = ()) -> list[str]:
    """Whether particles and mass stayed, in words.

    Whole particles are judged exactly, and the mass with them. Masses without a column n are judged by their printed
    digits: each may be off by half a unit of its last one.

    Parameters
    ----------
    totals : sequence of Totals
        Of the frames.
    flows : sequence of Flow or None, optional
        What had been fed and had left by then, where the run's table tells.
    """
    counts = [t.particles for t in totals if t.particles is not None]
    if len(counts) == len(totals):
        return [judge_particles(counts, flows), "Mass: goes with the particles, which are whole numbers."]
    said = ["Primary particles: the dump has no column n."]
    first, last = totals[0].mass, totals[-1].mass
    lowest, highest = min(t.mass for t in totals), max(t.mass for t in totals)
    digits = min(t.digits for t in totals)
    if any(flow is not None and (flow.fed or flow.left) for flow in flows):
        said.append(f"Mass: from {first:.6g} to {last:.6g} kg; clusters were fed or left, so that it is not judged.")
    elif highest - lowest <= 10.0 ** (1 - digits) * highest:
        said.append(
            f"Mass: {last:.{min(digits, 9)}g} kg throughout, to the {digits} digits of single masses (conserved)."
        )
    else:
        said.append(
            f"Mass: from {lowest:.6g} to {highest:.6g} kg, more than the {digits} digits of single masses round "
            "(NOT conserved, unless clusters were fed or left)."
        )
    return said


def judge_particles(counts: Sequence[int], flows: Sequence[Flow | None] = ()) -> str:
    """Whether the number of primary particles is what was there at first, plus what was fed, less what left."""
    known = [flow for flow in flows if flow is not None]
    low, high = min(counts), max(counts)
    if len(known) < len(counts) or not any(flow.fed or flow.left for flow in known):
        if low == high:
            return f"Primary particles: {low:,} in every frame (conserved exactly)."
        why = "NOT conserved" if len(known) == len(counts) else "NOT conserved, unless clusters were fed or left"
        return f"Primary particles: from {low:,} to {high:,} ({why})."
    own = {count - flow.fed + flow.left for count, flow in zip(counts, known)}
    text = f"Primary particles: {counts[0]:,} at first, {known[-1].fed:,} fed, {known[-1].left:,} left, {counts[-1]:,} at last"
    if len(own) == 1:
        return f"{text} (conserved exactly)."
    return f"{text} (NOT conserved: off by up to {max(own) - min(own):,})."
