"""The sources keep to what `./run lint` asks, and it notices when they do not."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def lint(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["./run", "lint", *arguments], cwd=ROOT, capture_output=True, text=True, check=False)


def test_sources_are_clean() -> None:
    r = lint()
    assert r.returncode == 0, r.stdout + r.stderr


@pytest.mark.parametrize(
    ("name", "text", "tool"),
    [
        ("src/CLUSTER/model/lint_probe.h", "int  f( );\n", "clang-format"),
        ("bench/lint_probe.py", "x = [1,2]\n", "ruff format"),
        ("bench/lint_probe.py", "import os\n", "ruff check"),
        ("python/src/clusterdem/lint_probe.py", "def f(x):\n    return x\n", "mypy"),
    ],
)
def test_untidy_file_is_named(name: str, text: str, tool: str) -> None:
    file = ROOT / name
    try:
        file.write_text(text)
        r = lint()
        assert r.returncode != 0
        assert f"FAILED: {tool}" in r.stderr
        assert "lint_probe" in r.stdout + r.stderr
    finally:
        file.unlink()


def test_unknown_argument_is_refused() -> None:
    r = lint("--tiddy")
    assert r.returncode == 2
    assert "--tiddy" in r.stderr and "--tidy" in r.stderr
