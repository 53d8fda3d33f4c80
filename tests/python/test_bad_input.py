"""Bad input: one line that names file, line and rule; exit code 2; finished frames kept."""

from __future__ import annotations

import gzip
import os
import re
import shutil

import pytest
import zstandard
from clusterdem import Box
from clusterdem.cli import main
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from synthetic import BOX, dump_text, random_frame, write_dump, write_run

TEXT = dump_text(random_frame(12, 10, 0.5))
NAMES_LINE = 13  # of ITEM: ATOMS


def changed(line, text):
    lines = TEXT.split("\n")
    lines[line - 1] = text
    return "\n".join(lines)


def swap_word(line, position, word):
    lines = TEXT.split("\n")
    words = lines[line - 1].split()
    words[position] = word
    return changed(line, " ".join(words) + " ")


CASES = {
    "truncated inside a row": (TEXT[:-200], 25, "half-written|must hold 22 numbers"),
    "truncated after a row": (TEXT[: TEXT.rindex("\n", 0, -2) + 1], 24, "ends after 11 of 12 rows"),
    "last row without its end": (TEXT.rstrip(), 25, "half-written"),
    "truncated in the header": ("\n".join(TEXT.split("\n")[:9]), 9, "box bounds"),
    "no column mass": (TEXT.replace(" mass ", " weight "), NAMES_LINE, "no column mass"),
    "no column diameter": (TEXT.replace(" diameter ", " width "), NAMES_LINE, "no column diameter or radius"),
    "no column x": (TEXT.replace("id x ", "id q "), NAMES_LINE, "no column x, xs or xu"),
    "NaN": (swap_word(15, 1, "nan"), 15, r"column 2 \(x\) must be finite"),
    "infinite": (swap_word(16, 8, "-inf"), 16, r"column 9 \(mass\) must be finite"),
    "a word": (swap_word(14, 3, "abc"), 14, r"column 4 \(z\) must be a number"),
    "underscores": (swap_word(14, 3, "1_0"), 14, r"column 4 \(z\) must be a number"),
    "negative mass": (swap_word(17, 8, "-1"), 17, "mass must be positive"),
    "diameter beyond the box": (swap_word(17, 7, "5"), 17, "smaller than the box"),
    "a row too short": (changed(14, "1 2 3"), 14, "must hold 22 numbers, not 3"),
    "a row too long": (swap_word(14, 0, "1 1"), 14, "must hold 22 numbers, not 23"),
    "too many rows": (TEXT.replace("\n12\n", "\n11\n"), 25, "more than its 11 rows"),
    "rows without a count": (
        dump_text(random_frame(1)).replace("\n1\nITEM: BOX", "\n0\nITEM: BOX"),
        14,
        "more than its 0 rows",
    ),
    "too few rows before the next frame": (TEXT.replace("\n12\n", "\n13\n") + TEXT, 25, "ends after 12 of 13 rows"),
    "negative count": (TEXT.replace("\n12\n", "\n-3\n"), 8, "must be 0 or more"),
    "no count": (TEXT.replace("ITEM: NUMBER OF ATOMS\n12\n", ""), None, "NUMBER OF ATOMS"),
    "count in words": (TEXT.replace("\n12\n", "\ntwelve\n"), 8, "one whole number"),
    "triclinic box": (TEXT.replace("BOUNDS pp", "BOUNDS xy xz yz pp"), 9, "orthogonal"),
    "upside-down box": (TEXT.replace("0.0 0.3", "0.3 0.0"), 10, "lower bound first"),
    "other units": (TEXT.replace("\nsi\n", "\ncgs\n"), 2, "units must be si"),
    "time in words": (TEXT.replace("\n0.5\n", "\nsoon\n"), 4, "the time must be"),
    "empty": ("", 1, "is empty"),
    "prose": ("Once upon a time\nthere was\n", 1, "not a LAMMPS dump"),
    "binary": (os.urandom(3000), 1, "not a"),
    "half a gzip": (
        gzip.compress(TEXT.encode())[:-300],
        None,
        r"the gzip data are cut at byte [\d,]+ in frame 1 \(step 10\); whole frames before that place: 0",
    ),
    "half a zstd": (
        zstandard.compress(TEXT.encode())[:-300],
        None,
        r"the zstd data are cut at byte [\d,]+; whole frames before that place: 0",
    ),
    "frames run backwards": (TEXT + dump_text(random_frame(3, 5)), 30, "step 5 comes after step 10"),
}


def check(result, path, line, rule):
    code, _, err = result
    assert code == 2
    assert len(err.strip().split("\n")) == 1, err
    assert re.search(rule, err), err
    assert err.startswith(f"clusterdem: {path}" + (f":{line}: " if line else "")), err


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("name", ["map", "sizes"])
def test_one_line_with_file_line_and_rule(case, name, tmp_path, command):
    text, line, rule = CASES[case]
    path = tmp_path / "bad.dump"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    check(command(name, path, "--out", tmp_path / "out", "--no-figures"), path, line, rule)


def test_no_file_a_folder_no_right(tmp_path, command):
    check(command("sizes", tmp_path / "absent"), tmp_path / "absent", None, "cannot be opened: No such file")
    check(command("sizes", tmp_path), tmp_path, None, "is a directory")
    check(command("report", tmp_path / "absent"), tmp_path / "absent", None, "must be the folder of a run")
    check(command("report", tmp_path), tmp_path, None, "holds no dump file")


def test_mixed_boxes(tmp_path, command):
    first = write_dump(tmp_path / "a.1.dump", random_frame(5, 1))
    other = Box(BOX.lo, (0.4, 0.003, 0.6), BOX.periodic)
    second = write_dump(tmp_path / "a.2.dump", random_frame(5, 2, box=other))
    check(command("map", first, second, "--out", tmp_path), second, 5, "the box differs")


def test_files_out_of_order(tmp_path, command):
    first = write_dump(tmp_path / "a.1.dump", random_frame(5, 200))
    second = write_dump(tmp_path / "a.2.dump", random_frame(5, 100))
    check(command("map", first, second, "--out", tmp_path), second, 5, "step 100 comes after step 200")


@pytest.mark.parametrize("grid", [("3000", "10"), ("0", "4"), ("100000", "100000")])
def test_grids_that_make_no_sense(grid, tmp_path, command):
    code, _, err = command("map", *write_run(tmp_path, 1), "--grid", *grid, "--out", tmp_path / "out")
    assert code == 2 and err.count("\n") == 1 and ("cell" in err)
    assert not (tmp_path / "out").exists()


def test_finished_frames_are_kept(tmp_path, command):
    good = write_run(tmp_path, 2)
    bad = tmp_path / "case1.9999999.dump"
    bad.write_text(TEXT[:-200])
    code, out, err = command("map", *good, bad, "--out", tmp_path / "out")
    assert code == 2 and str(bad) in err
    assert {path.name for path in (tmp_path / "out").glob("map.*.npz")} == {"map.0000000000.npz", "map.0000010000.npz"}
    assert (tmp_path / "out/fraction.png").exists() and "fraction.png" in out
    code, out, err = command("compare", *good, bad, "--case", "case1")
    assert code == 2 and "clusters at 0.01 s" in out


def test_output_that_cannot_be_written(tmp_path, command):
    (tmp_path / "file").write_text("here already")
    code, _, err = command("map", *write_run(tmp_path / "run", 1), "--out", tmp_path / "file")
    assert code == 2 and err.count("\n") == 1 and "cannot be written" in err


def test_compare_without_times(tmp_path, command):
    path = tmp_path / "a"
    path.write_text(dump_text(random_frame(5), time=False))
    check(command("compare", path, "--case", "case1"), path, 3, "give --dt")
    assert command("compare", path, "--case", "case1", "--dt", "1e-6")[0] == 0


@pytest.mark.parametrize("arguments", [(), ("map",), ("compare", "x"), ("sizes", "x", "--bin", "-1"), ("nothing",)])
def test_wrong_usage_is_exit_2(arguments, command):
    assert command(*arguments)[0] == 2


WORDS = [
    "nan",
    "inf",
    "-1",
    "0",
    "1e308",
    "1e-320",
    "99999999999999999999",
    "ITEM:",
    "ITEM: TIMESTEP",
    "pp",
    "\x00",
    "é",
    "_",
    "",
    "\t",
    "\r",
]


@st.composite
def mutated(draw):
    """A dump with a few bytes, words or lines changed, cut, doubled or swapped."""
    data = bytearray((TEXT + dump_text(random_frame(4, 20, 0.6))).encode())
    for _ in range(draw(st.integers(1, 4))):
        if not data:
            break
        kind = draw(st.sampled_from(["byte", "word", "cut", "drop line", "double line", "swap lines", "digits"]))
        at = draw(st.integers(0, len(data) - 1))
        lines = bytes(data).split(b"\n")
        row = draw(st.integers(0, len(lines) - 1))
        if kind == "byte":
            data[at] = draw(st.integers(0, 255))
        elif kind == "cut":
            del data[at:]
        elif kind == "digits":
            data[at:at] = draw(st.text("0123456789.eE+-", max_size=12)).encode()
        elif kind == "word":
            words = lines[row].split(b" ")
            words[draw(st.integers(0, len(words) - 1))] = draw(st.sampled_from(WORDS)).encode()
            lines[row] = b" ".join(words)
            data = bytearray(b"\n".join(lines))
        else:
            if kind == "drop line":
                del lines[row]
            elif kind == "double line":
                lines.insert(row, lines[row])
            else:
                other = draw(st.integers(0, len(lines) - 1))
                lines[row], lines[other] = lines[other], lines[row]
            data = bytearray(b"\n".join(lines))
    return bytes(data)


def outcome(data, folder, *arguments):
    """Exit code of a command on a dump with these bytes."""
    path = folder / "fuzz.dump"
    path.write_bytes(data)
    return main([arguments[0], str(path), *arguments[1:]])


@settings(max_examples=2000, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=mutated())
@pytest.mark.filterwarnings("error")
def test_fuzz_read(data, tmp_path_factory):
    """2,000 mutated dumps: done, or bad input said in one line; no other exit."""
    assert outcome(data, tmp_path_factory.getbasetemp(), "compare", "--case", "case1", "--dt", "1e-6") in (0, 2)


@settings(max_examples=200, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=mutated())
@pytest.mark.filterwarnings("error")
def test_fuzz_write(data, tmp_path_factory):
    """200 more, with exact overlap and every output: nothing half-written stays."""
    folder = tmp_path_factory.getbasetemp() / "fuzz"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    options = ("--deposit", "overlap", "--no-figures", "--grid", "3", "3", "--out", str(folder / "out"))
    assert outcome(data, folder, "map", *options) in (0, 2)
    assert not list(folder.rglob(".tmp-*"))
