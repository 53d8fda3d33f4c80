"""Copies of the checkout to work in, and the site as `./run docs` builds it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("CLUSTERDEM_BUILD", ROOT / "build"))
sys.path[:0] = [str(ROOT / "doc" / "extensions"), str(Path(__file__).parent)]


def copy_sources(folder: Path) -> Path:
    """All files of the checkout, also those not yet added, without what is built."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    for name in set(listed.stdout.split("\0")) - {""}:
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


@pytest.fixture
def copied_sources(tmp_path: Path) -> Path:
    return copy_sources(tmp_path / "clusterdem")


@pytest.fixture(scope="session")
def site() -> Path:
    """build/docs, made anew."""
    made = subprocess.run(["./run", "docs"], cwd=ROOT, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert made.returncode == 0, made.stdout + made.stderr
    return ROOT / "build" / "docs"
