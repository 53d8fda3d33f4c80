"""The cases' switches for what a scene may need or not: each does what its line in common.in says."""

import numpy as np
import pytest
from lammps_run import D_P, ROOT, diameter, run_file

INPUTS = ROOT / "inputs"
PARTICLES = 2_000_000


def case1(folder, frame="case1.00000100.dump", **variables):
    """A hundred steps of case 1, if nothing else is said: its first and last frame, and its log."""
    variables = {"inputs": INPUTS, "tend": 1e-4, "digits": 17, **variables}
    run = run_file(folder, ["-in", str(INPUTS / "case1.in"), "-log", "log"], **variables)
    return run.dump("case1.00000000.dump"), run.dump(frame), (folder / "log").read_text()


@pytest.fixture(scope="module")
def default(tmp_path_factory):
    return case1(tmp_path_factory.mktemp("default"))[1]


@pytest.mark.parametrize(
    "switches",
    [
        {"gravity": 0},
        {"law": "schiller/naumann"},
        {"refresh": 10},
        {"gusts": "own frozen"},
    ],
    ids=str,
)
def test_another_model_gives_another_run_of_the_same_solids(tmp_path, default, switches):
    _, last, _ = case1(tmp_path, **switches)
    assert last["n"].sum() == PARTICLES
    assert len(last["n"]) != len(default["n"]) or not np.array_equal(last["vz"], default["vz"])


@pytest.mark.parametrize(
    "switches, line",
    [
        ({"motion": "nve/sphere", "atoms": "sphere"}, "fix move all nve/sphere\n"),
        ({}, "fix move all nve/cluster gravity 9.81 0 0 -1 drag drag\n"),
        ({}, "gran/cluster 10.0 0.3 0.33 tangential linear cutoff"),
        ({"contact": "frictionless"}, "gran/cluster 10.0 0.3 0.0 tangential none cutoff"),
    ],
    ids=str,
)
def test_contact_and_rotation(tmp_path, switches, line):
    """The engine's log shows the style; at first the case has no contacts in which they would differ."""
    assert line in case1(tmp_path / "sphere", **switches)[2]


def test_clusters_without_rotation(tmp_path, default):
    _, last, log = case1(tmp_path, atoms="sphere", motion="nve")
    assert "atom_style   sphere\n" in log and np.abs(last["vz"] - default["vz"]).max() < 1e-9  # rounding


@pytest.mark.parametrize("atoms", ["cluster", "sphere"])
def test_copies_of_the_domain(tmp_path, atoms):
    first, last, _ = case1(tmp_path, atoms=atoms, nx=2, nz=2)
    assert len(first["n"]) == 4 * 5_000 and last["n"].sum() == 4 * PARTICLES
    x, z = first["x"], first["z"]
    quarters = [(x >= dx) & (x < dx + 0.3) & (z >= dz) & (z < dz + 0.6) for dx in (0, 0.3) for dz in (0, 0.6)]
    one, *others = (np.sort(x[q] % 0.3 + 1j * (z[q] % 0.6)) for q in quarters)
    assert all(np.abs(other - one).max() < 1e-12 for other in others)  # rounding
    assert not list(tmp_path.glob("*.data"))


def test_size_switches(tmp_path):
    for n_start in (100, 1600):
        first, last, _ = case1(tmp_path / str(n_start), n_start=n_start)
        assert first["n"].tolist() == [n_start] * (PARTICLES // n_start) and last["n"].sum() == PARTICLES
    _, last, _ = case1(tmp_path / "limits", n_min=10, n_max=1000)
    assert last["n"].min() >= 10 and last["l"].max() <= diameter(1000) * (1 + 1e-12)
    assert last["l"].min() >= diameter(10) * (1 - 1e-12) and D_P < last["l"].min()


def test_height_takes_solids_along(tmp_path):
    first, last, _ = case1(tmp_path, height=0.25)
    assert len(first["n"]) == 1250 and last["n"].sum() == PARTICLES // 4 and last["z"].max() < 0.15


def test_what_is_switched_off_is_not_there(tmp_path):
    _, last, log = case1(tmp_path, gravity=0, ncc=0, merge="no")
    assert not last["N_cc"].any() and "fix fall" not in log.replace('then "fix fall', "")  # the line itself


def test_digits(tmp_path):
    case1(tmp_path, digits=6)
    row = (tmp_path / "case1.00000100.dump").read_text().splitlines()[-1].split()
    assert max(len(word.lstrip("-").split("e")[0].replace(".", "").lstrip("0")) for word in row[1:]) <= 6


def test_dump_styles(tmp_path):
    """Every style holds the same frame, and clusterdem reads it. (Text with 17 digits is exact.)"""
    from clusterdem import read_file

    frames = {}
    for style in ("custom", "custom/zstd", "custom/gz", "binary"):
        folder = tmp_path / style.replace("/", "_")
        variables = {"inputs": INPUTS, "tend": 1e-6, "height": 0.05, "digits": 17, "dump_style": style}
        r = run_file(folder, ["-in", str(INPUTS / "case1.in"), "-log", "log"], check=False, **variables)
        if "Unrecognized dump style" in r.output:
            pytest.skip("a LAMMPS without the package COMPRESS")
        assert r.code == 0, r.output[-2000:]
        (path,) = folder.glob("case1.00000001.dump*")
        (frames[style],) = read_file(path)
    text = frames.pop("custom")
    for frame in frames.values():
        assert frame.step == text.step and frame.time == text.time
        assert all(np.array_equal(frame[name], text[name]) for name in ("id", "x", "vz", "mass", "n", "N_st", "Re"))


@pytest.mark.parametrize("contact", ["hertz", "hooke"])
def test_contacts_of_turning_clusters_without_rotation_are_refused_in_words(tmp_path, contact):
    r = run_file(
        tmp_path,
        ["-in", str(INPUTS / "case1.in"), "-log", "none"],
        check=False,
        inputs=INPUTS,
        contact=contact,
        tend=1e-5,
    )
    assert r.code == 2 and f"-var contact {contact} is of clusters that can turn" in r.output
    assert "add -var atoms sphere" in r.output
    turning = run_file(
        tmp_path,
        ["-in", str(INPUTS / "case1.in"), "-log", "none"],
        inputs=INPUTS,
        contact=contact,
        atoms="sphere",
        tend=1e-5,
    )
    assert turning.code == 0
