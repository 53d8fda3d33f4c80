"""LAMMPS given by the user: what is wrong with it is said before anything is built."""

import pytest

HELP = """
Large-scale Atomic/Molecular Massively Parallel Simulator - {version}
{mpi}
Installed packages:

{packages}
"""


def give(machine, version="4 Feb 2025", engine=None, packages="GRANULAR PLUGIN", mpi="MPI v3.1: Open MPI v4.1.4"):
    source = machine.folder / "lammps" / "src"
    source.mkdir(parents=True)
    (source / "version.h").write_text(f'#define LAMMPS_VERSION "{version}"\n')
    text = HELP.format(version=engine or version, mpi=mpi, packages=packages)
    exe = machine.script(machine.folder / "lmp", f"cat <<'END'\n{text}\nEND")
    return {"LAMMPS_SOURCE_DIR": str(source.parent), "LAMMPS_EXE": str(exe)}


@pytest.mark.parametrize(
    "lammps, message",
    [
        ({"version": "29 Aug 2024"}, "is LAMMPS of 20240829; 4 Feb 2025 or later is needed"),
        ({"engine": "22 Jul 2025"}, "is version '22 Jul 2025'"),
        ({"packages": "PLUGIN"}, "has no package GRANULAR"),
        ({"packages": "GRANULAR"}, "has no package PLUGIN"),
        ({"mpi": "MPI v1.0: LAMMPS MPI STUBS for LAMMPS version 4 Feb 2025"}, "was built without MPI"),
    ],
)
def test_unfit(machine, lammps, message):
    assert message in machine.fails(**give(machine, **lammps))


@pytest.mark.parametrize("given, missing", [("LAMMPS_EXE", "LAMMPS_SOURCE_DIR"), ("LAMMPS_SOURCE_DIR", "LAMMPS_EXE")])
def test_half_given(machine, given, missing):
    said = machine.fails(**{given: give(machine)[given]})
    assert f"{given} is given but {missing} is not." in said


def test_no_source_there(machine):
    lammps = give(machine) | {"LAMMPS_SOURCE_DIR": str(machine.folder)}
    assert "holds neither version.h nor src/version.h" in machine.fails(**lammps)


def test_engine_does_not_run(machine):
    lammps = give(machine)
    machine.script(machine.folder / "lmp", "echo libmpi.so.40: not found; exit 127")
    assert "does not run: libmpi.so.40: not found" in machine.fails(**lammps)
    lammps["LAMMPS_EXE"] = "no-such-lmp"
    assert "LAMMPS_EXE=no-such-lmp is not an executable file" in machine.fails(**lammps)


@pytest.mark.parametrize("folder", ["lammps", "lammps/src"])
def test_root_and_src_are_both_accepted(machine, folder):
    lammps = give(machine, version="4 Jul 2026", engine="4 Jul 2026 - Update 1")
    exports = " ".join(f"{name}={value}" for name, value in lammps.items())
    process = machine.bash(f'{exports}; LAMMPS_SOURCE_DIR=$PWD/{folder}; use_lammps pinned; echo "$LAMMPS_SOURCE_DIR"')
    said, _ = process.communicate(timeout=60)
    assert said.strip() == str(machine.folder / "lammps" / "src")
