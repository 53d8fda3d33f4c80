"""Two ranks against one: python bench/weak_strong.py [clusters] [rounds]

The clusters of growth.py with gas, contacts and events: the same domain on one and on two ranks (strong), and on two ranks
a domain twice as large (weak). Turn by turn, seconds of the loop by the clock times the share of the processor.
"""

from __future__ import annotations

import statistics
import sys
import tempfile
from pathlib import Path

from alternate import loop_seconds
from growth import script


def main() -> None:
    clusters = int(float(sys.argv[1])) if len(sys.argv) > 1 else 125_000
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    runs = {"one": (clusters, 1), "strong": (clusters, 2), "weak": (2 * clusters, 2)}
    times: dict[str, list[float]] = {name: [] for name in runs}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(rounds):
            for name, (count, ranks) in runs.items():
                times[name].append(loop_seconds(Path(folder), script(count, "events", warm=20, steps=100), ranks))
    for name, gain in (("strong", "speed-up by two ranks"), ("weak", "efficiency of two ranks")):
        ratio = [one / two for one, two in zip(times["one"], times[name], strict=True)]
        print(
            f"{name}: {gain} {statistics.median(ratio):.2f} ({min(ratio):.2f} to {max(ratio):.2f}), {clusters:,} clusters"
        )


if __name__ == "__main__":
    main()
