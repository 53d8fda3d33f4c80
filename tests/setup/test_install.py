"""What `cmake --install` and `pip wheel` put where, and the one version that all of it bears."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import clusterdem
import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("CLUSTERDEM_BUILD", ROOT / "build"))
VERSION = clusterdem.__version__


def run(*command: str | Path, **options) -> str:
    r = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, **options)
    assert r.returncode == 0, r.stdout + r.stderr
    return r.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory) -> Path:
    prefix = tmp_path_factory.mktemp("prefix")
    run("cmake", "--install", BUILD, "--prefix", prefix)
    return prefix


def plugin_of(prefix: Path) -> Path:
    (plugin,) = prefix.glob("lib*/**/lammps/plugins/clusterplugin.so")
    return plugin


def test_plugin_path_finds_the_plugin_and_says_its_version(installed, tmp_path):
    engine = re.search(r'^exec "(.*?)"', (BUILD / "bin" / "lmp").read_text(), re.M)[1]
    environment = os.environ | {"LAMMPS_PLUGIN_PATH": str(plugin_of(installed).parent)}
    (tmp_path / "in").write_text("plugin list\n")
    said = run(engine, "-in", "in", "-log", "none", cwd=tmp_path, env=environment)
    assert f"Cluster DEM {VERSION} for LAMMPS" in said
    assert "fix style plugin cluster/breakmerge" in said


def test_installed_wrapper_runs_the_installed_case(installed, tmp_path):
    inputs = installed / "share" / "clusterdem" / "inputs"
    case = ("-in", inputs / "case1.in", "-var", "inputs", inputs, "-var", "tend", "2e-5", "-log", "none")
    said = run(installed / "bin" / "lmp_cluster", *case, cwd=tmp_path)
    assert "Total wall time" in said
    assert (tmp_path / "case1.restart").exists()


def test_plugin_exports_its_version(installed):
    plugin = plugin_of(installed)
    assert "clusterdem_version" in run("nm", "-D", "--defined-only", plugin)
    assert VERSION.encode() + b"\0" in plugin.read_bytes()


def test_one_version():
    assert f"\nversion: {VERSION}\n" in (ROOT / "CITATION.cff").read_text()
    assert re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.M)[1] == VERSION


def test_wheel_holds_the_package(tmp_path):
    source = shutil.copytree(ROOT / "python", tmp_path / "python", ignore=shutil.ignore_patterns("build", "*.egg-info"))
    run(sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", tmp_path, source)
    (wheel,) = tmp_path.glob("*.whl")
    assert wheel.name == f"clusterdem-{VERSION}-py3-none-any.whl"
    inside = {name for name in zipfile.ZipFile(wheel).namelist() if name.startswith("clusterdem/")}
    assert inside == set(run("git", "ls-files", "clusterdem", cwd=ROOT / "python" / "src").split())
