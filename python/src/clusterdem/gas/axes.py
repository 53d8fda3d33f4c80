"""Where a CFD result lies in the engine's box: axes turned, lengths scaled, origin moved."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..frame import Floats
from .field import Axes

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254, "ft": 0.3048}
SPEEDS = {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3, "km/h": 1 / 3.6, "ft/s": 0.3048}


@dataclass(frozen=True)
class Placement:
    """x' = shift + factor · (the source's axes in another order, with signs).

    Parameters
    ----------
    order : (int, int, int)
        Which of the source's axes becomes x, y, z.
    signs : (float, float, float)
        1, or -1 where the axis is turned round.
    factor : float
        The source's unit of length in m.
    shift : (float, float, float)
        Where the source's origin comes to lie (m).
    """

    order: tuple[int, int, int] = (0, 1, 2)
    signs: tuple[float, float, float] = (1.0, 1.0, 1.0)
    factor: float = 1.0
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def turned(self, vectors: Floats) -> Floats:
        """Components along the new axes, shape (N, 3)."""
        return vectors[:, self.order] * self.signs

    def placed(self, points: Floats) -> Floats:
        """Points of the source in the box (m), shape (N, 3)."""
        return self.shift + self.factor * self.turned(points)

    def back(self, points: Floats) -> Floats:
        """Points of the box in the source's own axes and units."""
        own = np.empty_like(points)
        own[:, self.order] = (points - self.shift) / self.factor * self.signs
        return own

    def axes(self, axes: Axes) -> Axes:
        """Axes of a source's grid, in the box, ascending."""
        x, y, z = (np.sort(s + self.factor * sign * axes[k]) for k, sign, s in zip(self.order, self.signs, self.shift))
        return (x, y, z)


def parse_axes(text: str) -> tuple[tuple[int, int, int], tuple[float, float, float]]:
    """``x,-z,y``: the source's x stays, its z turned round becomes y, its y becomes z."""
    words = text.split(",")
    if sorted(word.lstrip("+-") for word in words) != ["x", "y", "z"] or not all(
        re.fullmatch("[+-]?[xyz]", word) for word in words
    ):
        raise InputError(
            "--axes", f"must name x, y and z once each, with or without a sign, such as x,-z,y; not {text}"
        )
    (i, a), (j, b), (k, c) = (("xyz".index(word[-1]), -1.0 if word[0] == "-" else 1.0) for word in words)
    return (i, j, k), (a, b, c)
