"""What a gas field file says of where it is from: lines ``name: value``, read by people and by ``clusterdem gas check``."""

from __future__ import annotations

import math

from .. import __version__
from .field import GasField
from .quantities import C_MU, Recipe
from .resample import Making
from .sections import KeptFlux
from .sources import Source


def _lifetime(recipe: Recipe) -> str:
    if recipe.dissipation:
        return f"{recipe.lifetime:g} k / {recipe.dissipation}"
    return f"{recipe.lifetime / C_MU:.4g} / {recipe.frequency}" if recipe.frequency else ""


UNITS = "m, s, m/s, kg/m^3, m^2/s"


def provenance(source: Source, making: Making, gas: GasField, kept: KeptFlux | None) -> str:
    """The lines for a field that was made of a source."""
    recipe, placement = making.recipe, making.placement
    order = ", ".join(
        f"{name} = {'-' if sign < 0 else ''}{'xyz'[k]}"
        for name, sign, k in zip("xyz", placement.signs, placement.order)
    )
    shift = " ".join(f"{v:.9g}" for v in placement.shift)
    lines = {
        "source": source.path,
        "source time": "unknown" if math.isnan(source.time) else f"{source.time:.9g}",
        "time in this file (s)": "none" if math.isnan(gas.time) else f"{gas.time:.9g}",
        "axes (of this file = of the source)": order,
        "lengths": f"times {placement.factor:.9g}, shifted by {shift} m",
        "velocity": f"{','.join(recipe.velocity_names(source.path, source.arrays))}, times {recipe.speed:.9g}",
    }
    for name, value in (
        ("fluctuation", f"sqrt(2 k), k = {recipe.energy}" if recipe.energy else ",".join(recipe.fluctuation)),
        ("lifetime of eddies", _lifetime(recipe)),
        ("density", recipe.density),
        ("viscosity", recipe.viscosity or (recipe.dynamic_viscosity and f"{recipe.dynamic_viscosity} / density")),
        ("mirrored at", " ".join(making.mirror)),
        ("revolved about", making.revolve),
    ):
        if value:
            lines[name] = value
    lines["walls"] = "no slip" if making.no_slip else "as the source has them"
    if gas.solid is not None:
        lines["points in solids"] = f"{int(gas.solid.sum())} of {gas.solid.size}, at rest"
    if kept is not None:
        lines[f"flux along {kept.axis}, of the source"] = " ".join(f"{q:.6g}" for q in kept.source[[0, -1]])
        lines["flux on this grid"] = " ".join(f"{q:.6g}" for q in kept.grid[[0, -1]]) + (
            " (then corrected)" if making.keep_flux else ""
        )
    lines["units"] = UNITS
    lines["program"] = f"clusterdem {__version__}"
    return "\n".join(f"{name}: {' '.join(value.split())}" for name, value in lines.items())
