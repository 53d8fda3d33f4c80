"""The prescribed gas: still, fast, reversed, not a number; steps from far below to far above the relaxation time."""

from __future__ import annotations

import numpy as np
from draw import Draw
from drawn_scene import EITHER, HELD, NU_G, REFUSED, RHO_G, Clusters, Scene
from family import family
from invariants import velocity
from start_states import crowd, diameter


def loose(draw: Draw, d_p: float, speed: float, most: int = 8) -> tuple[Clusters, float]:
    """A few clusters far apart: no contacts, only gas."""
    n = draw.random.integers(3, 2001, draw.whole(1, most))
    side = 40.0 * float(diameter(d_p, 2000))
    x = draw.random.uniform(0.0, side, (len(n), 3))
    x[:, 1] = (np.arange(len(n)) + 0.5) * side / most  # each in a plane of its own
    v = speed * np.array([draw.direction() for _ in n])
    return Clusters(n, x, v), side


def stokes_time(scene: Scene) -> float:
    """Shortest relaxation time m/(3 pi rho_g nu_g d) of the scene's clusters."""
    n = scene.clusters.n
    return float((scene.mass(n) / (3.0 * np.pi * RHO_G * NU_G * scene.diameter(n))).min())


def uniform_gas(draw: Draw) -> tuple[float, float, float]:
    strength = draw.one_of([0.0, draw.log(1e-6, 300.0), 300.0])
    return tuple(float(u) for u in strength * draw.direction())


LAWS = ["stokes", "trancong 0.8 1.1", "schiller/naumann", "wen/yu 0.6", "difelice 0.6"]


@family(
    "gas",
    60,
    8,
    "1 to 8 clusters, d_p 1 µm…5 mm, in uniform gas of 0…300 m/s at 1e-6…300 m/s of their own, every drag law, "
    "exponential and explicit drag, Δt/τ (Stokes) 1e-3…1e4, np 1 and 2",
    "kinetic energy relative to the gas never rises. Explicit drag above Δt = 2τ grows without bounds: refused (with "
    "law stokes: exactly then)",
    "Explicit drag above 2τ ran on until clusters were thrown out of the box (14 of 60 scenes ended in “Lost "
    "atoms”): it is refused at once",
)
def gas(draw: Draw) -> Scene:
    d_p = draw.particle()
    clusters, side = loose(draw, d_p, draw.speed())
    scene = Scene(clusters, (side, side, side), 1.0, 60, d_p, momentum=False, energy=1e-12)
    u = uniform_gas(draw)
    law = draw.one_of(LAWS)
    exponential = draw.random.random() < 0.6
    ratio = draw.log(1e-3, 1e4)
    scene.dt = ratio * stokes_time(scene)
    # no cluster may cross a quarter of the box in a step: the engine would lose it whatever the drag
    fastest = float(np.linalg.norm(clusters.v, axis=1).max()) + float(np.linalg.norm(u))
    if fastest * scene.dt > 0.2 * side:
        shrink = 0.2 * side / (fastest * scene.dt)
        clusters.v *= shrink
        u = tuple(shrink * s for s in u)
    scene.frame = u
    integrator = "exponential" if exponential else "explicit"
    scene.gas = f"velocity {u[0]!r} {u[1]!r} {u[2]!r} law {law} integrator {integrator}"
    scene.limits = (3, 2000)
    scene.np_ = draw.one_of([1, 1, 2])
    if not exponential:
        scene.refusals = ("relaxation",)
        scene.expect = (REFUSED if ratio > 2.0 else HELD) if law == "stokes" else EITHER
    return scene


@family(
    "reversed gas",
    16,
    3,
    "gas of up to 300 m/s that turns round every 20 steps (equal-style variable), or blows up one half of the box "
    "and down the other (atom-style); exponential drag, Δt/τ 1e-3…1e4",
    "no cluster is ever faster than the fastest gas or its own start",
)
def reversed_gas(draw: Draw) -> Scene:
    d_p = draw.particle()
    clusters, side = loose(draw, d_p, 1e-6)
    scene = Scene(clusters, (side, side, side), 1.0, 200, d_p, momentum=False)
    scene.dt = draw.log(1e-3, 1e4) * stokes_time(scene)
    u = min(draw.log(1e-6, 300.0), 0.2 * side / scene.dt)  # no cluster may cross the box in a step
    own = min(1e-6, 0.2 * side / scene.dt)
    scene.clusters.v *= own / 1e-6
    if draw.random.random() < 0.5:
        scene.before_gas = f"variable w equal {u!r}*(1-2*(floor(step/20)%2))"
    else:
        scene.before_gas = f"variable w atom {u!r}*(1-2*(x<{0.5 * side!r}))"
    scene.gas = f"velocity 0 0 v_w law {draw.one_of(LAWS)} integrator exponential"
    scene.more = (slower_than(u + own),)
    return scene


def slower_than(limit: float):
    def check(scene, frames, run) -> str:
        fastest = max(float(np.linalg.norm(velocity(frame), axis=1).max()) for frame in frames)
        return "" if fastest <= limit * (1.0 + 1e-12) else f"a cluster reached {fastest}, the gas only {limit}"

    return check


BAD = [
    # (variable, which refusals are right)
    ("variable w equal 1.0/(step-10)", ("formula",)),
    ("variable w equal sqrt(9.5-step)", ("formula",)),
    ("variable w equal exp(800*(step>10))-exp(800*(step>10))", ("gas variable",)),
    ("variable w equal exp(800*(step>10))", ("gas variable",)),
    ("variable w equal -exp(800*(step>10))", ("gas variable",)),
    ("variable w atom exp(800*(step>10))*(id==1)", ("not a number",)),
    ("variable w atom (id==2)*1e200*(step>10)", ("not a number", "lost", "relaxation")),
    ("variable w atom exp(800*(step>10))-exp(800*(step>10))", ("not a number",)),
    ("variable w atom 1.0/(step-10)", ("formula",)),
]


@family(
    "bad gas",
    36,
    6,
    "a gas variable that turns to NaN, infinity, a division by zero or 1e200 m/s within a run, equal- and "
    "atom-style, for all clusters or one; with and without size law, np 1 and 2",
    "refused on the step where it happens, naming the variable or the fix",
    "atom-style variables: the error came on the same step already; nothing to fix",
)
def bad_gas(draw: Draw) -> Scene:
    variable, refusals = BAD[draw.index % len(BAD)]
    clusters, side = loose(draw, 1e-4, draw.log(1e-6, 10.0))
    while len(clusters) < 2:
        clusters, side = loose(draw, 1e-4, 1.0)
    scene = Scene(clusters, (side, side, side), 1e-6, 40, momentum=False)
    scene.before_gas = variable
    scene.gas = "velocity 0 0 v_w integrator " + draw.one_of(["explicit", "exponential"])
    if draw.random.random() < 0.5:
        scene.size = "K 0.0266 drag drag plane none"
        scene.every = draw.whole(1, 7)
    scene.expect, scene.refusals = REFUSED, refusals
    scene.np_ = draw.one_of([1, 2])
    return scene


@family(
    "gas and contacts",
    24,
    3,
    "20 to 100 clusters collide in uniform gas of 0…300 m/s, exponential drag, all drag laws, e 0.1…1, μ 0…10, np 1, "
    "2, 4",
    "kinetic (relative to the gas) + elastic energy ≤ start, to 4 (ω dt)²",
)
def gas_and_contacts(draw: Draw) -> Scene:
    d_p = draw.particle()
    n = draw.random.integers(200, 2001, draw.whole(20, 100))
    y = 2.0 * float(diameter(d_p, 2000))
    scene = Scene(Clusters(n, np.zeros((1, 3)), np.zeros((1, 3))), (1.0, 1.0, 1.0), 1.0, 1500, d_p, momentum=False)
    contact = scene.contact
    contact.k_n, contact.e, contact.mu = draw.stiffness(), draw.uniform(0.1, 1.0), draw.friction()
    omega = contact.frequency(0.5 * float(scene.mass(n.min())))
    scene.dt = np.pi / omega / 40.0
    speed = min(draw.speed(), 0.05 * float(scene.diameter(n.min())) * omega)
    scene.clusters, side = crowd(
        draw, d_p, n, speed, draw.uniform(1.05, 1.3), y, least=14.0 * float(diameter(d_p, 2000))
    )
    scene.box = (side, 2.0 * y, side)
    u = uniform_gas(draw)
    # the gas must not press the springs through: its drag is felt against a gas that clusters outrun
    share = min(1.0, 0.05 * float(scene.diameter(n.min())) * omega / max(float(np.linalg.norm(u)), 1e-300))
    u = tuple(share * s for s in u)
    scene.gas = f"velocity {u[0]!r} {u[1]!r} {u[2]!r} law {draw.one_of(LAWS)} integrator exponential"
    scene.frame = u
    scene.energy = 4.0 * (omega * scene.dt) ** 2
    scene.np_ = draw.one_of([1, 2, 4])
    return scene
