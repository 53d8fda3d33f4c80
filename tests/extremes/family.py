"""Families of scenes: what each tries, what must hold, what was found; a registry of their draws."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from draw import Draw
from drawn_scene import Scene

SEED = 2007


@dataclass
class Family:
    """`small` scenes of the `count` stay in the test suite."""

    name: str
    count: int
    small: int
    tried: str
    holds: str
    found: str
    draw: Callable[[Draw], Scene]

    def scene(self, index: int, seed: int = SEED) -> Scene:
        draw = Draw(seed, self.name, index)
        scene = self.draw(draw)
        scene.family, scene.index = self.name, index
        return scene


FAMILIES: dict[str, Family] = {}


def family(name: str, count: int, small: int, tried: str, holds: str, found: str = "–"):
    def register(draw: Callable[[Draw], Scene]):
        FAMILIES[name] = Family(name, count, small, tried, holds, found, draw)
        return draw

    return register
