"""Tries thousands of continuations of one LAMMPS input a minute, each in a process of its own."""

from __future__ import annotations

import os
import signal
import subprocess
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("CLUSTERDEM_BUILD", ROOT / "build"))
LMP = os.environ.get("CLUSTERDEM_LMP", str(BUILD / "bin" / "lmp"))

SECONDS = 30  # a line takes milliseconds: one that takes this long, on a busy machine, hangs
MEGABYTES = 2048  # of address space; a line that wants more wants it by mistake


def build_server() -> Path:
    """Compile fork_server.cpp for the LAMMPS of this build; nothing happens when it is current."""
    folder = BUILD / "fuzz"
    wanted = ("LAMMPS_SOURCE_DIR:", "LAMMPS_SIZES:", "CMAKE_CXX_COMPILER:")
    settings = ["-D" + line for line in (BUILD / "CMakeCache.txt").read_text().splitlines() if line.startswith(wanted)]
    call("cmake", "-S", str(Path(__file__).parent), "-B", str(folder), *settings)
    call("cmake", "--build", str(folder))
    return folder / "fork_server.so"


def call(*command: str) -> None:
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


@dataclass
class Answer:
    """How one continuation ended, and all that it printed."""

    status: int
    output: str

    @property
    def ending(self) -> str:
        if self.status < 0:
            name = signal.Signals(-self.status).name
            return f"hangs (over {SECONDS} s)" if name == "SIGALRM" else f"killed by {name}"
        known = ["ran", "refused", "an exception that LAMMPS does not know", "not finite"]
        return known[self.status] if self.status < len(known) else f"exit code {self.status}"


class Server:
    """A LAMMPS process that has read `scene` and waits for continuations."""

    def __init__(self, folder: Path, scene: str):
        plugin = build_server()
        # the address sanitizer reserves terabytes of address space
        megabytes = 0 if "ASAN_OPTIONS" in os.environ else MEGABYTES
        script = scene + f"plugin load {plugin}\nfork_server {SECONDS} {megabytes}\n"
        (folder / "scene.lmp").write_text(script)
        environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        self.process = subprocess.Popen(
            [LMP, "-in", "scene.lmp", "-log", "none"],
            cwd=folder,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        said = b""
        while not said.endswith(b"fork_server ready\n"):
            line = self.process.stdout.readline()
            assert line, said.decode()
            said += line

    def run(self, script: str) -> Answer:
        text = script.encode()
        self.process.stdin.write(b"%d\n" % len(text) + text)
        self.process.stdin.flush()
        header = self.process.stdout.readline()
        assert header, "the server itself died"
        status, size = map(int, header.split())
        # one character per byte, as LAMMPS counts them when it places a caret
        return Answer(status, self.process.stdout.read(size).decode("latin-1"))

    def close(self) -> None:
        self.process.stdin.close()
        self.process.wait(timeout=60)
        self.process.stdout.close()
