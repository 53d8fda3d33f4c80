"""How time and memory grow with the number of clusters: python bench/growth.py [clusters ...] [--traffic]

Clusters of 30 particles at the density of case 1's end (66,000 in 0.3 x 0.6 m) in domains twice as high as wide; lean
contacts, gas force refreshed and sizes checked every 10 steps. Every size runs the same 300 steps: 100 to warm up, 200
timed, with another seed in every turn; one rank. --traffic counts what a cluster-step fetches from memory, by
valgrind's cache simulator.
"""

from __future__ import annotations

import argparse
import re
import shutil
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from alternate import LMP
from measured_run import MB, MeasuredRun, measured_run
from table import head, row

SPACING = (0.3 * 0.6 / 66_000) ** 0.5  # mean distance of clusters [m]
DT, WARM, STEPS = 1e-6, 100, 200
# A lattice of clusters, each moved at random inside its own square: none overlap, and no file of 5e6 lines is needed.
SCRIPT = """
units si
atom_style cluster
atom_modify map yes
boundary p f p
comm_modify vel yes cutoff 5.3e-3
neighbor 0.2e-3 bin
neigh_modify every 1 delay 0 check yes binsize 2e-3
lattice custom 1.0 a1 {spacing} 0 0 a2 0 0.003 0 a3 0 0 {spacing} basis 0.5 0.5 0.5
region box block 0 {nx} 0 1 0 {nz}
create_box 1 box
create_atoms 1 box
variable d equal 1e-4*60^(1/3)
variable free equal 0.49*({spacing}-v_d)
set type 1 diameter $d
set type 1 density 1000
displace_atoms all random ${{free}} 0 ${{free}} {seed} units box
pair_style gran/cluster 10.0 0.3 0.0 tangential none cutoff 1.5876e-3
pair_coeff * *
variable u atom 0.3*sin(79190*x+104729*z)
variable w atom 1.5+0.3*sin(61379*x-94321*z)
velocity all set v_u 0 v_w
{motion}
{ours}
timestep {dt}
thermo 1000
run {warm}
{count}
run {steps}
{count}
"""
BARE = "fix move all nve\nfix fall all gravity 9.81 vector 0 0 -1"
FUSED = "fix move all nve/cluster gravity 9.81 0 0 -1 drag drag"
DRAG = (
    "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law trancong 0.8 1.1 plane xz "
    "fluctuation 0.75 0 0.75 cell {x} 1 {z} 5e-3 {seed} refresh 10\n"
)
SIZE = "fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 0.0266"
LAYERS = {"bare": (BARE, ""), "no events": (FUSED, DRAG + SIZE + " break no merge no"), "events": (FUSED, DRAG + SIZE)}
EVENTS = "print 'events so far: $(f_size[3]+f_size[4]:%.0f)'"


def script(clusters: int, layer: str, seed: int = 1, warm: int = WARM, steps: int = STEPS) -> str:
    nx = max(1, round((clusters / 2) ** 0.5))
    nz = max(1, round(clusters / nx))
    cells = [max(1, round(n * SPACING / size)) for n, size in ((nx, 0.01), (nz, 0.02))]
    motion, ours = LAYERS[layer]
    ours = ours.format(x=cells[0], z=cells[1], seed=seed)
    count = EVENTS if layer == "events" else ""
    return SCRIPT.format(
        spacing=SPACING, nx=nx, nz=nz, motion=motion, ours=ours, seed=seed, dt=DT, warm=warm, steps=steps, count=count
    )


def run(folder: Path, text: str) -> MeasuredRun:
    (folder / "in.lmp").write_text(text)
    return measured_run(folder, ["-in", "in.lmp"])


def events_of(run: MeasuredRun) -> int:
    before, after = re.findall(r"^events so far: (\d+)", run.output, re.MULTILINE)
    return int(after) - int(before)


def copy_rate(size: int, rounds: int = 5) -> float:
    """Bytes read and written per second by one core that copies arrays, `size` bytes touched in all."""
    a = np.ones(size // 16)
    b = np.empty_like(a)
    repeats, best = max(1, 2**30 // size), 0.0
    for _ in range(rounds):
        start = time.process_time()
        for _ in range(repeats):
            np.copyto(b, a)
        best = max(best, repeats * 16 * len(a) / (time.process_time() - start))
    return best


def turns(clusters: float) -> int:
    """Small runs are repeated, the largest take minutes."""
    return max(1, min(15, round(2e6 / clusters)))


def traffic(folder: Path, layer: str, clusters: int = 60_000) -> float:
    """Bytes that a cluster-step fetches from memory: lines missed between two lengths, in a last cache of 4 MB that holds
    a small part of the clusters, as 32 MB hold of a million.
    """
    missed = {}
    for steps in (0, 40):
        (folder / "in.lmp").write_text(script(clusters, layer, warm=20, steps=steps))
        command = ["valgrind", "--tool=cachegrind", "--cache-sim=yes", "--cachegrind-out-file=/dev/null"]
        command += ["--trace-children=yes", "--LL=4194304,16,64", LMP, "-log", "none", "-in", "in.lmp"]
        done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(done.stdout[-2000:] + done.stderr[-2000:])
        counts = re.findall(r"LLd misses:\s+([\d,]+)", done.stderr)  # of LAMMPS and of what MPI starts beside it
        missed[steps] = max(int(count.replace(",", "")) for count in counts)
        atoms = int(re.findall(r"steps with (\d+) atoms", done.stdout)[-1])
    return 64 * (missed[40] - missed[0]) / 40 / atoms


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clusters", type=float, nargs="*", default=[5e3, 2e4, 6e4, 2.5e5, 1e6, 5e6])
    parser.add_argument("--traffic", action="store_true", help="count memory traffic, too (minutes)")
    options = parser.parse_args()

    for size in (5e5, 8e6, 5e8):
        print(f"copying arrays over {size / MB:g} MB: {copy_rate(int(size)) / 1e9:.1f} GB/s read and written")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        empty = run(folder, script(1, "bare")).peak_bytes
        print(f"a run of one cluster: {empty / MB:.0f} MB")
        columns = [f"{layer}, ns per cluster-step" for layer in LAYERS]
        memory = ["bytes per cluster, LAMMPS", "bytes per cluster, process"]
        print(head("clusters", *columns, "events per cluster and s", *memory))
        for clusters in options.clusters:
            times: dict[str, list[float]] = {layer: [] for layer in LAYERS}
            events, exposure = 0, 0.0
            for turn in range(turns(clusters)):
                for layer in LAYERS:
                    last = run(folder, script(round(clusters), layer, seed=turn + 1))
                    times[layer].append(last.ns_per_step)
                events += events_of(last)
                exposure += last.atoms * last.steps * DT
            columns = [f"{statistics.median(t):.1f} ({min(t):.1f} to {max(t):.1f})" for t in times.values()]
            memory = [last.own_bytes / last.atoms, (last.peak_bytes - empty) / last.atoms]
            print(
                row(f"{last.atoms:,}", *columns, f"{events / exposure:.1f}", *(f"{m:.0f}" for m in memory)), flush=True
            )
        if options.traffic:
            if not shutil.which("valgrind"):
                raise SystemExit("--traffic needs valgrind")
            for layer in LAYERS:
                print(f"{layer}: {traffic(folder, layer):.0f} bytes fetched per cluster-step")


if __name__ == "__main__":
    main()
