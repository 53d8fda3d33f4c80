"""Examples in docstrings and in the README are run; so are the words of the command line and the time it takes to say them."""

from __future__ import annotations

import ast
import doctest
import importlib
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import clusterdem
import numpy as np
import pytest
from clusterdem import Frame, observables
from clusterdem.cli import COMMANDS, _summary, parser
from synthetic import BOX, random_frame, write_dump

MODULES = sorted(
    module.name
    for module in pkgutil.walk_packages(clusterdem.__path__, "clusterdem.")
    if "__main__" not in module.name and ".gas" not in module.name
)
README = Path(__file__).parents[2] / "python/README.md"


@pytest.fixture
def files(tmp_path, monkeypatch):
    """The files that the examples read: one.dump, two clusters of 500 and 1000 µm; a folder case1."""
    monkeypatch.chdir(tmp_path)
    columns = {"x": np.array([0.1, 0.2]), "z": np.array([0.1, 0.5]), "diameter": np.array([5e-4, 1e-3])}
    columns["mass"] = 1000 * np.pi / 6 * columns["diameter"] ** 3
    write_dump(tmp_path / "one.dump", Frame(0, 0.0, BOX, columns), ["x", "z", "diameter", "mass"])
    folder = tmp_path / "case1"
    folder.mkdir()
    for i in (0, 1):
        write_dump(folder / f"case1.{10000 * i:08d}.dump", random_frame(100, 10000 * i, 0.01 * i))
    log = "create_atoms 1 random 5 ${seed} NULL\ncreate_atoms 1 random 5 7 NULL\n"
    (folder / "case1.log").write_text(log + "fix size all cluster/breakmerge 10 1e-4 2000 K 0.0266\n")
    before = dict(observables.REGISTRY)
    yield tmp_path
    observables.REGISTRY.clear()
    observables.REGISTRY.update(before)


@pytest.mark.parametrize("name", MODULES)
def test_examples(name, files):
    module = importlib.import_module(name)
    found = doctest.testmod(module, extraglobs={"np": np}, optionflags=doctest.IGNORE_EXCEPTION_DETAIL)
    assert found.failed == 0


def test_what_people_script_with_has_examples(files):
    """The names of the package that are worked with most."""
    for name in ("Frame", "Box", "Run", "Grid", "maps_of", "read_dumps", "sauter_diameter", "class_shares"):
        assert ">>>" in getattr(clusterdem, name).__doc__, name


def test_the_readmes_script_runs(files):
    (block,) = re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL)
    done = subprocess.run([sys.executable, "-c", block], cwd=files, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr


def test_public_names_are_those_of_the_stub():
    stub = ast.parse((Path(clusterdem.__file__).parent / "__init__.pyi").read_text())
    names = {alias.name for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert names == set(clusterdem.__all__) and all(getattr(clusterdem, name) is not None for name in names)
    assert set(clusterdem.__all__) <= set(dir(clusterdem))


def test_importing_the_package_brings_nothing_heavy():
    script = "import sys, clusterdem, clusterdem.cli; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert not {"numpy", "scipy", "polars", "matplotlib", "MDAnalysis", "cmaes", "vtkmodules"} & set(loaded)


@pytest.mark.parametrize("name", COMMANDS)
def test_a_commands_summary_is_its_first_line(name):
    module = importlib.import_module(f"clusterdem.cli.{name}")
    assert _summary(name) == module.__doc__.splitlines()[0]
    assert _summary(name).endswith(".") and len(_summary(name)) < 120
    assert parser(name).parse_args(_least(name)).run is module.run


def _least(name):
    """The fewest words that a command takes."""
    words = {"compare": ["a", "--case", "case1"], "start": [], "gas": ["jet"], "mixing": ["a", "--type", "1"]}
    return [name, *words.get(name, ["a"])]


def test_help_lists_every_command(command):
    code, out, _ = command("--help")
    assert code == 0 and all(re.search(rf"^    {name}\b", out, re.MULTILINE) for name in COMMANDS)
    for name in COMMANDS:
        code, out, _ = command(name, "--help")
        assert code == 0 and out.startswith(f"usage: clusterdem {name}")


@pytest.mark.parametrize(
    "words", [["mapp", "x"], ["map", "x", "--gird", "3", "3"], ["--versio"], [], ["sizes", "x", "--dt", "0"]]
)
def test_typos_end_with_usage(words, command):
    code, _, err = command(*words)
    assert code == 2 and "usage: clusterdem" in err
