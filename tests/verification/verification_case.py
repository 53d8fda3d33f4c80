"""What the verification cases share: run a case's input, compare with a reference, record, draw."""

from __future__ import annotations

import json
import os
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

import matplotlib
import numpy as np
from lammps_run import Run, run_file

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)

# True under `./run verify`: the long variants too, and all that is measured is recorded.
FULL = bool(os.environ.get("CLUSTERDEM_VERIFY"))

STYLE = {
    "figure.dpi": 100,
    "figure.constrained_layout.use": True,
    "font.size": 9,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "lines.linewidth": 1.2,
    "lines.markersize": 4,
    "legend.frameon": False,
}


@dataclass
class Row:
    """One line of the results table. tolerance None: measured and told, not judged."""

    quantity: str
    reference: float
    measured: float
    error: float
    tolerance: float | None
    relative: bool
    passed: bool


@dataclass
class VerificationCase:
    folder: Path  # README.md, the input script, the figure
    scratch: Path
    results: Path | None  # where rows are recorded and whether the committed figure is redrawn

    def run(self, **variables) -> Run:
        """Run the input script of the case, with -var NAME VALUE for each variable, in a folder of its own."""
        (script,) = self.folder.glob("*.in")
        name = "-".join(str(value).replace("/", "_") for value in variables.values()) or "default"
        return run_file(self.scratch / name, ["-in", str(script), "-log", "log.lammps"], **variables)

    def check(
        self, quantity: str, reference: float, measured: float, *, rel: float | None = None, abs: float | None = None
    ) -> None:
        """Record the row and fail unless measured is within rel (of the reference) or abs."""
        assert (rel is None) != (abs is None), "one tolerance, relative or absolute"
        row = self._row(quantity, reference, measured, rel if abs is None else abs, abs is None)
        self._record(row)
        assert row.passed, f"{quantity}: {measured!r}, expected {reference!r}; error {row.error:.3g}"

    def report(self, quantity: str, reference: float, measured: float, *, relative: bool = True) -> None:
        """Record a difference that is told, not judged: the models differ, and the case's README says how."""
        self._record(self._row(quantity, reference, measured, None, relative))

    @staticmethod
    def _row(quantity, reference, measured, tolerance, relative) -> Row:
        error = float(np.abs(measured - reference)) / (float(np.abs(reference)) if relative else 1.0)
        passed = tolerance is None or error <= tolerance  # a NaN fails
        return Row(quantity, float(reference), float(measured), error, tolerance, relative, bool(passed))

    def _record(self, row: Row) -> None:
        if self.results:
            with open(self.results / f"{self.folder.name}.jsonl", "a") as file:
                file.write(json.dumps(asdict(row)) + "\n")

    @contextmanager
    def figure(self, columns: int = 1, width: float = 4.6, height: float = 3.2):
        """Axes of the case's figure, which is saved on leaving: beside its README under `./run verify`."""
        with plt.rc_context(STYLE):
            figure, axes = plt.subplots(1, columns, figsize=(width * columns, height))
            yield axes
            target = self.folder if self.results else self.scratch
            figure.savefig(target / "figure.png", metadata={"Software": None})
            plt.close(figure)


# The contact models that a linear spring-dashpot case goes through.
CONTACTS = ["granular", "gran/cluster"]
