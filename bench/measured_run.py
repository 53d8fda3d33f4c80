"""Runs LAMMPS once and reads what it took: time of the loop, peak memory, neighbor lists built."""

from __future__ import annotations

import re
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

from alternate import LMP

MB = 1e6


@dataclass(frozen=True)
class MeasuredRun:
    """The last `run` command of a script on one rank."""

    seconds: float  # CPU seconds of the loop: wall time times the share of the processor that it got
    steps: int
    atoms: int  # at the end
    lists: int  # neighbor lists built
    own_bytes: float  # what LAMMPS and its styles count as theirs
    peak_bytes: float  # of the process, set-up included
    output: str

    @property
    def ns_per_step(self) -> float:
        """Nanoseconds per atom and step, where the number of atoms stays."""
        return 1e9 * self.seconds / self.atoms / self.steps


def peak_so_far(process: int) -> float:
    """High-water mark of a running process [bytes]; what rusage says after its end starts from that of its parent."""
    try:
        status = Path(f"/proc/{process}/status").read_text()
    except OSError:
        return 0.0
    found = re.search(r"VmHWM:\s+(\d+) kB", status)
    return 1024.0 * int(found[1]) if found else 0.0


def measured_run(folder: Path, arguments: list[str]) -> MeasuredRun:
    """Runs LAMMPS with `arguments` in `folder` on one rank."""
    peak = 0.0
    with (folder / "output").open("w+") as output:
        process = subprocess.Popen(
            [LMP, "-log", "none", *arguments], cwd=folder, stdin=subprocess.DEVNULL, stdout=output, stderr=output
        )
        while process.poll() is None:
            peak = max(peak, peak_so_far(process.pid))
            time.sleep(0.02)
        output.seek(0)
        text = output.read()
    if process.returncode:
        raise RuntimeError(text[-3000:])

    def last(pattern: str) -> str:
        return re.findall(pattern, text)[-1]

    share = float(last(r"([\d.]+)% CPU use")) / 100
    return MeasuredRun(
        seconds=float(last(r"Loop time of (\S+)")) * min(share, 1.0),
        steps=int(last(r"procs for (\d+) steps")),
        atoms=int(last(r"steps with (\d+) atoms")),
        lists=int(last(r"Neighbor list builds = (\d+)")),
        own_bytes=float(last(r"Per MPI rank memory allocation .* = \S+ \| (\S+) \|")) * 2**20,
        peak_bytes=peak,
        output=text,
    )
