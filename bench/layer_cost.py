"""What our fixes cost on top of the bare engine, on the same clusters: python bench/layer_cost.py [clusters ...]

Bare: box, pair style, neighbor lists, integration and gravity of LAMMPS. Ratios of loop times, median of five turns.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from alternate import alternate, ratios, write_clusters

SCRIPT = """
units si
atom_style {atoms}
atom_modify map yes
boundary p f p
comm_modify vel yes cutoff 5.3e-3
neighbor 0.2e-3 bin
neigh_modify every 1 delay 0 check yes binsize 2e-3
read_data clusters.data
{pair}
variable u atom 0.3*sin(79190*x+104729*z)
variable w atom 2+0.3*sin(61379*x-94321*z)
velocity all set v_u 0 v_w
{motion}{ours}
timestep 1e-6
thermo 1000
run {steps}
"""
DRAG = (
    "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law trancong 0.8 1.1 plane xz "
    "fluctuation 0.75 0 0.75 cell 30 1 30 5e-3 1 refresh {}\n"
)
APART = "fix move all {}\nfix fall all gravity 9.81 vector 0 0 -1\n"
TOGETHER = "fix move all nve/cluster gravity 9.81 0 0 -1 drag drag\n"
SIZE = "fix size all cluster/breakmerge {} 1e-4 2000 drag drag K 0.0266 break no merge no\n"
EVENTS = "fix size all cluster/breakmerge {} 1e-4 2000 drag drag K 0.0266\n"
ENGINES = {
    "nve/sphere + granular linear_history": (
        "sphere",
        "nve/sphere",
        "pair_style granular\npair_coeff * * hooke 10.0 0.3 tangential linear_history 8.57 1.0 0.33 "
        "damping coeff_restitution cutoff 1.5876e-3",
    ),
    "nve + gran/cluster without rotation or friction": (
        "cluster",
        "nve",
        "pair_style gran/cluster 10.0 0.3 0.0 cutoff 1.5876e-3\npair_coeff * *",
    ),
}
LAYERS = {
    "bare": "",
    "drag every step": DRAG.format(1),
    "drag refreshed every 10": DRAG.format(10),
    "drag refreshed every 50": DRAG.format(50),
    "drag 50, sizes every 100, no events": DRAG.format(50) + SIZE.format(100),
    "drag 50, sizes every 100, events": DRAG.format(50) + EVENTS.format(100),
}
FUSED = "nve/cluster, "  # the same with gravity and held drag in the pass that moves; has no rotation


def scripts(atoms: str, motion: str, pair: str, steps: int) -> dict[str, str]:
    apart = APART.format(motion)
    result = {
        what: SCRIPT.format(atoms=atoms, motion=apart, pair=pair, ours=ours, steps=steps)
        for what, ours in LAYERS.items()
    }
    if motion == "nve":
        for what in list(LAYERS)[3:]:
            result[FUSED + what] = SCRIPT.format(
                atoms=atoms, motion=TOGETHER, pair=pair, ours=LAYERS[what], steps=steps
            )
    return result


def main() -> None:
    counts = [int(word) for word in sys.argv[1:]] or [5_000, 60_000]
    for wanted in counts:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            count = write_clusters(folder / "clusters.data", wanted)
            steps = max(300, 30_000_000 // count)
            for engine, (atoms, motion, pair) in ENGINES.items():
                times = alternate(folder, scripts(atoms, motion, pair, steps))
                bare = sorted(times["bare"])[len(times["bare"]) // 2]
                print(f"{count} clusters, {engine}: bare {1e9 * bare / count / steps:.1f} ns per cluster-step")
                for what, (median, low, high) in ratios(times, "bare").items():
                    print(f"  {what}: {median:.2f} ({low:.2f} to {high:.2f})", flush=True)


if __name__ == "__main__":
    main()
