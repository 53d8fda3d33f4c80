"""Clusters that come and go by other commands, other atoms among them, groups, and every rule of what clusters carry."""

from __future__ import annotations

import numpy as np
from draw import Draw
from drawn_scene import EITHER, RHO_P, Clusters, Scene
from families_events import GAS, empty
from families_neighbors import sums_stay
from family import family
from invariants import Frame, contacts
from start_states import diameter, lattice

# one column for each rule; m times a column of the rule mean stays, the sum of one of the rule split, a copy is one of those at the start
COLUMNS = (
    "fix own all property/atom d_mean d_split i_copy\n"
    "variable s atom 1+0.5*sin(6361*z)\nvariable n atom 1+floor(1000*abs(sin(7919*x)))\n"
    "set group all d_mean v_s\nset group all d_split v_s\nset group all i_copy v_n\n"
    "compute own all property/atom d_mean d_split i_copy\nvariable mean atom mass*c_own[1]\n"
    "compute sums all reduce sum v_mean c_own[2]\ncompute ends all reduce max c_own[3]\n"
    'fix sums all ave/time 1 1 10 c_sums[*] mode scalar file sums.txt format " %.17g"\n'
    'fix ends all ave/time 1 1 10 c_ends mode scalar file ends.txt format " %.17g"'
)


def copies_are_of_the_start(scene, frames: list[Frame], run) -> str:
    """The largest of copied integers is never above that of the start, and whole."""
    ends = run.table("ends.txt")[:, 1]
    if np.any(ends > ends[0]) or np.any(ends != np.round(ends)):
        return f"a copied integer becomes {ends.max()}, above {ends[0]} of the start"
    return ""


def bodies_untouched(x: np.ndarray, d: float):
    """Bodies keep place and size, and nobody is born inside of one."""

    def check(scene, frames: list[Frame], run) -> str:
        body = run.dump("bodies.dump")
        if not np.array_equal(body["diameter"], np.full(len(x), d)) or np.abs(body["x"] - x[:, 0]).max() > 0.0:
            return "a body has moved or has another size"
        for k, frame in enumerate(frames):
            place = np.column_stack([frame[axis] for axis in "xyz"])
            gap = np.linalg.norm(place[:, None] - x[None], axis=2) - 0.5 * (frame["diameter"][:, None] + d)
            if len(gap) and gap.min() < -1e-9 * d:
                return f"a cluster overlaps a body by {-gap.min()} in frame {k}"
        return ""

    return check


def others_untouched(count: int):
    """Clusters outside of the group neither break nor merge."""

    def check(scene, frames: list[Frame], run) -> str:
        others = run.dump("others.dump")
        if len(others["id"]) != count or len(np.unique(others["mass"])) > 1:
            return f"{len(others['id'])} clusters outside of the group, {count} at the start"
        return ""

    return check


def no_pieces_overlap(scene, frames: list[Frame], run) -> str:
    """Nobody is born into anybody, whatever came before."""
    for k, frame in enumerate(frames):
        overlap = contacts(scene, frame)[2]
        if overlap.max(initial=0.0) > 1e-9 * frame["diameter"].max(initial=0.0):
            return f"an overlap of {overlap.max()} in frame {k}"
    return ""


@family(
    "guests",
    42,
    6,
    "up to 200 clusters that break into threes to hundreds, and merge, while fix deposit lets clusters in, delete_atoms takes some "
    "out between two runs and reset_atoms gives new IDs, large bodies lie among them that belong to no fix of ours, or half of the clusters "
    "are in another group; columns by each rule of carry; np 1, 2, 4",
    "particles with what was fed and left; bodies and others untouched, nobody in a body; sums of what is carried",
)
def guests(draw: Draw) -> Scene:
    d_p = draw.particle()
    each = draw.whole(60, 2000)
    d, largest = float(diameter(d_p, each)), float(diameter(d_p, 2000))
    columns = draw.whole(6, 14)
    gap = draw.uniform(1.01, 3.0)
    x, length, width = lattice(columns, columns, gap * d, 2.0 * d)
    scene = empty((max(length, 13.0 * largest), 6.5 * largest, max(width, 13.0 * largest)))
    scene.d_p, scene.momentum = d_p, False
    scene.clusters = Clusters(np.full(len(x), each), x, np.zeros((len(x), 3)))
    scene.gas = GAS
    scene.size = f"K {float(diameter(d_p, draw.whole(3, max(each // 3, 4)))) * 1e-3 * draw.log(1e-3, 1e3)!r} drag drag merge 0.2 terms st cc"
    scene.dt, scene.steps, scene.frames, scene.every = 1e-12, 40, 4, draw.one_of([1, 5])
    scene.np_ = draw.one_of([1, 2, 4])
    scene.expect, scene.refusals = EITHER, ("thin rank",)
    scene.more = (no_pieces_overlap,)
    kind = draw.index % 6
    box = "0 {!r} 0 {!r} 0 {!r}".format(*scene.box)
    if kind == 0:
        scene.open = True
        mass = each * np.pi / 6 * d_p**3 * RHO_P
        scene.files["one.mol"] = (
            f"one cluster\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\nDiameters\n\n1 {d!r}\n\nMasses\n\n1 {float(mass)!r}\n"
        )
        scene.before = f"molecule one one.mol\nregion top block {box}"
        scene.extra = (
            f"fix feed all deposit 10 0 {draw.whole(1, 5)} {draw.whole(1, 99999)} region top near {1.01 * d!r} mol one"
        )
    elif kind == 1:
        scene.open = True
        scene.extra = (
            "run 20\nregion corner block INF {!r} INF INF INF INF\ndelete_atoms region corner compress {}\n{}".format(
                scene.box[0] * draw.uniform(0.05, 0.6),
                draw.one_of(["yes", "no"]),
                draw.one_of(["", "reset_atoms id", "reset_atoms id sort yes"]),
            )
        )
    elif kind == 2:
        body = largest * draw.uniform(1.5, 3.0)
        scene.types, scene.widest = 2, body
        apart = x[:, 0] >= np.median(x[:, 0])
        scene.clusters = Clusters(scene.clusters.n[apart], x[apart], np.zeros((int(apart.sum()), 3)))
        place = np.array(
            [[0.0, scene.clusters.x[0, 1], z] for z in np.arange(0.6, scene.box[2] / body - 0.6, 1.1) * body]
        )
        place[:, 0] = scene.clusters.x[:, 0].min() - 0.5 * (d + body) - 1e-3 * d
        if place[0, 0] < 0.5 * body:  # no room: shift all to the right
            scene.box = (scene.box[0] + body, *scene.box[1:])
            scene.clusters.x[:, 0] += body
            place[:, 0] += body
        atoms = "\n".join(f"create_atoms 2 single {a!r} {b!r} {c!r}" for a, b, c in place.tolist())
        scene.before = f"{atoms}\nset type 2 diameter {body!r} density 1000\ngroup clusters type 1\ngroup bodies type 2"
        scene.group = "clusters"
        scene.extra = (
            "dump bodies bodies custom 40 bodies.dump id x y z diameter\ndump_modify bodies sort id format float %.17g"
        )
        scene.more = (no_pieces_overlap, bodies_untouched(place, body))
    elif kind == 3:
        mine = np.arange(len(x)) % 2 == 0
        scene.clusters = Clusters(np.full(int(mine.sum()), each), x[mine], np.zeros((int(mine.sum()), 3)))
        atoms = "\n".join(f"create_atoms 1 single {a!r} {b!r} {c!r}" for a, b, c in x[~mine].tolist())
        scene.before = f"group clusters id <= {mine.sum()}\n{atoms}\ngroup others subtract all clusters\nset group others diameter {d!r}"
        scene.before += f"\nset group others density {0.5 * RHO_P!r}"
        scene.more = (others_untouched(int((~mine).sum())),)
        scene.group = "clusters"
        scene.extra = "fix drift others nve/sphere\ndump others others custom 40 others.dump id mass\ndump_modify others sort id format float %.17g"
    elif kind == 4:
        scene.size += " carry d_mean mean carry d_split split carry i_copy copy"
        scene.extra = COLUMNS
        scene.more = (no_pieces_overlap, sums_stay, copies_are_of_the_start)
    else:
        scene.extra = "run 20\nreset_atoms id\nrun 10\nwrite_data half.data"
    return scene
