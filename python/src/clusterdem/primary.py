"""The primary particles that clusters are made of: what turns masses into volumes of solids.

A fraction of solids needs their volume. Where it comes from, the first that is there: a density that is given; the run's
own log, beside the dump; the columns n, mass and diameter of the dump; at last :data:`ASSUMED`, which is refused where a
cluster's mass over its volume exceeds it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .errors import ArgumentError

Floats = NDArray[np.float64]

ASSUMED = 2000.0
"""Density (kg/m³) where nothing tells another: that of the paper's particles."""

LIGHTEST, HEAVIEST = 1e-3, 1e6
"""What a density may be (kg/m³): an aerogel's grain to more than any metal."""

VOIDAGE = 0.5
"""Between the particles of a cluster, as ``fix cluster/breakmerge`` has it by default."""

SLACK = 1e-3
"""Numbers of a dump are printed with six digits or more: relations between them hold to this share."""

MOST_KINDS = 8


@dataclass(frozen=True)
class Kind:
    """One kind of primary particles.

    Parameters
    ----------
    diameter : float
        Diameter (m); NaN where it is not known.
    density : float
        Density (kg/m³).
    """

    diameter: float
    density: float

    @property
    def mass(self) -> float:
        """Mass of one particle (kg)."""
        return self.density * np.pi / 6 * self.diameter**3

    def __str__(self) -> str:
        of_size = "" if np.isnan(self.diameter) else f"{1e6 * self.diameter:.4g} µm and "
        return f"{of_size}{self.density:.4g} kg/m³"


@dataclass(frozen=True)
class Primary:
    """The primary particles of a run.

    Parameters
    ----------
    kinds : tuple of (int, Kind)
        Each kind with the atom type of its clusters; type 0 stands for all types that are not named.
    source : str
        Who says so.
    """

    kinds: tuple[tuple[int, Kind], ...]
    source: str

    @classmethod
    def of_density(cls, density: float, source: str = "given") -> Primary:
        """One kind, of which only the density (kg/m³) is known."""
        if not LIGHTEST <= density <= HEAVIEST:
            raise ArgumentError("density", f"must be {LIGHTEST:g} to {HEAVIEST:g} kg/m³, not {density:g}")
        return cls(((0, Kind(float("nan"), density)),), source)

    @property
    def words(self) -> str:
        """What they are and who says so, in one line."""
        return f"primary particles of {' and of '.join(str(kind) for _, kind in self.kinds)} ({self.source})"

    @property
    def density(self) -> float | None:
        """The density (kg/m³) if all kinds have the same."""
        found = {kind.density for _, kind in self.kinds}
        return found.pop() if len(found) == 1 else None

    def solids(self, mass: Floats, n: Floats | None = None, types: Floats | None = None) -> Floats:
        """Volume of the solids in each cluster (m³), shape (N,).

        Parameters
        ----------
        mass : ndarray, shape (N,)
            Masses (kg).
        n : ndarray, shape (N,), optional
            Primary particles in each.
        types : ndarray, shape (N,), optional
            Atom types; of several kinds without types it is the mass of one particle, mass / n, that tells them apart.

        Raises
        ------
        ArgumentError
            If there are several kinds of different density and neither ``n`` nor ``types``.
        """
        densities = np.array([kind.density for _, kind in self.kinds])
        if self.density is not None:
            which = np.zeros(len(mass), int)
        elif types is not None and len({number for number, _ in self.kinds}) == len(self.kinds):
            which = np.zeros(len(mass), int)
            for index, (number, _) in enumerate(self.kinds):
                which[np.rint(types) == number] = index
        elif n is not None:
            each = np.array([kind.mass for _, kind in self.kinds])
            which = np.abs(np.log((mass / n)[:, None] / each)).argmin(axis=1)
        else:
            rule = f"{self.words}: a column type or n must tell them apart, or one density for all must be given"
            raise ArgumentError("density", rule)
        volume: Floats = mass / densities[which]
        return volume


FIX = re.compile(r"^\s*fix\s+\S+\s+\S+\s+cluster/breakmerge\s+\S+\s+(\S+)\s+(\S+)\s+(.*)$", re.MULTILINE)
KIND = re.compile(r"\bkind\s+(\d+)\s+(\S+)\s+(\S+)")


def primary_of_log(path: Path) -> Primary | None:
    """The primary particles that ``fix cluster/breakmerge`` was given, as the engine's log echoes it; None without one."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return None
    found = None
    for d_p, rho_p, rest in FIX.findall(re.sub(r"&[ \t]*\n", " ", text)):
        numbers = [(0, d_p, rho_p), *((int(t), d, rho) for t, d, rho in KIND.findall(rest))]
        try:
            kinds = tuple((number, Kind(float(d), float(rho))) for number, d, rho in numbers)
        except ValueError:  # a line before its variables are filled in
            continue
        if all(kind.diameter > 0 and kind.density > 0 for _, kind in kinds):
            found = Primary(kinds, path.name)
    return found


@lru_cache(maxsize=64)
def primary_beside(dump: Path) -> Primary | None:
    """What the log beside a dump tells: ``NAME.log``, or the engines' own ``log.lammps`` and ``log.liggghts``."""
    name = re.sub(r"\.(\d+\.)?(dump|maps)(\.gz|\.bz2|\.xz|\.zst|\.bin)?$", "", dump.name)
    for log in (f"{name}.log", "log.lammps", "log.liggghts"):
        if (found := primary_of_log(dump.with_name(log))) is not None:
            return found
    return None


def primary_of_columns(mass: Floats, diameter: Floats, n: Floats | None) -> Primary | None:
    """The primary particles that follow from n, mass and diameter at :data:`VOIDAGE`; None where these are not clusters'.

    Clusters of one kind have one mass / n and one diameter³ / n, so that a column n of another meaning does not pass.
    """
    if n is None or not len(n) or not (n >= 1).all():
        return None
    each, size = mass / n, diameter * np.cbrt((1 - VOIDAGE) / n)
    order = np.argsort(each, kind="stable")
    begins = np.flatnonzero(np.diff(np.log(each[order]), prepend=-np.inf) > 10 * SLACK)
    if len(begins) > MOST_KINDS:
        return None
    kinds = []
    for group in np.split(order, begins[1:]):
        d_p = float(np.median(size[group]))
        if np.ptp(size[group]) > 10 * SLACK * d_p:
            return None
        kinds.append((0, Kind(d_p, float(np.median(each[group])) / (np.pi / 6 * d_p**3))))
    return Primary(tuple(kinds), f"from the columns n, mass and diameter at voidage {VOIDAGE:g}")


def check_heavier(primary: Primary, solids: Floats, diameter: Floats) -> None:
    """Refuse primary particles so light that a cluster would hold more solids than its own volume."""
    if not len(solids):
        return
    share = solids / (np.pi / 6 * diameter**3)
    if share.max() > 1 + SLACK:
        density = primary.density
        heaviest = "a cluster" if density is None else f"a cluster of {density * float(share.max()):.4g} kg/m³"
        rule = f"{heaviest} (mass over volume) cannot be made of {primary.words}: give the density of the particles (kg/m³)"
        raise ArgumentError("density", rule)
