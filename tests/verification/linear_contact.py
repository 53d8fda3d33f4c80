"""Closed form of the linear spring-dashpot contact, m x'' + eta x' + k x = m g, x(0) = start, x'(0) = v.

x is the overlap, m the effective mass, g an acceleration that presses the bodies together (0: free pair).
eta = -2 ln e sqrt(m k) / sqrt(pi^2 + ln^2 e) gives the rebound speed e v for g = 0 (Schaefer, Dippel & Wolf 1996,
Force schemes in simulations of granular materials, J. Phys. I France 6, 5-20).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq


@dataclass
class LinearContact:
    k: float  # [N/m]
    m: float  # effective mass [kg]
    e: float
    g: float = 0.0  # [m/s^2]

    @property
    def eta(self) -> float:
        """Dashpot coefficient [kg/s]."""
        return -2.0 * np.log(self.e) * np.sqrt(self.m * self.k) / np.hypot(np.pi, np.log(self.e))

    @property
    def omega(self) -> float:
        """Angular frequency of the damped oscillation [1/s]."""
        return float(np.sqrt(self.k / self.m - (0.5 * self.eta / self.m) ** 2))

    @property
    def free_duration(self) -> float:
        """Contact time at g = 0 [s]."""
        return float(np.pi / self.omega)

    def _constants(self, v: float, start: float) -> tuple[float, float, float, float]:
        beta, rest = 0.5 * self.eta / self.m, self.m * self.g / self.k
        return beta, rest, start - rest, (v + beta * (start - rest)) / self.omega

    def overlap(self, t, v: float, start: float = 0.0):
        beta, rest, a, b = self._constants(v, start)
        return rest + np.exp(-beta * t) * (a * np.cos(self.omega * t) + b * np.sin(self.omega * t))

    def speed(self, t, v: float, start: float = 0.0):
        beta, _, a, b = self._constants(v, start)
        w = self.omega
        cos, sin = np.cos(w * t), np.sin(w * t)
        return np.exp(-beta * t) * (-beta * (a * cos + b * sin) + w * (b * cos - a * sin))

    def duration(self, v: float) -> float:
        """Time until the overlap is zero again [s]."""
        if self.g == 0.0:
            return self.free_duration
        later = np.linspace(0.5, 2.0, 1000) * self.free_duration
        apart = later[np.flatnonzero(self.overlap(later, v) < 0.0)[0]]
        return float(brentq(self.overlap, 0.5 * self.free_duration, apart, args=(v,), xtol=1e-16))

    def rebound(self, v: float) -> float:
        """Speed of separation [m/s]."""
        return -float(self.speed(self.duration(v), v))
