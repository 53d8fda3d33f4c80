"""Which arrays of a CFD result are the gas: names, units, and what is derived from them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..frame import Floats
from .axes import Placement

C_MU = 0.09
"""Of the k-ε model."""
VECTOR_NAMES = (
    "velocity", "u", "gasvelocity", "velocitygas", "ugas", "uair", "ug", "uf", "fluidvelocity", "velocityvector",
    "velocityfield", "vel", "umean", "meanvelocity", "velocitymean", "vg", "v",
)  # fmt: skip
COMPONENT_NAMES = (
    ("xvelocity", "yvelocity", "zvelocity"), ("velocityx", "velocityy", "velocityz"), ("svu", "svv", "svw"),
    ("velocityu", "velocityv", "velocityw"), ("velocity[i]", "velocity[j]", "velocity[k]"), ("u", "v", "w"),
    ("ux", "uy", "uz"), ("vx", "vy", "vz"), ("ug", "vg", "wg"), ("gasvelocityx", "gasvelocityy", "gasvelocityz"),
    ("velocity0", "velocity1", "velocity2"), ("u0", "u1", "u2"), ("velx", "vely", "velz"),
    ("umeanx", "umeany", "umeanz"), ("ugx", "ugy", "ugz"),
)  # fmt: skip
"""Looked for in this order where no --velocity is given, without regard to capitals, blanks, signs between and units."""


def plain(name: str) -> str:
    """A name without its unit, capitals and what stands between its words: ``Velocity[i] (m/s)`` is ``velocity[i]``."""
    name = re.sub(r"\s*\((?=[^()]*\)\s*$)[^()]*\)\s*$", "", name)  # (m/s)
    name = re.sub(r"\s*\[(?![ijk]\])[^\[\]]*\]\s*$", "", name)  # [ m s^-1 ]
    return re.sub(r"[\s_.:\-]+", "", name).lower()


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
    dissipation, frequency : str
        Dissipation rate ε of k (m²/s³), or its specific one ω (1/s), for lifetime and size of eddies.
    lifetime : float
        c of the lifetime c k/ε.
    density, viscosity, dynamic_viscosity : str
        kg/m³, m²/s, Pa·s.
    speed : float
        The source's unit of velocity in m/s.
    """

    velocity: Sequence[str] = ()
    fluctuation: Sequence[str] = ()
    energy: str = ""
    dissipation: str = ""
    frequency: str = ""
    lifetime: float = 0.3
    density: str = ""
    viscosity: str = ""
    dynamic_viscosity: str = ""
    speed: float = 1.0

    def names(self, path: str, arrays: Mapping[str, Floats]) -> list[str]:
        """Arrays that must be sampled, all of which the source has."""
        wanted = [*self.velocity_names(path, arrays), *self._others()]
        for name in wanted:
            if name not in arrays and _number(name) is None:
                raise InputError(path, f"has no array '{name}'; it has: {', '.join(sorted(arrays)) or 'none'}")
        return list(dict.fromkeys(name for name in wanted if _number(name) is None))

    def moving(self, path: str, arrays: Mapping[str, Floats]) -> set[str]:
        """Those arrays that vanish where nothing moves."""
        names = {*self.velocity_names(path, arrays), *self.fluctuation, self.energy}
        return {name for name in names if name in arrays}

    def _others(self) -> list[str]:
        scalars = (self.energy, self.dissipation, self.frequency, self.density, self.viscosity, self.dynamic_viscosity)
        return [name for name in (*self.fluctuation, *scalars) if name]

    def velocity_names(self, path: str, arrays: Mapping[str, Floats]) -> tuple[str, ...]:
        """The velocity's array, or those of its three components ("0" for none)."""
        if self.velocity:
            return tuple(self.velocity)
        by_name: dict[str, list[str]] = {}
        for name in arrays:
            by_name.setdefault(plain(name), []).append(name)
        vectors = {k: [n for n in v if arrays[n].ndim == 2 and arrays[n].shape[1] > 1] for k, v in by_name.items()}
        scalars = {k: [n for n in v if n not in vectors[k]] for k, v in by_name.items()}
        for kind in VECTOR_NAMES:
            if vectors.get(kind):
                return (vectors[kind][0],)
        for kinds in COMPONENT_NAMES:
            found = [scalars.get(kind, ["0"])[0] if scalars.get(kind) else "0" for kind in kinds]
            if sum(name != "0" for name in found) >= 2:
                return tuple(found)
        listed = ", ".join(sorted(arrays)) or "none"
        raise InputError(path, f"no array has a usual name of a velocity: give --velocity NAME or U,V,W of: {listed}")

    def _eddies(self, path: str, k: Floats, samples: Mapping[str, Floats]) -> dict[str, Floats]:
        """Lifetime c k/ε and size C_mu^(3/4) k^(3/2)/ε of eddies, as the engine's page of fix drag/cluster has them."""
        if self.dissipation:
            rate = _scalar(path, self.dissipation, samples)
        elif self.frequency:
            rate = C_MU * k * _scalar(path, self.frequency, samples)  # Wilcox's definition of ω
        else:
            return {}
        with np.errstate(divide="ignore", invalid="ignore"):
            period, size = self.lifetime * k / rate, C_MU**0.75 * np.maximum(k, 0.0) ** 1.5 / rate
        return {"period": _above_zero(period), "eddy_size": _above_zero(size)}

    def gas(self, path: str, samples: Mapping[str, Floats], placement: Placement) -> dict[str, Floats]:
        """The gas's arrays at N points, from the samples there.

        Isotropic turbulence has the r.m.s. fluctuation u' = √(2k/3) in each component (k = ½<u_i u_i>; Pope, Turbulent
        Flows, 2000, section 5.3). The engine draws uniformly from −a to a, whose r.m.s. is a/√3, so that
        a = √3 u' = √(2k).
        """
        velocity = self.speed * _vector(path, self.velocity_names(path, samples), samples, "velocity")
        arrays = {"velocity": placement.turned(velocity)}
        if self.energy:
            k = _scalar(path, self.energy, samples)
            # continued linearly to a wall, where it vanishes, k may come out below zero
            arrays["fluctuation"] = self.speed * np.repeat(np.sqrt(2 * np.maximum(k, 0.0))[:, None], 3, axis=1)
            arrays |= self._eddies(path, self.speed**2 * k, samples)
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


def _above_zero(values: Floats) -> Floats:
    """Where there is no turbulence, at walls and in solids, the least of the others: it cannot be 0 there."""
    sound = np.isfinite(values) & (values > 0)
    return np.where(sound, values, values[sound].min() if sound.any() else np.nan)


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
