"""Contacts alone: impacts, time steps that are far too long, clusters at one point, a quiet box."""

from __future__ import annotations

import numpy as np
from draw import Draw
from drawn_scene import EITHER, HELD, REFUSED, Clusters, Contact, Scene
from family import family
from invariants import velocity
from start_states import crowd, diameter, meeting

EPS = 2.2e-16


def impact_scene(draw: Draw, contact: Contact, resolution: float, deepest: float = 0.4) -> Scene:
    """Two clusters that meet once; `resolution` steps per undamped contact time."""
    d_p = draw.particle()
    n = (draw.whole(3, 2000), draw.whole(3, 2000))
    d = tuple(float(diameter(d_p, k)) for k in n)
    scene = Scene(Clusters(np.array(n), np.zeros((2, 3)), np.zeros((2, 3))), (1.0, 1.0, 1.0), 1.0, 1, d_p, contact)
    m = tuple(float(scene.mass(k)) for k in n)
    omega = contact.frequency(m[0] * m[1] / (m[0] + m[1]))
    dt = np.pi / omega / resolution
    box = 6.0 * sum(d)
    # overlap stays below `deepest` of the smaller one; and a step moves clusters by far more than rounding
    speed = max(min(draw.speed(), deepest * min(d) * omega), 1e5 * EPS * box / dt)
    rounding = 4.0 * EPS * box / (speed * dt)
    offset = draw.one_of([0.0, draw.uniform(0.0, 0.95)])
    gap = draw.uniform(0.1, 3.0) * speed * min(dt, 1.0 / omega)
    zeta = contact.damping_ratio()
    contact_time = np.pi / (omega * np.sqrt(1.0 - zeta**2)) if zeta < 0.9999 else 40.0 / omega
    scene.clusters = meeting(draw, d, n, m, box, speed, gap, offset)
    scene.box = (box, box, box)
    scene.dt = dt
    scene.steps = int(np.ceil((gap / speed + 1.3 * contact_time) / dt)) + 2
    scene.limits = (3, max(n))
    scene.energy = 4.0 * (omega * dt) ** 2 + rounding
    if offset == 0.0:
        # entering a contact in mid-step costs the work of one step, damping at entry one step of it
        tolerance = (omega * dt) ** 2 + 3.0 * zeta * omega * dt + 10.0 * rounding
        scene.more = (restitution(contact.e, tolerance),)
    return scene


def restitution(e: float, tolerance: float):
    """Closed form of the linear spring-dashpot: rebound speed = e x approach speed."""

    def check(scene, frames, run) -> str:
        before, after = (np.diff(velocity(frame), axis=0)[0] for frame in (frames[0], frames[-1]))
        measured = -float(before @ after) / float(before @ before)
        return "" if abs(measured - e) <= tolerance else f"rebound {measured:.6g}, not {e:.6g} within {tolerance:.1e}"

    return check


@family(
    "impact",
    60,
    12,
    "two clusters meet once, head-on or oblique, anywhere in a periodic box: k_n 1e-2…1e6 N/m, e 1e-12…1, μ 0…10, "
    "1e-6…300 m/s (overlap kept below 0.4 d), d_p 1 µm…5 mm, 20…200 steps per contact; pair granular, np 1 and 2",
    "momentum; kinetic + elastic energy ≤ start·(1 + 4 (ω dt)²); head-on: rebound = e × approach to first order in ω "
    "dt",
)
def impact(draw: Draw) -> Scene:
    contact = Contact(draw.stiffness(), draw.restitution(zero=False), draw.friction())
    scene = impact_scene(draw, contact, draw.log(20.0, 200.0))
    scene.np_ = draw.one_of([1, 1, 2])
    return scene


@family(
    "coarse step",
    40,
    6,
    "a crowd in a closed box at 0.3…1e4 contact times per step, no step control; pair granular with both our fixes, "
    "np 1 and 2",
    "no cluster lost in silence, nothing not finite; momentum. Energy is not bounded: nothing in the engine watches "
    "the step",
)
def coarse_step(draw: Draw) -> Scene:
    return too_coarse(draw, Contact(draw.stiffness(), draw.restitution(zero=False), draw.friction()))


def too_coarse(draw: Draw, contact: Contact) -> Scene:
    d_p = draw.particle()
    n = draw.random.integers(3, 2001, draw.whole(2, 40))
    d = diameter(d_p, n)
    scene = Scene(Clusters(n, np.zeros((1, 3)), np.zeros((1, 3))), (1.0, 1.0, 1.0), 1.0, 300, d_p, contact)
    omega = contact.frequency(0.5 * float(scene.mass(n.min())))
    scene.dt = np.pi / omega * draw.log(0.3, 1e4)
    # fast enough to meet, slow enough that a step moves less than a diameter
    speed = draw.log(1e-3, 0.3) * float(d.min()) / scene.dt
    y = 2.0 * float(d.max())
    scene.clusters, side = crowd(
        draw, d_p, n, speed, draw.uniform(1.1, 2.0), y, least=14.0 * float(diameter(d_p, 2000))
    )
    scene.box = (side, 2.0 * y, side)
    scene.gas = "law none"
    scene.size = "K 1 drag drag break no merge no"
    scene.expect = EITHER
    scene.refusals = ("lost", "not a number", "non-numeric")
    scene.np_ = draw.one_of([1, 2])
    return scene


@family(
    "stock e = 0",
    8,
    2,
    "two clusters meet with e = 0 in pair granular, whose damping takes the logarithm of e; fix cluster/breakmerge or "
    "fix drag/cluster beside it",
    "refused at the contact: the force of that pair style is not a number (pair gran/cluster takes e = 0)",
    "As in “one point”",
)
def stock_zero(draw: Draw) -> Scene:
    scene = impact_scene(draw, Contact(draw.stiffness(), 1e-3, draw.friction()), 20.0)
    scene.contact.e = 0.0
    scene.more, scene.energy = (), None
    side, x = 8.0 * float(scene.diameter(2000)), scene.clusters.x
    apart = x[1] - x[0] - scene.box[0] * np.round((x[1] - x[0]) / scene.box[0])
    scene.clusters.x = np.array([np.full(3, 0.5 * side), 0.5 * side + apart])
    scene.box, scene.limits = (side, side, side), (3, 2000)
    if draw.index % 2:
        scene.gas = "law none"
    else:
        scene.size = "K 1 umf 0.001 terms cc mf break no merge no plane none"
    scene.expect, scene.refusals = REFUSED, ("not a number",)
    return scene


@family(
    "one point",
    24,
    4,
    "2 to 30 clusters at the very same point, or 1e-15…1e-3 d from it; k_n 1e-2…1e6, e 0.1…1; pair granular with fix "
    "cluster/breakmerge",
    "the same point has no direction to push: refused; any distance: momentum, energy ≤ start, kinetic energy from "
    "the springs included",
    "14 of 24 scenes ended well with positions that were not numbers (they also keep neighbor lists from being "
    "rebuilt, where the engine would look): fix cluster/breakmerge looks at each check",
)
def one_point(draw: Draw) -> Scene:
    contact = Contact(draw.stiffness(), draw.uniform(0.1, 1.0), draw.friction())
    d_p = draw.particle()
    count = draw.whole(2, 30)
    n = np.full(count, draw.whole(3, 2000))
    d = float(diameter(d_p, n[0]))
    same = draw.random.random() < 0.4
    side = 16.0 * float(diameter(d_p, 2000))
    x = np.full((count, 3), 0.37 * side)
    if not same:
        x += draw.log(1e-15, 1e-3) * d * draw.random.normal(size=(count, 3))
        same = len(np.unique(x, axis=0)) < count  # too near for the digits of a position
    scene = Scene(Clusters(n, x, np.zeros((count, 3))), (side, side, side), 1.0, 400, d_p, contact)
    scene.dt = np.pi / contact.frequency(0.5 * float(scene.mass(n[0])) / count) / 50.0
    scene.size = "K 1 umf 0.001 terms cc mf break no merge no"
    scene.energy = 0.05
    scene.expect, scene.refusals = (REFUSED, ("not a number",)) if same else (HELD, ())
    return scene


@family(
    "quiet box",
    4,
    1,
    "1e6 steps of six clusters at rest or at 1e-6 m/s, with checks every 100 steps, in still gas or none",
    "nothing drifts: momentum, energy ≤ start, no event",
)
def quiet_box(draw: Draw) -> Scene:
    gas = ["", "law none", "velocity 0 0 0", "velocity 0 0 0 integrator exponential"][draw.index % 4]
    n = np.full(6, 400)
    clusters, side = crowd(draw, 1e-4, n, [0.0, 1e-6][draw.index // 2 % 2], 2.5, 0.0015, least=0.012)
    scene = Scene(clusters, (side, 0.003, side), 1e-6, 1_000_000, gas=gas, every=100)
    scene.size = "K 0.0266 umf 0.0065 " + ("drag drag" if gas else "terms cc mf") + " merge no"
    scene.energy = 1e-9  # 1e6 roundings of 1e-16, all the same way
    scene.momentum = gas in ("", "law none")
    scene.more = (no_event,)
    return scene


def no_event(scene, frames, run) -> str:
    last = run.table()[-1]
    return "" if last[3] + last[4] == 0 else f"{last[3]:.0f} breakups and {last[4]:.0f} merges"
