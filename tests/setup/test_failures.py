"""Each way in which set-up can fail ends with one clear message: what is missing, what to type."""

import os
import shutil
import signal
import subprocess
import time

import pytest

TARBALL = "lammps_20250204+dfsg.1.orig.tar.xz"
needs_apt = pytest.mark.skipif(not shutil.which("apt-get"), reason="no apt-get here")


def test_no_apt(machine):
    said = machine.without("apt-get", "mpirun", "ninja").fails()
    assert "missing: ninja mpirun. There is no apt-get here" in said
    assert "on Debian: ninja-build openmpi-bin" in said


def test_neither_root_nor_sudo(machine):
    machine.command("apt-get", "echo called; exit 1")
    said = machine.without("mpirun", "cmake", "sudo").fails(as_nobody=True)
    assert "sudo apt-get install --no-install-recommends cmake openmpi-bin\n" in said
    assert "called" not in said


def test_sudo_that_wants_a_password(machine):
    machine.command("sudo", "exit 1")
    said = machine.without("mpirun").fails(as_nobody=True)
    assert "sudo apt-get install --no-install-recommends openmpi-bin\n" in said


def test_absent_lists_are_fetched_once(machine):
    """The first install fails for want of lists, then `update`, then install again."""
    log = machine.folder / "calls"
    machine.command(
        "apt-get",
        f'echo "$*" >>{log}\ncase "$*" in *update) touch {log}.updated;; esac\n'
        f"[ -e {log}.updated ] || exit 100\nln -sf /bin/true {machine.bin}/mpirun",
    )
    machine.without("mpirun").fails(CXX="/nonexistent")  # stops at the compiler, after the tools
    install = "-q -y install --no-install-recommends openmpi-bin"
    assert log.read_text().splitlines() == [install, "-q -y update", install]


def test_packages_cannot_be_installed(machine):
    machine.command("apt-get", 'echo "E: no such host" >&2; exit 100')
    machine.command("sudo", 'shift; exec "$@"')
    said = machine.without("mpirun").fails()
    assert "could not be installed (no network?): openmpi-bin" in said
    assert "E: no such host" in said


@pytest.mark.parametrize(
    "compiler, found",
    [("echo '#define __GNUC__ 8'", "GCC 8"), ("echo '#define __clang_major__ 9'", "Clang 9"), ("exit 1", "none")],
)
def test_compiler_too_old(machine, compiler, found):
    old = machine.script(machine.folder / "old-c++", compiler)
    said = machine.fails(CXX=str(old))
    assert f"the compiler {old} is too old or does not work (found: {found})" in said
    assert "CXX=g++-12 ./run setup" in said


@needs_apt
def test_no_network(machine):
    said = machine.offline().fails()
    assert "no network, or a proxy in the way?" in said
    assert "LAMMPS_SOURCE_DIR=/path/lammps LAMMPS_EXE=/path/lmp ./run setup" in said
    assert not list(machine.cache.glob("downloads/trixie/apt.*/")), "the private lists are removed"


def test_no_debian(machine):
    """apt-get without any Debian archive among its sources."""
    machine.command("apt-get", "exit 100")
    said = machine.fails(APT_ETC=str(machine.folder))
    assert "this is no Debian system" in said
    assert "LAMMPS_SOURCE_DIR=/path/lammps" in said


def test_disk_full(machine):
    machine.command("df", "echo; echo disk 1048576 1038336 10240 99% /")
    said = machine.fails()
    assert "disk full: the build of LAMMPS needs 1500 MB" in said
    assert "where 10 MB are free" in said
    assert "XDG_CACHE_HOME=/other/disk ./run setup" in said


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can mount")
def test_small_disk(machine):
    small = machine.folder / "cache"
    small.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=10m", "tmpfs", small], check=False).returncode:
        pytest.skip("mounting is not allowed here")
    try:
        assert "where 10 MB are free" in machine.fails()
    finally:
        subprocess.run(["umount", small], check=True)


@needs_apt
def test_corrupt_tarball_in_the_cache(machine):
    tarball = machine.cache / "downloads" / "trixie" / TARBALL
    tarball.parent.mkdir(parents=True)
    tarball.write_text("half a download")
    said = machine.offline().fails()
    assert f"{tarball} was corrupt: deleted." in said
    assert not tarball.exists()


def fake_archive(machine, action):
    """An apt-get whose `source` does ACTION, and one Debian archive to ask."""
    (machine.folder / "sources.list").write_text("deb http://mirror.example/debian bookworm main\n")
    machine.environment["APT_ETC"] = str(machine.folder)
    keyring = machine.folder / "keyring.gpg"
    keyring.touch()
    machine.environment["APT_KEYRING"] = str(keyring)
    machine.command("apt-get", f'case "$*" in *source*) {action};; esac')


def test_wrong_checksum(machine):
    fake_archive(machine, f"echo garbage >{TARBALL}")
    said = machine.fails()
    assert f"the fetched {TARBALL} has a wrong SHA-256 and was deleted." in said
    assert not list(machine.cache.rglob(TARBALL))


def test_other_version_in_the_archive(machine):
    fake_archive(machine, "echo other >lammps_20991231.orig.tar.xz")
    assert f"holds another version of LAMMPS than {TARBALL}" in machine.fails()


def test_interrupted(machine):
    fake_archive(machine, "sleep 60")
    process = machine.start()
    deadline = time.monotonic() + 60
    while not list(machine.cache.glob("downloads/trixie/apt.*/new")) and time.monotonic() < deadline:
        time.sleep(0.1)
    os.killpg(process.pid, signal.SIGINT)
    said, _ = process.communicate(timeout=60)
    assert process.returncode == 130
    assert said.count("interrupted: nothing half-made will be used") == 1
    assert not list(machine.cache.glob("downloads/trixie/apt.*/"))


def test_unknown_words(machine):
    assert "unknown verb 'caes1'. Type ./run help" in machine.fails("./run", "caes1")
    assert "say --lammps newest" in machine.fails("./run", "setup", "--lammps", "oldest")
    assert "unknown argument fast" in machine.fails("./run", "setup", "fast")
    assert "--np wants the number of ranks" in machine.fails("./run", "case1", "--np", "two")


def test_a_build_folder_of_another_checkout_is_left_alone(machine, tmp_path):
    """A link build -> OTHER/build: the other checkout would be given this one's code. A checkout that moved is no such case."""
    other = tmp_path / "other"
    (other / "build" / "venv").mkdir(parents=True)
    (other / "run").touch()
    cache = other / "build" / "CMakeCache.txt"
    cache.write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={other}\n")
    shutil.rmtree(machine.folder / "build")
    (machine.folder / "build").symlink_to(other / "build")
    script = "build=$root/build; source setup/plugin.sh\nbuild_plugin() { echo BUILT; }\nbuild_python() { :; }\ncheck_build_is_ours\nbuild_plugin"
    process = machine.bash(script)
    output = process.communicate(timeout=60)[0]
    assert process.returncode != 0 and f"is the build folder of {other}, too" in output and "BUILT" not in output
    (other / "run").unlink()  # the other one is gone
    process = machine.bash(script)
    assert "BUILT" in process.communicate(timeout=60)[0] and process.returncode == 0
