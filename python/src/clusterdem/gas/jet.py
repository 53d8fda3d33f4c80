"""A plane turbulent jet by Görtler's solution, for scenes whose gas comes from no CFD run."""

from __future__ import annotations

import math

import numpy as np

from .field import Axes, GasField

SIGMA = 7.67
"""Görtler's spreading parameter, from Reichardt's measurements."""


def plane_jet(
    axes: Axes, slot: float, speed: float, centre: float, nozzle: float, coflow: float = 0.0, intensity: float = 0.0
) -> GasField:
    """A jet upward along z out of a slot along y.

    H. Görtler, ZAMM 22 (1942) 244; H. Schlichting, Boundary-Layer Theory, 7th ed. (1979), chapter XXIV: with the
    distance s from the jet's origin, eta = sigma x/s and the kinematic momentum K = U²b, which the jet keeps,

        w = √3/2 √(K sigma/s) sech² eta,   u = √3/4 √(K/(sigma s)) (2 eta sech² eta − tanh eta).

    Its origin lies 3/4 sigma slots below the nozzle, so that the speed on its axis there is that of the slot. It has no
    divergence; from far beside it flows in the gas that it draws along. A co-flow is added as it is, good while slow.

    Parameters
    ----------
    axes : (x, y, z)
        Points of the grid (m), none below the nozzle.
    slot, speed : float
        Width of the slot b (m), speed of the gas in it U (m/s).
    centre, nozzle : float
        x of the slot's middle, z of its mouth (m).
    coflow : float
        Upward velocity of the gas around it (m/s).
    intensity : float
        r.m.s. fluctuation as a share of the jet's own velocity there; 0 for none. The amplitude is √3 times that, as
        the engine draws uniformly between ± the amplitude.
    """
    x, _, z = np.meshgrid(*axes, indexing="ij")
    s = z - nozzle + 0.75 * SIGMA * slot
    eta = SIGMA * (x - centre) / s
    bell = 1 / np.cosh(np.clip(eta, -300, 300)) ** 2
    w = math.sqrt(3) / 2 * speed * np.sqrt(slot * SIGMA / s) * bell
    u = math.sqrt(3) / 4 * speed * np.sqrt(slot / (SIGMA * s)) * (2 * eta * bell - np.tanh(eta))
    arrays = {"velocity": np.stack([u, np.zeros_like(u), w + coflow], axis=-1)}
    if intensity > 0:
        arrays["fluctuation"] = np.repeat(math.sqrt(3) * intensity * w[..., None], 3, axis=-1)
    return GasField(axes, arrays, path="jet")
