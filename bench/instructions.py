"""Instructions of a step, function by function, counted by valgrind's callgrind: python bench/instructions.py

Case 1's physics without events, 5,000 clusters: the difference of a run of 300 steps and one of 100, so that the set-up is left out.
CLUSTERDEM_LMP names another build of LAMMPS and plugin.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from alternate import LMP, write_clusters
from layer_cost import DRAG, SCRIPT

STEPS = (100, 300)
APART = "fix move all nve\nfix fall all gravity 9.81 vector 0 0 -1\n"
TOGETHER = "fix move all nve/cluster gravity 9.81 0 0 -1 drag drag\n"
PAIR = "pair_style gran/cluster 10.0 0.3 0.0 cutoff 1.5876e-3\npair_coeff * *"
LINE = re.compile(r"^\s*([\d,]+) \([^)]*\)\s+\S*?:(\S.*?)(?: \[.*\])?$")


def counted(folder: Path, motion: str, drag: str, steps: int) -> dict[str, int]:
    """Instructions of each function in one run."""
    script = SCRIPT.format(atoms="cluster", motion=motion, pair=PAIR, ours=drag, steps=steps)
    (folder / "in.lmp").write_text(script)
    out = folder / "callgrind.out"
    # the wrapper is a shell script: its last line starts the executable, which is what is to be counted
    command = [
        "valgrind",
        "--tool=callgrind",
        "--trace-children=yes",
        f"--callgrind-out-file={out}.%p",
        LMP,
        "-in",
        "in.lmp",
        "-log",
        "none",
    ]
    done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stdout[-2000:] + done.stderr[-2000:])
    largest = max(folder.glob("callgrind.out.*"), key=lambda file: file.stat().st_size)
    listing = subprocess.run(
        ["callgrind_annotate", "--threshold=99.9", str(largest)], capture_output=True, text=True, check=True
    ).stdout
    for file in folder.glob("callgrind.out.*"):
        file.unlink()
    functions: dict[str, int] = {}
    for line in listing.splitlines():
        match = LINE.match(line)
        if match:
            name = re.sub(r"\(.*", "", match[2]).removeprefix("LAMMPS_NS::").removeprefix("ClusterDEM::")
            functions[name] = functions.get(name, 0) + int(match[1].replace(",", ""))
    return functions


def main() -> None:
    if not shutil.which("valgrind"):
        sys.exit("needs valgrind (Debian package valgrind)")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        count = write_clusters(folder / "clusters.data", 5_000)
        for title, motion, refresh in (
            ("nve, gravity, drag every step", APART, 1),
            ("nve, gravity, drag held for 50", APART, 50),
            ("nve/cluster, drag held for 50", TOGETHER, 50),
        ):
            try:
                few, many = (counted(folder, motion, DRAG.format(refresh), steps) for steps in STEPS)
            except RuntimeError as error:
                print(f"{title}: not run ({str(error).strip().splitlines()[-1]})")
                continue
            per = {f: (n - few.get(f, 0)) / (STEPS[1] - STEPS[0]) / count for f, n in many.items()}
            print(f"{title}: {sum(per.values()):.1f} instructions per cluster-step")
            for function, n in sorted(per.items(), key=lambda item: -item[1])[:12]:
                print(f"  {n:7.1f}  {function}", flush=True)


if __name__ == "__main__":
    main()
