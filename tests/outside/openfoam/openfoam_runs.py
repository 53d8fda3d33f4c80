"""Runs OpenFOAM's own tools on the set-ups beside this file, and asks OpenFOAM for its values at points.

Debian's package ``openfoam`` (v1912); `./run verify-gas` installs it.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
PROJECT = Path("/usr/share/openfoam")
HEAD = "FoamFile {{ version 2.0; format ascii; class dictionary; object {}; }}\n"


def installed() -> bool:
    return shutil.which("blockMesh") is not None


def tool(case: Path, *words: str) -> None:
    """Run a tool in a case; what it says goes to log.TOOL there."""
    env = os.environ | {
        "WM_PROJECT_DIR": str(PROJECT),
        "OMPI_ALLOW_RUN_AS_ROOT": "1",
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    }
    done = subprocess.run(words, cwd=case, env=env, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    (case / f"log.{words[0]}").write_text(done.stdout + done.stderr)
    if done.returncode:
        raise RuntimeError(f"{' '.join(words)} in {case}: {(done.stdout + done.stderr)[-800:]}")


def set_up(name: str, folder: Path, cells: tuple[str, str] | None = None) -> Path:
    """A copy of a set-up with its mesh; ``cells`` replaces numbers of cells, as (old, new)."""
    case = folder / name
    shutil.copytree(HERE / name, case)
    (case / "constant").mkdir(exist_ok=True)
    if cells:
        mesh = case / "system" / "blockMeshDict"
        text = mesh.read_text()
        assert cells[0] in text
        mesh.write_text(text.replace(*cells))
    tool(case, "blockMesh")
    if name in ("hanging", "dual"):
        tool(case, "topoSet")
        tool(case, "refineHexMesh", "c0", "-overwrite")
    if name == "dual":
        tool(case, "polyDualMesh", "30", "-overwrite")
    (case / "0").mkdir(exist_ok=True)
    return case


def solver(case: Path) -> str:
    words = (case / "system" / "controlDict").read_text().replace(";", " ").split()
    return words[words.index("application") + 1]


def solve(case: Path, layout: str = "whole") -> None:
    """Run a case's solver, on two ranks where the layout is "processors" or "collated"."""
    if layout == "whole":
        tool(case, solver(case))
        return
    handler = "collated" if layout == "collated" else "uncollated"
    tool(case, "decomposePar", "-fileHandler", handler)
    words = ("--oversubscribe", "-np", "2", solver(case), "-parallel", "-fileHandler", handler)
    tool(case, "mpirun", *words)


def sampled(case: Path, points: np.ndarray, fields: tuple[str, ...] = ("U",)) -> dict[str, np.ndarray]:
    """OpenFOAM's own values at points of the latest time, by its ``cellPointFace``; NaN where it finds no cell."""
    listed = " ".join("({:.12g} {:.12g} {:.12g})".format(*point) for point in points)
    (case / "system" / "asked").write_text(
        HEAD.format("asked")
        + "type sets; libs (sampling); writeControl writeTime; interpolationScheme cellPointFace;\n"
        f"setFormat raw; fields ({' '.join(fields)}); sets ( cloud {{ type cloud; axis xyz; points ({listed}); }} );\n"
    )
    tool(case, "postProcess", "-latestTime", "-func", "asked")
    found = {}
    for name in fields:
        (path,) = (case / "postProcessing" / "asked").glob(f"*/cloud_{name}.xy")
        rows = np.loadtxt(path, ndmin=2)
        at = np.argmin(np.linalg.norm(points[None, :, :] - rows[:, None, :3], axis=2), axis=1)
        values = np.full((len(points), rows.shape[1] - 3), np.nan)
        values[at] = rows[:, 3:]
        found[name] = values
    return found
