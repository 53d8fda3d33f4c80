"""Case 1 with every primary particle resolved, against case 1 as clusters: python bench/resolved.py [--share 1]

2.0e6 particles of 100 um in the box of case 1, stock `pair granular`, `fix nve/sphere` and gravity; the gas force of
fix drag/cluster on each particle (a cluster of one), refreshed every 50 steps. Timed over some hundred steps, scaled to
a simulated second; the clusters are run through the whole case, their number grows on the way. --share leaves a part
of the domain's height, for a quick look.
"""

from __future__ import annotations

import argparse
import math
import tempfile
from dataclasses import dataclass
from pathlib import Path

from alternate import ROOT
from measured_run import MB, MeasuredRun, measured_run
from table import head, row

D_P, RHO_P = 1e-4, 2000.0  # primary particle [m], [kg/m^3]
E_N, MU = 0.3, 0.33  # restitution and friction, the paper's table 1
IMPACT = 1.0  # approach speed that a Hertzian contact is timed at [m/s]: gusts of +-0.75 m/s

# A perfect lattice with the particles shaken within their own cells: none overlap. Start at the speed of the gas, with
# the scatter that the gusts give within a few milliseconds.
SCRIPT = """
units si
atom_style {atoms}
atom_modify sort 1000 3e-4
boundary p p p
comm_modify vel yes
neighbor {skin} bin
neigh_modify binsize 3e-4
lattice custom 1.0 a1 750e-6 0 0 a2 0 600e-6 0 a3 0 0 600e-6 basis 0.5 0.5 0.5
region box block 0 400 0 5 0 {rows}
create_box 1 box
create_atoms 1 box
set type 1 diameter 1e-4
set type 1 density 2000
displace_atoms all random 320e-6 245e-6 245e-6 7 units box
{pair}
variable u atom normal(0,0.1,11)
variable v atom normal(0,0.1,12)
variable w atom normal(2,0.1,13)
velocity all set v_u v_v v_w
fix move all {motion}
fix fall all gravity 9.81 vector 0 0 -1
fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 law trancong 0.8 1.1 &
    fluctuation 0.75 0 0.75 cell 30 1 {cells} 5e-3 1 refresh 50
timestep {dt}
thermo 1000
run {warm}
run {steps}
"""


def mass_of_pair() -> float:
    """Effective mass of two primary particles [kg]."""
    return math.pi / 6 * D_P**3 * RHO_P / 2


def linear_contact(k: float) -> float:
    """Duration of a contact of two primary particles with spring k [N/m] and restitution E_N [s]."""
    return math.sqrt(mass_of_pair() / k * (math.pi**2 + math.log(E_N) ** 2))


def hertz_contact(modulus: float, poisson: float) -> float:
    """The same for elastic spheres at the approach speed IMPACT; Landau & Lifshitz, Theory of Elasticity, section 9."""
    plane = modulus / (2 * (1 - poisson**2))
    return 2.87 * (mass_of_pair() ** 2 / (D_P / 4 * plane**2 * IMPACT)) ** 0.2


def granular(normal: str, tangential: str) -> str:
    return f"pair_style granular\npair_coeff * * {normal} tangential {tangential} damping coeff_restitution"


def hooke(k: float) -> str:
    return granular(f"hooke {k} {E_N}", f"linear_history {0.857142857 * k} 1.0 {MU}")


FRICTIONLESS = f"pair_style gran/cluster 10.0 {E_N} 0.0 tangential none cutoff 1e-4\npair_coeff * *"
GLASS = (4.8e10, 0.2)  # Young's modulus [Pa] and Poisson's ratio: Chung & Ooi, Granular Matter 13 (2011), test 1
HERTZ = granular(f"hertz/material {GLASS[0]} {E_N} {GLASS[1]}", f"mindlin NULL 1.0 {MU}")


@dataclass(frozen=True)
class Resolved:
    """A way to resolve the particles. Skins by measurement: the shorter the step, the rarer the lists are rebuilt."""

    name: str
    pair: str
    dt: float
    skin: float
    steps: int
    atoms: str = "sphere"
    motion: str = "nve/sphere"


RESOLVED = (
    Resolved("k_n = 10 N/m as the clusters', at their step", hooke(10.0), 1e-6, 2e-4, 250),
    Resolved("… without friction and rotation, our styles", FRICTIONLESS, 1e-6, 2e-4, 250, "cluster", "nve"),
    Resolved("k_n = 1000 N/m, step t_c/20", hooke(1e3), linear_contact(1e3) / 20, 1e-4, 250),
    Resolved("glass (E = 48 GPa, Hertz), step t_c/20", HERTZ, hertz_contact(*GLASS) / 20, 5e-5, 100),
)
SETTINGS = {"standard": 1e-6, "fast": 5e-6}  # of the inputs, and their steps [s]


def run_clusters(setting: str, share: float) -> MeasuredRun:
    with tempfile.TemporaryDirectory() as name:
        arguments = ["-in", str(ROOT / "inputs/case1.in"), "-var", "inputs", str(ROOT / "inputs")]
        return measured_run(Path(name), [*arguments, "-var", "height", str(share), "-var", "setting", setting])


def run_resolved(way: Resolved, share: float) -> MeasuredRun:
    with tempfile.TemporaryDirectory() as name:
        text = SCRIPT.format(
            atoms=way.atoms, skin=way.skin, rows=round(1000 * share), cells=max(1, round(30 * share)), pair=way.pair,
            motion=way.motion, dt=f"{way.dt:.3g}", warm=60, steps=way.steps,
        )  # fmt: skip
        (Path(name) / "in.lmp").write_text(text)
        return measured_run(Path(name), ["-in", "in.lmp"])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--share", type=float, default=1.0, help="part of the domain's height")
    share = parser.parse_args().share

    for k in (10.0, 1e3):
        print(f"contact of two primary particles, k_n = {k:g} N/m: {linear_contact(k):.3g} s")
    print(f"contact of two primary particles, glass at {IMPACT:g} m/s: {hertz_contact(*GLASS):.3g} s\n")

    cost = ["ns per object-step", "core-s per simulated s", "peak MB", "MB of LAMMPS"]
    print(head("", "objects", "step [s]", "lists per 1000 steps", *cost))

    def show(name: str, objects: str, dt: float, run: MeasuredRun, ns: str) -> float:
        """Prints a row; core-seconds per simulated second."""
        seconds = run.seconds / run.steps / dt
        lists = f"{1000 * run.lists / run.steps:.0f}"
        memory = f"{run.peak_bytes / MB:,.0f}", f"{run.own_bytes / MB:,.0f}"
        print(row(name, objects, f"{dt:.2g}", lists, ns, f"{seconds:,.0f}", *memory), flush=True)
        return seconds

    ours, theirs = {}, {}
    for setting, dt in SETTINGS.items():
        run = run_clusters(setting, share)
        ours[setting] = show(f"clusters, {setting}", f"{round(5000 * share):,} to {run.atoms:,}", dt, run, "")
    for way in RESOLVED:
        run = run_resolved(way, share)
        theirs[way.name] = show(way.name, f"{run.atoms:,}", way.dt, run, f"{run.ns_per_step:.0f}")

    print("\n" + head("core-seconds, resolved over clusters", *ours))
    for name, seconds in theirs.items():
        print(row(name, *(f"{seconds / value:,.0f}" for value in ours.values())))


if __name__ == "__main__":
    main()
