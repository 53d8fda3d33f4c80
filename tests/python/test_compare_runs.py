"""Two groups of runs: Welch's test against scipy and tables, and the command against plain numpy."""

from __future__ import annotations

import csv
import math

import numpy as np
import pytest
from clusterdem import ArgumentError, InputError, Run, compare_runs, difference_between
from clusterdem.analysis.sizes import sauter_diameter
from clusterdem.frame import Frame
from clusterdem.observables import How, find
from scipy import stats
from synthetic import SKEW, SKEW_NAMES, skew_frame, write_dump

OBSERVED = "count mass mean_diameter sauter_diameter size_classes granular_temperature largest_group".split()


def test_welch_is_scipys():
    rng = np.random.default_rng(11)
    first, second = rng.normal(1, 0.3, (4, 6)), rng.normal(1.4, 1.0, (3, 6))
    found = difference_between(first, second)
    expected = stats.ttest_ind(second, first, axis=0, equal_var=False)
    np.testing.assert_allclose(found.p_value, expected.pvalue, rtol=1e-10)
    np.testing.assert_allclose(found.difference / found.error, expected.statistic, rtol=1e-10)
    np.testing.assert_allclose(found.first_spread, np.std(first, axis=0, ddof=1), rtol=1e-12)
    np.testing.assert_allclose(found.second, second.mean(axis=0), rtol=1e-12)


def test_one_run_beside_several_is_students_test_with_their_spread():
    rng = np.random.default_rng(12)
    several, one = rng.normal(1, 0.3, (5, 4)), rng.normal(1, 0.3, (1, 4))
    expected = stats.ttest_ind(one, several, axis=0, equal_var=True)  # pooled: of one run no variance comes in
    for found, sign in ((difference_between(several, one), 1), (difference_between(one, several), -1)):
        np.testing.assert_allclose(found.p_value, expected.pvalue, rtol=1e-10)
        np.testing.assert_allclose(found.difference, sign * (one[0] - several.mean(axis=0)), rtol=1e-12)
        np.testing.assert_allclose(found.error, several.std(axis=0, ddof=1) * math.sqrt(1 + 1 / 5), rtol=1e-12)
    assert np.isnan(difference_between(one, several).first_spread).all()


def test_single_runs_and_runs_that_are_alike():
    found = difference_between(np.array([[1.0]]), np.array([[3.0]]))
    assert found.difference.tolist() == [2.0] and math.isnan(found.error[0]) and math.isnan(found.p_value[0])
    same = np.array([[1.0, 2.0], [1.0, 2.0]])
    assert difference_between(same, same + [0.0, 1.0]).p_value.tolist() == [1.0, 0.0]
    digits = np.array([[1.0], [1.0 + 1e-9], [1.0 + 3e-9]])  # the same but for rounding, off by a hundred spreads
    assert difference_between(digits, digits + 1e-7).p_value.tolist() == [1.0]
    assert difference_between(digits, digits + 1e-5).p_value.tolist() == [0.0]
    for wrong in (np.zeros((0, 2)), np.zeros((2, 3)), np.zeros(2)):
        with pytest.raises(ArgumentError, match="second: must be rows as long as the first's"):
            difference_between(same, wrong)


def write_runs(folder, name, counts, steps=(0, 100, 200), shift=0.0, **options):
    """A folder per run, of three frames at 0, 0.01 and 0.02 s; the frames by run and time."""
    made = []
    for number, count in enumerate(counts):
        place = folder / f"{name}{number}"
        place.mkdir(parents=True)
        frames = []
        for k, step in enumerate(steps):
            frame = skew_frame(count + 7 * k, 1000 * number + step + int(shift))
            columns = frame.columns | {"diameter": frame.diameter * (1 + 0.1 * shift)}
            frames.append(Frame(step, 1e-4 * step, SKEW, columns))
            write_dump(place / f"run.{step:05d}.dump", frames[-1], SKEW_NAMES, **options)
        made.append(frames)
    return made


def rows_by_name(path):
    with open(path) as file:
        return {(float(r["time"]), r["observable"], r["part"]): r for r in csv.DictReader(file)}


def plain(frame, borders):
    """Observables of a frame, by loops and numpy."""
    apart = np.stack([frame.x, frame.y, frame.z], axis=1)[:, None] - np.stack([frame.x, frame.y, frame.z], axis=1)
    apart[..., 0] -= 0.12 * np.round(apart[..., 0] / 0.12)  # x repeats
    near = np.linalg.norm(apart, axis=2) <= (frame.diameter[:, None] + frame.diameter) / 2
    together = near
    for _ in range(8):  # reached in 2⁸ steps
        together = together @ together
    d, v = frame.diameter, np.stack([frame["vx"], frame["vz"]])
    shares = [100 * ((d >= a) & (d < b)).mean() for a, b in zip([0, *borders], [*borders, np.inf], strict=True)]
    return {
        ("count", ""): len(frame),
        ("mass", ""): frame.mass.sum(),
        ("mean_diameter", ""): d.sum() / len(d),
        ("sauter_diameter", ""): (d**3).sum() / (d**2).sum(),
        ("granular_temperature", ""): v.var(axis=1, ddof=1).mean(),
        ("largest_group", ""): together.sum(axis=1).max(),
        ("size_classes", "<4000"): shares[0],
        ("size_classes", "4000-6000"): shares[1],
        ("size_classes", ">6000"): shares[2],
    }


def test_groups(tmp_path, command):
    first = write_runs(tmp_path, "a", [90, 110, 105])
    second = write_runs(tmp_path, "b", [60, 75], shift=1)
    folders = [tmp_path / f"a{i}" for i in range(3)], [tmp_path / f"b{i}" for i in range(2)]
    words = (*folders[0], "--with", *folders[1], "--classes", "4000", "6000", "--observe", *OBSERVED)
    code, out, err = command("compare", *words, "--out", tmp_path / "c")
    assert (code, err) == (0, "") and "a0 … a2 (3 runs); second: b0 … b1 (2 runs)" in out
    assert (tmp_path / "c/compare.png").stat().st_size > 1000
    rows = rows_by_name(tmp_path / "c/compare.csv")
    assert {time for time, _, _ in rows} == {0.0, 0.01, 0.02}
    for k, time in enumerate((0.0, 0.01, 0.02)):
        mine, theirs = ([plain(run[k], (4e-3, 6e-3)) for run in group] for group in (first, second))
        for key in mine[0]:
            row = {
                name: float(text)
                for name, text in rows[(time, *key)].items()
                if name not in ("observable", "part", "unit")
            }
            a, b = np.array([one[key] for one in mine], float), np.array([one[key] for one in theirs], float)
            assert row["first"] == pytest.approx(a.mean(), rel=1e-11)
            assert row["second"] == pytest.approx(b.mean(), rel=1e-11)
            assert row["first_spread"] == pytest.approx(np.std(a, ddof=1), rel=1e-9)
            assert row["second_spread"] == pytest.approx(np.std(b, ddof=1), rel=1e-9)
            assert row["difference"] == pytest.approx(b.mean() - a.mean(), rel=1e-9)
            percent = math.nan if key[0] == "size_classes" else 100 * (b.mean() / a.mean() - 1)
            assert row["difference_percent"] == pytest.approx(percent, rel=1e-9, nan_ok=True)
            error = math.sqrt(np.var(a, ddof=1) / 3 + np.var(b, ddof=1) / 2)
            assert row["standard_error"] == pytest.approx(error, rel=1e-9)
            if error > 0:
                assert row["p"] == pytest.approx(stats.ttest_ind(a, b, equal_var=False).pvalue, rel=1e-8)
            else:
                assert row["p"] == (a[0] == b[0])
    # the last time is printed, with signs and percent
    assert "at 0.02 s" in out and "at 0.01 s" not in out
    change = float(rows[(0.02, "mean_diameter", "")]["difference_percent"])
    assert f"{change:+.1f} %" in next(line for line in out.splitlines() if line.startswith("mean_diameter"))


def test_two_runs(tmp_path, command):
    write_runs(tmp_path, "a", [90, 60])
    code, out, _ = command(
        "compare", tmp_path / "a0", tmp_path / "a1", "--observe", "count", "strip_diameter", "--out", tmp_path / "c"
    )
    rows = rows_by_name(tmp_path / "c/compare.csv")
    row = rows[(0.01, "count", "")]
    assert code == 0 and (row["first"], row["second"], row["difference"]) == ("97.0", "67.0", "-30.0")
    assert row["standard_error"] == row["p"] == row["first_spread"] == "nan"
    assert [part for _, name, part in rows if name == "strip_diameter"][:6] == list("123456")
    assert "-28.8 %" in out  # at the last time 74 beside 104


def test_the_classes_and_cells_are_the_same_for_all_runs(tmp_path):
    """They follow from the first run, whatever the sizes of the others."""
    write_runs(tmp_path, "a", [90])
    write_runs(tmp_path, "b", [80], shift=5)
    first, second = Run(tmp_path / "a0"), Run(tmp_path / "b0")
    compared = compare_runs([first], [second], ["size_classes", "map", "sauter_diameter"])
    how = How().settled([first.at(0.0), first.at(0.02)])
    frame = second.at(0.01)
    assert compared.found["size_classes"][1].second.tolist() == find("size_classes")(frame, how).tolist()
    assert compared.found["map"][1].second.shape == (900,)
    assert compared.found["sauter_diameter"][1].second[0] == pytest.approx(sauter_diameter(frame.diameter))


def test_times_in_common(tmp_path):
    write_runs(tmp_path, "a", [20], steps=(0, 100, 200))
    write_runs(tmp_path, "b", [20], steps=(100, 150, 200))
    write_runs(tmp_path, "c", [20], steps=(300, 400))
    a, b, c = (Run(tmp_path / f"{name}0") for name in "abc")
    assert compare_runs([a], [b], ["count"]).times == (0.01, 0.02)
    assert compare_runs([a], [b], ["count"], times=[0.02]).times == (0.02,)
    one = compare_runs([a], [b], ["count"], times=[0.02, 0.01]).found["count"]
    assert [d.first.tolist() for d in one] == [[34], [27]]  # in the order that they are asked for
    with pytest.raises(
        ArgumentError, match=r"time: the runs have no time in common: .*a0 0 to 0.02 s, .*c0 0.03 to 0.04 s"
    ):
        compare_runs([a], [c])
    with pytest.raises(ArgumentError, match=r"time: .*a0 has no frame within 0.00015 s of 0.015 s"):
        compare_runs([a], [b], times=[0.015])
    with pytest.raises(ArgumentError, match="second: needs a run or more"):
        compare_runs([a], [])


def test_empty_frames_and_frames_without_times(tmp_path):
    write_runs(tmp_path, "a", [0])
    write_runs(tmp_path, "b", [5])
    compared = compare_runs([Run(tmp_path / "a0")], [Run(tmp_path / "b0")], ["count", "mean_diameter"])
    assert compared.found["count"][0].difference.tolist() == [5] and math.isnan(
        compared.found["mean_diameter"][0].first[0]
    )
    write_runs(tmp_path, "t", [5], time=False)
    with pytest.raises(InputError, match="t0: needs frames with times, by which runs are compared: give --dt"):
        compare_runs([Run(tmp_path / "t0")], [Run(tmp_path / "b0")])


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("a0",), "--with: must name the second group to compare a run with (dump files are compared with --case)"),
        (("a0", "a1", "a2"), "--with: must name the second group of 3 runs"),
        (("a0", "absent"), "absent: must be the folder of a run"),
        (("a0", "a1", "--observe", "speed"), "--observables: there is no 'speed'; there are count"),
        (("a0", "a1", "--classes", "3", "2"), "--classes: must be sizes above 0, ascending"),
        (("a0", "a1", "--time", "7"), "has no frame within 0.07 s of 7 s"),
        (("a0", "a1", "--rows", "paper"), "--rows: are sources beside a published case: give --case too"),
        (("a0", "two"), "two: a run's name must be chosen"),
        (("a0/run.00000.dump", "--case", "case1", "--time", "1"), "--time: is for two groups of runs, without --case"),
        (("a0/run.00000.dump", "--case", "case1", "--with", "a1"), "--with: is for two groups of runs, without --case"),
    ],
)
def test_words_that_cannot_be(words, said, tmp_path, command, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_runs(tmp_path, "a", [5, 6, 7])
    (tmp_path / "two").mkdir()
    for name in ("one", "other"):
        write_dump(tmp_path / f"two/{name}.dump", skew_frame(3), SKEW_NAMES)
    code, _, err = command("compare", *words, "--out", tmp_path / "out")
    assert code == 2 and said in err, err
