"""The cached build of LAMMPS: built once, never half, and only from Debian's own archive."""

import os
import signal
import time

import pytest

# In place of the real archive and the real compilation: a tarball of two files and a slow `cmake`
# that counts its calls. It leaves the log of its calls where the test can read it.
FAKES = """
lammps_tarball=none
fetch_lammps() {
  mkdir -p "$downloads/$1" lammps-9/src lammps-9/cmake lammps-9/doc
  echo '#define LAMMPS_VERSION "9 Sep 2029"' >lammps-9/src/version.h
  touch lammps-9/doc/large
  tar -cJf "$downloads/$1/$2" lammps-9
  echo fetched >>calls
}
need_space() { :; }
nice() {
  echo building >>calls
  [[ -e fast ]] || sleep 2
  echo '[1/1] linked'
  mkdir -p "$build"
  printf '%s\\n' '#!/bin/sh' 'echo dump custom/zstd' '# engine' >"$build/lmp"
  chmod +x "$build/lmp"
  echo built >>calls
}
cmake() { :; }
mpirun() { echo 1; }
use_lammps pinned
cat "$LAMMPS_EXE" "$LAMMPS_SOURCE_DIR/version.h"
"""


def test_two_at_once_build_once(machine):
    both = [machine.bash(FAKES), machine.bash(FAKES)]
    outputs = [process.communicate(timeout=60)[0] for process in both]
    assert [process.returncode for process in both] == [0, 0], outputs
    assert all('engine\n#define LAMMPS_VERSION "9 Sep 2029"' in output for output in outputs)
    assert sum("waiting for another ./run" in output for output in outputs) == 1
    assert (machine.folder / "calls").read_text().split() == ["fetched", "building", "built"]


def test_killed_build_goes_on(machine):
    calls = machine.folder / "calls"
    process = machine.bash(FAKES)
    deadline = time.monotonic() + 20
    while not (calls.exists() and "building" in calls.read_text()) and time.monotonic() < deadline:
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate(timeout=20)
    kept = [path.name for path in machine.cache.glob("lammps/*/")]
    assert kept and all(name.endswith(".part") for name in kept), "nothing looks finished"

    (machine.folder / "fast").touch()
    process = machine.bash(FAKES)
    assert "engine" in process.communicate(timeout=60)[0]
    assert calls.read_text().split() == ["fetched", "building", "building", "built"], "fetched only once"
    (home,) = machine.cache.glob("lammps/*/")
    assert sorted(path.name for path in home.iterdir()) == ["build.log", "lmp", "src"]


def test_build_without_compressed_dumps_is_refused(machine):
    (machine.folder / "fast").touch()
    process = machine.bash(FAKES.replace("echo dump custom/zstd", "echo dump custom"))
    assert "libzstd or pkg-config were not found" in process.communicate(timeout=60)[0]
    assert process.returncode == 2
    assert "engine" in machine.bash(FAKES).communicate(timeout=60)[0], "goes on once they are there"
    assert (machine.folder / "calls").read_text().split().count("fetched") == 1


def test_key_tells_builds_apart(machine):
    (machine.folder / "fast").touch()
    keys = set()
    for change in ("", "lammps_options+=(-DPKG_MISC=on)", "CXXFLAGS=-O1", "mpirun() { echo 2; }"):
        body = FAKES.replace("use_lammps pinned", f"{change}\nuse_lammps pinned\n")
        said = machine.bash(body + 'echo "$LAMMPS_EXE"').communicate(timeout=60)[0]
        keys.add(said.splitlines()[-1])
    assert len(keys) == 4


@pytest.mark.parametrize(
    "flavour, holds", [("portable", "-O3 -DNDEBUG"), ("sanitized", "-fsanitize=address,undefined")]
)
def test_other_engines_are_other_builds_without_native_code(machine, flavour, holds):
    (machine.folder / "fast").touch()
    body = FAKES.replace("cmake() { :; }", 'cmake() { echo "$*" >>options; }').replace(
        "use_lammps pinned",
        f"use_lammps pinned\necho $LAMMPS_EXE\nunset LAMMPS_SOURCE_DIR LAMMPS_EXE\nuse_lammps {flavour}\n",
    )
    body += "echo $LAMMPS_EXE\n"
    said = [line for line in machine.bash(body).communicate(timeout=60)[0].splitlines() if line.endswith("/lmp")]
    assert len(said) == len(set(said)) == 2
    pinned, other = (machine.folder / "options").read_text().splitlines()
    assert "-march=native" in pinned and "-fsanitize" not in pinned
    assert "-march=native" not in other and holds in other


def archives(machine, files):
    for name, text in files.items():
        path = machine.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    process = machine.bash(f"APT_ETC={machine.folder} debian_archives")
    return process.communicate(timeout=20)[0].split()


def test_archive_from_one_line_sources(machine):
    assert archives(
        machine,
        {
            "sources.list": """
# deb http://old.example/debian bookworm main
deb cdrom:[Debian GNU/Linux 12]/ bookworm main
deb [signed-by=/k.gpg arch=amd64] https://vendor.example/apt stable main
deb http://security.example/debian-security bookworm-security main
deb [arch=amd64] http://mirror.example/debian/ bookworm main contrib
deb-src http://mirror.example/debian/ bookworm main
"""
        },
    ) == ["http://mirror.example/debian/"]


def test_archive_from_deb822_sources(machine):
    assert archives(
        machine,
        {
            "sources.list.d/a.sources": "Types: deb\nURIs: https://vendor.example/node\nSuites: any\nComponents: main",
            "sources.list.d/debian.sources": """Types: deb
# a comment
URIs: http://mirror.example/debian
Suites: bookworm bookworm-updates
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg

Types: deb
URIs: http://mirror.example/debian-security
Suites: bookworm-security
Components: main
""",
        },
    ) == ["http://mirror.example/debian"]


def test_no_archive(machine):
    assert archives(machine, {}) == []
