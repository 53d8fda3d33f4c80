"""Copies of the checkout to work in, and the site as `./run docs` builds it."""

import subprocess
from pathlib import Path

import pytest
from checkout import ROOT, copy_sources


@pytest.fixture
def copied_sources(tmp_path: Path) -> Path:
    return copy_sources(tmp_path / "clusterdem")


@pytest.fixture(scope="session")
def site() -> Path:
    """build/docs, made anew."""
    made = subprocess.run(["./run", "docs"], cwd=ROOT, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert made.returncode == 0, made.stdout + made.stderr
    return ROOT / "build" / "docs"
