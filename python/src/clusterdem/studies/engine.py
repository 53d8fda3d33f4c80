"""Which LAMMPS runs: where it is, and an identity that changes when it or a plugin does."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from ..errors import ArgumentError, InputError


@dataclass(frozen=True)
class Engine:
    """A LAMMPS executable.

    Parameters
    ----------
    path : str
        The executable.
    version : str
        What it says first, such as ``LAMMPS (4 Feb 2025)``.
    identity : str
        Hash of the version and the files.
    files : tuple of Path
        The executable, what it starts where it is a script, libraries of LAMMPS' that this maps, and the plugins.
    """

    path: str
    version: str
    identity: str
    files: tuple[Path, ...]

    @property
    def changed(self) -> bool:
        """Whether one of the files is another than when the engine was found."""
        return _identity(self.version, self.files) != self.identity


def _identity(version: str, files: tuple[Path, ...]) -> str:
    digest = hashlib.sha256(version.encode())
    for file in files:
        digest.update(file.read_bytes() if file.is_file() else b"gone")
    return digest.hexdigest()


PROBE = """shell "echo executable: $(readlink -f /proc/$PPID/exe)"
shell "cat /proc/$PPID/maps"
"""
"""A script with which the process that really runs tells who it is; LAMMPS leaves what stands in quotes as it is."""


def find_engine(given: str | None = None) -> Engine:
    """The executable that is given, or $CLUSTERDEM_LMP, or lmp beside this command, or lmp on the path."""
    beside = shutil.which("lmp", path=str(Path(sys.argv[0]).absolute().parent))
    named = given or os.environ.get("CLUSTERDEM_LMP")
    path = shutil.which(named) if named else beside or shutil.which("lmp")
    if path is None:
        raise ArgumentError("executable", f"{named or 'lmp'} is no executable: name LAMMPS here, or by CLUSTERDEM_LMP")
    path = os.path.abspath(path)
    with tempfile.NamedTemporaryFile("w", suffix=".in") as script:
        script.write(PROBE)
        script.flush()
        command = [path, "-in", script.name, "-log", "none"]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
    version = re.search(r"^LAMMPS \(.*?\)", done.stdout, re.MULTILINE)
    if done.returncode != 0 or version is None:
        raise InputError(path, f"is not LAMMPS, or does not start: {(done.stdout + done.stderr).strip()[-200:]}")
    files = [Path(path)]
    files += [Path(found) for found in re.findall(r"^executable: (/.+)$", done.stdout, re.MULTILINE)]
    files += [Path(found) for found in sorted(set(re.findall(r" (/\S*liblammps\S*)$", done.stdout, re.MULTILINE)))]
    for folder in re.findall(r"^Loaded \d+ plugins? from (.+)$", done.stdout, re.MULTILINE):
        files += sorted(Path(folder.strip()).glob("*plugin.so"))
    every = tuple(dict.fromkeys(files))
    return Engine(path, version[0], _identity(version[0], every), every)
