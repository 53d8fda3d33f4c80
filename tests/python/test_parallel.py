"""Frames over MPI ranks, interruption, and memory."""

from __future__ import annotations

import hashlib
import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from synthetic import dump_text, random_frame, write_run

MPI = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", "2"]
needs_mpi = pytest.mark.skipif(
    shutil.which("mpirun") is None or importlib.util.find_spec("mpi4py") is None, reason="needs mpirun and mpi4py"
)


def run(arguments, launcher=(), **options):
    command = [*launcher, sys.executable, "-m", "clusterdem", *(str(a) for a in arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, **options)


def digests(folder):
    return {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir() if path.suffix != ".png"
    }


@needs_mpi
@pytest.mark.parametrize("one_file", [False, True])
def test_two_ranks_write_the_same_bytes(tmp_path, one_file):
    dumps = write_run(tmp_path, 5)
    if one_file:
        joined = tmp_path / "all.dump"
        joined.write_text("".join(path.read_text() for path in dumps))
        dumps = [joined]
    names = ("sizes", "velocities", "groups") if one_file else ("map", "flow", "mixing")
    more = {"map": ("--average", "2"), "flow": ("--average", "2"), "mixing": ("--above", "diameter", "1e-3")}
    for name in names:
        words = [name, *dumps, "--no-figures", *more.get(name, ())]
        one = run([*words, "--out", tmp_path / f"{name}1"])
        two = run([*words, "--out", tmp_path / f"{name}2"], MPI)
        assert (one.returncode, two.returncode) == (0, 0), two.stderr
        assert one.stdout.replace(f"{name}1", "") == two.stdout.replace(f"{name}2", "")
        assert digests(tmp_path / f"{name}1") == digests(tmp_path / f"{name}2")


@needs_mpi
def test_bad_input_on_either_rank_ends_both(tmp_path):
    dumps = write_run(tmp_path, 4)
    dumps[2].write_text(dumps[2].read_text()[:-300])
    done = run(["sizes", *dumps, "--no-figures", "--out", tmp_path / "out"], MPI)
    assert done.returncode == 2 and "Traceback" not in done.stderr
    assert done.stderr.count("clusterdem: ") == 1 and str(dumps[2]) in done.stderr
    assert (tmp_path / "out/sizes.csv").read_text().count("\n") == 3


@pytest.mark.parametrize("before", [signal.default_int_handler, signal.SIG_IGN], ids=["in front", "as under nohup … &"])
def test_interrupting_leaves_whole_files_only(tmp_path, before):
    """Shells start background jobs with Ctrl-C's signal ignored; it ends them all the same."""
    text = "".join(dump_text(random_frame(3000, step)) for step in range(40))
    (tmp_path / "all.dump").write_text(text)
    out = tmp_path / "out"
    command = [sys.executable, "-m", "clusterdem", "map", str(tmp_path / "all.dump"), "--out", str(out)]
    child = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, before),
    )
    deadline = time.monotonic() + 60
    while len(list(out.glob("*.npz"))) < 3 and time.monotonic() < deadline:
        time.sleep(0.005)
    child.send_signal(signal.SIGINT)
    _, err = child.communicate(timeout=60)
    assert child.returncode == 130 and "interrupted" in err and "Traceback" not in err
    names = os.listdir(out)
    assert names and not [name for name in names if name.startswith(".tmp")]
    for name in names:
        if name.endswith(".npz"):
            with np.load(out / name) as data:
                assert data["mass"].shape == (30, 30)
        else:
            assert (out / name).read_bytes().count(b"\n") == 901


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
def test_memory_does_not_grow_with_the_number_of_frames(tmp_path):
    script = (
        "import sys; from clusterdem.cli import main; assert main(sys.argv[1:]) == 0; "
        "print(*[line.split()[1] for line in open('/proc/self/status') if line.startswith('VmHWM')])"
    )
    text = dump_text(random_frame(20_000, 1), time=False)
    peaks = []
    for frames in (4, 24):
        path = tmp_path / f"{frames}.dump"
        path.write_text("".join(text.replace("STEP\n1\n", f"STEP\n{step}\n") for step in range(frames)))
        command = [sys.executable, "-c", script, "map", path, "--no-figures", "--out", tmp_path / "out"]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        peaks.append(int(done.stdout.split()[-1]) / 1024)
    assert peaks[1] < peaks[0] + 30, peaks
