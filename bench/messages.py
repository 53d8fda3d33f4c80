"""What ranks send each other, as the ranks grow with the domain: python bench/messages.py [ranks ...] [--clusters N]

Every rank holds the same part of a larger and larger domain (weak scaling) of clusters as in growth.py, with gas, contacts
and sizes. count_messages.cpp, loaded before MPI, counts messages, their bytes and collective calls of the time loop, which
do not depend on the speed of the machine: more ranks than cores are welcome. Three runs tell apart what a plain step, a
rebuild of the neighbor lists and a check for events send. Printed as the most of any rank.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path

from alternate import LMP
from growth import DRAG, FUSED, SPACING
from scaling_plan import GHOST_CUTOFF, Part, processor_grid
from table import head, row

STEPS, EVERY = 20, 5
K = 0.038  # few enough events that parts stay alike: 2 % more clusters at the end
SCRIPT = """
units si
atom_style cluster
atom_modify map yes
boundary p f p
comm_modify vel yes cutoff {cutoff}
neighbor 0.2e-3 bin
neigh_modify {lists} binsize 2e-3
processors {px} 1 {pz}
lattice custom 1.0 a1 {spacing} 0 0 a2 0 0.003 0 a3 0 0 {spacing} basis 0.5 0.5 0.5
region box block 0 {nx} 0 1 0 {nz}
create_box 1 box
create_atoms 1 box
variable d equal 1e-4*60^(1/3)
variable free equal 0.49*({spacing}-v_d)
set type 1 diameter $d
set type 1 density 1000
displace_atoms all random ${{free}} 0 ${{free}} 1 units box
reset_atoms id sort yes
pair_style gran/cluster 10.0 0.3 0.0 tangential none cutoff 1.5876e-3
pair_coeff * *
variable u atom 0.3*sin(79190*x+104729*z)
variable w atom 1.5+0.3*sin(61379*x-94321*z)
velocity all set v_u 0 v_w
{motion}
{gas}
fix size all cluster/breakmerge {every} 1e-4 2000 drag drag K {k}
timestep 1e-6
thermo {thermo}
thermo_style custom step f_size[3] f_size[4] f_size[5]
run {steps}
"""
RARELY = 1_000_000
# lists rebuilt, checks made: never and never; every EVERY steps; events where they happen
LOADS = {
    "a step": ("every 1 delay 0 check yes", RARELY),
    "a rebuild": (f"every {EVERY} delay 0 check no", RARELY),
    "a check": ("every 1 delay 0 check yes", EVERY),
}


def script(ranks: int, clusters: int, load: str, steps: int = STEPS) -> str:
    """A domain of `ranks` equal parts, each with about `clusters` clusters."""
    px, pz = processor_grid(ranks)
    side = round(clusters**0.5)
    lists, every = LOADS[load]
    gas = DRAG.format(x=px * max(1, round(side * SPACING / 0.01)), z=pz * max(1, round(side * SPACING / 0.02)), seed=1)
    return SCRIPT.format(
        cutoff=GHOST_CUTOFF, lists=lists, px=px, pz=pz, spacing=SPACING, nx=px * side, nz=pz * side, motion=FUSED,
        gas=gas, every=every, k=K, thermo=steps, steps=steps,
    )  # fmt: skip


@dataclass
class Sent:
    """By one rank in the time loop."""

    messages: dict[int, float] = field(default_factory=dict)  # by tag; 0 is LAMMPS' own
    bytes: dict[int, float] = field(default_factory=dict)
    neighbors: int = 0
    calls: dict[str, float] = field(default_factory=dict)  # collective
    given: dict[str, float] = field(default_factory=dict)  # bytes to collective calls


def read_counts(path: Path) -> Sent:
    """The last loop: all ranks meet before it, after it and at the end of the program."""
    lines = [line.split() for line in path.read_text().splitlines()]
    loop = int(lines[-1][0]) - 2
    sent = Sent()
    for segment, kind, *words in lines:
        if int(segment) != loop:
            continue
        if kind == "send":
            sent.messages[int(words[0])], sent.bytes[int(words[0])] = float(words[1]), float(words[2])
        elif kind == "to":
            sent.neighbors += 1
        else:
            sent.calls[kind], sent.given[kind] = float(words[0]), float(words[1])
    return sent


def build_counter(folder: Path) -> Path:
    """The library that counts."""
    library = folder / "libcount.so"
    source = Path(__file__).with_name("count_messages.cpp")
    subprocess.run(["mpicxx", "-std=c++17", "-shared", "-fPIC", "-O1", "-o", library, source], check=True)
    return library


@dataclass
class Counted:
    """A run: what each rank sent, lists built and events."""

    ranks: list[Sent]
    lists: int
    breakups: int
    newborns: int


def count(folder: Path, counter: Path, text: str, ranks: int) -> Counted:
    """Runs a script on `ranks` ranks and counts."""
    (folder / "in.lmp").write_text(text)
    environment = os.environ | {
        "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "COUNT_MESSAGES": str(folder / "count"),
    }  # fmt: skip
    command = ["mpirun", "--oversubscribe", "-np", str(ranks), "-x", "COUNT_MESSAGES", "-x", f"LD_PRELOAD={counter}"]
    done = subprocess.run(
        [*command, LMP, "-log", "none", "-in", "in.lmp"],
        cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
    )  # fmt: skip
    if done.returncode:
        raise RuntimeError(done.stdout[-3000:] + done.stderr[-3000:])
    last = re.findall(r"^ +(\d+) +(\d+) +(\d+) +(\d+) *$", done.stdout, re.MULTILINE)[-1]
    lists = int(re.findall(r"Neighbor list builds = (\d+)", done.stdout)[-1])
    sent = [read_counts(folder / f"count.{rank}") for rank in range(ranks)]
    return Counted(sent, lists, int(last[1]), int(last[3]) - int(last[1]))


@dataclass(frozen=True)
class Traffic:
    """Of the rank that sends most, for each time that something is done."""

    messages: float
    bytes: float
    routed_messages: float  # of the births' numbers, by the crystal router
    routed_bytes: float
    reductions: float  # collective calls
    given: float  # bytes to them
    other: tuple[str, ...]  # collective calls that take an entry for every rank


REDUCTIONS = ("Allreduce", "Exscan", "Reduce", "Bcast", "Scan")


def traffic(counted: Counted, times: int, minus: Counted | None = None) -> Traffic:
    """Per one of `times`, less what `minus` sent beside it."""

    def most(take) -> float:  # type: ignore[no-untyped-def]
        return float(max(take(rank) for rank in counted.ranks) - (max(map(take, minus.ranks)) if minus else 0)) / times

    def total(values: dict[str, float]) -> float:
        return sum(values.get(name, 0) for name in REDUCTIONS)

    return Traffic(
        most(lambda r: r.messages.get(0, 0)),
        most(lambda r: r.bytes.get(0, 0)),
        most(lambda r: sum(n for tag, n in r.messages.items() if tag)),
        most(lambda r: sum(n for tag, n in r.bytes.items() if tag)),
        most(lambda r: total(r.calls)),
        most(lambda r: total(r.given)),
        tuple(sorted(set(counted.ranks[0].calls) - set(REDUCTIONS))),
    )


def measure(folder: Path, counter: Path, ranks: int, clusters: int) -> tuple[dict[str, Traffic], Counted]:
    """Traffic of a step, of a rebuild and of a check beside both."""
    runs = {load: count(folder, counter, script(ranks, clusters, load), ranks) for load in LOADS}
    step, rebuild, check = (runs[load] for load in LOADS)
    one_step = traffic(step, STEPS)
    per_rebuild = traffic(rebuild, rebuild.lists, step)
    # these lists are built without the reduction of every step that asks whether to
    per_rebuild = replace(per_rebuild, reductions=per_rebuild.reductions + STEPS / rebuild.lists)
    # at a check with events lists are rebuilt, too: that part is known
    checks = STEPS // EVERY
    rough = traffic(check, checks, step)
    share = check.lists / checks
    per_check = Traffic(
        rough.messages - share * per_rebuild.messages,
        rough.bytes - share * per_rebuild.bytes,
        rough.routed_messages,
        rough.routed_bytes,
        rough.reductions - share * per_rebuild.reductions,
        rough.given - share * per_rebuild.given,
        rough.other,
    )
    return {"a step": one_step, "a rebuild": per_rebuild, "a check": per_check}, check


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ranks", type=int, nargs="*", default=[1, 2, 4, 8, 16])
    parser.add_argument("--clusters", type=int, default=2000, help="of each rank at the start")
    options = parser.parse_args()
    print(head("ranks", "of", "messages", "bytes", "plan", "neighbors", "routed: messages", "bytes", "reductions",
               "bytes", "others"))  # fmt: skip
    with tempfile.TemporaryDirectory() as name:
        counter = build_counter(Path(name))
        for ranks in options.ranks:
            found, check = measure(Path(name), counter, ranks, options.clusters)
            side = round(options.clusters**0.5) * SPACING
            part = Part(*processor_grid(ranks), side, side, options.clusters / side**2)
            for load, t in found.items():
                plan = part.bytes_of(load)
                print(row(ranks, load, f"{t.messages:.1f}", f"{t.bytes:,.0f}", f"{plan:,.0f}",
                          max(r.neighbors for r in check.ranks), f"{t.routed_messages:.1f}", f"{t.routed_bytes:,.0f}",
                          f"{t.reductions:.1f}", f"{t.given:,.0f}", " ".join(t.other) or "none"), flush=True)  # fmt: skip
            print(f"  ({check.breakups} breakups, {check.newborns} newborns in {STEPS // EVERY} checks of all ranks)")


if __name__ == "__main__":
    main()
