"""What a run of very many clusters on very many ranks asks of memory, network and files: python bench/scaling_plan.py
[clusters] [ranks] [--aspect A ...] and the rates of a machine (see --help).

A model of LAMMPS' brick decomposition in the x-z plane with what this package sends on top. Its widths are checked
against what ranks really send by bench/messages.py (tests/engine/test_scaling.py holds it to that); times are the model's,
from the rates given, and are no measurement.
"""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass

from table import head, row

GHOST_CUTOFF = 5.3e-3  # twice the claim of a break plus the skin of the cases [m]
PER_AREA = 66_000 / (0.3 * 0.6)  # clusters, at the end of case 1 [1/m^2]
DOUBLE = 8  # bytes
# numbers sent per ghost; atom_style cluster
FORWARD = 6  # position and velocity
REVERSE = 3  # force
BORDER = 11  # position, velocity, ID, type, mask, radius, mass
# Of a check: positions and velocities of now, power and number of contacts, particles and stable size. Where events happen:
# suitors and their choice, rooms as they are asked for and as they are taken, powers, who changes. Each goes through all swaps
# once; choices and rooms (5 numbers each) once more for each further round of the settlement, which is not counted here.
CHECK = (FORWARD, 2, 2)
EVENTS = (2, 2, 5, 5, 3, 1)
BIRTH = 32  # bytes of a birth on its way to its number


def processor_grid(ranks: int, aspect: float = 1.0) -> tuple[int, int]:
    """How many parts px and pz come nearest to squares in a domain `aspect` times as high as wide."""
    divisors = [n for n in range(1, ranks + 1) if ranks % n == 0]
    return min(((n, ranks // n) for n in divisors), key=lambda p: (abs(math.log(aspect * p[0] / p[1])), p[0]))


@dataclass(frozen=True)
class Part:
    """One rank's part of the domain, of px * pz equal ones."""

    px: int
    pz: int
    width: float  # [m]
    height: float
    per_area: float = PER_AREA  # clusters [1/m^2]
    cutoff: float = GHOST_CUTOFF  # [m]

    @property
    def clusters(self) -> float:
        """Owned."""
        return self.per_area * self.width * self.height

    @property
    def ghosts(self) -> float:
        """Copies of others' clusters, or of own ones across the periodic sides."""
        return self.per_area * (self.width + 2 * self.cutoff) * (self.height + 2 * self.cutoff) - self.clusters

    @property
    def swaps(self) -> int:
        """Messages of one exchange with neighbors: two along every axis that is divided."""
        return 2 * (self.px > 1) + 2 * (self.pz > 1)

    @property
    def sent(self) -> float:
        """Clusters in those messages: along x, then along z with the corners."""
        along_x = 2 * self.height * (self.px > 1)
        along_z = 2 * (self.width + 2 * self.cutoff) * (self.pz > 1)
        return self.per_area * self.cutoff * (along_x + along_z)

    @property
    def handed_over(self) -> int:
        """Messages that hand over clusters that have moved out: a size and the clusters, to one or to both sides."""
        return sum(0 if p == 1 else 2 if p == 2 else 4 for p in (self.px, self.pz))

    def messages_of(self, load: str) -> float:
        """Messages of a rank; of a rebuild and a check those beside the step's own."""
        if load == "a step":
            return 2 * self.swaps
        if load == "a rebuild":
            return self.swaps + self.handed_over  # of each list of ghosts its length
        return len({"a check": CHECK, "events": EVENTS}[load]) * self.swaps

    def bytes_of(self, load: str) -> float:
        """Bytes of a rank; of a rebuild and a check those beside the step's own."""
        numbers = {
            "a step": FORWARD + REVERSE,
            "a rebuild": BORDER - FORWARD,
            "a check": sum(CHECK),
            "events": sum(EVENTS),
        }[load]
        return DOUBLE * numbers * self.sent


@dataclass(frozen=True)
class Machine:
    """Rates of a cluster computer; defaults are round numbers, to be replaced by those of the one at hand."""

    ns_per_step: float  # of a cluster, one rank, all in
    latency: float  # of a message [s]
    bandwidth: float  # of a rank's share of the network [bytes/s]
    files: float  # parallel file system [bytes/s]
    one_writer: float  # what one rank formats and writes [bytes/s]


def times(part: Part, ranks: int, machine: Machine, check_every: int, events: float) -> dict[str, float]:
    """Seconds of one step on average: where all ranks have the same load. Every check has events at this size, and so a
    rebuild; `events` are births per cluster and step.
    """
    stages = math.ceil(math.log2(ranks)) if ranks > 1 else 0
    births = events * part.clusters * check_every
    at_checks = ("a rebuild", "a check", "events")
    messages = part.messages_of("a step") + sum(map(part.messages_of, at_checks)) / check_every
    sent = part.bytes_of("a step") + sum(map(part.bytes_of, at_checks)) / check_every
    routed = 2 * stages, 2 * births * BIRTH * stages / 2
    reductions = 1 + REDUCTIONS_OF_A_CHECK / check_every
    return {
        "computing": machine.ns_per_step * 1e-9 * part.clusters,
        "neighbors": messages * machine.latency + sent / machine.bandwidth,
        "numbers": (routed[0] * machine.latency + routed[1] / machine.bandwidth) / check_every,
        "reductions": reductions * 2 * stages * machine.latency,
    }


REDUCTIONS_OF_A_CHECK = 5  # of a check with events and its rebuild (bench/messages.py)
BYTES_PER_CLUSTER = 500  # of memory, ghosts alike: bench/README.md, "Growth with size"
BYTES_OF_A_RANK = 60e6  # of the process itself


def plan(clusters: float, ranks: int, aspects: list[float], machine: Machine, check_every: int, events: float) -> None:
    """Prints the tables."""
    print(f"{clusters:.3g} clusters on {ranks:,} ranks; a check every {check_every} steps, {events:.2g} births per "
          f"cluster and step\n")  # fmt: skip
    print(head("domain, height to width", "parts", "of m x m", "ghosts %", "MB of a rank", "a step", "a rebuild",
               "a check", "ms per step", "beside computing %"))  # fmt: skip
    for aspect in aspects:
        px, pz = processor_grid(ranks, aspect)
        width = (clusters / PER_AREA / aspect) ** 0.5
        part = Part(px, pz, width / px, aspect * width / pz)
        sent = [f"{part.messages_of(load):.0f} of {part.bytes_of(load) / 1e3:,.0f} kB"
                for load in ("a step", "a rebuild", "a check")]  # fmt: skip
        cost = times(part, ranks, machine, check_every, events)
        memory = BYTES_OF_A_RANK + BYTES_PER_CLUSTER * (part.clusters + part.ghosts)
        print(row(f"{aspect:g}", f"{px} x {pz}", f"{part.width:.3g} x {part.height:.3g}",
                  f"{100 * part.ghosts / part.clusters:.1f}", f"{memory / 1e6:.0f}", *sent,
                  f"{1e3 * sum(cost.values()):.2f}",
                  f"{100 * (sum(cost.values()) / cost['computing'] - 1):.1f}"))  # fmt: skip
    print("\n" + head("ms per step", *cost))
    print(row("of the last", *(f"{1e3 * value:.3f}" for value in cost.values())))


FRAME_BYTES = {"text": 217.0, "text, zstd": 74.0, "binary": 176.0, "restart": 120.0}  # per cluster; see doc/scaling.md


def files(clusters: float, ranks: int, machine: Machine) -> None:
    """Prints what a frame and a restart file take."""
    print("\n" + head("file", "GB", "all ranks at once, s", "one rank, s"))
    for kind, each in FRAME_BYTES.items():
        size = each * clusters
        many = max(size / machine.files, size / ranks / machine.one_writer)
        print(row(kind, f"{size / 1e9:.0f}", f"{many:.1f}", f"{size / machine.one_writer:,.0f}"))


def ids(clusters: float, born: float) -> None:
    """Prints how long IDs last: every birth takes one that was never used."""
    print(
        "\n"
        + head(
            "LAMMPS_SIZES", "IDs", f"left after {clusters:.3g}", f"last for s, at {born:.3g} births per cluster and s"
        )
    )
    for sizes, most in (("smallbig", 2**31 - 1), ("bigbig", 2**63 - 1)):
        left = max(0.0, most - clusters)
        print(row(sizes, f"{most:.3g}", f"{left:.3g}", f"{left / (born * clusters):.3g}"))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clusters", type=float, nargs="?", default=1e9)
    parser.add_argument("ranks", type=int, nargs="?", default=10_000)
    parser.add_argument("--aspect", type=float, nargs="+", default=[1, 2, 8, 100])
    parser.add_argument("--every", type=int, default=10, help="steps between checks")
    parser.add_argument("--births", type=float, default=20.0, help="per cluster and second")
    parser.add_argument("--dt", type=float, default=1e-6, help="time step [s]")
    parser.add_argument("--ns", type=float, default=65.0, help="per cluster and step on one rank [ns]")
    parser.add_argument("--latency", type=float, default=2e-6, help="of a message [s]")
    parser.add_argument("--bandwidth", type=float, default=5e8, help="of a rank's share of the network [bytes/s]")
    parser.add_argument("--files", type=float, default=1e11, help="of the file system [bytes/s]")
    parser.add_argument("--writer", type=float, default=1e8, help="of one rank that writes [bytes/s]")
    o = parser.parse_args()
    machine = Machine(o.ns, o.latency, o.bandwidth, o.files, o.writer)
    plan(o.clusters, o.ranks, o.aspect, machine, o.every, o.births * o.dt)
    files(o.clusters, o.ranks, machine)
    ids(o.clusters, o.births)


if __name__ == "__main__":
    main()
