"""Random draws of a scene's parameters: every scene has its own stream, so it can be drawn alone."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from typing import TypeVar

import numpy as np

T = TypeVar("T")


class Draw:
    """Numbers of one scene, a function of (seed, family, index) alone."""

    def __init__(self, seed: int, family: str, index: int) -> None:
        self.index = index
        self.random = np.random.default_rng([seed, zlib.crc32(family.encode()), index])

    def log(self, lo: float, hi: float) -> float:
        """Uniform in the logarithm; the ends themselves one time in twenty each, since faults sit there."""
        where = self.random.random()
        if where < 0.05:
            return lo
        if where > 0.95:
            return hi
        return float(np.exp(self.random.uniform(np.log(lo), np.log(hi))))

    def uniform(self, lo: float, hi: float) -> float:
        return float(self.random.uniform(lo, hi))

    def whole(self, lo: int, hi: int) -> int:
        """From lo to hi, both included."""
        return int(self.random.integers(lo, hi + 1))

    def one_of(self, choices: Sequence[T]) -> T:
        return choices[int(self.random.integers(len(choices)))]

    def direction(self, planar: bool = True) -> np.ndarray:
        v = self.random.normal(size=3)
        if planar:
            v[1] = 0.0
        return v / np.linalg.norm(v)

    # ---- the ranges of the campaign

    def stiffness(self) -> float:
        return self.log(1e-2, 1e6)

    def restitution(self, zero: bool = True) -> float:
        e = self.one_of([0.0, 1e-12, 1.0, 0.3, 0.9, self.uniform(0.0, 1.0), self.uniform(0.0, 1.0)])
        return e if e > 0.0 or zero else 0.5

    def friction(self) -> float:
        return self.one_of([0.0, 0.33, 10.0, self.uniform(0.0, 10.0)])

    def speed(self) -> float:
        return self.log(1e-6, 300.0)

    def particle(self) -> float:
        return self.log(1e-6, 5e-3)
