"""What is fitted: numbers within a range, and choices between named values."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...frame import Floats

DIGITS = 4
"""Significant digits of a fitted number: what is run is what is reported, and equal values are one run."""

PLACE = re.compile(r"\{(\w+)\}")
"""A parameter's place in a variable's value."""

Point = dict[str, float | str]
"""A value for every parameter."""


@dataclass(frozen=True)
class Real:
    """A number within a range.

    Parameters
    ----------
    name : str
        Its name.
    low, high : float
        The range.
    log : bool
        Whether equal ratios count as equal steps.
    """

    name: str
    low: float
    high: float
    log: bool = False

    def unit(self, value: float) -> float:
        """Where a value lies in the range, 0 to 1."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def value(self, unit: float) -> float:
        """The value at a place of the range, rounded to :data:`DIGITS`."""
        unit = min(max(unit, 0.0), 1.0)
        exact = self.low * (self.high / self.low) ** unit if self.log else self.low + unit * (self.high - self.low)
        return self.rounded(exact)

    def rounded(self, value: float) -> float:
        """A value with few digits, inside the range."""
        return min(max(float(f"{value:.{DIGITS}g}"), self.low), self.high)


@dataclass(frozen=True)
class Choice:
    """One of several named values.

    Parameters
    ----------
    name : str
        Its name.
    options : tuple of str
        The values.
    """

    name: str
    options: tuple[str, ...]


Parameter = Real | Choice


def reals(parameters: Sequence[Parameter]) -> list[Real]:
    """The numbers among the parameters."""
    return [parameter for parameter in parameters if isinstance(parameter, Real)]


def choices(parameters: Sequence[Parameter]) -> list[Choice]:
    """The choices among the parameters that have more than one option."""
    return [parameter for parameter in parameters if isinstance(parameter, Choice) and len(parameter.options) > 1]


def units(parameters: Sequence[Parameter], point: Point) -> Floats:
    """Where a point's numbers lie in their ranges, shape (P,)."""
    return np.array([real.unit(float(point[real.name])) for real in reals(parameters)])


def moved(parameters: Sequence[Parameter], point: Point, unit: Floats) -> Point:
    """A point with its numbers elsewhere in their ranges."""
    return point | {real.name: real.value(float(u)) for real, u in zip(reals(parameters), unit)}


def text_of(value: float | str) -> str:
    """A value as LAMMPS gets it."""
    return value if isinstance(value, str) else f"{value:.{DIGITS}g}"


def fill(variables: Mapping[str, str], point: Point) -> dict[str, str]:
    """Variables of a run at a point: ``{name}`` is replaced; a parameter without a place sets the variable of its name."""
    placed = {name for text in variables.values() for name in PLACE.findall(text)}
    filled = {name: PLACE.sub(lambda place: text_of(point[place[1]]), text) for name, text in variables.items()}
    return filled | {name: text_of(value) for name, value in point.items() if name not in placed}


def described(point: Point) -> str:
    """A point in one line."""
    return ", ".join(f"{name} = {text_of(value)}" for name, value in point.items())
