"""Whole case 1, up to 0.05 s: seconds on one core and on two ranks, by phase of a step: python bench/case1.py [rounds]

Settings `standard` (the input's own) and `fast` of inputs/, taken in turn; median of the rounds. Wall time times the share of the
core that a run got: what an idle machine would show, but for caches and memory that others use.
"""

from __future__ import annotations

import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from alternate import LMP, ROOT

SETTINGS = {"standard": [], "fast": ["-var", "setting", "fast"]}
PHASES = ("Pair", "Neigh", "Comm", "Output", "Modify", "Other")


def whole_case(setting: str, ranks: int) -> dict[str, float]:
    """Seconds of the loop, of the run with its set-up, and of each phase of a step; cluster-steps; clusters at the end."""
    launch = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
    with tempfile.TemporaryDirectory() as folder:
        command = [*launch, LMP, "-in", "inputs/case1.in", "-log", "none", "-var", "outdir", folder, *SETTINGS[setting]]
        environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        done = subprocess.run(
            command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True
        )
        if done.returncode:
            raise RuntimeError(done.stdout[-2000:] + done.stderr[-2000:])
        table = [line.split() for line in (Path(folder) / "case1.N.txt").read_text().splitlines() if line[0] != "#"]
    text = done.stdout
    wall = float(re.findall(r"Loop time of (\S+)", text)[-1])
    share = min(1.0, float(re.findall(r"([\d.]+)% CPU use", text)[-1]) / 100)
    hours, minutes, seconds = (float(word) for word in re.findall(r"Total wall time: (\S+)", text)[-1].split(":"))
    times = {"loop": wall * share, "with set-up": (3600 * hours + 60 * minutes + seconds) * share, "CPU share": share}
    for phase in PHASES:
        row = re.findall(rf"^{phase} +\|(.*)$", text, re.MULTILINE)[-1].split("|")
        times[phase] = float(row[1]) * share
    steps = [int(row[0]) for row in table]
    clusters = [int(row[2]) for row in table]
    times["cluster-steps"] = sum(
        (b - a) * (m + n) / 2 for a, b, m, n in zip(steps, steps[1:], clusters, clusters[1:], strict=False)
    )
    times["clusters"] = clusters[-1]
    return times


def main() -> None:
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    runs = {(setting, ranks): [] for setting in SETTINGS for ranks in (1, 2)}
    for _ in range(rounds):
        for setting, ranks in runs:
            runs[setting, ranks].append(whole_case(setting, ranks))
    for (setting, ranks), results in runs.items():
        middle = {key: statistics.median(result[key] for result in results) for key in results[0]}
        phases = ", ".join(f"{phase} {middle[phase]:.1f}" for phase in PHASES)
        print(
            f"{setting}, {ranks} rank{'s' * (ranks > 1)}: loop {middle['loop']:.1f} s "
            f"({min(r['loop'] for r in results):.1f} to {max(r['loop'] for r in results):.1f}), with set-up {middle['with set-up']:.0f} s, "
            f"{middle['cluster-steps'] / middle['loop'] / 1e6:.0f} million cluster-steps/s, {middle['clusters']:.0f} clusters; "
            f"{phases}; CPU share {middle['CPU share']:.2f}"
        )
    for setting in SETTINGS:
        one, two = runs[setting, 1], runs[setting, 2]
        efficiency = [a["loop"] / b["loop"] / 2 for a, b in zip(one, two, strict=True)]
        print(
            f"{setting}: efficiency of two ranks {statistics.median(efficiency):.2f} ({min(efficiency):.2f} to {max(efficiency):.2f})"
        )


if __name__ == "__main__":
    main()
