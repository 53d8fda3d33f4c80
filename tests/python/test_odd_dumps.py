"""Dumps as people have them: empty frames, cut files, no boundary letters, words, twins, a growing box, other planes."""

from __future__ import annotations

import csv
import gzip
import struct

import numpy as np
import polars as pl
import pytest
import zstandard
from clusterdem import ArgumentError, Box, Frame, Grid, InputError, maps_of, read_dumps, read_file
from clusterdem.io.rows import parse_rows
from synthetic import BOX, dump_text, random_frame, write_dump

GRAINS = Box((-0.1, -0.05, 0.0), (0.1, 0.05, 0.3), (False, False, False))
NAMES = "id type mass x y z radius".split()


def grains(count=300, step=0, box=GRAINS, seed=3):
    """Solid spheres of 1 to 6 mm and 2500 kg/m³ anywhere in a box."""
    rng = np.random.default_rng([seed, step, count])
    radius = rng.uniform(0.5e-3, 3e-3, count)
    columns = {"id": np.arange(1.0, count + 1), "type": rng.integers(1, 3, count).astype(float), "radius": radius}
    for axis, letter in enumerate("xyz"):
        columns[letter] = box.lo[axis] + box.lengths[axis] * rng.random(count)
    columns |= {"diameter": 2 * radius, "mass": 2500 * np.pi / 6 * (2 * radius) ** 3}
    return Frame(step, 1e-5 * step, box, columns)


def text_of(frame, names=NAMES, letters="ff ff ff"):
    text = dump_text(frame, names, units=False, time=False)
    flags = " ".join("pp" if p else "ff" for p in frame.box.periodic)
    return text.replace(f"BOUNDS {flags}", f"BOUNDS {letters}".rstrip())


def write(path, *frames, **options):
    path.write_text("".join(text_of(frame, **options) for frame in frames))
    return path


def rows_of(path):
    with open(path) as file:
        return list(csv.DictReader(file))


EMPTY = [grains(0, 0), grains(200, 1000), grains(0, 2000), grains(150, 3000)]


@pytest.fixture
def filling(tmp_path):
    return write(tmp_path / "filling.dump", *EMPTY)


def test_empty_frames_are_frames(filling):
    read = list(read_dumps(filling))
    assert [(frame.step, len(frame)) for frame in read] == [(0, 0), (1000, 200), (2000, 0), (3000, 150)]
    assert read[0].mass.shape == (0,) and set(read[0].columns) == set(read[1].columns)
    assert read[2].solids.sum() == 0


def test_sizes_of_empty_frames(filling, tmp_path, command):
    code, out, err = command("sizes", filling, "--out", tmp_path / "s", "--dt", "1e-5")
    assert (code, err) == (0, "")
    rows = rows_of(tmp_path / "s/sizes.csv")
    assert [row["clusters"] for row in rows] == ["0", "200", "0", "150"]
    assert [float(row["mass"]) for row in rows] == pytest.approx([frame.mass.sum() for frame in EMPTY])
    assert np.isnan(float(rows[0]["mean"])) and float(rows[1]["mean"]) == pytest.approx(EMPTY[1].diameter.mean())
    shares = [key for key in rows[0] if key.startswith("n_")]
    assert len(shares) == 4 and sum(float(rows[3][key]) for key in shares) == pytest.approx(100)


def test_maps_of_empty_frames(filling, tmp_path, command):
    code, out, err = command("map", filling, "--rho", "2500", "--grid", "4", "5", "--out", tmp_path / "m")
    assert (code, err) == (0, "")
    for frame in EMPTY:
        with np.load(tmp_path / f"m/map.{frame.step:010d}.npz") as maps:
            volume = np.pi / 6 * (frame.diameter**3).sum()
            assert maps["fraction"].sum() * 0.2 * 0.1 * 0.3 / 20 == pytest.approx(volume)
            assert np.isnan(maps["mean_diameter"]).all() == (len(frame) == 0)
    rows = rows_of(tmp_path / "m/nonuniformity.csv")
    assert float(rows[0]["largest"]) == 0 and rows[0]["dispersion"] == "nan" and float(rows[1]["largest"]) > 0
    assert (tmp_path / "m/fraction.png").stat().st_size > 5000


@pytest.mark.parametrize(
    "words",
    [
        ("profile", "--rho", "2500"),
        ("scatter",),
        ("table",),
        ("film", "--rho", "2500", "--dpi", "50", "--grid", "4", "5"),
        ("vtk", "--rho", "2500", "--grid", "4", "5"),
        ("vtk", "--deposit", "overlap", "--rho", "2500", "--grid", "4", "5"),
    ],
    ids=" ".join,
)
def test_other_commands_go_on(filling, tmp_path, command, words):
    out = tmp_path / ("film.gif" if words[0] == "film" else "out")
    code, _, err = command(words[0], filling, *words[1:], "--out", out)
    assert (code, err) == (0, "")


def test_one_grain_and_none_at_all(tmp_path, command):
    one, none = write(tmp_path / "one.dump", grains(1)), write(tmp_path / "none.dump", grains(0))
    for path in (one, none):
        for words in (("sizes",), ("map", "--rho", "2500"), ("profile", "--rho", "2500"), ("scatter",)):
            code, _, err = command(words[0], path, *words[1:], "--out", tmp_path / "out")
            assert (code, err) == (0, ""), words


# ---- cut files


@pytest.mark.parametrize("pack, kind", [(gzip.compress, "gzip"), (zstandard.compress, "zstd")])
def test_every_whole_frame_before_a_cut(tmp_path, command, pack, kind):
    frames = [random_frame(2000, step, step * 1e-3) for step in (1, 2, 3, 4)]
    parts = [pack(dump_text(frame).encode()) for frame in frames]
    path = tmp_path / "run.dump.x"
    path.write_bytes(b"".join(parts[:3]) + parts[3][: len(parts[3]) // 2])
    cut = path.stat().st_size
    read = []
    with pytest.raises(
        InputError, match=rf"the {kind} data are cut at byte {cut:,}.*whole frames before that place: 3"
    ):
        read.extend(read_dumps(path))
        for frame in read_dumps(path):
            read.append(frame)
    read = []
    with pytest.raises(InputError):
        for frame in read_dumps(path):
            read.append(frame)
    assert [frame.step for frame in read] == [1, 2, 3]
    np.testing.assert_array_equal(read[2].x, frames[2].x)
    code, out, err = command("sizes", path, "--out", tmp_path / "s")
    assert code == 2 and err.count("\n") == 1 and "whole frames before that place: 3" in err
    assert len(rows_of(tmp_path / "s/sizes.csv")) == 3


def test_a_cut_within_one_packed_stream(tmp_path):
    """One stream for all frames, cut in the last; the frames before lie in what could be unpacked."""
    text = "".join(dump_text(random_frame(500, step, 0.1)) for step in (1, 2, 3, 4)).encode()
    packed = gzip.compress(text)
    (tmp_path / "a.gz").write_bytes(packed[: int(0.9 * len(packed))])
    read = []
    with pytest.raises(
        InputError, match=r"cut at byte [\d,]+ in frame 4 \(step 4\); whole frames before that place: 3"
    ):
        for frame in read_file(tmp_path / "a.gz"):
            read.append(frame)
    assert [frame.step for frame in read] == [1, 2, 3]


def test_a_damaged_stream_keeps_what_lies_before(tmp_path):
    parts = [gzip.compress(dump_text(random_frame(300, step, 0.1)).encode()) for step in (1, 2)]
    (tmp_path / "a.gz").write_bytes(parts[0] + parts[1][:2000] + b"\xff" * 500 + parts[1][2500:])
    read = []
    with pytest.raises(InputError, match="the gzip data are damaged before byte"):
        for frame in read_file(tmp_path / "a.gz"):
            read.append(frame)
    assert [frame.step for frame in read] == [1]


def test_a_binary_header_cannot_ask_for_more_than_the_file_holds(tmp_path):
    head = struct.pack("<q", -10) + b"DUMPCUSTOM" + struct.pack("<iiqq", 1, 2, 0, 10**10)
    head += struct.pack("<i6i6d", 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 1)
    head += struct.pack("<ii", 5, 0) + b"\0" + struct.pack("<i", 20) + b"x y z mass diameter " + struct.pack("<i", 1)
    (tmp_path / "a.dump.bin").write_bytes(head)
    with pytest.raises(InputError, match="declares 10,000,000,000 rows of 5 numbers, the file holds 0 bytes more"):
        list(read_file(tmp_path / "a.dump.bin"))


# ---- boundary letters


def test_without_letters_nothing_wraps(tmp_path):
    """A centre 1 mm beyond x = 0.1 counts in the outermost cell at that side, not at the other."""
    frame = grains(400)
    beyond = dict(frame.columns, x=frame.x.copy(), z=frame.z.copy())
    beyond["x"][7], beyond["z"][8] = 0.101, -0.001
    path = write(tmp_path / "a.dump", Frame(0, 0.0, GRAINS, beyond), letters="")
    (read,) = read_dumps(path)
    assert read.box.periodic == (False, False, False)
    assert read.x[7] == 0.101 and read.z[8] == -0.001
    for method in ("nearest", "overlap"):
        maps = maps_of(read.with_density(2500), Grid(read.box, 4, 6), method)
        alone = Frame(0, 0.0, GRAINS, {name: values[[7]] for name, values in read.columns.items()}).with_density(2500)
        own = maps_of(alone, Grid(read.box, 4, 6), method)["mass"]
        assert own[3].sum() == pytest.approx(read.mass[7]) and own[0].sum() == 0
        assert maps["mass"].sum() == pytest.approx(read.mass.sum(), rel=1e-12)


def test_far_outside_is_refused(tmp_path):
    frame = grains(5)
    frame.x[2] = 0.4
    with pytest.raises(InputError, match=":12: x lies far outside the box"):
        list(read_dumps(write(tmp_path / "a.dump", frame)))


# ---- columns


def test_mass_follows_from_density_and_diameter(tmp_path, command):
    frame = grains(100)
    columns = dict(frame.columns, density=np.full(100, 2500.0))
    path = write(tmp_path / "a.dump", Frame(0, 0.0, GRAINS, columns), names="id type x y z diameter density".split())
    (read,) = read_dumps(path)
    np.testing.assert_allclose(read.mass, frame.mass, rtol=1e-14)
    (some,) = read_dumps(path, ())
    np.testing.assert_allclose(some.mass, frame.mass, rtol=1e-14)
    assert command("map", path, "--rho", "2500", "--grid", "4", "4", "--out", tmp_path / "m")[0] == 0


def with_words(frame):
    rows = text_of(frame).split("\n")
    at = next(i for i, row in enumerate(rows) if row.startswith("ITEM: ATOMS"))
    rows[at] = rows[at].replace("type ", "type element ")
    for i in range(at + 1, at + 1 + len(frame)):
        words = rows[i].split()
        rows[i] = " ".join([*words[:2], "Si" if i % 2 else "C", *words[2:]])
    return "\n".join(rows)


def test_columns_of_words(tmp_path, command):
    frame = grains(20)
    path = tmp_path / "a.dump"
    path.write_text(with_words(frame))
    (read,) = read_dumps(path)
    assert read.texts["element"].tolist()[:3] == ["Si", "C", "Si"] and "element" not in read
    np.testing.assert_array_equal(read.mass, frame.mass)
    assert command("table", path, "--out", tmp_path / "t")[0] == 0
    table = pl.read_csv(tmp_path / "t/clusters.0000000000.csv")
    assert table["element"].to_list()[:3] == ["Si", "C", "Si"] and table["id"].to_list() == list(range(1, 21))
    code, _, err = command("vtk", path, "--rho", "2500", "--grid", "3", "3", "--out", tmp_path / "v")
    assert code == 0 and err == "clusterdem: note: column element holds words: VTK's files leave it out\n"
    assert "element" not in (tmp_path / "v/clusters.0000000000.vtp").read_text()


def test_words_are_read_by_both_parsers():
    block = b"1 Si 2.5\n2 C 3.5\n"
    for text in (block, block.replace(b" ", b"  ")):
        ids, names, values = parse_rows(text, 2, ("id", "element", "x"), (0, 1, 2), "a", 1, (1,))
        assert (ids.tolist(), names.tolist(), values.tolist()) == ([1, 2], ["Si", "C"], [2.5, 3.5])


def test_y_is_there(tmp_path):
    with_y, without = (
        write(tmp_path / "a.dump", grains(3)),
        write_dump(tmp_path / "b.dump", random_frame(3), ["x", "z", "mass", "diameter"]),
    )
    (read,) = read_dumps(str(with_y))
    assert read["y"] is read.y and read.y.tolist() == grains(3)["y"].tolist()
    (flat,) = read_dumps(without)
    assert flat.y.tolist() == [0.0015] * 3  # the middle of the box
    with pytest.raises(KeyError, match="no column 'tau' was read; there are"):
        flat["tau"]


# ---- frames


def test_the_same_step_twice_is_taken_once_with_a_note(tmp_path, command):
    first, second = grains(30, 0), grains(40, 10)
    path = write(tmp_path / "a.dump", first, first, second)
    code, _, err = command("sizes", path, "--out", tmp_path / "s")
    assert code == 0 and err == f"clusterdem: note: {path}: step 0 stands twice: the first is taken\n"
    assert [row["clusters"] for row in rows_of(tmp_path / "s/sizes.csv")] == ["30", "40"]


def test_the_same_step_in_two_files(tmp_path, command):
    paths = [
        write(tmp_path / "a.1.dump", grains(30, 0), grains(40, 10)),
        write(tmp_path / "a.2.dump", grains(40, 10), grains(50, 20)),
    ]
    assert [frame.step for frame in read_dumps(paths)] == [0, 10, 20]
    code, _, err = command("sizes", *paths, "--out", tmp_path / "s")
    assert code == 0 and err.count("note: ") == 1 and "step 10 stands in" in err
    assert [row["step"] for row in rows_of(tmp_path / "s/sizes.csv")] == ["0", "10", "20"]


@pytest.fixture
def growing(tmp_path):
    tall = Box(GRAINS.lo, (0.1, 0.05, 0.5), GRAINS.periodic)
    return write(tmp_path / "growing.dump", grains(200, 0), grains(300, 1000, tall), letters="mm mm mm")


def test_a_box_that_grows(growing, tmp_path, command):
    for words in (("sizes",), ("table",), ("scatter",), ("vtk", "--rho", "2500", "--grid", "4", "4")):
        code, _, err = command(words[0], growing, *words[1:], "--out", tmp_path / words[0])
        assert (code, err) == (0, ""), words
    assert [row["clusters"] for row in rows_of(tmp_path / "sizes/sizes.csv")] == ["200", "300"]
    code, _, err = command("map", growing, "--rho", "2500", "--grid", "4", "4", "--out", tmp_path / "m")
    assert code == 2 and f"{growing}:" in err and "maps need one box for all frames" in err
    assert (tmp_path / "m/map.0000000000.npz").exists()


# ---- planes


def test_another_plane(tmp_path, command):
    """A bed in x and y, 10 mm deep: what lies where is told by y, and the cells are 50 x 100 x 10 mm."""
    box = Box((0.0, 0.0, 0.0), (0.2, 0.4, 0.01), (False, False, False))
    frame = grains(200, 0, box, seed=8)
    frame.columns["y"][:] *= 0.5  # the lower half
    path = write(tmp_path / "bed.dump", frame)
    words = ("--rho", "2500", "--plane", "xy", "--grid", "4", "4", "--out", tmp_path / "m")
    code, _, err = command("map", path, *words)
    assert (code, err) == (0, "")
    with np.load(tmp_path / "m/map.0000000000.npz") as maps:
        assert {"x_edges", "y_edges"} <= set(maps) and maps["y_edges"][-1] == 0.4
        expected = np.histogram2d(frame.x, frame["y"], (maps["x_edges"], maps["y_edges"]), weights=frame.mass / 2500)[0]
        np.testing.assert_allclose(maps["fraction"], expected / (0.05 * 0.1 * 0.01), rtol=1e-12)
        assert maps["fraction"][:, 2:].sum() == 0 < maps["fraction"][:, :2].min()
    assert (tmp_path / "m/map.0000000000.csv").read_text().startswith("x,y,mass,fraction,")
    for name in ("profile", "scatter", "vtk"):
        more = () if name == "scatter" else ("--rho", "2500")
        assert command(name, path, "--plane", "xy", *more, "--out", tmp_path / name)[0] == 0, name


@pytest.mark.parametrize("plane", ["xx", "xw", "x", "xyz", ""])
def test_what_is_no_plane(plane, tmp_path, command):
    path = write(tmp_path / "a.dump", grains(5))
    for name in ("map", "profile", "scatter", "vtk"):
        code, _, err = command(name, path, "--plane", plane, "--out", tmp_path / "out")
        assert code == 2 and err == f"clusterdem: --plane: must be two of x, y, z, such as xz, not {plane}\n"
    with pytest.raises(ArgumentError, match="^plane: "):
        Grid(BOX, 3, 3, plane)
