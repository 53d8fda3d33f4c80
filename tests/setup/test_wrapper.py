"""build/bin/lmp: LAMMPS with the plugin loaded, from any folder and under mpirun."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LMP = Path(os.environ.get("CLUSTERDEM_LMP", ROOT / "build" / "bin" / "lmp"))
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
pytestmark = pytest.mark.skipif(not LMP.exists(), reason="type ./run setup first")


def run(folder, *command, **environment):
    (folder / "in.styles").write_text("info styles fix\nplugin list\n")
    result = subprocess.run(
        [*map(str, command), "-in", "in.styles", "-log", "none"],
        cwd=folder,
        env=os.environ | AS_ROOT | environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def test_any_folder(tmp_path):
    assert "Loaded 1 plugins" in run(tmp_path, LMP)


def test_through_a_link_with_a_space(tmp_path):
    folder = tmp_path / "a folder"
    folder.mkdir()
    (folder / "lmp").symlink_to(LMP)
    assert "Loaded 1 plugins" in run(folder, "./lmp")


def test_under_mpirun(tmp_path):
    said = run(tmp_path, "mpirun", "--oversubscribe", "-np", "2", LMP)
    assert said.count("Loaded 1 plugins") == 1


def test_other_plugins_are_kept(tmp_path):
    (tmp_path / "mine").mkdir()
    said = run(tmp_path, LMP, LAMMPS_PLUGIN_PATH=str(tmp_path / "mine"))
    assert f"Loaded 0 plugins from {tmp_path}/mine" in said
    assert "Loaded 1 plugins" in said


@pytest.mark.skipif(not (ROOT / "build" / ".loads").exists(), reason="type ./run setup first")
def test_setup_does_nothing_when_nothing_is_missing():
    if any(name in os.environ for name in ("LAMMPS_SOURCE_DIR", "LAMMPS_EXE")):
        pytest.skip("with the user's own LAMMPS")
    plugin = ROOT / "build" / "plugin" / "clusterplugin.so"
    command = [ROOT / "run", "setup"]
    subprocess.run(command, stdin=subprocess.DEVNULL, timeout=300, check=True)
    before = plugin.stat().st_mtime_ns
    again = subprocess.run(command, stdin=subprocess.DEVNULL, timeout=300, check=True, capture_output=True, text=True)
    assert again.stdout + again.stderr == ""  # each step that does something says so
    assert plugin.stat().st_mtime_ns == before


@pytest.mark.skipif(not shutil.which("cmake"), reason="no cmake here")
@pytest.mark.parametrize(
    "source, message",
    [
        (None, "Say where LAMMPS is"),
        ("", "holds neither version.h nor src/version.h"),
        ('#define LAMMPS_VERSION "29 Aug 2024"', "LAMMPS of 4 Feb 2025 or later is needed"),
        ("#define LAMMPS_VERSION", "No version date"),
    ],
)
def test_cmake_says_what_is_wrong_with_the_source(tmp_path, source, message):
    arguments = ["cmake", "-S", str(ROOT), "-B", str(tmp_path / "build")]
    if source is not None:
        arguments.append(f"-DLAMMPS_SOURCE_DIR={tmp_path}")
        if source:
            (tmp_path / "version.h").write_text(source + "\n")
    result = subprocess.run(arguments, capture_output=True, text=True, check=False)
    assert result.returncode != 0
    assert message in " ".join(result.stderr.split())
