"""What src/LIGGGHTS/README.md says to copy into LIGGGHTS' sources is all that its compiler needs."""

import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
HEADERS = Path("/usr/include/liggghts")


@pytest.mark.skipif(not HEADERS.is_dir(), reason="the headers of LIGGGHTS are not installed")
def test_what_is_copied_compiles(tmp_path):
    page = (ROOT / "src/LIGGGHTS/README.md").read_text(encoding="utf-8")
    lines = re.findall(r"^(?:cp|rm) .*LIGGGHTS/src/.*$", page, re.M)
    assert len(lines) > 5
    (tmp_path / "LIGGGHTS/src").mkdir(parents=True)
    (tmp_path / "src").symlink_to(ROOT / "src")
    subprocess.run(["bash", "-ec", "\n".join(lines)], cwd=tmp_path, check=True)
    sources = sorted((tmp_path / "LIGGGHTS/src").glob("*.cpp"))
    assert len(sources) > 25
    mpi = subprocess.run(["mpicxx", "-showme:compile"], capture_output=True, text=True, check=True).stdout.split()

    def compiled(source: Path) -> str:
        flags = "-DCLUSTER_FOR_LIGGGHTS -std=c++17 -ffp-contract=off -fsyntax-only -w".split()
        done = subprocess.run(
            ["c++", *flags, *mpi, "-isystem", str(HEADERS), source.name],
            cwd=source.parent,
            capture_output=True,
            text=True,
        )
        return "" if done.returncode == 0 else f"{source.name}: {done.stderr[:600]}"

    with ThreadPoolExecutor(2) as pool:
        assert [text for text in pool.map(compiled, sources) if text] == []
