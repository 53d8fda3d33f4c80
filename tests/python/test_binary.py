"""LAMMPS' binary custom dumps: every bit, any number of writers, and what is damaged."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from clusterdem import InputError, read_dumps, read_file
from synthetic import BOX, NAMES, random_frame


def binary(frame, writers=3, names=NAMES, revision=2, units=b"si", triclinic=0, boundary=(0, 0, 1, 1, 0, 0)):
    """A frame as DumpCustom::header_binary and write_binary put it."""
    names = " ".join(names).encode()
    text = struct.pack("<q", -10) + b"DUMPCUSTOM" + struct.pack("<iiqq", 1, revision, frame.step, len(frame))
    text += struct.pack("<i6i", triclinic, *boundary)
    text += struct.pack("<6d", *(bound for pair in zip(frame.box.lo, frame.box.hi) for bound in pair))
    text += struct.pack("<ii", len(names.split()), len(units)) + units
    text += b"\1" + struct.pack("<d", frame.time) + struct.pack("<i", len(names)) + names + struct.pack("<i", writers)
    for rows in np.array_split(np.column_stack([frame[name] for name in names.decode().split()]), writers):
        text += struct.pack("<i", rows.size) + rows.astype("<f8").tobytes()
    return text


@pytest.mark.parametrize("writers", [1, 3])
def test_every_bit_comes_back(tmp_path, writers):
    frames = [random_frame(100, step, step * 1e-6, seed=step) for step in (10, 20)]
    (tmp_path / "a.dump.bin").write_bytes(b"".join(binary(frame, writers) for frame in frames))
    for read, frame in zip(read_dumps([tmp_path / "a.dump.bin"]), frames, strict=True):
        assert (read.step, read.time, read.box.lo, read.box.hi) == (frame.step, frame.time, BOX.lo, BOX.hi)
        assert read.box.periodic == (True, False, True)
        for name in NAMES:
            np.testing.assert_array_equal(read[name], frame[name])


def test_a_share_and_some_columns(tmp_path):
    (tmp_path / "a").write_bytes(b"".join(binary(random_frame(50, step, 0.0)) for step in (1, 2, 3)))
    (read,) = read_file(tmp_path / "a", ("vx",), share=(1, 3))
    assert read.step == 2 and "vx" in read and "vz" not in read


@pytest.mark.parametrize(
    "change, rule",
    [
        (lambda text: text[:-9], "ends inside"),
        (lambda text: text[:60], "ends inside"),
        (lambda text: text + b"more", "binary2txt"),
        (lambda text: text + binary(random_frame(20, 4, 0.1)), "rise in time"),
        (lambda text: text.replace(b"si", b"lj"), "units must be si"),
        (lambda text: text[:-8] + struct.pack("<d", np.nan), "finite"),
    ],
)
def test_damage_is_told(tmp_path, change, rule):
    (tmp_path / "a").write_bytes(change(binary(random_frame(20, 5, 0.1))))
    with pytest.raises(InputError, match=rule):
        list(read_file(tmp_path / "a", NAMES))


@pytest.mark.parametrize("options, rule", [({"revision": 1}, "binary2txt"), ({"triclinic": 1}, "orthogonal")])
def test_what_is_not_read(tmp_path, options, rule):
    (tmp_path / "a").write_bytes(binary(random_frame(20, 5, 0.1), **options))
    with pytest.raises(InputError, match=rule):
        list(read_file(tmp_path / "a"))
