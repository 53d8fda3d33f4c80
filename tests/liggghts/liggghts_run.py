"""Runs LIGGGHTS with the fixes, and LAMMPS with the plugin, from one data file."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from lammps_run import ROOT, Run, diameter, launch
from lammps_run import run as run_lammps

BUILD = Path(os.environ.get("CLUSTERDEM_BUILD", ROOT / "build"))
WRAPPER = BUILD / "bin" / "liggghts-cluster"
LIBRARY = BUILD / "liggghts" / "liggghtscluster.so"

needs_liggghts = pytest.mark.skipif(
    not (WRAPPER.exists() and LIBRARY.exists()), reason="LIGGGHTS is not set up: ./run setup --liggghts"
)

COLUMNS = "id x y z vx vy vz diameter mass f_size[1] f_size[3] f_size[4] f_size[5] f_size[6] " + " ".join(
    f"f_drag[{k}]" for k in range(1, 9)
)
K_N = 10.0


def run_liggghts(folder: Path, script: str, np_: int = 1, check: bool = True) -> Run:
    """Run `script` in `folder` on np_ ranks."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "in.liggghts").write_text(script)
    environment = dict(os.environ)
    if os.geteuid() == 0:
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    command = [*launch(np_), str(WRAPPER), "-in", "in.liggghts", "-log", "log.liggghts"]
    done = subprocess.run(
        command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, timeout=300
    )
    output = (done.stdout + done.stderr).decode(errors="replace")  # its warnings may hold any bytes
    run = Run(done.returncode, output, folder)
    if check:
        assert run.code == 0, run.output[-3000:]
    return run


def write_data(path: Path, n, x, v, box=(0.04, 0.003, 0.04)) -> None:
    """Clusters of n[k] particles at x[k] with velocities v[k]; both engines read it alike."""
    lines = ["clusters", "", f"{len(n)} atoms", "1 atom types"]
    lines += [f"0 {length!r} {axis}lo {axis}hi" for axis, length in zip("xyz", box)]
    lines += ["", "Atoms", ""]
    lines += [
        f"{k} 1 {diameter(count)!r} 1000.0 " + " ".join(repr(float(c)) for c in at)
        for k, (count, at) in enumerate(zip(n, x), start=1)
    ]
    lines += ["", "Velocities", ""]
    lines += [f"{k} " + " ".join(repr(float(c)) for c in of) + " 0 0 0" for k, of in enumerate(v, start=1)]
    path.write_text("\n".join(lines) + "\n")


def head_liggghts(ghosts: float = 11e-3) -> str:
    return f"""
units si
atom_style granular
atom_modify map array sort 0 0
boundary p f p
newton off
communicate single vel yes cutoff {ghosts}
"""


def pair_liggghts(gamma: float = 0.0, tangential: str = "off", friction: float = 0.0) -> str:
    """Damping and tangential damping `gamma` [1/s], times the reduced mass."""
    values = {"kn": K_N, "kt": 6 / 7 * K_N, "gamman": gamma, "gammat": gamma, "coefficientFriction": friction}
    given = "".join(f"fix {k} all property/global {k} peratomtypepair 1 {value!r}\n" for k, value in values.items())
    return given + f"pair_style gran model hooke/stiffness tangential {tangential}\npair_coeff * *\n"


NEIGHBORS = "neighbor 0.5e-3 bin\nneigh_modify every 1 delay 0 check yes\n"


def start_liggghts(pair: str | None = None, data: str = "clusters.data") -> str:
    return head_liggghts() + f"read_data {data}\n" + NEIGHBORS + (pair_liggghts() if pair is None else pair)


def start_lammps(pair: str | None = None, data: str = "clusters.data") -> str:
    elastic = (
        f"pair_style granular\npair_coeff * * hooke {K_N} 1.0 tangential linear_nohistory 0.0 0.0 "
        "damping coeff_restitution cutoff 1.5876e-3\n"
    )
    return (
        "units si\natom_style sphere\natom_modify map hash sort 0 0\nboundary p f p\nnewton off\n"
        f"comm_modify vel yes cutoff 5.7e-3\nread_data {data}\n{NEIGHBORS}" + (elastic if pair is None else pair)
    )


def write(name: str = "end.dump") -> str:
    """For both engines; the format of LIGGGHTS is one for the whole row."""
    return f"write_dump all custom {name} {COLUMNS} modify sort id format "


def write_lammps(name: str = "end.dump") -> str:
    return write(name) + "float %.17g\n"


def write_liggghts(name: str = "end.dump") -> str:
    return write(name) + '"%d' + " %.17g" * (len(COLUMNS.split()) - 1) + '"\n'


def in_both(folder: Path, script: str, pairs: tuple[str | None, str | None] = (None, None)) -> tuple[Run, Run]:
    """`script` after the start from folder/clusters.data, with a dump at its end, by LAMMPS and by LIGGGHTS."""
    data = str(folder / "clusters.data")
    return (
        run_lammps(folder / "lammps", start_lammps(pairs[0], data) + script + write_lammps()),
        run_liggghts(folder / "liggghts", start_liggghts(pairs[1], data) + script + write_liggghts()),
    )


def agree(a: dict[str, np.ndarray], b: dict[str, np.ndarray], name: str, tolerance: float) -> None:
    """Relative to the largest value of the column."""
    scale = np.abs(a[name]).max()
    assert np.abs(a[name] - b[name]).max() <= tolerance * max(scale, 1e-300), name
