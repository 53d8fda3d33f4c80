"""Our plugin and stock LAMMPS against LIGGGHTS, on equal clusters and contacts: python bench/liggghts.py [clusters ...]

No events. The same start positions (one data file), forces, step, skin, bins, output and freedoms for every engine; CPU
time of the time loop, engines turn by turn, ratios within a turn, median of seven turns.
"""

from __future__ import annotations

import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from alternate import D_P, LMP, ratios, write_clusters

LIGGGHTS = os.environ.get("LIGGGHTS_EXE", "liggghts")
TURNS = 7
K_N, RESTITUTION, FRICTION = 10.0, 0.3, 0.33
K_T = 6 / 7 * K_N  # 2 (1 - nu)/(2 - nu) k_n, nu = 0.25

SCRIPT = """
units si
{head}
boundary p f p
read_data clusters.data
neighbor 0.2e-3 bin
neigh_modify every 1 delay 0 check yes binsize 2e-3
{pair}
variable u atom 0.3*sin(79190*x+104729*z)
variable w atom 2+0.3*sin(61379*x-94321*z)
velocity all set v_u 0 v_w
{motion}
timestep 1e-6
thermo_style custom step atoms ke
thermo {every}
run {steps}
"""


def apart(motion: str) -> str:
    return f"fix move all {motion}\nfix fall all gravity 9.81 vector 0 0 -1"


def lammps(style: str, pair: str) -> dict[str, str]:
    return {
        "head": f"atom_style {style}\natom_modify map yes\ncomm_modify vel yes",
        "pair": pair,
    }


def granular(tangential: str) -> str:
    return (
        f"pair_style granular\npair_coeff * * hooke {K_N} {RESTITUTION} tangential {tangential} "
        "damping coeff_restitution"
    )


def gran_cluster(friction: float) -> str:
    return f"pair_style gran/cluster {K_N} {RESTITUTION} {friction} tangential linear\npair_coeff * *"


def liggghts(n: int, tangential: str, friction: float) -> dict[str, str]:
    """The damping of this engine goes with the mass of the pair: made here for two clusters of n particles.

    Without friction, too, a tangential model is named: only combinations of its list does LIGGGHTS run at full speed.
    """
    log_e = math.log(RESTITUTION)
    reduced_mass = 0.5 * n * math.pi / 6 * D_P**3 * 2000.0
    gamma = -2 * log_e / math.hypot(math.pi, log_e) * math.sqrt(K_N / reduced_mass)
    values = {"kn": K_N, "kt": K_T, "gamman": gamma, "gammat": gamma, "coefficientFriction": friction}
    given = "".join(f"fix {k} all property/global {k} peratomtypepair 1 {v!r}\n" for k, v in values.items())
    return {
        "head": "atom_style granular\natom_modify map array\nnewton off\ncommunicate single vel yes",
        "pair": f"{given}pair_style gran model hooke/stiffness tangential {tangential}\npair_coeff * *",
    }


def variants(n: int) -> dict[str, dict[str, tuple[str, dict[str, str]]]]:
    """By scene, by name: the executable and its part of the script. The first is what the others are compared with."""
    return {
        "friction with history, rotation": {
            "LIGGGHTS, hooke/stiffness tangential history": (
                LIGGGHTS, liggghts(n, "history", FRICTION) | {"motion": apart("nve/sphere")}),
            "LAMMPS, pair granular linear_history": (
                LMP,
                lammps("sphere", granular(f"linear_history {K_T!r} 1.0 {FRICTION}")) | {"motion": apart("nve/sphere")}),
            "plugin, pair gran/cluster tangential linear": (
                LMP, lammps("sphere", gran_cluster(FRICTION)) | {"motion": apart("nve/sphere")}),
        },
        "no friction, no rotation": {
            "LIGGGHTS, hooke/stiffness tangential no_history, nve": (
                LIGGGHTS, liggghts(n, "no_history", 0.0) | {"motion": apart("nve")}),
            "LAMMPS, pair granular, nve": (
                LMP, lammps("sphere", granular("linear_nohistory 0.0 0.0")) | {"motion": apart("nve")}),
            "plugin, pair gran/cluster, atom_style cluster, nve/cluster": (
                LMP, lammps("cluster", gran_cluster(0.0)) | {"motion": "fix move all nve/cluster gravity 9.81 0 0 -1"}),
        },
    }  # fmt: skip


def run(folder: Path, engine: str, script: str) -> tuple[float, str]:
    """CPU seconds of the time loop, its wall time times the share of a core that the process got; and the output."""
    (folder / "in.bench").write_text(script)
    before, start = os.times(), time.perf_counter()
    done = subprocess.run(
        [engine, "-in", "in.bench", "-log", "none"],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
    )
    wall, after = time.perf_counter() - start, os.times()
    if done.returncode:
        raise RuntimeError(done.stdout[-2000:] + done.stderr[-2000:])
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return loop_time(done.stdout) * min(cpu / wall, 1.0), done.stdout


def loop_time(output: str) -> float:
    return float(re.findall(r"Loop time of (\S+)", output)[-1])


def share(phase: str, output: str) -> float:
    """Of the loop, as either engine prints it."""
    return float(re.findall(rf"^{phase} +(?:time \(%\) =|\|) *(\S+)", output, re.M)[-1]) / loop_time(output)


def kinetic_energy(output: str) -> float:
    """Of the last step, as a check that engines do the same work."""
    rows = re.findall(r"^ *\d+ +\d+ +([\d.e+-]+) *$", output, re.M)
    return float(rows[-1])


def compare(folder: Path, count: int, n: int) -> None:
    steps = max(300, 20_000_000 // count)
    for scene, engines in variants(n).items():
        times: dict[str, list[float]] = {name: [] for name in engines}
        outputs: dict[str, list[str]] = {name: [] for name in engines}
        for turn in range(TURNS + 1):
            for name, (engine, part) in engines.items():
                seconds, output = run(folder, engine, SCRIPT.format(**part, steps=steps, every=steps))
                if turn:  # the first turn warms up
                    times[name].append(seconds)
                    outputs[name].append(output)
        base = next(iter(engines))
        print(f"{count} clusters of {n} particles, {scene}, {steps} steps:")
        for name, (median, low, high) in ratios(times, base).items():
            cost = 1e9 * statistics.median(times[name]) / count / steps
            pair, neigh = (cost * statistics.median(share(p, o) for o in outputs[name]) for p in ("Pair", "Neigh"))
            print(
                f"  {name}: {cost:.1f} ns per cluster-step (pair {pair:.1f}, neighbor lists {neigh:.1f}), "
                f"{1 / median:.2f} times as fast ({1 / high:.2f} to {1 / low:.2f}), "
                f"kinetic energy at the end {kinetic_energy(outputs[name][-1]):.6g}", flush=True,
            )  # fmt: skip


def main() -> None:
    counts = [int(word) for word in sys.argv[1:]] or [5_000, 60_000]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for wanted in counts:
            for n in (25, 400):
                compare(folder, write_clusters(folder / "clusters.data", wanted, n), n)


if __name__ == "__main__":
    main()
