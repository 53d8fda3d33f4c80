"""A small copy of the bootstrap in a folder of its own, on a machine made poorer one thing at a time."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NOBODY = 65534
# What a test may take away or replace; everything else of this machine stays on the PATH.
REMOVABLE = ("apt-get", "sudo", "mpirun", "mpicxx", "cmake", "ninja", "c++", "xz", "df")


class Machine:
    """`./run` of a copied checkout, with its own cache and a PATH from which commands can be taken."""

    def __init__(self, folder: Path, commands: Path) -> None:
        self.folder = folder
        self.cache = folder / "cache" / "clusterdem"
        self.bin = folder / "bin"
        self.environment = {
            "HOME": str(folder),
            "XDG_CACHE_HOME": str(folder / "cache"),
            "PATH": f"{self.bin}:{commands}",
            "LC_ALL": "C",
        }
        for name in ("run", "setup", "CMakeLists.txt"):
            copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy2
            copy(ROOT / name, folder / name)
        (folder / "build" / "venv" / "bin").mkdir(parents=True)
        self.script(folder / "build" / "venv" / "bin" / "python", "exit 0")
        self.bin.mkdir()
        for command in REMOVABLE:
            if found := shutil.which(command):
                (self.bin / command).symlink_to(found)

    def without(self, *commands: str) -> "Machine":
        for command in commands:
            (self.bin / command).unlink(missing_ok=True)
        return self

    def script(self, path: Path, body: str) -> Path:
        path.unlink(missing_ok=True)
        path.write_text(f"#!/bin/sh\n{body}\n")
        path.chmod(0o755)
        return path

    def command(self, name: str, body: str) -> Path:
        return self.script(self.bin / name, body)

    def offline(self) -> "Machine":
        for name in ("http_proxy", "https_proxy"):
            self.environment[name] = "http://127.0.0.1:9"
        return self

    def start(self, *arguments: str, as_nobody: bool = False, **environment: str) -> subprocess.Popen:
        as_user = {}
        if as_nobody and os.geteuid() == 0:
            subprocess.run(["chown", "-R", str(NOBODY), str(self.folder)], check=True)
            as_user = {"user": NOBODY, "group": NOBODY, "extra_groups": []}
        return subprocess.Popen(
            arguments or ["./run", "setup"],
            cwd=self.folder,
            env=self.environment | environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
            **as_user,
        )

    def fails(self, *arguments: str, **options) -> str:
        """What a command says that is expected to fail."""
        process = self.start(*arguments, **options)
        output, _ = process.communicate(timeout=120)
        assert process.returncode == 2, output
        return output

    def bash(self, body: str) -> subprocess.Popen:
        """BODY with the functions of setup/ at hand."""
        files = "common debian debian_source lammps"
        return self.start(
            "bash",
            "-c",
            "set -euo pipefail; shopt -s inherit_errexit; root=$PWD cache=$XDG_CACHE_HOME/clusterdem\n"
            f'for f in {files}; do source "setup/$f.sh"; done\n{body}',
        )


def public_folder():
    """Not pytest's own folder: that one is closed to the unprivileged user of some tests."""
    folder = tempfile.TemporaryDirectory(prefix="clusterdem-setup-")
    os.chmod(folder.name, 0o755)
    return folder


@pytest.fixture(scope="session")
def commands():
    """A folder of links to this machine's commands, without the removable ones."""
    found = {}
    for source in ("/bin", "/sbin", "/usr/bin", "/usr/sbin", "/usr/local/bin"):
        if os.path.isdir(source):
            found |= {entry.name: entry.path for entry in os.scandir(source)}
    with public_folder() as folder:
        for name in found.keys() - set(REMOVABLE):
            os.symlink(found[name], f"{folder}/{name}")
        yield Path(folder)


@pytest.fixture
def machine(commands):
    with public_folder() as folder:
        yield Machine(Path(folder), commands)
