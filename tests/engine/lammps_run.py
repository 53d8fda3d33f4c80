"""Runs real LAMMPS inputs as subprocesses and reads what they leave."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
LMP = os.environ.get("CLUSTERDEM_LMP", str(ROOT / "build" / "bin" / "lmp"))

D_P = 1e-4  # diameter of a primary particle [m]
RHO_P = 2000.0  # its density [kg/m^3]
M_P = float(np.pi) / 6 * D_P**3 * RHO_P  # its mass [kg]


def diameter(n: float, voidage: float = 0.5) -> float:
    """Equivalent diameter [m] of n particles (MODEL section 1)."""
    return float(D_P * np.cbrt(n / (1.0 - voidage)))


@dataclass
class Run:
    """One finished run: exit code, all that it printed, the folder that it ran in."""

    code: int
    output: str
    folder: Path

    def dump(self, name: str = "end.dump") -> dict[str, np.ndarray]:
        """Columns of the last frame of a custom dump, sorted by id."""
        return self.frames(name)[-1]

    def frames(self, name: str) -> list[dict[str, np.ndarray]]:
        frames, lines = [], (self.folder / name).read_text().splitlines()
        while lines:
            start = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
            count = int(lines[lines.index("ITEM: NUMBER OF ATOMS") + 1])
            names = lines[start].split()[2:]
            rows = np.array([line.split() for line in lines[start + 1 : start + 1 + count]], dtype=float)
            rows = rows.reshape(count, len(names))
            rows = rows[np.argsort(rows[:, names.index("id")])]
            frames.append({name: rows[:, k] for k, name in enumerate(names)})
            lines = lines[start + 1 + count :]
        return frames

    def table(self, name: str = "out.txt") -> np.ndarray:
        """Rows of a fix ave/time file."""
        return np.atleast_2d(np.loadtxt(self.folder / name))


def launch(np_: int) -> list[str]:
    return [] if np_ == 1 else ["mpirun", "--oversubscribe", "-np", str(np_)]


def run(folder: Path, script: str, np_: int = 1, check: bool = True, timeout: float = 600, **variables) -> Run:
    """Run `script` in `folder` on np_ ranks."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "in.lmp").write_text(script)
    arguments = ["-in", "in.lmp", "-log", "log.lammps"]
    return run_file(folder, arguments, np_, check, timeout, **variables)


def run_file(
    folder: Path, arguments: list[str], np_: int = 1, check: bool = True, timeout: float = 600, **variables
) -> Run:
    folder.mkdir(parents=True, exist_ok=True)
    command = [*launch(np_), LMP, *arguments]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    environment = dict(os.environ)
    if os.geteuid() == 0:
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run(
        command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=timeout
    )
    result = Run(done.returncode, done.stdout + done.stderr, folder)
    # a finding of ./run sanitize ends a run like a refusal, but is never the one that a test expects
    assert "runtime error: " not in done.stderr, done.stderr[-3000:]
    if "keyword has been removed" in result.output:
        pytest.skip("another LAMMPS: " + result.output[result.output.index("ERROR: ") :].split("\n")[0])
    if check:
        assert result.code == 0, result.output[-3000:]
    return result


# ---- pieces of scripts ----

HEAD = """
units        si
atom_style   sphere
atom_modify  map hash sort 0 0
boundary     p f p
comm_modify  vel yes cutoff {ghost}
neighbor     0.5e-3 bin
newton       {newton}
region       box block 0 {x} 0 0.003 0 {z}
create_box   1 box
"""

HOOKE = "hooke 10.0 0.3 tangential linear_history 8.571428571 1.0 0.33 damping coeff_restitution"
CUTOFF = 1.5876e-3


def head(x: float = 0.04, z: float = 0.04, ghost: float = 5.7e-3, newton: str = "on") -> str:
    return HEAD.format(x=x, z=z, ghost=ghost, newton=newton)


def pair(model: str = HOOKE, cutoff: float = CUTOFF) -> str:
    return f"pair_style granular\npair_coeff * * {model} cutoff {cutoff}\n"


def clusters(*rows: tuple) -> str:
    """Clusters given as (n, (x, z), (vx, vz)), one type, all at y = 1.5 mm."""
    text = ""
    for k, (n, (x, z), (vx, vz)) in enumerate(rows, start=1):
        text += (
            f"create_atoms 1 single {x!r} 0.0015 {z!r}\n"
            f"set atom {k} diameter {diameter(n)!r}\nset atom {k} density 1000.0\n"
            f"set atom {k} vx {vx!r} vz {vz!r}\n"
        )
    return text


def random_clusters(count: int, n: int = 400, seed: int = 1) -> str:
    d = float(diameter(n))
    return (
        "region plane block EDGE EDGE 0.0015 0.0015 EDGE EDGE\n"
        f"create_atoms 1 random {count} {seed} plane overlap {d!r} maxtry 10000\n"
        f"set type 1 diameter {d!r}\nset type 1 density 1000.0\nreset_atoms id sort yes\n"
    )


def write(*columns: str, name: str = "end.dump") -> str:
    return (
        f"write_dump all custom {name} id x y z vx vy vz fx fz diameter mass {' '.join(columns)} "
        "modify sort id format float %.17g\n"
    )


@cache
def bits_of_ids() -> int:
    """Of this engine: 32, or 64 where it was built with -DLAMMPS_SIZES=bigbig."""
    said = subprocess.run([LMP, "-h"], capture_output=True, text=True, check=True).stdout
    return int(re.search(r"sizeof\(tagint\): *(\d+)-bit", said)[1])


def have_mpirun() -> bool:
    return shutil.which("mpirun") is not None
