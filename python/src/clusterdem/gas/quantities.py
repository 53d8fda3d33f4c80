"""Which arrays of a CFD result are the gas: names, units, and what is derived from them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..frame import Floats
from .axes import Placement

KNOWN_VELOCITIES = (
    ("velocity",), ("U",), ("Velocity",), ("UGas",), ("U.gas",), ("U.air",),
    ("x-velocity", "y-velocity", "z-velocity"), ("x-velocity", "y-velocity", "0"),
    ("X_VELOCITY", "Y_VELOCITY", "Z_VELOCITY"), ("X_VELOCITY", "Y_VELOCITY", "0"),
    ("SV_U", "SV_V", "SV_W"), ("SV_U", "SV_V", "0"),
    ("Velocity u", "Velocity v", "Velocity w"), ("u", "v", "w"), ("ux", "uy", "uz"), ("u", "0", "w"), ("ux", "0", "uz"),
)  # fmt: skip
"""Looked for in this order where no --velocity is given; "0" is a component that is not there."""


@dataclass(frozen=True)
class Recipe:
    """How the gas's arrays follow from those of a source; every name can be a number instead, except the velocity's.

    Parameters
    ----------
    velocity : sequence of str
        One vector, or three components ("0" for none); empty for the usual names.
    fluctuation : sequence of str
        Amplitudes: one vector, one scalar for all components, or three.
    energy : str
        Turbulent kinetic energy k (m²/s²) instead.
    density, viscosity, dynamic_viscosity : str
        kg/m³, m²/s, Pa·s.
    speed : float
        The source's unit of velocity in m/s.
    """

    velocity: Sequence[str] = ()
    fluctuation: Sequence[str] = ()
    energy: str = ""
    density: str = ""
    viscosity: str = ""
    dynamic_viscosity: str = ""
    speed: float = 1.0

    def names(self, path: str, arrays: Mapping[str, Floats]) -> list[str]:
        """Arrays that must be sampled, all of which the source has."""
        velocity = self._velocity(path, arrays)
        scalars = (self.energy, self.density, self.viscosity, self.dynamic_viscosity)
        wanted = [name for name in (*velocity, *self.fluctuation, *scalars) if name and _number(name) is None]
        for name in wanted:
            if name not in arrays:
                raise InputError(path, f"has no array '{name}'; it has: {', '.join(sorted(arrays)) or 'none'}")
        return list(dict.fromkeys(wanted))

    def _velocity(self, path: str, arrays: Mapping[str, Floats]) -> Sequence[str]:
        if self.velocity:
            return self.velocity
        for names in KNOWN_VELOCITIES:
            if all(name in arrays or name == "0" for name in names):
                return names
        found = ", ".join(sorted(arrays)) or "none"
        raise InputError(path, f"no array has a usual name of a velocity: give --velocity NAME or U,V,W of: {found}")

    def gas(self, path: str, samples: Mapping[str, Floats], placement: Placement) -> dict[str, Floats]:
        """The gas's arrays at N points, from the samples there.

        Isotropic turbulence has the r.m.s. fluctuation u' = √(2k/3) in each component (k = ½<u_i u_i>; Pope, Turbulent
        Flows, 2000, section 5.3). The engine draws uniformly from −a to a, whose r.m.s. is a/√3, so that
        a = √3 u' = √(2k).
        """
        velocity = self.speed * _vector(path, self._velocity(path, samples), samples, "velocity")
        arrays = {"velocity": placement.turned(velocity)}
        if self.energy:
            k = _scalar(path, self.energy, samples)
            # continued linearly to a wall, where it vanishes, k may come out below zero
            arrays["fluctuation"] = self.speed * np.repeat(np.sqrt(2 * np.maximum(k, 0.0))[:, None], 3, axis=1)
        elif self.fluctuation:
            amplitude = self.speed * _vector(path, self.fluctuation, samples, "fluctuation")
            arrays["fluctuation"] = np.abs(placement.turned(amplitude))
        if self.density:
            arrays["density"] = _scalar(path, self.density, samples)
        if self.viscosity:
            arrays["viscosity"] = _scalar(path, self.viscosity, samples)
        elif self.dynamic_viscosity:
            with np.errstate(divide="ignore", invalid="ignore"):  # a density of zero is found by the checks
                arrays["viscosity"] = _scalar(path, self.dynamic_viscosity, samples) / arrays["density"]
        return arrays


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _scalar(path: str, name: str, samples: Mapping[str, Floats]) -> Floats:
    value = _number(name)
    if value is not None:
        return np.full(len(next(iter(samples.values()))), value)
    values = samples[name]
    if values.ndim > 1 and values.shape[1] > 1:
        raise InputError(path, f"array '{name}' must have one component, not {values.shape[1]}")
    return values.reshape(-1)


def _vector(path: str, names: Sequence[str], samples: Mapping[str, Floats], what: str) -> Floats:
    if len(names) == 3:
        return np.stack([_scalar(path, name, samples) for name in names], axis=1)
    (name,) = names
    if _number(name) is not None:
        return np.repeat(_scalar(path, name, samples)[:, None], 3, axis=1)
    values = samples[name].reshape(len(samples[name]), -1)
    parts = values.shape[1]
    if parts == 1 and what == "fluctuation":
        return np.repeat(values, 3, axis=1)
    if parts == 2:
        return np.concatenate([values, np.zeros((len(values), 1))], axis=1)
    if parts != 3:
        raise InputError(path, f"array '{name}' for the {what} must have three components, not {parts}")
    return values
