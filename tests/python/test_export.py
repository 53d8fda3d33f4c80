"""VTK, tables, films, scatter, Universe: each read back by something else."""

from __future__ import annotations

import base64
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import polars as pl
import pytest
from clusterdem import ArgumentError, read_file
from clusterdem.analysis.correlation import pair_correlation
from clusterdem.frame import Box, Frame
from clusterdem.io.universe import run_universe, to_universe
from PIL import Image
from synthetic import BOX, random_frame, write_dump, write_run


def arrays(path):
    kinds = {"Float64": np.float64, "Int64": np.int64}
    found = {}
    for item in ElementTree.parse(path).iter("DataArray"):
        raw = base64.b64decode(item.text)
        values = np.frombuffer(raw[8:], kinds[item.get("type")])
        assert int.from_bytes(raw[:8], "little") == len(raw) - 8
        found[item.get("Name")] = values.reshape(-1, int(item.get("NumberOfComponents", 1)))
    return found


def test_vtk(tmp_path, command):
    dumps = write_run(tmp_path, 2)
    code, out, err = command("vtk", *dumps, "--out", tmp_path / "v", "--grid", "5", "7")
    assert (code, err) == (0, "")
    frame = random_frame(800, 10000, 0.01)
    points = arrays(tmp_path / "v/clusters.0000010000.vtp")
    np.testing.assert_array_equal(points["Points"], np.stack([frame[c] for c in "xyz"], axis=1))
    for name, parts in (("v", "v{}"), ("ug", "ug_{}"), ("fd", "fd_{}")):
        np.testing.assert_array_equal(points[name], np.stack([frame[parts.format(c)] for c in "xyz"], axis=1))
    for name in ("diameter", "n", "l", "mass"):
        np.testing.assert_array_equal(points[name].ravel(), frame[name])
    image = arrays(tmp_path / "v/maps.0000010000.vti")
    assert image["mass"].size == 35 and image["mass"].sum() == pytest.approx(frame.mass.sum(), rel=1e-12)
    for name in ("clusters", "maps"):
        series = ElementTree.parse(tmp_path / f"v/{name}.pvd")
        entries = [(float(e.get("timestep")), e.get("file")) for e in series.iter("DataSet")]
        assert [t for t, _ in entries] == [0.0, 0.01] and all((tmp_path / "v" / f).exists() for _, f in entries)


def test_vtk_reads_time_and_vectors(tmp_path, command):
    """VTK's own readers find the time, the vectors and the cells where they are."""
    vtk = pytest.importorskip("vtkmodules.vtkIOXML")
    to_numpy = pytest.importorskip("vtkmodules.util.numpy_support").vtk_to_numpy
    dumps = write_run(tmp_path, 2)
    frame = random_frame(800, 10000, 0.01)
    for plane, cells in (("xz", (5, 1, 7)), ("zx", (7, 1, 5)), ("xy", (5, 7, 1))):
        words = ("--out", tmp_path / plane, "--grid", "5", "7", "--plane", plane)
        if plane == "xy":
            words = ("--out", tmp_path / plane, "--grid", "5", "1", "--plane", plane)
            cells = (5, 1, 1)
        assert command("vtk", *dumps, *words)[0] == 0
        image = vtk.vtkXMLImageDataReader()
        image.SetFileName(str(tmp_path / plane / "maps.0000010000.vti"))
        image.Update()
        data = image.GetOutput()
        assert data.GetDimensions() == tuple(count + 1 for count in cells)
        assert data.GetFieldData().GetArray("TimeValue").GetNumberOfTuples() == 1
        assert data.GetFieldData().GetArray("TimeValue").GetValue(0) == 0.01
        assert data.GetSpacing() == pytest.approx([length / count for length, count in zip(BOX.lengths, cells)])
        mass = to_numpy(data.GetCellData().GetArray("mass"))
        velocity = to_numpy(data.GetCellData().GetArray("velocity"))
        assert velocity.shape == (np.prod(cells), 3)
        # the cell of the first cluster, by VTK's own numbering, holds what lies in it
        place = np.array([frame.x[0], frame.y[0], frame.z[0]])
        index = [int(p / length * count) for p, length, count in zip(place, BOX.lengths, cells)]
        cell = data.ComputeCellId(index)
        inside = np.ones(800, bool)
        for axis, letter in enumerate("xyz"):
            inside &= (frame[letter] / BOX.lengths[axis] * cells[axis]).astype(int) == index[axis]
        assert mass[cell] == pytest.approx(frame.mass[inside].sum(), rel=1e-12)
        for axis, letter in enumerate("xyz"):
            mean = np.average(frame[f"v{letter}"][inside], weights=frame.mass[inside]) if letter in plane else 0.0
            assert velocity[cell, axis] == pytest.approx(mean, rel=1e-12)
    without = write_dump(tmp_path / "steps.dump", Frame(7, np.nan, BOX, frame.columns), time=False)
    assert command("vtk", without, "--out", tmp_path / "steps")[0] == 0
    assert "TimeValue" not in (tmp_path / "steps/maps.0000000007.vti").read_text()
    assert 'timestep="7.0"' in (tmp_path / "steps/maps.pvd").read_text()
    points = vtk.vtkXMLPolyDataReader()
    points.SetFileName(str(tmp_path / "xz" / "clusters.0000010000.vtp"))
    points.Update()
    data = points.GetOutput()
    assert data.GetNumberOfPoints() == 800 and data.GetFieldData().GetArray("TimeValue").GetValue(0) == 0.01
    np.testing.assert_array_equal(to_numpy(data.GetPointData().GetArray("v"))[:, 2], frame["vz"])
    assert data.GetPointData().GetArray("fd").GetNumberOfComponents() == 3


@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_tables(kind, tmp_path, command):
    code, _, _ = command("table", *write_run(tmp_path, 2), "--format", kind, "--out", tmp_path / "t")
    assert code == 0
    read = {"csv": pl.read_csv, "parquet": pl.read_parquet}[kind]
    table = read(tmp_path / f"t/clusters.*.{kind}")
    assert table.height == 1200 and table.columns[:2] == ["step", "time"]
    last = table.filter(pl.col("step") == 10000)
    np.testing.assert_array_equal(last["diameter"].to_numpy(), random_frame(800, 10000).diameter)
    assert last["n"].dtype == pl.Int64


def test_film(tmp_path, command):
    dumps = write_run(tmp_path, 3, 50)
    code, _, err = command("film", *dumps, "--out", tmp_path / "f.gif", "--dpi", "60", "--grid", "6", "6")
    assert (code, err) == (0, "")
    with Image.open(tmp_path / "f.gif") as film:
        assert film.n_frames == 3
    code, _, err = command("film", *dumps, "--out", tmp_path / "f.avi")
    assert code == 2 and ".mp4 or .gif" in err
    if shutil.which("ffmpeg") is None:
        assert "needs ffmpeg" in command("film", *dumps, "--out", tmp_path / "f.mp4")[2]
        return
    assert command("film", *dumps, "--out", tmp_path / "f.mp4", "--dpi", "60")[0] == 0
    probe = [
        "ffprobe",
        "-v",
        "error",
        "-count_frames",
        "-show_entries",
        "stream=nb_read_frames,codec_name",
        "-of",
        "csv=p=0",
    ]
    assert subprocess.run(
        [*probe, str(tmp_path / "f.mp4")], capture_output=True, text=True, check=True
    ).stdout.split() == ["h264,3"]


def test_scatter_and_profile(tmp_path, command):
    dumps = write_run(tmp_path, 2, 100)
    for colour in ("diameter", "vz", "speed"):
        assert command("scatter", *dumps, "--colour", colour, "--out", tmp_path / colour)[0] == 0
        assert len(list((tmp_path / colour).glob("*.png"))) == 2
    assert command("profile", *dumps, "--out", tmp_path / "p")[0] == 0
    assert {p.name for p in (tmp_path / "p").iterdir()} == {
        "lateral.csv",
        "strips.csv",
        "height.csv",
        "height.png",
        "gr.csv",
        "lateral.png",
        "gr.png",
    }


def test_universe(tmp_path):
    (path, *_) = write_run(tmp_path, 1, 300)
    (frame,) = read_file(path)
    universe = frame.to_universe()
    assert universe.atoms.n_atoms == 300
    np.testing.assert_allclose(universe.atoms.positions[:, 0], 1e6 * frame.x, rtol=1e-6)
    np.testing.assert_array_equal(universe.atoms.masses, frame.mass)
    np.testing.assert_allclose(universe.atoms.radii, 5e5 * frame.diameter)
    np.testing.assert_array_equal(universe.atoms.particle_counts, frame["n"].astype(int))
    np.testing.assert_allclose(universe.dimensions[:3], [3e5, 3e3, 6e5])
    large = universe.select_atoms("prop radius > 500")
    assert len(large) == (frame.diameter > 1e-3).sum()


def test_a_universe_of_all_frames(tmp_path):
    """Clusters in another order in the second frame: by their ids each is where it is."""
    low = Box((-0.1, 0.0, 0.2), (0.2, 0.003, 0.8), BOX.periodic)
    frames = [random_frame(30, step, 1e-3 * step, box=low) for step in (0, 5)]
    types = np.arange(30) % 3 + 1.0
    for frame in frames:
        frame.columns["type"] = types
    turned = Frame(5, 5e-3, low, {name: values[::-1] for name, values in frames[1].columns.items()})
    for shift, origin in ((True, np.array(low.lo)), (False, np.zeros(3))):
        universe = run_universe([frames[0], turned], shift)
        assert len(universe.trajectory) == 2 and universe.atoms.types.tolist() == [f"{t:.0f}" for t in types]
        for ts, frame in zip(universe.trajectory, frames):
            places = np.stack([frame.x, frame.y, frame.z], axis=1)
            np.testing.assert_allclose(ts.positions, 1e6 * (places - origin), atol=0.05)
            np.testing.assert_allclose(ts.velocities[:, 2], 1e6 * frame["vz"], rtol=1e-6)
            assert (ts.data["step"], ts.data["time"]) == (frame.step, frame.time)
            np.testing.assert_allclose(ts.data["origin"], 1e6 * origin)
    with pytest.raises(ArgumentError, match="clusters change between step 0 and step 9: take a Universe of each frame"):
        run_universe([frames[0], random_frame(31, 9, box=low)])
    with pytest.raises(ArgumentError, match="frames: there are none"):
        run_universe([])
    assert to_universe(random_frame(0)).atoms.n_atoms == 0


def test_tables_in_memory():
    frame = random_frame(10)
    frame = Frame(3, 0.5, BOX, frame.columns, texts={"element": np.array(["Si"] * 10)})
    for table in (frame.to_polars(), frame.to_pandas()):
        assert list(table.columns[:2]) == ["step", "time"] and list(table["element"]) == ["Si"] * 10
        assert list(table["n"]) == frame["n"].astype(int).tolist() and list(table["vz"]) == frame["vz"].tolist()


def test_pair_correlation_of_chance_is_one_also_across_the_border():
    r, g = pair_correlation(random_frame(20_000), 4e-3)
    assert g[5:].mean() == pytest.approx(1, abs=0.02) and r[-1] < 4e-3


def test_pair_correlation_of_pairs():
    """1,000 pairs 2 mm apart, some across the border: one neighbour each at 2 mm."""
    rng = np.random.default_rng(5)
    x, z = 0.3 * rng.random(1000), 0.6 * rng.random(1000)
    columns = {"x": np.concatenate([x, (x + 0.00205) % 0.3]), "z": np.concatenate([z, z])}
    columns.update(mass=np.ones(2000), diameter=np.full(2000, 1e-4), y=np.full(2000, 0.0015))
    r, g = pair_correlation(Frame(0, 0.0, BOX, columns), 4e-3)
    peak = int(np.argmax(g))
    assert r[peak] == pytest.approx(0.00205, abs=6e-5)
    neighbours = g[peak] * 2000 / 0.18 * 2 * np.pi * r[peak] * 1e-4
    assert neighbours == pytest.approx(1, abs=0.1)


def test_pair_correlation_in_space_and_with_walls():
    cube = Box((0, 0, 0), (0.1, 0.1, 0.1), (True, True, True))
    rng = np.random.default_rng(0)
    columns = {axis: 0.1 * rng.random(20_000) for axis in "xyz"}
    columns.update(mass=np.ones(20_000), diameter=np.full(20_000, 1e-4))
    _, g = pair_correlation(Frame(0, 0.0, cube, columns), 4e-3)
    assert g[10:].mean() == pytest.approx(1, abs=0.02)
    walls = Box(cube.lo, cube.hi, (False, False, False))
    _, g = pair_correlation(Frame(0, 0.0, walls, columns), 4e-3)
    assert 0.9 < g[10:].mean() < 1
