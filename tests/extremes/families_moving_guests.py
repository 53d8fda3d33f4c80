"""Clusters that are poured in, and bodies that come nearer while clusters break beside them."""

from __future__ import annotations

import numpy as np
from draw import Draw
from drawn_scene import EITHER, RHO_P, VOIDAGE, Clusters, Scene
from families_events import GAS, empty
from family import family
from invariants import CLUSTERS_FED, Frame
from start_states import diameter, lattice

STEPS, FRAMES, DT = 40, 4, 1e-12


def nobody_in_a_body(d: float, travel: float):
    """Bodies may have come nearer by `travel` since somebody was born beside them, and keep their size."""

    def check(scene, frames: list[Frame], run) -> str:
        for k, (frame, body) in enumerate(zip(frames, run.frames("bodies.dump"))):
            if not np.array_equal(body["diameter"], np.full(len(body["id"]), d)):
                return f"a body has another size in frame {k}"
            centres = np.column_stack([body[axis] for axis in "xyz"])
            place = np.column_stack([frame[axis] for axis in "xyz"])
            gap = np.linalg.norm(place[:, None] - centres[None], axis=2) - 0.5 * (frame["diameter"][:, None] + d)
            if gap.size and gap.min() < -travel:
                return f"a cluster overlaps a body by {-gap.min()} in frame {k}, bodies moved {travel}"
        return ""

    return check


def at_least_fed(count: int):
    def check(scene, frames: list[Frame], run) -> str:
        fed = run.table()[-1, CLUSTERS_FED]
        return "" if fed >= count else f"{fed:.0f} clusters were poured in, {count} at least were to be"

    return check


@family(
    "moving guests",
    24,
    2,
    "up to 150 clusters that break into threes to hundreds, and merge, while fix pour lets in two sizes of clusters from "
    "above, in two runs, or bodies 1.5 to 3 times the largest cluster, that belong to no fix of ours, move towards them; np 1, 2, 4",
    "particles with what was fed; nobody in a body but by its own way",
)
def moving_guests(draw: Draw) -> Scene:
    d_p = draw.particle()
    poured = draw.index % 2 == 0
    each = draw.whole(60, 300 if poured else 2000)
    d, largest = float(diameter(d_p, each)), float(diameter(d_p, 2000))
    columns = draw.whole(6, 12)
    x, length, width = lattice(columns, columns, draw.uniform(1.01, 3.0) * d, 2.0 * d)
    scene = empty((max(length, 13.0 * largest), 6.5 * largest, max(width, 13.0 * largest)))
    scene.d_p, scene.momentum = d_p, False
    scene.clusters = Clusters(np.full(len(x), each), x, np.zeros((len(x), 3)))
    scene.gas = GAS
    scene.size = f"K {float(diameter(d_p, draw.whole(3, max(each // 3, 4)))) * 1e-3 * draw.log(1e-3, 1e3)!r} drag drag merge 0.2 terms st cc"
    scene.dt, scene.steps, scene.frames, scene.every = DT, STEPS, FRAMES, draw.one_of([1, 5])
    scene.np_ = draw.one_of([1, 2, 4])
    scene.expect, scene.refusals = EITHER, ("thin rank",)
    if poured:
        add_pour(draw, scene, d, largest)
    else:
        add_bodies(draw, scene, d, largest)
    return scene


def add_pour(draw: Draw, scene: Scene, d: float, largest: float) -> None:
    """Once at the first step of each run: at this step the fall from the region takes longer than the run."""
    scene.open, scene.boundary = True, "p p f"
    floor = scene.box[2]
    scene.box = (*scene.box[:2], floor + 5.0 * largest)
    other = float(diameter(scene.d_p, draw.whole(20, 300)))
    density = RHO_P * (1.0 - VOIDAGE)
    region = f"0 {scene.box[0]!r} 0 {scene.box[1]!r} {floor + largest!r} {floor + 4.0 * largest!r}"
    scene.before = f"region hopper block {region}\nfix fall all gravity 9.81 vector 0 0 -1"
    pour = (
        f"pour 1000 1 {{}} region hopper vol {draw.uniform(0.003, 0.02)!r} 50 diam poly 2 {d!r} 0.3 {other!r} 0.7 "
        f"dens {density!r} {density!r}"
    )
    first, second = (pour.format(draw.whole(1, 99999)) for _ in range(2))
    scene.extra = f"fix feed all {first}\nrun 20\nunfix feed\nfix more all {second}"
    scene.more = (at_least_fed(2),)


def add_bodies(draw: Draw, scene: Scene, d: float, largest: float) -> None:
    """A column of bodies on the left, 1e-3 d away, that goes half of this way."""
    body = largest * draw.uniform(1.5, 3.0)
    scene.types, scene.widest = 2, body
    scene.box = (scene.box[0] + body + d, *scene.box[1:])
    x = scene.clusters.x
    x[:, 0] += body + d
    z = np.arange(0.6, scene.box[2] / body - 0.6, 1.1) * body
    left = float(x[:, 0].min()) - 0.5 * (d + body) - 1e-3 * d
    speed = 0.5e-3 * d / (STEPS * DT)
    atoms = "\n".join(f"create_atoms 2 single {left!r} {float(x[0, 1])!r} {a!r}" for a in z.tolist())
    scene.before = (
        f"{atoms}\nset type 2 diameter {body!r} density 1000\ngroup clusters type 1\ngroup bodies type 2\n"
        f"velocity bodies set {speed!r} 0 0\nfix bodies bodies nve/sphere"
    )
    scene.group = "clusters"
    scene.extra = (
        f"dump bodies bodies custom {STEPS // FRAMES} bodies.dump id x y z diameter\n"
        "dump_modify bodies sort id format float %.17g"
    )
    scene.more = (nobody_in_a_body(body, 0.5e-3 * d),)
