"""Other people's fixes around ours: balance, walls, heat and a divided column, cutoffs by type."""

from __future__ import annotations

import numpy as np
from draw import Draw
from drawn_scene import EITHER, Clusters, Scene
from families_events import GAS, empty
from family import family
from start_states import diameter, lattice

COLUMNS = (
    "fix own all property/atom temperature heatflow d_share\n"
    "variable t atom 300+50*sin(7919*x)\nvariable s atom 1+0.5*sin(6361*z)\n"
    "set group all temperature v_t\nset group all d_share v_s\n"
    "compute own all property/atom temperature d_share\nvariable heat atom mass*c_own[1]\n"
    "compute sums all reduce sum v_heat c_own[2]\n"
    'fix sums all ave/time 1 1 10 c_sums[*] mode scalar file sums.txt format " %.17g"'
)
PLANES = "granular hooke 10 0.3 tangential linear_history 8.57 1.0 0.33 damping coeff_restitution"


def sums_stay(scene, frames, run) -> str:
    """Heat and a column that is divided, to rounding of as many additions as there are clusters."""
    table = run.table("sums.txt")[:, 1:]
    off = np.abs(table / table[0] - 1.0).max()
    return "" if off < 1e-11 else f"sums of what clusters carry change by {off}"


def within(lo: float, hi: float):
    def check(scene, frames, run) -> str:
        for k, frame in enumerate(frames):
            r = 0.5 * frame["diameter"]
            out = max((lo - frame["z"] + r).max(initial=-1.0), (frame["z"] + r - hi).max(initial=-1.0))
            if out > 1e-6 * (hi - lo):
                return f"a cluster sticks {out} into a wall in frame {k}"
        return ""

    return check


@family(
    "neighbors",
    30,
    5,
    "up to 400 clusters that break into threes to hundreds at one check or cascade, beside fix balance, planes within the box, planes that "
    "move, temperature and a divided column, cutoffs by type (comm mode multi); np 1, 2, 4",
    "particles in whole numbers; heat and divided columns to rounding; nobody in a wall",
)
def neighbors(draw: Draw) -> Scene:
    d_p = draw.particle()
    each = draw.whole(60, 2000)
    d, largest = float(diameter(d_p, each)), float(diameter(d_p, 2000))
    columns = draw.whole(8, 20)
    x, length, width = lattice(columns, columns, draw.uniform(1.01, 3.0) * d, 2.0 * d)
    scene = empty((max(length, 13.0 * largest), 4.0 * largest, max(width, 13.0 * largest)))
    scene.d_p, scene.momentum = d_p, False
    scene.clusters = Clusters(np.full(len(x), each), x, np.zeros((len(x), 3)))
    scene.gas = GAS
    scene.size = f"K {float(diameter(d_p, draw.whole(3, max(each // 3, 4)))) * 1e-3 * draw.log(1e-3, 1e3)!r} drag drag merge 0.2 terms st cc"
    scene.dt, scene.steps, scene.frames, scene.every = 1e-12, 40, 4, draw.one_of([1, 5])
    scene.np_ = draw.one_of([1, 2, 4])
    scene.expect, scene.refusals = EITHER, ("thin rank",)
    kind = draw.index % 5
    if kind == 0:
        scene.extra = "fix even all balance 10 1.0 shift xz 5 1.0"
    elif kind in (1, 2):
        scene.boundary = "p p f"
        move = f" wiggle z {1e-3 * d!r} {10 * scene.dt!r}" if kind == 2 else ""
        lowest, highest = float(x[:, 2].min()) - 0.5 * d, float(x[:, 2].max()) + 0.5 * d
        lo, hi = lowest - 2e-3 * d, highest + 3e-3 * d
        if lo < 0.0 or hi > scene.box[2]:
            scene.clusters.x[:, 2] += 4e-3 * d - lowest
            lo, hi = 2e-3 * d, highest - lowest + 7e-3 * d
        scene.extra = f"fix planes all wall/gran {PLANES} zplane {lo!r} {hi!r}{move}"
        scene.more = (within(lo, hi + (2e-3 * d if kind == 2 else 0.0)),)
    elif kind == 3:
        scene.size += " carry d_share split"
        scene.extra = COLUMNS
        scene.more = (sums_stay,)
    else:
        scene.extra = (
            f"neighbor {scene.skin()!r} multi\ncomm_modify mode multi vel yes cutoff/multi * {scene.ghost()!r}"
        )
    return scene
