"""What can be wrong with gas fields: numbers, units, cover of the box, times.

The rules are those of ``fix drag/cluster … field``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import InputError
from ..frame import Box, Floats
from .divergence import divergence
from .field import NAMES, UNITS, VECTORS, GasField
from .sections import balance

SOUND = 343.0
"""Speed of sound in air at 20 °C (m/s)."""
DENSITIES = (0.05, 200.0)
"""From hot or thin gas to 100 bar and more (kg/m³)."""
KINEMATIC = (1e-7, 1e-2)
"""From dense to thin, hot gas (m²/s); air at 20 °C and 1 bar: 1.5e-5."""
DYNAMIC = (5e-6, 2e-4)
"""Gases up to 2000 K or so (Pa·s), at any pressure; air at 20 °C: 1.8e-5."""
OTHER_UNIT = 100.0
"""Box and field that differ in length by this factor are in different units."""
MUCH_CHANGE = 0.1
"""Change of the flux through sections from which it is worth a warning: the gas gains or loses a tenth on its way."""
SAME = 1e-6
"""Relative difference below which lengths, planes and grids are the same."""


@dataclass(frozen=True)
class Finding:
    """One thing found.

    Parameters
    ----------
    level : {"error", "warning", "note"}
        An error stops a run, or must; a note is no fault.
    path : str
        The file.
    rule : str
        What, in one line.
    kind : str
        Warnings of one kind are told once for a series; "" for one of its own.
    """

    level: str
    path: str
    rule: str
    kind: str = ""

    def __str__(self) -> str:
        return f"{self.path}: {self.level}: {self.rule}"


def refuse(findings: Sequence[Finding]) -> None:
    """Raise the first error among the findings, if there is one."""
    errors = [finding for finding in findings if finding.level == "error"]
    if errors:
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        raise InputError(errors[0].path, errors[0].rule + more)


def check_field(gas: GasField) -> list[Finding]:
    """Numbers and units of one field."""
    errors = _axes(gas) + [rule for name in NAMES if name in gas for rule in _numbers(gas, name)]
    if errors:
        return [Finding("error", gas.path, rule) for rule in errors]
    warnings = [Finding("warning", gas.path, rule, kind) for kind, rule in (*_units(gas), *_conservation(gas))]
    return warnings + _solids(gas)


def _solids(gas: GasField) -> list[Finding]:
    if gas.solid is None or not gas.solid.any():
        return []
    count = int(gas.solid.sum())
    rule = f"{count:,} of {gas.solid.size:,} points lie in solids, the first at {_first(gas, gas.solid)}: at rest there"
    return [Finding("note", gas.path, rule, "solids")]


def _axes(gas: GasField) -> list[str]:
    rules = []
    for name, axis in zip("xyz", gas.axes):
        if not np.all(np.isfinite(axis)):
            rules.append(f"{name} coordinates must be finite")
        elif axis.size > 1 and np.any(np.diff(axis) <= 0):
            k = int(np.argmax(np.diff(axis) <= 0))
            rules.append(f"{name} coordinates must increase: {axis[k]:.9g}, then {axis[k + 1]:.9g}")
    return rules


def _numbers(gas: GasField, name: str) -> list[str]:
    values = gas[name]
    bad = ~np.isfinite(values)
    if bad.any():
        points = bad.any(axis=-1) if name in VECTORS else bad
        return [
            f"array {name} must be finite: {int(points.sum()):,} points are not, the first at {_first(gas, points)}"
        ]
    low = values < 0 if name == "fluctuation" else values <= 0
    if name != "velocity" and low.any():
        points = low.any(axis=-1) if name in VECTORS else low
        rule = "must not be negative" if name == "fluctuation" else "must be above zero"
        return [f"array {name} {rule}: {values[low].flat[0]:.6g} {UNITS[name]} at {_first(gas, points)}"]
    return []


def _first(gas: GasField, points: Any) -> str:
    return gas.place(int(np.argmax(points)))


def _units(gas: GasField) -> list[tuple[str, str]]:
    rules = []
    fastest = int(np.argmax(gas.speed))
    speed = float(gas.speed.flat[fastest])
    if speed > SOUND:
        rule = f"the velocity reaches {speed:.4g} m/s at {gas.place(fastest)}, faster than sound ({SOUND:g} m/s)"
        rules.append(("speed", f"{rule}: was it in mm/s or cm/s? (--velocity-unit)"))
    elif speed == 0:
        rules.append(("rest", "the gas is at rest everywhere"))
    for name, (least, most) in (("density", DENSITIES), ("viscosity", KINEMATIC)):
        if name in gas:
            low, high = float(gas[name].min()), float(gas[name].max())
            if low < least or high > most:
                found = f"{name} is {low:.4g} to {high:.4g} {UNITS[name]}, that of a gas is {least:g} to {most:g}"
                rules.append((name, found + (": is it the kinematic one, in SI units?" if name == "viscosity" else "")))
    if "density" in gas and "viscosity" in gas:
        dynamic = gas["density"] * gas["viscosity"]
        low, high = float(dynamic.min()), float(dynamic.max())
        if low < DYNAMIC[0] or high > DYNAMIC[1]:
            rule = (
                f"density times viscosity is {low:.4g} to {high:.4g} Pa s, that of a gas is {DYNAMIC[0]:g} to "
                f"{DYNAMIC[1]:g}: viscosity must be the kinematic one, in m^2/s (--dynamic-viscosity converts)"
            )
            rules.append(("dynamic viscosity", rule))
    return rules


def _conservation(gas: GasField) -> list[tuple[str, str]]:
    found = balance(gas)
    if found.change <= MUCH_CHANGE:
        return []
    what = "flux of mass" if "density" in gas else "flux"
    rule = (
        f"the {what} through sections across {found.axis} changes by {100 * found.change:.3g} % of the largest, most at "
        f"{found.axis} = {found.place:.4g} m: not conserved as it stands (right for the superficial velocity in a bed "
        "that changes, and for a plane cut out of a 3-D flow)"
    )
    return [("conservation", rule)]


def check_cover(gas: GasField, box: Box, edges: Mapping[str, str] | None = None) -> list[Finding]:
    """Whether a field covers a box, by the edge rules of the fix.

    Parameters
    ----------
    gas : GasField
        The field.
    box : Box
        The box and where it is periodic.
    edges : mapping of str to {"periodic", "clamp"}, optional
        What the command says of an axis. Of others the box may reach one spacing of the points beyond them, and they are
        periodic where the box is.
    """
    found, edges = [], edges or {}
    for k, name in enumerate("xyz"):
        if gas.axes[k].size == 1 or box.lengths[k] == 0:  # uniform, or a box that says nothing of y
            continue
        rules = [] if name in edges else _reach(name, gas.axes[k], box.lo[k], box.hi[k])
        if edges.get(name, "periodic" if box.periodic[k] else "clamp") == "periodic" and not rules:
            rules = _period(gas, k, box.lengths[k])
        found += [Finding(level, gas.path, text) for level, text in rules]
    return found


def _unit_hint(span: float, length: float) -> str:
    if length > OTHER_UNIT * span or span > OTHER_UNIT * length:
        return f": is it in mm? (the field is {span / length:.3g} times as long as the box; --length-unit)"
    return ""


def _reach(name: str, axis: Floats, low: float, high: float) -> list[tuple[str, str]]:
    rounding = SAME * (high - low)
    first, last = float(axis[0] - (axis[1] - axis[0])), float(axis[-1] + (axis[-1] - axis[-2]))
    hint = _unit_hint(float(axis[-1] - axis[0]), high - low)
    if low >= first - rounding and high <= last + rounding:
        return [("warning", f"along {name} it reaches from {axis[0]:.6g} to {axis[-1]:.6g} m{hint}")] if hint else []
    text = f"along {name} it reaches from {axis[0]:.6g} to {axis[-1]:.6g} m, the box from {low:.6g} to {high:.6g} m"
    return [("error", text + (hint or f": more than a spacing is missing, unless 'edge {name} clamp' is meant"))]


def _period(gas: GasField, k: int, period: float) -> list[tuple[str, str]]:
    name, axis = "xyz"[k], gas.axes[k]
    span = float(axis[-1] - axis[0])
    if span > period * (1 + SAME):
        text = f"along {name} it is {span:.6g} m long, longer than the period of the box, {period:.6g} m"
        return [("error", f"{text}{_unit_hint(span, period)}: 'edge {name} clamp' would accept it")]
    if period - span > SAME * period:
        return []
    for array, values in gas.arrays.items():
        apart = float(np.max(np.abs(np.take(values, 0, k) - np.take(values, -1, k))))
        if apart > SAME * max(float(np.max(np.abs(values))), math.ulp(0.0)):
            text = f"array {array}: along {name} the last plane is the first of the next period, but differs by up to"
            return [
                (
                    "error",
                    f"{text} {apart:.3g} {UNITS[array]}: leave it out (make --periodic {name}), or 'edge {name} clamp'",
                )
            ]
    return []


def check_series(fields: Sequence[GasField]) -> list[Finding]:
    """Whether files make a series: one grid, the same arrays, a time each, no frame missing."""
    found: list[Finding] = []
    if len(fields) < 2:
        return found
    first = fields[0]
    for gas in fields:
        if math.isnan(gas.time):
            found.append(Finding("error", gas.path, "a file of a series must have its TIME (--time)"))
        if set(gas.arrays) != set(first.arrays):
            text = f"has the arrays {', '.join(gas.arrays)}, but {first.path} has {', '.join(first.arrays)}"
            found.append(Finding("error", gas.path, text))
        for name, a, b in zip("xyz", gas.axes, first.axes):
            if a.size != b.size or float(np.max(np.abs(a - b))) > SAME * max(float(b[-1] - b[0]), 1e-12):
                found.append(Finding("error", gas.path, f"has another grid along {name} than {first.path}"))
    if found:
        return found
    ordered = sorted(fields, key=lambda gas: gas.time)
    times = np.array([gas.time for gas in ordered])
    steps = np.diff(times)
    for gas, before, step in zip(ordered[1:], ordered, steps):
        if step == 0:
            found.append(Finding("error", gas.path, f"has the same time as {before.path}, {gas.time:.9g} s"))
        elif step > 1.5 * float(np.median(steps)):
            text = (
                f"comes {step:.6g} s after {before.path}, where {np.median(steps):.6g} s is usual: is a frame missing?"
            )
            found.append(Finding("warning", gas.path, text))
    return found


def describe(gas: GasField) -> str:
    """A few lines: extent and arrays."""
    parts = []
    for name, axis in zip("xyz", gas.axes):
        if axis.size == 1:
            parts.append(f"{name} uniform")
        else:
            parts.append(f"{name} {axis[0]:.6g} to {axis[-1]:.6g} m ({axis.size})")
    time = "" if math.isnan(gas.time) else f"; t = {gas.time:.9g} s"
    lines = [f"{gas.path}: {', '.join(parts)}{time}"]
    for name, values in gas.arrays.items():
        if name in VECTORS:
            size = np.linalg.norm(values, axis=-1)
            mean = ", ".join(f"{v:.4g}" for v in values.reshape(-1, 3).mean(axis=0))
            lines.append(f"  {name}: {size.min():.4g} to {size.max():.4g} {UNITS[name]}, mean ({mean})")
        else:
            lines.append(f"  {name}: {values.min():.4g} to {values.max():.4g} {UNITS[name]}, mean {values.mean():.4g}")
    lines += [f"  {line}" for line in gas.provenance.splitlines()]
    return "\n".join(lines)


def describe_conservation(gas: GasField) -> str:
    """Two lines about a field without errors."""
    found, flux = divergence(gas), balance(gas)
    return (
        f"  flux through sections: changes by {100 * flux.change:.3g} % of the largest, most at "
        f"{flux.axis} = {flux.place:.4g} m\n"
        f"  divergence, walls and solids left out: {found.rms:.3g} 1/s r.m.s., at most {found.most:.3g} at "
        f"{gas.place(found.where)}"
    )
