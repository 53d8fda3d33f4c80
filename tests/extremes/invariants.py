"""What every finished scene must satisfy."""

from __future__ import annotations

from itertools import product

import numpy as np
from drawn_scene import Scene
from lammps_run import Run
from scipy.spatial import cKDTree

Frame = dict[str, np.ndarray]
FED, LEFT, CLUSTERS_FED, CLUSTERS_LEFT = 25, 26, 27, 28  # entries of the fix' vector: particles and clusters


def frames_of(run: Run) -> list[Frame]:
    return [*run.frames("frames.dump"), run.dump("end.dump")]


def fault_of(scene: Scene, run: Run, frames: list[Frame]) -> str:
    """The first thing that does not hold, or ""."""
    for check in (finite, particles, counts_of_the_fix, momentum, energy):
        fault = check(scene, frames, run)
        if fault:
            return fault
    for check in scene.more:
        fault = check(scene, frames, run)
        if fault:
            return fault
    return ""


def finite(scene: Scene, frames: list[Frame], run: Run) -> str:
    for k, frame in enumerate(frames):
        for name, column in frame.items():
            bad = ~np.isfinite(column) & ~((name == "f_drag[8]") & (column == np.inf))  # tau without drag
            if bad.any():
                return f"{name} of {bad.sum()} clusters is not finite in frame {k}"
    return ""


def particles(scene: Scene, frames: list[Frame], run: Run) -> str:
    """Whole particles, none lost or made; masses and diameters are those of the counts."""
    start = int(np.sum(scene.clusters.n))
    if scene.open:
        last = run.table()[-1]
        start += last[FED] - last[LEFT]
    for k, frame in enumerate(frames):
        n = np.round(frame["mass"] / scene.particle_mass())
        if n.sum() != start and (not scene.open or k == len(frames) - 1):
            return f"{start} particles at the start, and fed less left, {n.sum():.0f} in frame {k}"
        # density and diameter are printed with 17 digits, the engine makes the mass from them
        if len(n) and np.abs(frame["mass"] / scene.mass(n) - 1.0).max() > 1e-12:
            return f"a mass is not that of a whole number of particles in frame {k}"
        if len(n) and np.abs(frame["diameter"] / scene.diameter(n) - 1.0).max() > 1e-12:
            return f"a diameter does not fit the number of particles in frame {k}"
        if "f_size[1]" in frame and not np.array_equal(frame["f_size[1]"], n):
            return f"the fix counts other particles than the masses in frame {k}"
        if len(np.unique(frame["id"])) != len(frame["id"]):
            return f"an atom ID occurs twice in frame {k}"
        if (
            scene.size
            and len(n)
            and not (
                n.max() <= max(scene.limits[1], scene.clusters.n.max())
                and n.min() >= min(scene.limits[0], scene.clusters.n.min())
            )
        ):
            return f"a cluster of {n.min():.0f} or {n.max():.0f} particles is outside of the limits in frame {k}"
    return "" if scene.size or len(frames[-1]["id"]) == len(scene.clusters) else "a cluster was lost"


def counts_of_the_fix(scene: Scene, frames: list[Frame], run: Run) -> str:
    """Clusters at the end = at the start + born - breakups - merges."""
    if not scene.size:
        return ""
    last = run.table()[-1]
    expected = len(scene.clusters) + last[5] - last[3] - last[4] + last[CLUSTERS_FED] - last[CLUSTERS_LEFT]
    if expected != len(frames[-1]["id"]):
        return f"{len(frames[-1]['id'])} clusters at the end, {expected:.0f} by the counts of events"
    return ""


def velocity(frame: Frame) -> np.ndarray:
    return np.column_stack([frame[f"v{axis}"] for axis in "xyz"])


def kinetic(scene: Scene, frame: Frame) -> float:
    """Of translation, in the frame of reference of the scene, and of rotation."""
    v = velocity(frame) - np.asarray(scene.frame)
    energy = 0.5 * float(frame["mass"] @ (v**2).sum(axis=1))
    if "omegax" in frame:
        omega2 = sum(frame[f"omega{axis}"] ** 2 for axis in "xyz")
        energy += 0.05 * float((frame["mass"] * frame["diameter"] ** 2) @ omega2)  # I = m d^2/10
    return energy


def contacts(scene: Scene, frame: Frame) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pairs in contact (i, j) and their overlaps; more than once where they touch across a small box."""
    radius = 0.5 * frame["diameter"]
    if not len(radius):
        return np.empty(0, int), np.empty(0, int), np.empty(0)
    x = np.column_stack([frame[axis] for axis in "xyz"])
    periodic = np.array([kind == "p" for kind in scene.boundary.split()])
    box = np.where(periodic, scene.box, 0.0)
    x = np.where(periodic, np.mod(x, np.where(periodic, box, 1.0)), x)
    x = np.where(periodic & (x >= box), 0.0, x)  # -1e-20 % L is L
    reach = 2.0 * float(radius.max())
    if np.all(~periodic | (box > 2.0 * reach)):
        span = np.where(periodic, 0.0, np.abs(x).max() + 1.0)
        shift = np.where(periodic, 0.0, span)  # the tree wants positive coordinates in a box of its own
        tree = cKDTree(x + shift, boxsize=np.where(periodic, box, 4.0 * span))
        i, j = tree.query_pairs(reach, output_type="ndarray").T
        d = x[i] - x[j]
        d -= np.where(periodic, box * np.round(d / np.where(periodic, box, 1.0)), 0.0)
    else:
        i, j, d = images_of_pairs(x, box, reach)
    overlap = radius[i] + radius[j] - np.linalg.norm(d, axis=1)
    touching = overlap > 0.0
    return i[touching], j[touching], overlap[touching]


def images_of_pairs(x: np.ndarray, box: np.ndarray, reach: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Every pair with every image within reach, a cluster's own images included: for small boxes."""
    spans = [range(-int(np.ceil(reach / b)) - 1, int(np.ceil(reach / b)) + 2) if b else range(1) for b in box]
    i, j = np.triu_indices(len(x))
    found = []
    for shift in product(*spans):
        keep = (i != j) | (shift > (0, 0, 0))  # of a cluster's own images one of each two mirror images
        found.append((i[keep], j[keep], x[i[keep]] - x[j[keep]] - np.asarray(shift) * box))
    return tuple(np.concatenate(part) for part in zip(*found))


def elastic(scene: Scene, frame: Frame) -> float:
    """Of the normal springs."""
    return 0.5 * scene.contact.k_n * float((contacts(scene, frame)[2] ** 2).sum())


def momentum(scene: Scene, frames: list[Frame], run: Run) -> str:
    """Rounding of a contact force is 1e-16 of it; 1e-11 leaves room for some 1e5 of them adding up."""
    if not scene.momentum or not len(scene.clusters):
        return ""
    before = frames[0]["mass"] @ velocity(frames[0])
    mass = float(frames[0]["mass"].sum())
    fastest = np.sqrt(2.0 * (kinetic(scene, frames[0]) + elastic(scene, frames[0])) / mass)
    scale = mass * (fastest + float(np.linalg.norm(scene.frame)))
    for k, frame in enumerate(frames):
        change = float(np.abs(frame["mass"] @ velocity(frame) - before).max())
        if not change <= 1e-11 * scale:
            return f"momentum changed by {change / scale if scale else change:.1e} of its scale in frame {k}"
    return ""


def energy(scene: Scene, frames: list[Frame], run: Run) -> str:
    """Kinetic and elastic energy never exceed those of the start."""
    if scene.energy is None:
        return ""
    start, *later = (kinetic(scene, frame) + elastic(scene, frame) for frame in frames)
    for k, now in enumerate(later, start=1):
        if not now <= start * (1.0 + scene.energy):
            return f"energy rose by {now / start - 1.0 if start else now:.2e} of that of the start in frame {k}"
    return ""


def energy_rise(scene: Scene, frames: list[Frame]) -> float:
    """Largest energy over that of the start, where no bound is set but nothing outside acts."""
    if scene.energy is not None or not scene.momentum or not len(scene.clusters):
        return 1.0
    start, *later = (kinetic(scene, frame) + elastic(scene, frame) for frame in frames)
    return max(later) / start if start else 1.0
