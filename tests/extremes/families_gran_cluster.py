"""pair gran/cluster over the same ranges: both atom styles, every reading of the tangential force."""

from __future__ import annotations

import numpy as np
from draw import Draw
from drawn_scene import EITHER, HELD, REFUSED, Clusters, Contact, Scene
from families_contact import impact_scene, too_coarse
from family import family
from start_states import diameter


def tangential(draw: Draw) -> str:
    if draw.random.random() < 0.25:
        return "tangential " + draw.one_of(["linear", "none"])
    limit = draw.one_of(["", "delta_max poisson 0.5", "delta_max poisson -0.5", "delta_max kt {k}"])
    return "tangential md " + limit + " " + draw.one_of(["", "direction velocity"])


def contact_of(draw: Draw) -> Contact:
    contact = Contact(draw.stiffness(), draw.restitution(), draw.friction(), "gran/cluster")
    contact.words = tangential(draw).format(k=repr(contact.k_n * draw.log(0.01, 10.0)))
    return contact


@family(
    "gran/cluster impact",
    60,
    10,
    "two clusters meet once, as in “impact”, with pair gran/cluster: e 0…1 (0 itself included), every tangential "
    "keyword; atom styles sphere and cluster, np 1 and 2",
    "momentum; kinetic + elastic energy ≤ start·(1 + 4 (ω dt)²); head-on: rebound = e × approach to first order in ω "
    "dt",
)
def gran_impact(draw: Draw) -> Scene:
    scene = impact_scene(draw, contact_of(draw), draw.log(20.0, 200.0))
    scene.atom_style = draw.one_of(["sphere", "cluster"])
    scene.np_ = draw.one_of([1, 1, 2])
    return scene


@family(
    "gran/cluster one point",
    16,
    3,
    "2 to 30 clusters at one point or 1e-15…1e-3 d from it, pair gran/cluster, both atom styles",
    "the same point: refused, naming the pair; any distance: momentum and energy",
)
def gran_one_point(draw: Draw) -> Scene:
    contact = contact_of(draw)
    contact.e = max(contact.e, 0.1)
    d_p, count = draw.particle(), draw.whole(2, 30)
    n = np.full(count, draw.whole(3, 2000))
    side = 16.0 * float(diameter(d_p, 2000))
    x = np.full((count, 3), 0.37 * side)
    same = draw.random.random() < 0.4
    if not same:
        x += draw.log(1e-15, 1e-3) * float(diameter(d_p, n[0])) * draw.random.normal(size=(count, 3))
        same = len(np.unique(x, axis=0)) < count
    scene = Scene(Clusters(n, x, np.zeros((count, 3))), (side, side, side), 1.0, 400, d_p, contact)
    scene.atom_style = draw.one_of(["sphere", "cluster"])
    scene.dt = np.pi / contact.frequency(0.5 * float(scene.mass(n[0])) / count) / 50.0
    scene.energy = 0.05
    scene.expect, scene.refusals = (REFUSED, ("not a number",)) if same else (HELD, ())
    return scene


@family(
    "gran/cluster coarse step",
    24,
    4,
    "a crowd at 0.3…1e4 contact times per step, pair gran/cluster, no step control",
    "no cluster lost in silence, nothing not finite; momentum. Energy is not bounded",
)
def gran_coarse(draw: Draw) -> Scene:
    scene = too_coarse(draw, contact_of(draw))
    scene.atom_style = draw.one_of(["sphere", "cluster"])
    scene.expect = EITHER
    return scene
