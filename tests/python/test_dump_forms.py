"""Dumps of the forms that people have: the numbers are those of the plain dump, or the message says in one line what is wrong."""

import bz2
import gzip
import lzma
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import zstandard
from clusterdem import InputError, Run, read_dumps

ROOT = Path(__file__).resolve().parents[2]

N = 40
LO, HI = np.array([0.0, 0.0, 0.1]), np.array([0.3, 0.003, 0.7])


def table(seed: int = 1, n: int = N) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(seed)
    x = LO + rng.uniform(0.02, 0.98, (n, 3)) * (HI - LO)
    v = rng.normal(size=(n, 3)) + [1.0, 0.0, 5.0]
    d = 1e-4 * np.cbrt(2.0 * rng.integers(3, 2000, n))
    columns = dict(zip(("x", "y", "z", "vx", "vy", "vz"), (*x.T, *v.T)))
    share = (x - LO) / (HI - LO)
    return columns | {
        "id": np.arange(1, n + 1),
        "type": np.ones(n, int),
        "diameter": d,
        "radius": d / 2,
        "mass": np.pi / 6 * d**3 * 1000.0,
        "density": np.full(n, 1000.0),
        "element": np.array(["Si"] * n),
        "bad": np.where(np.arange(n) == 3, np.nan, np.arange(n)),
        "inf": np.where(np.arange(n) == 5, np.inf, 1.0),
        **{f"{axis}s": share[:, k] for k, axis in enumerate("xyz")},
        **{f"{axis}u": x[:, k] + (HI - LO)[k] * (axis != "y") for k, axis in enumerate("xyz")},
    }


PLAIN = "id type x y z vx vy vz diameter mass"


def dump(columns: str = PLAIN, step: int = 1000, seed: int = 1, box: str = "pp ff pp", n: int = N) -> str:
    data = table(seed, n)
    words = columns.split()
    head = f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{n}\nITEM: BOX BOUNDS {box}".rstrip()
    bounds = "".join(f"{lo} {hi}\n" for lo, hi in zip(LO.tolist(), HI.tolist()))
    rows = "".join(" ".join(repr(data[w][k].item()).strip("'") for w in words) + " \n" for k in range(n))
    return f"{head}\n{bounds}ITEM: ATOMS {columns}\n{rows}"


FORMS = {
    "bom": b"\xef\xbb\xbf" + dump().encode(),
    "crlf": dump().replace("\n", "\r\n").encode(),
    "blank tail": (dump() + "\n  \n\r\n").encode(),
    "gz": gzip.compress(dump().encode()),
    "bz2": bz2.compress(dump().encode()),
    "two parts of bz2": bz2.compress(dump().encode()[:2000]) + bz2.compress(dump().encode()[2000:]),
    "xz": lzma.compress(dump().encode()),
    "zst": zstandard.compress(dump().encode()),
    "tabs": dump().replace(" \n", "\n").replace(" ", "\t").replace("ITEM:\t", "ITEM: ").replace("OF\tATOMS", "OF ATOMS").replace("BOX\tBOUNDS\t", "BOX BOUNDS ").replace("ATOMS\t", "ATOMS ").encode(),
    "shrink-wrapped box": dump(box="mm ss mm").encode(),
    "no boundary letters": dump(box="").encode(),
    "radius, density": dump("id type x y z vx vy vz radius density").encode(),
    "no id, no type": dump("x y z vx vy vz diameter mass").encode(),
    "scaled": dump("id type xs ys zs vx vy vz diameter mass").encode(),
    "unwrapped": dump("id type xu yu zu vx vy vz diameter mass").encode(),
    "text column": dump("id element x y z vx vy vz diameter mass").encode(),
    "NaN and infinite columns": dump(PLAIN + " bad inf").encode(),
    "other order": dump("mass vz vy vx z diameter y x").encode(),
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_the_numbers_are_those_of_the_plain_dump(tmp_path, form):
    path = tmp_path / "one.dump"
    path.write_bytes(FORMS[form])
    (frame,) = read_dumps(path)
    expected = table()
    for name in ("x", "y", "z", "vx", "vy", "vz", "diameter", "mass"):
        assert frame[name] == pytest.approx(expected[name], rel=1e-12), name
    assert frame.step == 1000 and np.array_equal(frame.box.lo, LO) and np.array_equal(frame.box.hi, HI)


def test_columns_that_nobody_asked_for_may_hold_anything(tmp_path):
    path = tmp_path / "one.dump"
    path.write_text(dump(PLAIN + " bad inf"))
    (frame,) = read_dumps(path)
    assert np.isnan(frame["bad"]).tolist() == [k == 3 for k in range(N)]
    assert np.isinf(frame["inf"]).tolist() == [k == 5 for k in range(N)]
    with pytest.raises(InputError, match=r"one.dump:13: column 11 \(bad\) must be finite"):
        list(read_dumps(path, ["bad"]))


def test_velocities_must_be_finite_whoever_reads(tmp_path):
    path = tmp_path / "one.dump"
    path.write_text(dump().replace(repr(table()["vx"][7].item()), "nan"))
    with pytest.raises(InputError, match=r"one.dump:17: column 6 \(vx\) must be finite"):
        list(read_dumps(path))


def test_no_mass_and_a_density(tmp_path):
    path = tmp_path / "one.dump"
    path.write_text(dump("id type x y z vx vy vz diameter"))
    with pytest.raises(InputError, match=r"one.dump:9: no column mass, nor density.*--density KG/M3"):
        list(read_dumps(path))
    (frame,) = read_dumps(path, density=2650.0)
    assert frame["mass"] == pytest.approx(np.pi / 6 * table()["diameter"] ** 3 * 2650.0, rel=1e-12)
    solids = frame.particles.solids(frame["mass"])
    assert solids == pytest.approx(np.pi / 6 * table()["diameter"] ** 3, rel=1e-12)


def test_a_mass_in_the_dump_is_not_changed_by_a_density(tmp_path):
    path = tmp_path / "one.dump"
    path.write_text(dump())
    (frame,) = read_dumps(path, density=2650.0)
    assert frame["mass"] == pytest.approx(table()["mass"], rel=1e-12)


def test_twins_of_a_run_that_was_continued(tmp_path):
    """In one file and across two: each step once, the first that was written."""
    (tmp_path / "a.dump").write_text(dump() + dump(step=2000, seed=2) + dump(step=2000, seed=3) + "\n")
    (tmp_path / "b.dump").write_text(dump(step=2000, seed=4) + "\n\n" + dump(step=3000, seed=5))
    frames = list(read_dumps([tmp_path / "a.dump", tmp_path / "b.dump"]))
    assert [f.step for f in frames] == [1000, 2000, 3000]
    for frame, seed in zip(frames, (1, 2, 5)):
        assert frame["x"] == pytest.approx(table(seed)["x"], rel=1e-12)


@pytest.mark.parametrize("packed", [bz2.compress, lzma.compress])
def test_packed_data_that_are_cut(tmp_path, packed):
    data = packed((dump() + dump(step=2000, seed=2)).encode())
    path = tmp_path / "one.dump"
    path.write_bytes(data[:-40])
    with pytest.raises(InputError, match=r"cannot be read to its end: the (bzip2|xz) data are cut at byte"):
        list(read_dumps(path))
    path.write_bytes(data[:200] + bytes(60) + data[260:])
    with pytest.raises(InputError, match=r"cannot be read to its end: the (bzip2|xz) data are damaged before byte"):
        list(read_dumps(path))


OTHERS = {
    "dump local": ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ENTRIES c_1[1] c_1[2]\n1 2\n", 3,
                   "holds entries (pairs, bonds), not atoms, as dump local writes them: atoms are written by dump custom"),
    "VTK": ("# vtk DataFile Version 2.0\nGenerated by LIGGGHTS\nASCII\nDATASET POLYDATA\n", 1, "is a VTK file, which ParaView opens: not a dump"),
    "VTK XML": ('<?xml version="1.0"?>\n<VTKFile type="PolyData">\n', 1, "is an XML file, maybe VTK, which ParaView opens: not a dump"),
    "data file": ("LAMMPS data file via write_data\n\n10 atoms\n", 1, "is a data file, which read_data reads: not a dump"),
    "triclinic": (dump(box="xy xz yz pp ff pp"), 5, "only an orthogonal box can be read"),
}  # fmt: skip


@pytest.mark.parametrize("kind", OTHERS)
def test_other_files_are_told_in_one_line(tmp_path, kind):
    text, line, said = OTHERS[kind]
    (tmp_path / "a.dump").write_text(text)
    with pytest.raises(InputError) as error:
        list(read_dumps(tmp_path / "a.dump"))
    assert f"a.dump:{line}: {said}" in str(error.value) and "\n" not in str(error.value)


def clusterdem(folder, *words):
    return subprocess.run([sys.executable, "-m", "clusterdem", *words], cwd=folder, capture_output=True, text=True)


def test_report_of_any_dumps(tmp_path):
    """Names that no run of ours has, in any order, without table or log; and of one packed file."""
    (tmp_path / "atoms_1000.lammpstrj").write_text(dump())
    (tmp_path / "atoms_2000.lammpstrj").write_text(dump(step=2000, seed=2, n=30))
    done = clusterdem(
        tmp_path, "report", "atoms_2000.lammpstrj", "atoms_1000.lammpstrj", "--dt", "1e-5", "--grid", "6", "6"
    )
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "report.html").read_text()
    assert "t = 0.01 s" in page and "t = 0.02 s" in page and "Cluster DEM run atoms" in page
    (tmp_path / "packed").mkdir()
    (tmp_path / "packed" / "x.bz2").write_bytes(bz2.compress(dump().encode()))
    done = clusterdem(tmp_path / "packed", "report", "x.bz2", "--grid", "6", "6")
    assert done.returncode == 0, done.stderr
    done = clusterdem(tmp_path, "report", "none.dump")
    assert done.returncode == 2 and "none.dump: must be the folder of a run" in done.stderr


def test_run_of_dumps_finds_table_and_log_by_the_common_name(tmp_path):
    for step in (0, 1000):
        (tmp_path / f"bed.{step}.dump").write_text(dump(step=step))
    (tmp_path / "bed.N.txt").write_text("# seed=7\n# step time clusters\n0 0 40\n1000 0.01 40\n")
    run = Run.of_dumps([tmp_path / "bed.1000.dump", tmp_path / "bed.0.dump"])
    assert run.name == "bed" and run.steps == [0, 1000] and run.dt == pytest.approx(1e-5) and run.seed == "7"
    other = Run.of_dumps([tmp_path / "bed.0.dump"], dt=2e-5)
    assert other.times.tolist() == [0.0] and len(other) == 1


@pytest.mark.parametrize("command", ["sizes", "table", "scatter", "map", "vtk", "profile"])
def test_every_command_takes_dumps_without_mass(tmp_path, command):
    (tmp_path / "a.dump").write_text(dump("id type x y z vx vy vz diameter"))
    words = ["--grid", "5", "5"] if command in ("map", "vtk") else []
    done = clusterdem(tmp_path, command, "a.dump", "--density", "2000", *words)
    assert done.returncode == 0, done.stderr
    done = clusterdem(tmp_path, command, "a.dump", *words)
    assert done.returncode == 2 and "give the spheres' density (--density KG/M3)" in done.stderr


def test_the_readers_of_other_packages(tmp_path):
    """MDAnalysis' own reader wants the timestep first: without our time and units it opens the dump. The page says so."""
    mda = pytest.importorskip("MDAnalysis")
    ours = "ITEM: UNITS\nsi\nITEM: TIME\n0.001\n" + dump()
    (tmp_path / "case1.0.dump").write_text(ours)
    page = (ROOT / "python" / "README.md").read_text()
    command = next(line for line in page.splitlines() if line.strip().startswith("sed ") and "ITEM: UNITS" in line)
    done = subprocess.run(command, shell=True, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    universe = mda.Universe(str(tmp_path / "plain.dump"), format="LAMMPSDUMP", lammps_coordinate_convention="unscaled")
    expected = table()
    assert universe.atoms.positions == pytest.approx(
        np.column_stack([expected[a] - lo for a, lo in zip("xyz", LO)]), abs=1e-7
    )
    with pytest.raises(ValueError, match="invalid literal"):
        mda.Universe(str(tmp_path / "case1.0.dump"), format="LAMMPSDUMP")


def one(
    x: float = 0.15,
    y: str = "0.0015",
    d: float = 1e-3,
    columns: str = "id x y z vx vy vz diameter mass",
    values: str = "",
    head: str = "",
    ylo: float = 0.0,
) -> str:
    """A dump of one cluster at x, z = 0.4 m, in a box of 0.1 to 0.3 m by ylo to 0.003 m by 0.1 to 0.7 m."""
    given = {
        "id": "1",
        "x": repr(x),
        "y": y,
        "z": "0.4",
        "vx": "1",
        "vy": "2",
        "vz": "3",
        "diameter": repr(d),
        "mass": "1e-6",
        "density": "1200",
    }
    row = values or " ".join(given[name] for name in columns.split())
    return f"{head}ITEM: TIMESTEP\n50\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp ff pp\n0.1 0.3\n{ylo} 0.003\n0.1 0.7\nITEM: ATOMS {columns}\n{row}\n"


def read_one(tmp_path, text: str, **options):
    (tmp_path / "a.dump").write_text(text)
    (frame,) = read_dumps(tmp_path / "a.dump", **options)
    return frame


def test_a_place_just_below_a_periodic_side_is_inside(tmp_path):
    """0.1 - 1e-17 is 0.1 in doubles; the step below it is wrapped to 0.3 - 2e-17, which rounds to the side itself: to 0.1."""
    x = float(np.nextafter(0.1, 0.0))
    assert read_one(tmp_path, one(x))["x"][0] in (0.1, np.nextafter(0.3, 0.0))
    assert 0.1 <= read_one(tmp_path, one(x))["x"][0] < 0.3


def test_a_column_density_goes_before_a_given_one(tmp_path):
    frame = read_one(tmp_path, one(columns="id x y z vx vy vz diameter density"), density=2650.0)
    assert frame["mass"][0] == pytest.approx(np.pi / 6 * 1e-9 * 1200.0, rel=1e-12)


@pytest.mark.parametrize("axis", "xyz")
def test_every_velocity_must_be_finite(tmp_path, axis):
    text = one().replace(" 1 2 3 ", {"x": " nan 2 3 ", "y": " 1 nan 3 ", "z": " 1 2 inf "}[axis])
    with pytest.raises(InputError, match=rf"\(v{axis}\) must be finite"):
        read_one(tmp_path, text)


def test_without_y_the_middle_of_the_box_is_taken(tmp_path):
    assert read_one(tmp_path, one(columns="id x z vx vz diameter mass", ylo=0.001))["y"][0] == pytest.approx(0.002)


def test_the_time_of_the_dump_goes_before_a_given_step(tmp_path):
    assert read_one(tmp_path, one(head="ITEM: TIME\n0.25\n"), dt=1e-3).time == 0.25
    assert read_one(tmp_path, one(), dt=1e-3).time == 0.05


def test_diameters_reach_to_the_second_side_of_the_box(tmp_path):
    """Sides of 0.2, 0.003 and 0.6 m: a slab may be thinner than its clusters, but none is larger than its second side."""
    assert read_one(tmp_path, one(d=0.15))["diameter"][0] == 0.15
    with pytest.raises(InputError, match="diameter must be positive, and smaller than the box"):
        read_one(tmp_path, one(d=0.25))
