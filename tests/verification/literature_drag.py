"""Drag laws written from the literature, for comparison with the plugin's: drag force on one sphere [N].

slip: interstitial slip velocity [m/s], d: diameter [m], nu, rho: of the gas, eps: voidage.
"""

from __future__ import annotations

import numpy as np


def sphere_drag(c_d: float, slip: float, d: float, rho: float) -> float:
    """F = C_D (pi d^2/4) (rho/2) slip^2."""
    return c_d * 0.25 * np.pi * d**2 * 0.5 * rho * slip**2


def stokes(slip, d, nu, rho):
    """Stokes (1851): F = 3 pi mu d slip."""
    return 3 * np.pi * rho * nu * d * slip


def schiller_naumann_cd(re):
    """Schiller & Naumann (1933), with Newton's 0.44 above Re = 1000 (Clift, Grace & Weber 1978, table 5.1)."""
    return 24 / re * (1 + 0.15 * re**0.687) if re < 1000 else 0.44


def schiller_naumann(slip, d, nu, rho):
    return sphere_drag(schiller_naumann_cd(slip * d / nu), slip, d, rho)


def wen_yu(slip, d, nu, rho, eps):
    """Wen & Yu (1966), beta = 3/4 C_D eps (1 - eps) rho slip / d eps^-2.65; F = V_p beta slip / (1 - eps)."""
    beta_per_solid = 0.75 * schiller_naumann_cd(eps * slip * d / nu) * eps * rho * slip / d * eps**-2.65
    return np.pi / 6 * d**3 * beta_per_solid * slip


def di_felice(slip, d, nu, rho, eps):
    """Di Felice (1994): the drag of a lone sphere at the superficial velocity, times eps^-beta."""
    u = eps * slip
    re = u * d / nu
    c_d = (0.63 + 4.8 / np.sqrt(re)) ** 2
    beta = 3.7 - 0.65 * np.exp(-0.5 * (1.5 - np.log10(re)) ** 2)
    return sphere_drag(c_d, u, d, rho) * eps**-beta


def tran_cong_cd(re, c, ratio):
    """Tran-Cong, Gay & Michaelides (2004), Re on the nominal diameter, ratio = d_A/d_n, c = circularity."""
    x = ratio * re
    return 24 / re * ratio * (1 + 0.15 / np.sqrt(c) * x**0.687) + 0.42 * ratio**2 / (
        np.sqrt(c) * (1 + 4.25e4 * x**-1.16)
    )


def tran_cong(slip, d, nu, rho, c, ratio):
    return sphere_drag(tran_cong_cd(slip * d / nu, c, ratio), slip, d, rho)
