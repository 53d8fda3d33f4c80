"""Runs that are taken up in the middle from a restart file, on as many ranks or on others."""

from __future__ import annotations

import numpy as np
from draw import Draw
from drawn_scene import EITHER, Clusters, Scene
from families_events import GAS, empty
from family import family
from invariants import Frame
from start_states import diameter, lattice

OWN = "fix own all property/atom d_mean d_split i_copy"
SET = (
    "variable s atom 1+0.5*sin(6361*z)\nvariable n atom 1+floor(1000*abs(sin(7919*x)))\nset group all d_mean v_s\n"
    "set group all d_split v_s\nset group all i_copy v_n"
)
TABLE = (
    "compute own all property/atom d_mean d_split i_copy\nvariable mean atom mass*c_own[1]\n"
    "compute sums all reduce sum v_mean c_own[2]\ncompute ends all reduce max c_own[3]\n"
    "variable mean_sum equal c_sums[1]\nvariable split_sum equal c_sums[2]\nvariable end equal c_ends\n"
    'fix sums all ave/time 1 1 10 v_mean_sum v_split_sum v_end mode scalar file {} format " %.17g"'
)


def sums_stay_through_the_restart(scene, frames: list[Frame], run) -> str:
    """To rounding of as many additions as there are clusters; copied integers are of the start."""
    table = np.vstack([run.table(name)[:, 1:] for name in ("sums.txt", "again.txt")])
    off = np.abs(table[:, :2] / table[0, :2] - 1.0).max()
    if not off < 1e-11:
        return f"sums of what clusters carry change by {off}"
    if np.any(table[:, 2] > table[0, 2]) or np.any(table[:, 2] != np.round(table[:, 2])):
        return f"a copied integer becomes {table[:, 2].max()}, above {table[0, 2]} of the start"
    return ""


@family(
    "resumed",
    30,
    4,
    "up to 400 clusters that break into threes to hundreds, and merge, with columns by the rules mean, split and copy; the second "
    "half of the steps goes on from a restart file, on 1, 2 or 4 ranks after 1, 2 or 4; each `test`",
    "particles and counts of events through the restart, no overlap at birth; sums of what is carried",
)
def resumed(draw: Draw) -> Scene:
    d_p = draw.particle()
    each = draw.whole(60, 2000)
    d, largest = float(diameter(d_p, each)), float(diameter(d_p, 2000))
    columns = draw.whole(6, 20)
    x, length, width = lattice(columns, columns, draw.uniform(1.01, 3.0) * d, 2.0 * d)
    scene = empty((max(length, 13.0 * largest), 4.0 * largest, max(width, 13.0 * largest)))
    scene.d_p, scene.momentum = d_p, False
    scene.clusters = Clusters(np.full(len(x), each), x, np.zeros((len(x), 3)))
    scene.gas = GAS
    scene.size = (
        f"K {float(diameter(d_p, draw.whole(3, max(each // 3, 4)))) * 1e-3 * draw.log(1e-3, 1e3)!r} drag drag merge 0.2 "
        f"terms st cc test {draw.one_of(['always', 'contact', 'end'])} carry d_mean mean carry d_split split carry i_copy copy"
    )
    scene.dt, scene.steps, scene.frames, scene.every = 1e-12, 40, 4, draw.one_of([1, 5])
    scene.np_, scene.resumed_np = draw.one_of([1, 2, 4]), draw.one_of([1, 2, 4])
    scene.expect, scene.refusals = EITHER, ("thin rank",)
    scene.extra = "\n".join([OWN, SET, TABLE.format("sums.txt")])
    scene.extra_again = "\n".join([OWN, TABLE.format("again.txt")])
    scene.more = (sums_stay_through_the_restart,)
    return scene
