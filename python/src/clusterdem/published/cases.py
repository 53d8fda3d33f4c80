"""The numbers that a run is held against.

Sources: *paper* is X. Liu, L. Shi, X. Xu, "Study on non-uniformity of particle distribution using cluster discrete
element method" (Proceedings of the CSEE, 2007), sections 3.2 to 3.4; *row A* and the others are *prototype runs*: an
independent program for the same model, each row one reading of what the paper leaves open, with the span over seeds.
Cell fractions are on the paper's scale, ten times the true ones.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

Span = tuple[float, float]


def one(value: float) -> Span:
    """A single number as a span."""
    return (value, value)


@dataclass(frozen=True)
class Row:
    """One source's numbers for one case; what a source does not give is absent.

    Parameters
    ----------
    name : str
        ``paper``, or ``row A`` and so on.
    count : mapping of float to (low, high)
        Clusters by time (s).
    classes : tuple of (low, high)
        Percent of clusters <300, 300–600, 600–900, >900 µm at the end.
    mean : (low, high)
        Mean diameter by number at the end (m).
    fraction : mapping of float to (low, high)
        Largest cell fraction on a 30 x 30 grid by time, on the paper's scale.
    strips : tuple of float
        Mean diameter (m) in six equal strips from centre to wall at the end.
    """

    name: str
    count: Mapping[float, Span] = field(default_factory=dict)
    classes: tuple[Span, ...] = ()
    mean: Span | None = None
    fraction: Mapping[float, Span] = field(default_factory=dict)
    strips: tuple[float, ...] = ()


@dataclass(frozen=True)
class Case:
    """A case of the paper: its title, what the paper says in words, and the rows.

    Parameters
    ----------
    title : str
        What the case is.
    rows : tuple of Row
        The paper first, then row A.
    statement : str
        What the paper says besides the numbers.
    particles : int
        Primary particles.
    bounds : mapping of int to (str, float)
        What the statement bounds: mean diameter (m) at the end in a strip, 0 at the centre to 5 at the wall, as
        ``below`` or ``above`` with its limit.
    """

    title: str
    rows: tuple[Row, ...]
    statement: str
    particles: int
    bounds: Mapping[int, tuple[str, float]] = field(default_factory=dict)


END = 0.05
"""The end of every case (s)."""

SCALE = 10.0
"""The paper's printed fractions over the true ones: it counts as if the slab were 0.3 mm thick."""

CLASS_BORDERS = (300e-6, 600e-6, 900e-6)
"""Borders of the paper's size classes (m)."""

CELL = (0.01, 0.02)
"""Width and height of the cells of the paper's 30 x 30 grid (m)."""

D_P, RHO_P = 1e-4, 2000.0
"""Diameter (m) and density (kg/m³) of the primary particles, the paper's table 1."""

DIAMETER_RANGE = (181.7e-6, 1587.4e-6)
"""Smallest and largest diameters that the paper gives in every case (m)."""

CASES: dict[str, Case] = {
    "case1": Case(
        "uniform gas, 2 m/s, 2.0 million particles",
        (
            Row(
                "paper",
                {0.01: one(5638), 0.02: one(9437), 0.05: one(62524)},
                (one(30.35), one(66.78), one(1.50), one(1.37)),
                one(356e-6),
                {0.0: one(0.055), 0.02: one(0.045), 0.05: one(0.040)},
            ),
            Row(
                "row A",
                {0.01: (8822, 9017), 0.02: (16208, 16403), 0.03: (27758, 28547), 0.05: (65570, 65786)},
                ((19.3, 20.1), (77.7, 78.4), (1.9, 2.0), (0.2, 0.3)),
                (368e-6, 370e-6),
                {0.0: one(0.049), 0.02: (0.043, 0.047), 0.05: (0.042, 0.051)},
            ),
            Row(
                "row B",
                {0.01: one(6762), 0.02: one(12468), 0.03: one(23466), 0.05: one(72743)},
                (one(34.3), one(63.4), one(1.9), one(0.5)),
                one(349e-6),
                {0.0: one(0.049), 0.02: one(0.046), 0.05: one(0.043)},
            ),
            Row(
                "row E",
                {0.01: (6707, 7062), 0.02: (11205, 12469), 0.03: (18777, 19943), 0.05: (39261, 40019)},
                (one(50), one(41), one(1.1), one(8.1)),
                one(364e-6),
                {0.0: one(0.049), 0.05: one(0.051)},
            ),
        ),
        "Locally dense, but evenly so over the whole field; nearly steady after 0.05 s.",
        2_000_000,
    ),
    "case2": Case(
        "uniform gas, 5 m/s, 3.1 million particles",
        (
            Row(
                "paper",
                {0.01: one(14135), 0.03: one(72675), 0.05: one(59375)},
                (one(12.71), one(85.62), one(1.47), one(0.20)),
                one(437.2e-6),
                {0.0: one(0.080), 0.05: one(0.060)},
            ),
            Row(
                "row A",
                {0.01: (8510, 9024), 0.02: (13244, 13434), 0.03: (22486, 23335), 0.05: (55549, 57684)},
                ((6.2, 6.4), (85.4, 86.4), (6.5, 7.8), (0.6, 0.7)),
                (451e-6, 456e-6),
                {0.0: (0.063, 0.066), 0.02: (0.061, 0.066), 0.05: (0.058, 0.065)},
            ),
            Row(
                "row C",
                {0.01: one(12178), 0.02: one(21031), 0.03: one(33055), 0.05: one(59788)},
                (one(7.5), one(83.6), one(8.1), one(0.9)),
                one(435e-6),
                {0.0: one(0.066), 0.02: one(0.065), 0.05: one(0.085)},
            ),
            Row(
                "row E",
                {0.01: (15257, 17062), 0.02: (31015, 34617), 0.03: (47525, 49120), 0.05: (61085, 61366)},
                (one(11), one(83), one(3.7), one(2.7)),
                one(425e-6),
                {0.0: one(0.064), 0.05: one(0.08)},
            ),
        ),
        "Locally dense, but evenly so over the whole field; the number of clusters peaks at 0.03 s, then falls.",
        3_100_000,
    ),
    "case3": Case(
        "gas fast in the centre and falling at the walls, mean 5 m/s, 3.1 million particles",
        (
            Row("paper", {0.05: one(32453)}),
            Row(
                "row A",
                {0.01: (11925, 12334), 0.02: (19716, 20635), 0.03: (32754, 38426), 0.05: (76938, 77446)},
                ((28, 30), (64, 66), one(3.2), one(2.7)),
                (375e-6, 378e-6),
                {0.0: (0.063, 0.066), 0.02: (0.063, 0.067), 0.05: (0.064, 0.065)},
                (324e-6, 343e-6, 373e-6, 452e-6, 618e-6, 933e-6),
            ),
        ),
        "The walls grow dense and the centre dilute; clusters below 300 µm in the centre, mostly above 600 µm at the walls.",
        3_100_000,
        {0: ("below", 300e-6), 5: ("above", 600e-6)},
    ),
}
"""The three cases by name."""


def case_of(name: str) -> str | None:
    """The case that a run is, by what its files' names begin with; None if it is none."""
    return name if name in CASES else None


def solids_of(case: str) -> float:
    """Mass of the primary particles of a case (kg)."""
    return CASES[case].particles * math.pi / 6 * D_P**3 * RHO_P
