"""Breakup and merging at their ends: all at once, none, on every border, with every option."""

from __future__ import annotations

import numpy as np
from draw import Draw
from drawn_scene import EITHER, HELD, REFUSED, Clusters, Contact, Scene
from family import family
from invariants import contacts
from start_states import crowd, diameter, lattice

UP = (0.0, 0.0, 50.0)  # a gas that powers breaks; energy is bounded in its frame
GAS = "velocity 0 0 50 law stokes plane xz integrator exponential"


def table_check(column: int, name: str, least: int = 0, most: float = np.inf):
    """A total of fix cluster/breakmerge at the end (1-based entry of its vector) lies in a range."""

    def check(scene, frames, run) -> str:
        value = run.table()[-1, column]
        return "" if least <= value <= most else f"{value:.0f} {name}, expected {least} to {most}"

    return check


BREAKUPS, MERGES = 3, 4


def no_overlap(scene, frames, run) -> str:
    """Fragments are born beside each other and beside everybody else."""
    for k, frame in enumerate(frames):
        overlap = contacts(scene, frame)[2]
        if overlap.max(initial=0.0) > 1e-9 * frame["diameter"].max():
            return f"an overlap of {overlap.max()} in frame {k}"
    return ""


def empty(box: tuple[float, float, float]) -> Scene:
    return Scene(Clusters(np.empty(0, int), np.empty((0, 3)), np.empty((0, 3))), box, 1e-6, 20)


@family(
    "all break",
    16,
    3,
    "up to 5000 clusters of 2000 that all must break into threes at one check, in boxes from far too full to roomy; "
    "np 1, 2, 4. Scene 0: 5000 clusters, 3.3 million pieces asked for in a box that has no room",
    "particles, no overlap at birth, kinetic energy relative to the gas never rises, breaks go in stages or wait",
)
def all_break(draw: Draw) -> Scene:
    d_p = 1e-4 if draw.index < 4 else draw.particle()
    count = 5000 if draw.index == 0 else draw.whole(60, 500)
    spacing = 1.01 if draw.index == 0 else draw.uniform(1.001, 3.0)
    d = float(diameter(d_p, 2000))
    columns = int(np.ceil(np.sqrt(count)))
    x, length, width = lattice(columns, columns, spacing * d, 2.0 * d)
    scene = empty((length, 4.0 * d, width))
    scene.d_p, scene.momentum, scene.energy, scene.frame = d_p, False, 1e-9, UP
    scene.clusters = Clusters(np.full(count, 2000), x[:count], np.zeros((count, 3)))
    scene.gas = GAS
    scene.size = "K 1e-300 drag drag merge no terms st"
    # short: fragments of different sizes are blown at different speeds and would meet
    scene.dt, scene.steps, scene.frames = 1e-12, 30, 3
    scene.np_ = 1 if draw.index == 0 else draw.one_of([1, 2, 4])
    scene.time_limit = 300.0
    tight = min(length, width) < 4.0 * 1.6 * d
    if tight:
        scene.expect, scene.refusals = REFUSED, ("short box",)
    elif scene.np_ > 1:
        scene.expect, scene.refusals = EITHER, ("thin rank",)
    scene.more = (no_overlap, table_check(BREAKUPS, "breakups", least=1 if spacing > 2.2 else 0))
    return scene


@family(
    "all merge",
    24,
    6,
    "up to 1000 clusters at one velocity, half of the scenes spinning at random: as touching pairs apart from each "
    "other, so that all merge at one check, or as a lattice where each touches four; limits up to 2000 and up to "
    "20000, np 1, 2, 4",
    "particles, mass, momentum; kinetic (spin included) + elastic energy never rises (each merge may put in 1e-6 of "
    "its own); every pair merges",
    "The merged cluster took the mass-weighted mean of the spins, whose energy can exceed that of both parents (up "
    "to +59 %): it now keeps their spin angular momentum, which never adds energy",
)
def all_merge(draw: Draw) -> Scene:
    pairs, spinning = draw.index % 2 == 0, draw.index // 2 % 2 == 0
    d_p = draw.particle()
    each = draw.whole(3, 300)
    hi = draw.one_of([2000, 20_000])
    count = 2 * draw.whole(50, 500)
    d = float(diameter(d_p, each))
    largest = float(diameter(d_p, hi))
    spacing = 2.5 * d if pairs else 0.999 * d
    points = count // 2 if pairs else count
    columns = max(int(np.ceil(np.sqrt(points))), int(np.ceil(13.0 * largest / spacing)))
    x, length, width = lattice(columns, columns, spacing, 1.5 * largest)
    x = x[draw.random.permutation(len(x))[:points]] if draw.random.random() < 0.5 else x[:points]
    scene = empty((length, 3.0 * largest, width))
    scene.d_p = d_p
    scene.contact = Contact(draw.stiffness(), draw.uniform(0.1, 1.0), draw.friction())
    omega = scene.contact.frequency(0.5 * float(scene.mass(each)))
    scene.dt, scene.steps = np.pi / omega / 50.0, 100
    # it is the merging that is tried, not flight over half the box in a step
    speed = min(max(draw.speed(), 1e-7 * d * omega), 0.2 * d / scene.dt)
    if pairs:
        # so little that it does not push them apart first
        overlap = min(1e-4 * d, 0.05 * speed / omega / (1.0 + scene.contact.mu))
        aside = 0.5 * (d - overlap) * np.array([draw.direction() for _ in x])
        x = np.concatenate([x - aside, x + aside])
    scene.clusters = Clusters(np.full(len(x), each), x, np.tile(speed * draw.direction(), (len(x), 1)))
    if spinning:
        spin = np.array([0.0, speed / d * draw.log(0.1, 100.0), 0.0])  # the same for all: a mean would keep it
        scene.clusters.omega = spin + 0.1 * spin[1] * draw.random.normal(size=(len(x), 3))
    scene.limits = (3, hi)
    scene.size = "K 1e300 umf 0.001 terms mf"
    scene.energy = 0.01
    scene.np_ = draw.one_of([1, 2, 4])
    scene.more = (table_check(MERGES, "merges", count // 2, count // 2),) if pairs else ()
    return scene


def values_of_k() -> list[tuple[str, str, tuple[str, ...]]]:
    bad = [(k, REFUSED, ("K",)) for k in ("0", "-0.0", "-1", "-1e-300", "-1e300", "nan", "inf", "-inf")]
    good = [(k, HELD, ()) for k in ("1e-300", "1e-308", "1e-30", "1e-6", "1", "1e6", "1e100", "1e300")]
    emms = [
        ("emms 0", REFUSED, ("K",)),
        ("emms -1", REFUSED, ("K",)),
        ("emms 1e-9", REFUSED, ("K emms",)),
        ("emms 1e-300", REFUSED, ("K emms",)),
        ("emms 0.01", HELD, ()),
        ("emms 1e300", HELD, ()),
    ]
    return bad + good + emms


@family(
    "K",
    44,
    5,
    "K 0, negative, not a number, infinite, 1e-308…1e300, K emms of 0…1e300, on a crowd in gas; two rounds",
    "K <= 0 or not finite is refused with the rule; others: particles, energy relative to the gas, sizes within limits",
)
def size_constant(draw: Draw) -> Scene:
    values = values_of_k()
    k, expect, refusals = values[draw.index % len(values)]
    scene = small_crowd(draw, draw.whole(10, 60))
    scene.gas, scene.frame, scene.momentum = GAS, UP, False
    scene.size = f"K {k} drag drag"
    scene.expect, scene.refusals = expect, refusals
    return scene


def small_crowd(draw: Draw, count: int, least: float = 14.0, lo: int = 3, hi: int = 2000) -> Scene:
    """A crowd in the plane that fits the default claim, at speeds that keep overlaps below some 5 % of d."""
    d_p = draw.particle()
    n = draw.random.integers(lo, hi + 1, count)
    largest = float(diameter(d_p, 2000))
    scene = empty((1.0, 4.0 * largest, 1.0))
    scene.d_p = d_p
    scene.contact = Contact(draw.stiffness(), draw.uniform(0.1, 1.0), draw.friction())
    omega = scene.contact.frequency(0.5 * float(scene.mass(3)))
    scene.dt, scene.steps = np.pi / omega / 40.0, 1000
    slowest = scene.contact.frequency(0.5 * float(scene.mass(2000)))
    speed = min(draw.speed(), 0.05 * float(scene.diameter(3)) * slowest)
    scene.clusters, side = crowd(draw, d_p, n, speed, draw.uniform(1.02, 1.5), 2.0 * largest, least * largest)
    scene.box = (side, 4.0 * largest, side)
    scene.energy = 4.0 * (omega * scene.dt) ** 2
    return scene


@family(
    "E_in zero",
    12,
    3,
    "E_in* exactly 0: still gas and clusters at rest; contact term alone without a contact; contact term times 0",
    "l is the upper limit for all, nothing breaks, nothing is divided by zero",
)
def zero_power(draw: Draw) -> Scene:
    scene = small_crowd(draw, draw.whole(1, 40))
    scene.size = [
        "K 0.0266 terms cc umf 0.001 merge no",
        "K 0.0266 terms st drag drag merge no",
        "K 1e-300 terms cc ncc 0 umf 0.001 merge no",
    ][draw.index % 3]
    if "st" in scene.size:
        scene.gas = "velocity 0 0 0"
    scene.clusters.v[:] = 0.0
    scene.more = (upper_limit, table_check(BREAKUPS, "breakups", most=0))
    return scene


def upper_limit(scene, frames, run) -> str:
    hi = float(scene.diameter(scene.limits[1]))
    far = np.abs(frames[-1]["f_size[3]"] / hi - 1.0).max()
    return "" if far < 1e-12 else f"a stable diameter is {far:.1e} off the upper limit"


OPTIONS = {
    "nst": ["particle", "cluster", "cell"],
    "nsmf": ["emms", "paper"],
    "up": ["own", "cell", "superficial"],
    "ncc": ["0", "0.1", "1", "1e6"],
    "test": ["always", "contact", "end"],
    "hysteresis": ["0", "0.1", "0.26", "3"],
    "merge": ["no", "0.01", "0.2", "1e300"],
    "refused": ["leave", "break"],
    "spacing": ["1", "1.01", "2", "2.2"],
    "break": ["yes", "yes", "yes", "no"],
    "plane": ["xz", "none"],
}


@family(
    "options",
    70,
    8,
    "a crowd of 2 to 60 colliding clusters with every option of fix cluster/breakmerge drawn at random, K 1e-6…1e3, "
    "contact power and gas, k_n, e, μ, d_p over their ranges, checks every 1 to 20 steps, np 1, 2, 4",
    "particles, mass, counts of events; momentum where no gas acts; kinetic (relative to the gas) + elastic energy ≤ "
    "start",
    "as in “all merge”",
)
def options(draw: Draw) -> Scene:
    scene = small_crowd(draw, draw.whole(2, 60))
    scene.steps, scene.frames = 400, 5
    words = [f"{name} {draw.one_of(values)}" for name, values in OPTIONS.items()]
    words.append(f"grid {draw.whole(1, 30)} {draw.whole(1, 3)} {draw.whole(1, 30)}")
    scene.size = f"K {draw.log(1e-6, 1e3)!r} drag drag " + " ".join(words)
    if draw.random.random() < 0.5:
        scene.gas = "velocity 3 0 5 law none"
    else:
        scene.gas, scene.frame, scene.momentum = GAS, UP, False
    scene.every = draw.whole(1, 20)
    if "plane none" in scene.size:
        scene.box = (scene.box[0], scene.box[0], scene.box[2])
        if scene.box[0] < 6.5 * float(scene.diameter(2000)):
            scene.expect = EITHER
    scene.np_ = draw.one_of([1, 2, 4])
    if scene.np_ > 1:
        scene.expect, scene.refusals = EITHER, ("thin rank",)
    # of 1 to some hundreds of merges each may put in 1e-6
    scene.energy += 1e-3
    return scene


@family(
    "few",
    36,
    6,
    "no cluster, one, or two; one cell, or up to 1e6 cells for cell averages and gusts; np 1, 2, 4, so that ranks "
    "have no cluster",
    "as ever; nothing waits for a rank that has nothing",
)
def few(draw: Draw) -> Scene:
    count = draw.index % 3
    largest = float(diameter(1e-4, 2000))
    side = 20.0 * largest
    x = draw.random.uniform(0.0, side, (count, 3))
    x[:, 1] = 2.0 * largest
    scene = empty((side, 4.0 * largest, side))
    scene.clusters = Clusters(draw.random.integers(3, 2001, count), x, np.zeros((count, 3)))
    cells = draw.one_of(["1 1 1", "100 1 100", "100 100 100", "7 1 1"])
    scene.gas = f"{GAS} fluctuation 0.75 0 0.75 cell {cells} 1e-5 7"
    scene.size = f"K {draw.log(1e-6, 1.0)!r} drag drag nst cell up {draw.one_of(['cell', 'superficial'])} grid {cells}"
    scene.steps, scene.every, scene.momentum = 100, draw.whole(1, 3), False
    scene.np_ = [1, 2, 4][draw.index // 3 % 3]
    scene.time_limit = 60.0
    return scene


@family(
    "borders",
    36,
    4,
    "pairs that touch exactly across periodic corners, faces and the borders between ranks, moving together, and "
    "clusters sitting on them that must break; np 1, 2, 4",
    "every pair merges once, every big one breaks, whatever the ranks; momentum or energy relative to the gas",
)
def borders(draw: Draw) -> Scene:
    largest = float(diameter(1e-4, 2000))
    side = 32.0 * largest
    spots = side * np.array([[0.0, 0.0], [0.0, 0.5], [0.5, 0.0], [0.5, 0.5], [0.25, 0.0], [0.0, 0.25], [0.75, 0.5]])
    y = draw.one_of([0.0, 2.0 * largest])
    scene = empty((side, 4.0 * largest, side))
    pairs = draw.index % 2 == 0
    points, n = [], []
    for spot in spots:
        where = np.array([spot[0], y, spot[1]])
        if pairs:
            d = float(diameter(1e-4, 400))
            aside = 0.4999999 * d * draw.direction()
            points += [where - aside, where + aside]
            n += [400, 400]
        else:
            points.append(where)
            n.append(2000)
    v = draw.one_of([1e-3, 0.1, 10.0]) * np.array([1.0, 0.0, -1.0])
    x = np.mod(np.array(points), scene.box)
    x[x >= np.array(scene.box)] = 0.0
    scene.clusters = Clusters(np.array(n), x, np.tile(v, (len(n), 1)))
    scene.steps = 200
    scene.np_ = [1, 2, 4][draw.index // 2 % 3]
    if pairs:
        scene.size = "K 1e300 umf 0.001 terms mf"
        scene.more = (table_check(MERGES, "merges", 7, 7),)
        scene.energy = 1e-3
    else:
        scene.gas, scene.frame, scene.momentum, scene.energy = GAS, UP, False, 1e-3
        scene.size = "K 1e-300 terms st drag drag merge no"
        scene.more = (table_check(BREAKUPS, "breakups", 7), table_check(1, "clusters", 7 * 200))
    return scene


@family(
    "small box",
    30,
    5,
    "one or two clusters in a periodic box of 0.3 to 8 largest diameters, smaller than the pair cutoff, than a "
    "cluster, than a claim; with and without fix cluster/breakmerge, np 1, 2, 4",
    "below four claims the fix refuses; else, and without it, momentum and energy (all images counted)",
)
def small_box(draw: Draw) -> Scene:
    d_p = draw.particle()
    n = draw.random.integers(3, 2001, draw.whole(1, 2))
    largest = float(diameter(d_p, 2000))
    side = draw.log(0.3, 8.0) * largest
    scene = empty((side, side, side))
    scene.d_p = d_p
    scene.contact = Contact(draw.stiffness(), draw.uniform(0.1, 1.0), draw.friction())
    x = draw.random.uniform(0.0, side, (len(n), 3))
    scene.clusters = Clusters(n, x, np.zeros((len(n), 3)))
    scene.clusters.v = (
        0.01 * side * scene.contact.frequency(float(scene.mass(2000))) * np.array([draw.direction() for _ in n])
    )
    # a cluster is pushed by many images at once
    images = (2.0 * largest / side + 1.0) ** 3
    scene.dt = np.pi / scene.contact.frequency(0.5 * float(scene.mass(n.min())) / images) / 50.0
    scene.steps, scene.energy = 500, 0.05
    scene.np_ = draw.one_of([1, 2, 4])
    if draw.random.random() < 0.5:
        scene.size = "K 1e300 umf 0.001 terms mf"
        if side < 6.4 * largest:
            scene.expect, scene.refusals = REFUSED, ("short box",)
    return scene


@family(
    "leaving",
    12,
    2,
    "a cluster flies out of a box with fixed sides while others break or merge at every check; np 1, 2",
    "refused: lost atoms, never a smaller number of particles in silence",
    "Events recounted all clusters and so hid one that had left: 7 of 12 runs ended well with fewer particles. "
    "Events now add what they made to the number of clusters, and the engine's own test finds the loss",
)
def leaving(draw: Draw) -> Scene:
    scene = small_crowd(draw, draw.whole(20, 60), least=30.0)
    scene.boundary = "f p f"
    scene.gas, scene.frame, scene.momentum, scene.energy = GAS, UP, False, None
    scene.size = "K 1e-300 terms st drag drag merge no"
    side = scene.box[0]
    far = int(np.argmax(scene.clusters.x[:, 0]))
    scene.steps = 400
    away = side - scene.clusters.x[far, 0]
    scene.clusters.v[far, 0] = 3.0 * (away + float(scene.diameter(2000))) / (scene.steps * scene.dt)
    step = scene.clusters.v[far, 0] * scene.dt
    if step > 0.1 * side:
        scene.steps = 4000
        scene.clusters.v[far, 0] /= 10.0
    scene.every = draw.whole(1, 5)
    scene.frames = draw.one_of([1, 10])
    scene.np_ = draw.one_of([1, 2])
    scene.expect, scene.refusals = REFUSED, ("lost", "thin rank")
    return scene


@family(
    "atom IDs",
    8,
    2,
    "atom IDs up to the largest of the engine (2147483646): clusters that break, or merge; np 1, 2",
    "breaks that would need a higher ID are refused before they happen, merges go on",
)
def atom_ids(draw: Draw) -> Scene:
    scene = small_crowd(draw, 20)
    breaking = draw.index % 2 == 0
    scene.clusters.ids = 2147483646 - np.arange(20)
    scene.steps = 200
    scene.np_ = draw.one_of([1, 2])
    if breaking:
        scene.clusters.n[:] = 2000
        scene.gas, scene.momentum, scene.energy = GAS, False, None
        scene.clusters, side = crowd(
            draw, scene.d_p, scene.clusters.n, 0.0, 3.0, scene.box[1] / 2, 14 * float(scene.diameter(2000))
        )
        scene.clusters.ids = 2147483646 - np.arange(20)
        scene.box = (side, scene.box[1], side)
        scene.size = "K 1e-300 terms st drag drag merge no"
        scene.expect, scene.refusals = REFUSED, ("atom ID",)
    else:
        scene.size = "K 1e300 umf 0.001 terms mf merge 1e300"
        scene.energy += 1e-3
    return scene


WORDS: list[tuple[str, str]] = [
    # keyword and value; the only refusal that is right, or "" where it must hold
    ("void 0.999999999", "whole number"),
    ("spacing 1e6", "small claim"),
    ("hysteresis 1e300", ""),
    ("epsmf 0.999999999", ""),
    ("umf 1e300", ""),
    ("umf 1e-300", ""),
    ("gravity 1e300 z", ""),
    ("gravity 1e-300 x", ""),
    ("ncc 1e300", ""),
    ("merge 1e-300", ""),
    ("limits 1 2000000000", "pair cutoff"),
    ("limits 2000 2000", ""),
    ("limits 1 1", "too large"),
    ("claim 1e300", "ghost cutoff"),
    ("grid 2147483647 2147483647 2147483647 up cell", "many cells"),
    ("wide limits", "many sites"),
]


@family(
    "words",
    32,
    8,
    "numbers at the far end of what each keyword takes: voidage 1-1e-9, spacing 1e6, 1e±300, limits up to 2e9, "
    "(2^31)^3 cells; two rounds",
    "as ever, or refused with the reason; no hang, no memory without end",
    "A grid of (2^31)^3 cells ended in a segmentation fault: more than 1e8 cells are refused. Limits 1 to 3e6 with "
    "plane none listed lattice sites for 44 s and ran out of 8 GB: more than 1e7 sites are refused",
)
def words(draw: Draw) -> Scene:
    scene = small_crowd(draw, draw.whole(2, 30))
    word, refusal = WORDS[draw.index % len(WORDS)]
    scene.gas, scene.frame, scene.momentum = GAS, UP, False
    scene.energy += 1e-3
    if word == "wide limits":
        scene.limits, word = (1, 3_000_000), "plane none spacing 1"
        scene.box = (7.0 * float(scene.diameter(3_000_000)),) * 3
    scene.size = f"K {draw.log(1e-6, 1.0)!r} drag drag {word}"
    scene.steps, scene.time_limit = 200, 30.0
    if refusal:
        scene.expect, scene.refusals = REFUSED, (refusal,)
    return scene
