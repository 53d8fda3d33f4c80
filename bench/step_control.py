"""What fix cluster/timestep costs while it rejects nothing, in % of a step: python bench/step_control.py [clusters]"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from alternate import alternate, ratios, write_clusters

SCRIPT = """
units si
atom_style {atoms}
atom_modify map hash
boundary p f p
comm_modify vel yes cutoff 5.3e-3
neighbor 0.2e-3 bin
neigh_modify every 1 delay 0 check yes binsize 2e-3
read_data clusters.data
pair_style gran/cluster 10.0 0.3 0.33 cutoff 1.5876e-3
pair_coeff * *
variable u atom 0.3*sin(79190*x+104729*z)
variable w atom 2+0.3*sin(61379*x-94321*z)
velocity all set v_u 0 v_w
{control}
fix move all nve
fix fall all gravity 9.81 vector 0 0 -1
fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law trancong 0.8 1.1 plane xz &
    fluctuation 0.75 0 0.75 cell 30 1 30 5e-3 1
{size}
timestep 1e-6
thermo_style custom step ke pe {rejections}
thermo 1000
run {steps}
"""
SIZE = "fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 0.0266"


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 60_000
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        count = write_clusters(folder / "clusters.data", count)
        steps = max(200, 30_000_000 // count)
        print(f"{count} clusters, {steps} steps, one rank; ratio to a fixed step: median (lowest to highest)")
        for events, size in (("without events", ""), ("with fix cluster/breakmerge every 10 steps", SIZE)):
            scripts = {}
            for what, control in {
                "fixed step": "",
                "overlap": "fix dt all cluster/timestep 1e-6 energy off",
                "overlap and energy": "fix dt all cluster/timestep 1e-6",
            }.items():
                rejections = "f_dt[2] f_dt[3] f_dt[9]" if control else ""
                scripts[what] = SCRIPT.format(
                    atoms="cluster", control=control, size=size, steps=steps, rejections=rejections
                )
            for what, (median, low, high) in ratios(alternate(folder, scripts), "fixed step").items():
                print(f"  {events}, {what}: {median:.3f} ({low:.3f} to {high:.3f})")


if __name__ == "__main__":
    main()
