"""Pictures of a gas field: speed with streamlines, divergence, profiles along the height, further arrays."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ..errors import InputError
from ..frame import Floats
from ..plot.style import COLOURS, new_figure, styled
from .divergence import divergence
from .field import GasField

STREAM_POINTS = 200
"""Points along the longer side of the even grid that streamlines are drawn on."""

SCALAR_PANELS = (("density", "density (kg/m³)", 1.0), ("viscosity", "kinematic viscosity (mm²/s)", 1e6),
    ("period", "lifetime of eddies (ms)", 1e3), ("eddy_size", "size of eddies (mm)", 1e3))  # fmt: skip


def draw_gas(gas: GasField, y: float | None = None) -> Figure:
    """Draw the x–z plane of a field.

    Parameters
    ----------
    gas : GasField
        The field; of a 3-D one the plane nearest to ``y`` is drawn.
    y : float, optional
        Where (m); the middle by default.
    """
    x, ys, z = gas.axes
    if x.size < 2 or z.size < 2:
        raise InputError(gas.path, "needs two points or more along x and along z to be drawn")
    k = int(np.argmin(np.abs(ys - (ys.mean() if y is None else y))))
    velocity, div = gas["velocity"][:, k], divergence(gas)
    spread = np.where(div.inner, div.map, 0.0)[:, k]  # walls and solids left out
    most = float(np.percentile(np.abs(spread), 99)) or 1.0
    panels: list[Callable[[Any], Any]] = [
        lambda a: _speed(a, x, z, velocity),
        lambda a: _map(a, x, z, spread, "divergence (1/s)", "RdBu_r", (-most, most)),
    ]
    if "fluctuation" in gas:
        amplitude = np.linalg.norm(gas["fluctuation"][:, k], axis=-1)
        panels.append(lambda a: _map(a, x, z, amplitude, "amplitude of fluctuation (m/s)", "magma"))
    for name, label, factor in SCALAR_PANELS:
        if name in gas:
            values = factor * gas[name][:, k]
            panels.append(partial(_map, x=x, z=z, values=values, label=label, colours="cividis"))
    shape = float((z[-1] - z[0]) / (x[-1] - x[0]))
    wide = min(1.6, 7.5 / shape)  # of one panel (inch)
    with styled():
        width = (wide + 0.65) * (len(panels) + 1)
        figure = new_figure(width, max(wide * shape, 0.6) + 1.1, layout="compressed")
        axes = figure.subplots(1, len(panels) + 1)
        for axis, panel in zip(axes, panels):
            panel(axis)
            if gas.solid is not None and gas.solid[:, k].any():
                axis.contourf(1e3 * x, 1e3 * z, gas.solid[:, k].T, levels=[0.5, 1.5], colors=["0.55"])
        _profile(axes[-1], z, velocity)
        axes[-1].set_box_aspect(shape)
        axes[0].set_ylabel("z (mm)")
        words = [] if math.isnan(gas.time) else [f"t = {gas.time:.4g} s"]
        words += [f"y = {1e3 * ys[k]:.4g} mm"] if ys.size > 1 else []
        words += ["grey: solids"] if gas.solid is not None and gas.solid[:, k].any() else []
        if words:
            figure.suptitle(", ".join(words), fontsize=8)
    return figure


def _map(
    axis: Any, x: Floats, z: Floats, values: Floats, label: str, colours: str, limits: tuple[float, float] | None = None
) -> None:
    low, high = limits or (float(values.min()), float(values.max()))
    if high - low <= 1e-9 * max(abs(high), abs(low)):  # one value
        low, high = low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
    image = axis.pcolormesh(
        1e3 * x, 1e3 * z, values.T, cmap=colours, vmin=low, vmax=high, shading="gouraud", rasterized=True
    )
    axis.set_aspect("equal")
    axis.set_xlabel("x (mm)")
    axis.locator_params(axis="x", nbins=3)
    extend = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}
    beyond = (bool(values.min() < low), bool(values.max() > high))
    bar = axis.figure.colorbar(image, ax=axis, location="top", pad=0.03, aspect=15, extend=extend[beyond])
    bar.set_label(label)
    bar.locator.set_params(nbins=4)
    bar.outline.set_linewidth(0.5)


def _speed(axis: Any, x: Floats, z: Floats, velocity: Floats) -> None:
    speed = np.linalg.norm(velocity, axis=-1)
    _map(axis, x, z, speed, "speed (m/s)", "viridis", (0.0, float(speed.max()) or 1.0))
    if speed.max() == 0:
        return
    lengths = x[-1] - x[0], z[-1] - z[0]
    nx, nz = (max(int(STREAM_POINTS * length / max(lengths)), 5) for length in lengths)
    xs, zs = np.linspace(x[0], x[-1], nx), np.linspace(z[0], z[-1], nz)  # streamplot wants even spacing
    even = [_even(velocity[..., c], x, z, xs, zs) for c in (0, 2)]
    axis.streamplot(
        1e3 * xs, 1e3 * zs, even[0].T, even[1].T, color="white", linewidth=0.4, arrowsize=0.5, density=(0.5, 1.0)
    )
    axis.set_xlim(1e3 * x[0], 1e3 * x[-1])
    axis.set_ylim(1e3 * z[0], 1e3 * z[-1])


def _even(values: Floats, x: Floats, z: Floats, xs: Floats, zs: Floats) -> Floats:
    along_x = np.stack([np.interp(xs, x, row) for row in values.T], axis=1)
    return np.stack([np.interp(zs, z, row) for row in along_x], axis=0)


def _profile(axis: Any, z: Floats, velocity: Floats) -> None:
    """Over the width: mean of u and w, and the range of w."""
    u, w = velocity[..., 0], velocity[..., 2]
    axis.fill_betweenx(
        1e3 * z, w.min(axis=0), w.max(axis=0), color=COLOURS[0], alpha=0.2, linewidth=0, label="range of w"
    )
    axis.plot(w.mean(axis=0), 1e3 * z, color=COLOURS[0], label="mean w")
    axis.plot(u.mean(axis=0), 1e3 * z, color=COLOURS[1], linestyle="--", label="mean u")
    axis.set_ylim(1e3 * z[0], 1e3 * z[-1])
    axis.set_xlabel("velocity (m/s)")
    axis.legend(loc="best", framealpha=0.8, edgecolor="none")
