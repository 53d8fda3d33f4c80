"""The scenes of doc/scenes.md, short: balance in integers, and the same events on one and on two ranks."""

import numpy as np
import pytest
from lammps_run import ROOT, run_file

INPUTS = ROOT / "inputs"
# particles at the start, variables that make the run short and lively
SCENES = {
    "riser": (200_000, {"clusters": 500, "tend": 6e-3}),
    "feed": (0, {"interval": 20, "tend": 2e-3, "u_g": 8}),
    "box3d": (800_000, {"tend": 1e-3}),
    "two_densities": (800_000, {"tend": 6e-3}),
    "jet": (240_000, {"tend": 2e-3}),
    "duct": (160_000, {"clusters": 400, "tend": 0.042}),
}


def scene(folder, name, np_, **more):
    folder.mkdir(parents=True, exist_ok=True)
    arguments = ["-in", str(INPUTS / f"{name}.in"), "-log", f"{name}.log"]
    return run_file(folder, arguments, np_, inputs=INPUTS, **SCENES[name][1], **more)


@pytest.mark.parametrize("name", SCENES)
def test_scene(tmp_path, name):
    one, two = (scene(tmp_path / str(n), name, n) for n in (1, 2))
    names = (one.folder / f"{name}.N.txt").read_text().splitlines()[1].split()[1:]
    table, other = (dict(zip(names, r.table(f"{name}.N.txt").T, strict=True)) for r in (one, two))
    assert np.array_equal(table["particles"], SCENES[name][0] + table["fed"] - table["left"])
    assert table["breakups"][-1] > 0
    for count in ("clusters", "particles", "breakups", "merges", "born", "fed", "left"):
        assert np.array_equal(table[count], other[count]), count
    last = one.dump(max(file.name for file in one.folder.glob("*.dump")))
    assert last["n"].sum() == table["particles"][-1] and len(last["id"]) == table["clusters"][-1]


def test_what_each_scene_is_about(tmp_path):
    """Feed: clusters come in. Two densities: each kind keeps its particles. Box: motion in space."""
    feed = scene(tmp_path / "feed", "feed", 1)
    names = (feed.folder / "feed.N.txt").read_text().splitlines()[1].split()[1:]
    fed, left = (feed.table("feed.N.txt")[-1, names.index(name)] for name in ("fed", "left"))
    assert fed > 5_000 and left >= 0
    two = scene(tmp_path / "two", "two_densities", 1)
    kinds = two.table("two_densities.kinds.txt")
    assert np.all(kinds[:, 2:4] == 400_000)
    box = scene(tmp_path / "box", "box3d", 1)
    last = box.dump(max(file.name for file in box.folder.glob("*.dump")))
    assert np.ptp(last["y"]) > 0.015 and np.abs(last["vy"]).max() > 1e-3
