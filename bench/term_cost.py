"""What each term of the size law costs at a check, and what is left when it is off: python bench/term_cost.py

Checks on every step without events (a hysteresis that nothing exceeds), on clusters that have begun to collide. CPU nanoseconds per cluster and check: loop
time against that without the size law, over clusters and steps; median of five turns.
"""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path

from alternate import alternate, write_clusters

STEPS = 200
SCRIPT = """
units si
atom_style sphere
atom_modify map yes
boundary p f p
comm_modify vel yes cutoff 5.3e-3
neighbor 0.2e-3 bin
neigh_modify every 1 delay 0 check yes binsize 2e-3
read_data clusters.data
{pair}
variable u atom 1.0*sin(79190*x+104729*z)
variable w atom 2+1.0*sin(61379*x-94321*z)
velocity all set v_u 0 v_w
fix move all nve
fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law trancong 0.8 1.1 plane xz fluctuation 0.75 0 0.75 cell 10 1 10 5e-3 1
timestep 2e-6
thermo 1000
run 600
{size}
run {steps}
"""
SIZE = "fix size all cluster/breakmerge 1 1e-4 2000 drag drag umf 6.46e-3 K 0.0266 hysteresis 1e9 merge {merge} ncc {ncc} terms {terms}"
PAIRS = {
    "granular, linear history": "pair_style granular\npair_coeff * * hooke 10.0 0.3 tangential linear_history 8.57 1.0 0.33 "
    "damping coeff_restitution cutoff 1.5876e-3",
    "gran/cluster": "pair_style gran/cluster 10.0 0.3 0.33 cutoff 1.5876e-3\npair_coeff * *",
}
VARIANTS = {
    "no size law": "",
    "st cc mf, merging": SIZE.format(merge="1e-9", ncc=1, terms="st cc mf"),
    "… without N_cc": SIZE.format(merge="1e-9", ncc=0, terms="st cc mf"),
    "… without merging": SIZE.format(merge="no", ncc=1, terms="st cc mf"),
    "… without both": SIZE.format(merge="no", ncc=0, terms="st cc mf"),
    "mf alone": SIZE.format(merge="no", ncc=0, terms="mf"),
}


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        count = write_clusters(folder / "clusters.data", 10_000, lx=0.07, lz=0.14)
        for engine, pair in PAIRS.items():
            scripts = {what: SCRIPT.format(pair=pair, size=size, steps=STEPS) for what, size in VARIANTS.items()}
            times = alternate(folder, scripts)
            print(f"{count} clusters, {engine}", flush=True)
            for what in list(VARIANTS)[1:]:
                cost = [a - b for a, b in zip(times[what], times["no size law"], strict=True)]
                ns = [1e9 * c / count / STEPS for c in cost]
                print(f"  {what}: {statistics.median(ns):.0f} ns ({min(ns):.0f} to {max(ns):.0f})", flush=True)


if __name__ == "__main__":
    main()
