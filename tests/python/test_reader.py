"""Every way a dump may be written."""

from __future__ import annotations

import gzip

import numpy as np
import pytest
import zstandard
from clusterdem import Box, read_dumps, read_file
from synthetic import BOX, NAMES, dump_text, random_frame, write_dump


def same(read, frame, names=NAMES):
    assert (read.step, len(read)) == (frame.step, len(frame))
    for name in names:
        np.testing.assert_array_equal(read[name], frame[name])


def only(path, **options):
    (frame,) = read_file(path, **options)
    return frame


def test_every_bit_of_every_column_comes_back(tmp_path):
    frame = random_frame(1000, 42, 0.0123)
    read = only(write_dump(tmp_path / "a.dump", frame))
    same(read, frame)
    assert read.time == 0.0123 and read.box == BOX


@pytest.mark.parametrize("end", [" \n", "\n", " \r\n", "\r\n", "  \n", "\t\n"])
def test_ends_of_rows(tmp_path, end):
    frame = random_frame(50)
    (tmp_path / "a").write_bytes(dump_text(frame, end=end).encode())
    same(only(tmp_path / "a"), frame)


def test_aligned_columns(tmp_path):
    frame = random_frame(50)
    head, _, rows = dump_text(frame).partition("ITEM: ATOMS")
    (tmp_path / "a").write_text(head + "ITEM: ATOMS" + rows.replace(" ", "   "))
    same(only(tmp_path / "a"), frame)


def test_compressed(tmp_path):
    frame = random_frame(300)
    text = dump_text(frame).encode()
    (tmp_path / "a.gz").write_bytes(gzip.compress(text))
    (tmp_path / "a.zst").write_bytes(zstandard.compress(text))
    (tmp_path / "b.zst").write_bytes(zstandard.compress(text[:1000]) + zstandard.compress(text[1000:]))
    for name in ("a.gz", "a.zst", "b.zst"):
        same(only(tmp_path / name), frame)


@pytest.mark.parametrize("suffix", ["", ".gz", ".zst"])
def test_many_frames_in_one_file(tmp_path, suffix, monkeypatch):
    monkeypatch.setattr("clusterdem.io.streams.CHUNK", 1000)
    monkeypatch.setattr("clusterdem.io.streams.AT_ONCE", 0)
    frames = [random_frame(20 + 30 * i, 10 * i, 0.1 * i) for i in range(4)]
    text = "".join(dump_text(frame, units=i == 0) for i, frame in enumerate(frames)).encode()
    pack = {"": bytes, ".gz": gzip.compress, ".zst": zstandard.compress}[suffix]
    path = tmp_path / f"all.dump{suffix}"
    path.write_bytes(pack(text))
    for read, frame in zip(read_file(path), frames, strict=True):
        same(read, frame)
        assert text.split(b"\n")[read.line - 1] == b"ITEM: TIMESTEP"
    assert [f.step for f in read_file(path, share=(1, 3))] == [10]
    assert [f.step for f in read_file(path, share=(0, 3))] == [0, 30]


def test_liggghts_header_and_radius(tmp_path):
    frame = random_frame(100)
    columns = dict(frame.columns, radius=frame.diameter / 2, type=np.ones(100))
    liggghts = type(frame)(7, np.nan, BOX, columns)
    names = "id type x y z ix vx vy vz fx radius mass".split()
    columns.update(ix=np.zeros(100), fx=np.zeros(100))
    text = dump_text(liggghts, names, units=False, time=False).replace(" pp ff pp", "")
    (tmp_path / "a").write_text(text)
    read = only(tmp_path / "a")
    np.testing.assert_array_equal(read.diameter, frame.diameter)
    assert np.isnan(read.time) and read.label == "step 7" and read.box.periodic == (False, False, False)
    assert only(tmp_path / "a", dt=0.5).time == 3.5


def test_any_column_order_and_only_some(tmp_path):
    frame = random_frame(100)
    path = write_dump(tmp_path / "a", frame, sorted(NAMES, reverse=True))
    same(only(path), frame)
    some = only(path, columns=("vz", "absent"))
    assert set(some.columns) == {"x", "z", "mass", "diameter", "vz"}


@pytest.mark.parametrize("suffix", ["s", "u", "su"])
def test_scaled_and_unwrapped_coordinates(tmp_path, suffix):
    box = Box((-0.1, 0.0, 0.2), (0.2, 0.003, 0.8), (True, True, True))
    frame = random_frame(200, box=box)
    columns = dict(frame.columns)
    rng = np.random.default_rng(0)
    for axis, letter in enumerate("xyz"):
        value = frame[letter]
        if "u" in suffix:
            value = value + box.lengths[axis] * rng.integers(-3, 4, len(frame))
        if "s" in suffix:
            value = (value - box.lo[axis]) / box.lengths[axis]
        columns[letter + suffix] = value
    names = ["id", *(letter + suffix for letter in "xyz"), "diameter", "mass"]
    read = only(write_dump(tmp_path / "a", type(frame)(0, 0.0, box, columns), names))
    for axis, letter in enumerate("xyz"):
        np.testing.assert_allclose(read[letter], frame[letter], atol=1e-14)
        assert (read[letter] >= box.lo[axis]).all() and (read[letter] < box.hi[axis]).all()


def test_raw_names_of_the_fixes_outputs(tmp_path):
    frame = random_frame(10)
    raw = {"n": "f_bm[1]", "l": "f_bm[3]", "tau": "f_drag[8]"}
    head, _, rows = dump_text(frame).partition("ITEM: ATOMS")
    names, _, rows = rows.partition("\n")
    words = [raw.get(word, word) for word in names.split()]
    (tmp_path / "a").write_text(f"{head}ITEM: ATOMS {' '.join(words)}\n{rows}")
    same(only(tmp_path / "a"), frame)


def test_files_are_taken_in_natural_order(tmp_path):
    paths = [write_dump(tmp_path / f"a.{step}.dump", random_frame(10, step)) for step in (1000, 900, 20)]
    assert [frame.step for frame in read_dumps(paths)] == [20, 900, 1000]
