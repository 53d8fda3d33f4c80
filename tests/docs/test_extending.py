"""The worked examples of doc/extending.md: applied to a copy of the sources, compiled, their unit tests and the engine run.

Only what the examples change is compiled, without optimization, and linked with the other objects of this build, as an
incremental build does.
"""

import json
import math
import os
import re
import shlex
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from checkout import BUILD, ROOT, copy_sources
from lammps_run import Run, clusters, diameter, head, pair, write

EXAMPLES = ("drag_law", "size_law", "placement")


def command_of(entry: dict, tree: Path, output: Path) -> list[str]:
    """How a file is compiled, for its copy; without optimization."""
    words = [word.replace(str(ROOT), str(tree)) for word in shlex.split(entry["command"])]
    words[words.index("-o") + 1] = str(output)
    return ["-O0" if word == "-O3" else word for word in words]


def objects_that_need(changed: set[str]) -> set[str]:
    """Objects of the plugin that were compiled from any of these files, as the last build noted it."""
    text = subprocess.run(["ninja", "-C", BUILD, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    need = set()
    for block in text.split("\n\n"):
        name, *files = block.splitlines() or [""]
        if any(os.path.relpath(os.path.join(BUILD, file.strip()), ROOT) in changed for file in files):
            need.add(name.split(":")[0])
    return need


@pytest.fixture(scope="module")
def extended(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A tree with all three examples, its plugin in plugin/ and its new unit tests as new_tests."""
    # objects of other sources than the copy's would be linked otherwise
    subprocess.run(["cmake", "--build", BUILD, "--target", "clusterplugin"], check=True, capture_output=True)
    tree = copy_sources(tmp_path_factory.mktemp("extended"))
    changed = set()
    for example in EXAMPLES:
        patch = ROOT / "doc" / "extending" / f"{example}.patch"
        subprocess.run(["patch", "-p1", "-F3", "-i", patch], cwd=tree, check=True, capture_output=True)
        changed |= set(re.findall(r"^\+\+\+ b/(.*)$", patch.read_text(), re.M))

    (tree / "objects").mkdir()
    (tree / "plugin").mkdir()
    plugin = [
        e for e in json.loads((BUILD / "compile_commands.json").read_text()) if "clusterplugin.dir" in e["command"]
    ]
    stale = objects_that_need(changed)
    jobs, linked = [], []
    for entry in plugin:
        old = shlex.split(entry["command"])[-3]
        if old in stale:
            linked.append(tree / "objects" / Path(old).name)
            jobs.append(command_of(entry, tree, linked[-1]))
        else:
            linked.append(BUILD / old)
    assert jobs
    tests = [f'#include "{file}"\n' for file in sorted(changed) if file.startswith("tests/model/test_")]
    assert len(tests) == len(EXAMPLES)
    (tree / "new_tests.cpp").write_text("".join(tests))
    flags = ["-std=c++17", "-O0", "-ffp-contract=off", f"-I{tree}", f"-I{tree}/src/CLUSTER", f"-I{tree}/tests/model"]
    jobs.append(["c++", *flags, "new_tests.cpp", "-o", "new_tests", "-lgtest_main", "-lgtest", "-pthread"])

    def compile_one(command: list[str]) -> None:
        done = subprocess.run(command, cwd=tree, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr[-3000:]

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(compile_one, jobs))
    compile_one(["c++", "-shared", "-Wl,-z,nodelete", "-o", "plugin/clusterplugin.so", *map(str, linked)])
    return tree


def run(tree: Path, folder: Path, script: str) -> Run:
    cache = (BUILD / "CMakeCache.txt").read_text()
    engine = re.search(r"^LAMMPS_EXE:\w+=(.*)$", cache, re.M)[1]
    (folder / "in.lmp").write_text(script)
    done = subprocess.run(
        [engine, "-in", "in.lmp", "-log", "none"],
        cwd=folder,
        env=os.environ | {"LAMMPS_PLUGIN_PATH": str(tree / "plugin")},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr
    return Run(done.returncode, done.stdout, folder)


def test_unit_tests_of_the_examples(extended: Path) -> None:
    done = subprocess.run([extended / "new_tests", "--gtest_brief=1"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    assert "PASSED" in done.stdout and " 0 tests" not in done.stdout


def test_drag_law(extended: Path, tmp_path: Path) -> None:
    script = head() + clusters((400, (0.02, 0.02), (0.0, 0.0))) + pair()
    script += "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 0.3 law beetstra 0.5\nrun 0\n" + write("f_drag[7]")
    row = run(extended, tmp_path, script).dump()
    d = diameter(400)
    reynolds = 0.3 * d / 1.53e-5
    re = reynolds / 2  # of the superficial slip; eps = es = 1/2
    fast = 0.413 * re / 6 * (2 + 0.75 + 8.4 * re**-0.343) / (1 + 10**1.5 * re**-1.5)
    force = 3 * math.pi * 1.2 * 1.53e-5 * d * 0.15 * (20 + 0.25 * (1 + 1.5 * math.sqrt(0.5)) + fast)
    assert row["f_drag[7]"][0] == pytest.approx(reynolds, rel=1e-12)
    assert row["fz"][0] == pytest.approx(force, rel=1e-9)  # the table of C_D Re holds 1e-10


def test_size_law(extended: Path, tmp_path: Path) -> None:
    script = head() + clusters((400, (0.02, 0.02), (0.0, 0.0))) + pair()
    script += "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2\n"
    script += "fix size all cluster/breakmerge 10 1e-4 2000 drag drag K 0.004 exponent 0.4\nrun 0\n"
    row = run(extended, tmp_path, script + write("f_size[3]", "f_size[4]", "f_size[6]")).dump()
    power = row["f_size[4]"][0] - row["f_size[6]"][0]
    assert power > 1.0
    assert diameter(3) < row["f_size[3]"][0] < diameter(2000)
    assert row["f_size[3]"][0] == pytest.approx(0.004 / power**0.4, rel=1e-12)  # rounding


def test_placement(extended: Path, tmp_path: Path) -> None:
    """A cluster of 90 at the stable size of 10 breaks into a square of nine, whose sides meet at right angles."""
    script = head() + clusters((90, (0.02, 0.02), (0.0, 0.0))) + pair() + "fix move all nve\n"
    script += "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2\n"
    size = "fix size all cluster/breakmerge 1 1e-4 2000 drag drag terms st merge no lattice square K "
    power = run(extended, tmp_path, script + size + "1.0\nrun 0\n" + write("f_size[4]")).dump()["f_size[4]"][0]
    script += f"{size} {diameter(10.5) * power:.17g}\n"
    end = run(extended, tmp_path, script + "timestep 1e-9\nrun 1\n" + write()).dump()
    assert len(end["x"]) == 9
    at = np.column_stack((end["x"], end["z"]))
    distance = np.sort(np.linalg.norm(at[:, None] - at[None], axis=-1), axis=1) / (2 * diameter(10))
    # of the nine one has four neighbors at a spacing, four have three, four have two; hexagonal: six around one
    neighbors = sorted(int(np.sum(np.abs(row - 1.0) < 1e-6)) for row in distance)
    assert neighbors == [2, 2, 2, 2, 3, 3, 3, 3, 4]
