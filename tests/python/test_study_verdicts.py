"""Every sentence by which a study judges, on both sides of its rule."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from clusterdem import InputError
from clusterdem.observables import How
from clusterdem.studies.calibrate.fit import Confirmed, Fit, jackknife
from clusterdem.studies.calibrate.identify import Direction, Identified, in_words
from clusterdem.studies.calibrate.local import Flip, Neighbourhood
from clusterdem.studies.calibrate.parameters import Choice, Real
from clusterdem.studies.calibrate.report import as_markdown as calibrate_report
from clusterdem.studies.calibrate.score import Yardstick, yardstick
from clusterdem.studies.calibrate.search import Trial
from clusterdem.studies.calibrate.study import Calibration, Case, Confirm, Search
from clusterdem.studies.calibrate.targets import Target
from clusterdem.studies.engine import Engine
from clusterdem.studies.runs import Cost, Failure, Setting, StudyRun
from clusterdem.studies.trade.answer import as_input
from clusterdem.studies.trade.answer import in_words as answer
from clusterdem.studies.trade.errors import Error
from clusterdem.studies.trade.report import as_markdown as trade_report
from clusterdem.studies.trade.report import percent, seconds, write_table
from clusterdem.studies.trade.study import Study
from clusterdem.studies.trade.weigh import Weighed, cheapest, weigh

ENGINE = Engine("/opt/lmp", "LAMMPS (1 Apr 2026)", "1", ())


def failed(setting, seed, reason="lost atoms"):
    run = StudyRun(setting, seed, f"{setting.name}{seed}", Path("runs/key"), (), ("lmp", "-in", "a b"), 1, ENGINE, None)
    return Failure(run, reason)


# ---- trade


def weighed(name, seconds, errors, failures=0, axis="dt"):
    setting = Setting(axis, name, {"dt": name, "law": "a b"})
    costs = {seed: Cost(s, s) for seed, s in enumerate(seconds, 1)}
    return Weighed(setting, costs, errors, tuple(failed(setting, 7 + k) for k in range(failures)))


def of(**errors):
    return {name: None if e is None else Error(*e) for name, e in errors.items()}


REFERENCE = weighed("fine", [10.0, 12.0, 11.0], of(map=(0, 0, 0.3), clusters=(0, 0, 0.02)), axis="reference")


@pytest.mark.parametrize(
    "value, uncertainty, told",
    [
        (0.03, 0.01, True),  # 0.03 + 2 * 0.01 is the tolerance itself
        (0.03, 0.0101, None),
        (0.07, 0.01, None),  # 0.07 - 2 * 0.01 is the tolerance itself
        (0.0701, 0.01, False),
        (0.05, 0.0, True),
        (0.0501, 0.0, False),
    ],
)
def test_within_is_told_at_two_standard_errors(value, uncertainty, told):
    tolerance = 0.05 + 1e-12  # sums of decimals
    assert Error(value, uncertainty, 1.0).within(tolerance) is told
    w = weighed("2", [1, 1, 1], of(map=(value, uncertainty, 1.0), clusters=(0, 0, 0)))
    assert w.within(tolerance) is told
    words = answer([REFERENCE, w], cheapest([REFERENCE, w], tolerance), tolerance)
    assert ("Cannot be told" in words) is (told is None)
    assert ("the reference itself" in words) is (told is not True)


def test_the_answer_names_cost_gain_and_the_worst_observable():
    """Clusters 2 ± 1 % end at 4 %, the map's 3 ± 0.2 % at 3.4 %: clusters are the worst, though their error is smaller."""
    best = weighed("2", [2.0, 4.0, 3.0], of(map=(0.03, 0.002, 0.3), clusters=(0.02, 0.01, 0.016)))
    assert answer([REFERENCE, best], best, 0.05) == (
        "Cheapest within 5 %: 2, 3 core-seconds instead of 11 (3.67 times faster). Its largest error: N 2 ± 1 %; single "
        "seeds differ by 1.6 %."
    )
    assert answer([REFERENCE, best], REFERENCE, 0.005) == (
        "Cheapest within 0.5 %: the reference itself, 11 core-seconds."
    )


def test_what_cannot_be_told_is_told_of_cheaper_settings_only_cheapest_first():
    """Of each the observable that leaves it open: not the map, which is certain."""
    certain = (0.001, 0.0, 0.3)
    slow = weighed("slow", [9.0, 9.1, 9.2], of(map=certain, clusters=(0.04, 0.01, 0.1)))
    quick = weighed("quick", [1.0, 1.1, 1.2], of(map=certain, clusters=(0.045, 0.02, 0.1)))
    best = weighed("best", [5.0, 5.1, 5.2], of(map=certain, clusters=certain))
    words = answer([REFERENCE, slow, quick, best], best, 0.05)
    assert words.startswith("Cannot be told within 5 %, more seeds are needed: quick (N 4.5 ± 2 %, 1.1 core-seconds). ")
    words = answer([REFERENCE, slow, quick], REFERENCE, 0.05)
    assert "quick (N 4.5 ± 2 %, 1.1 core-seconds); slow (N 4 ± 1 %, 9.1 core-seconds). Cheapest" in words


def study_of(**changes):
    plain = Study(Path("s.toml"), Path("/in/case.in"), (), (1, 2, 3), {}, 1, False, ("map", "clusters"), How())
    return replace(plain, **changes)


def test_the_report_of_a_trade():
    inside = weighed("inside", [5.0, 6.0, 5.5], of(map=(0.3, 0.01, 0.3), clusters=(1e-13, 0, 0.02)))
    outside = weighed("a|b", [1.0, 2.0, 1500.0], of(map=(0.31, 0.01, 0.3), clusters=None), failures=1)
    none = weighed("none", [], of(map=None, clusters=None), failures=3)
    text = trade_report(study_of(), ENGINE, [REFERENCE, inside, outside, none], "The answer.")
    assert "LAMMPS (1 Apr 2026), 1 rank, 3 seeds; all runs with the script's defaults." in text
    assert "| 0 | reference | fine | 11 | 1.00 | 0 | 0 |" in text and "| *spread* |  |  | *30* | *2* |" in text
    assert "| 1 | dt | inside | 5.5 | 2.00 | 30 ± 1 | 0 |" in text  # at the spread itself no single run could show it
    assert "| 2 | dt | a\\|b (1 of 3 runs failed) | 2 | 5.50 | **31 ± 1** | n/c |" in text
    assert "| 3 | dt | none (3 of 3 runs failed) | – | – | n/c | n/c |" in text
    assert "\nThe answer.\n" in text and text.count("lost atoms") == 4 and "none, seed 9\n$ lmp -in 'a b'\n" in text
    text = trade_report(study_of(ranks=2, variables={"tend": "1", "nx": "3"}), ENGINE, [REFERENCE, inside], "")
    assert ", 2 ranks, 3 seeds; all runs with tend=1 nx=3." in text and "Runs that failed" not in text


@pytest.mark.parametrize(
    "share, text",
    [(0.0504, "5"), (0.1234, "12"), (0.99449, "99"), (1.0, "100"), (1.234, "123"), (np.inf, "∞"), (np.nan, "–")],
)
def test_shares_in_percent(share, text):
    assert percent(share) == text


@pytest.mark.parametrize("value, text", [(0.01234, "0.0123"), (999.4, "999"), (1234.4, "1234"), (np.inf, "–")])
def test_seconds_for_reading(value, text):
    assert seconds(value) == text


def test_the_table_of_a_trade(tmp_path):
    """Every column beside its own number; what cannot be compared is empty."""
    other = weighed("2", [4.0, 5.0, 6.5], of(map=(0.31, 0.02, 0.3), clusters=None), failures=1)
    other.costs[2] = Cost(7.0, 5.0)
    with open(write_table(tmp_path / "t.csv", [REFERENCE, other], ("map", "clusters"))) as file:
        first, second = csv.DictReader(file)
    assert second == {
        "number": "1", "axis": "dt", "setting": "2", "variables": "dt=2 law=a b", "core_seconds": "5.0", "wall": "6.5",
        "speedup": "2.2", "finished": "3", "failed": "1",
        "map_error": "0.31", "map_uncertainty": "0.02", "map_spread": "0.3", "map_inside": "False",
        "clusters_error": "", "clusters_uncertainty": "", "clusters_spread": "", "clusters_inside": "",
    }  # fmt: skip
    assert (first["speedup"], first["map_inside"], first["clusters_spread"]) == ("1.0", "True", "0.02")


def test_the_answer_as_an_input():
    text = as_input(study_of(), REFERENCE, "One. Two.")
    assert text == (
        "# s.toml: case.in at the setting named below; by clusterdem trade.\n# One.\n# Two.\n"
        'variable dt       index fine\nvariable law      index "a b"\nvariable inputs   index /in\n'
        "include  ${inputs}/case.in\n"
    )


def test_a_reference_of_too_few_runs():
    setting = Setting("reference", "fine", {})
    runs = [failed(setting, seed).run for seed in (1, 2, 3)]
    failures = {run.key: Failure(run, "ended with status 3") for run in runs}
    with pytest.raises(
        InputError, match="the reference has 0 finished runs, it needs 3; fine, seed 1: ended with status 3"
    ):
        weigh(study_of(), runs, failures, {})


# ---- calibrate


def identified(deviation, scatter=(0.0, 0.0), correlation=0.0, misfit=1.0, directions=()):
    matrix = np.array([[1.0, correlation], [correlation, 1.0]])
    alone = np.array(deviation)
    return Identified(("K", "c"), np.array(deviation), alone, np.array(scatter), matrix, tuple(directions), misfit)


HALF = 0.5 / np.sqrt(12)  # half of what an even distribution over the range leaves open


@pytest.mark.parametrize(
    "deviation, scatter, said, unsaid",
    [
        ((0.99 * HALF, 0.99 * HALF), (0, 0), ["The data determine K, c."], ["They do not determine"]),
        ((0.99 * HALF, 1.01 * HALF), (0, 0), ["The data determine K.", "They do not determine c: more than half"], []),
        (
            (1.01 * HALF, 1.01 * HALF),
            (0, 0),
            ["They do not determine K, c: more than half of what"],
            ["The data determine"],
        ),
        ((0.6 * HALF, 0.6 * HALF), (0.79 * HALF, 0.81 * HALF), ["The data determine K.", "not determine c:"], []),
    ],
)
def test_determined_is_what_leaves_less_than_half_by_misfit_and_seeds(deviation, scatter, said, unsaid):
    words = " ".join(in_words(identified(deviation, scatter)))
    assert all(text in words for text in said) and not any(text in words for text in unsaid)


def test_where_nothing_fits_nothing_is_said_to_be_determined():
    fits = " ".join(in_words(identified((0.01, 0.01), misfit=4.0)))
    assert "The data determine K, c." in fits and "Nothing fits" not in fits
    none = " ".join(in_words(identified((0.01, 0.01), misfit=4.01)))
    assert "Nothing fits: at the best point the mean square deviation is 4.01 times what the errors allow." in none
    assert "The data determine" not in none


@pytest.mark.parametrize("value, said", [(0.79, ""), (0.81, "+0.81"), (-0.79, ""), (-0.81, "-0.81")])
def test_twins_are_errors_that_correlate_beyond_eight_tenths(value, said):
    words = " ".join(in_words(identified((0.01, 0.01), correlation=value)))
    text = f"K and c cannot be told apart (correlation of their errors {said})."
    assert (text in words) if said else ("told apart" not in words)


def test_combinations_that_are_told_and_that_the_seeds_hide():
    first = Direction(9.0, 1.0, np.array([0.8, -0.6]), True)
    weak = Direction(2.0, 1.9, np.array([0.29, 0.957]), False)
    hidden = Direction(2.0, 2.1, np.array([0.6, 0.8]), False)
    words = in_words(identified((0.01, 0.01), directions=(first, weak)))
    assert words[-2:] == ["Of 2 independent combinations of parameters the data tell 1.", "Not told: +0.96 c."]
    words = in_words(identified((0.01, 0.01), directions=(first, hidden)))
    hint = "hidden by the seeds' scatter: more seeds or a larger domain may tell"
    assert words[-1] == f"Not told: +0.80 c +0.60 K, {hint}."
    assert not any("Not told" in text for text in in_words(identified((0.01, 0.01), directions=(first, first))))
    assert replace(first, noise=99.0).hidden is False  # what is told is not hidden


class Model:
    """What a report asks of the model."""

    engine = ENGINE

    def __init__(self, failures=0):
        every = [failed(Setting("case", f"K = {k}", {}), 1, f"lost {k}") for k in range(failures)]
        self.failures = {f.run.key: f for f in every}
        self.used = set(range(17))


def fitted(flips=(), confirmed=False):
    """Two targets at two seeds; the second is a bound."""
    targets = (
        Target("clusters", 0.02, 0, 5400.0),
        Target("mean_diameter", 0.02, 0, 3e-4, "below"),
        Target("largest_diameter", 0.02, 0, 1e-3, "above"),
        Target("dispersion", 0.02, 0, 2.0),
    )
    case = Case(Path("s.toml"), Path("/in/case.in"), "flow", targets, 1.0, 1.0, {"law": "x {c}"}, 1)
    parameters = (Real("K", 0.01, 1.0, True), Real("c", 0.0, 2.0), Choice("begin", ("gas", "rest", "mid")))
    point = {"K": 0.1, "c": 0.5, "begin": "gas"}
    study = Calibration(Path("s.toml"), (case,), parameters, {"A": point | {"K": 0.2}}, Search({}, (1, 2), None))
    samples = {1: np.array([5300.0, 2.5e-4, 2e-3, np.nan]), 2: np.array([5500.0, 2.9e-4, 3e-3, 1.0])}
    best = Trial(3, point, "trial 3", samples, 0.25, True)
    other = Trial(1, point | {"begin": "rest"}, "trial 1", {1: samples[1]}, 7.0, False)
    third = Trial(2, point | {"begin": "gas"}, "trial 2", samples, 0.5, True)
    scale = yardstick(study, np.zeros(4))
    near = Neighbourhood(point, np.zeros((2, 4)), np.zeros((2, 4, 2)), tuple(flips))
    found = identified((0.05, 0.1), (0.01, 0.02))
    fit = Fit(study, np.zeros(4), scale, [other, third, best], best, near, found)
    if confirmed:
        stack = np.array([samples[2], samples[2] + np.array([100.0, 0, 0, 0.5])])
        fit.final = scale
        fit.confirmed = [Confirmed("the fit", point, stack, 0.3, 0.02), Confirmed("A", point, stack, 0.4, 0.03)]
    return fit


def test_a_choice_cannot_be_told_within_two_standard_errors():
    text = calibrate_report(fitted([Flip("begin", "rest", 0.2, 0.1), Flip("begin", "mid", -0.21, 0.1)]), Model())
    assert "| begin | rest | 1 | none with all seeds, of 1 | +0.200 ± 0.100 (cannot be told) |" in text
    assert "| begin | mid | 0 | none with all seeds, of 0 | -0.210 ± 0.100 |\n" in text
    assert "| begin | gas | 2 | 0.250 | the fit |" in text


def test_the_report_of_a_fit():
    text = calibrate_report(fitted(), Model())
    assert "LAMMPS (1 Apr 2026); case.in; 3 trials, 2 of them with all 2 seeds; 17 runs." in text
    assert "Number 3 (trial 3), loss 0.250 in the search." in text
    # K: place 0.5 of a range of two decades, ± 0.05 by misfit and ± 0.01 by seeds; 0.05 is 17 % of 0.289
    low, high = 0.01 * 100**0.45, 0.01 * 100**0.55
    assert (
        f"| K | 0.1 | {low:.3g} to {high:.3g} | {0.01 * 100**0.49:.3g} to {0.01 * 100**0.51:.3g} | 17 % | 0.01 to 1, log |"
        in text
    )
    assert "| c | 0.5 | 0.3 to 0.7 | 0.46 to 0.54 | 35 % | 0 to 2 |" in text
    assert "| begin | gas |  |  |  | gas, rest, mid |" in text
    assert "lmp -in case.in -var law 'x 0.5' -var K 0.1 -var begin gas\n" in text
    assert f"| flow | N(0.02) | 5,400 | 5,400 ± {np.std([5300, 5500], ddof=1):,.0f} |" in text
    assert "| flow | mean d(0.02) | < 300 µm | 270 µm ± 28 |" in text
    assert "| flow | largest d(0.02) | > 1000 µm | 2500 µm ± 7.1e+02 |" in text
    assert "| flow | dispersion(0.02) | 2 | none |" in text  # one of its seeds gave none
    assert "Runs that failed" not in text and "confirmed |" not in text


def test_errors_of_observation_and_seeds_add_in_squares():
    """0.1 and 0.24 make 0.26, 0.1 and 0.105 make 0.145; weights are even."""
    scale = yardstick(fitted().study, np.array([0.24, 0.0, 0.105, 0.1]))
    assert scale.errors == pytest.approx([0.26, 0.1, 0.145, 0.02**0.5]) and scale.weights == pytest.approx([1] * 4)


def test_the_losss_error_is_the_jackknifes():
    """Without squares to speak of the loss is r^2: seeds at 1, 2 and 6 hundredths of an error."""
    scale = Yardstick((Target("size_classes", 1, 0, 30.0),), np.array([1.0]), np.array([1.0]))
    samples = np.array([[30.01], [30.02], [30.06]])
    left = np.array([(0.02 + 0.06) / 2, (0.01 + 0.06) / 2, (0.01 + 0.02) / 2]) ** 2  # loss without each seed
    assert jackknife(scale, samples) == pytest.approx(np.sqrt(2 / 3 * ((left - left.mean()) ** 2).sum()), rel=1e-3)


def test_the_command_of_the_fit_is_that_of_the_last_stage():
    fit = fitted()
    confirm = Confirm({"height": "0.6", "law": "y {c}"}, (1, 2), None)
    fit.study = replace(fit.study, confirm=confirm)
    assert "lmp -in case.in -var law 'y 0.5' -var height 0.6 -var K 0.1 -var begin gas\n" in calibrate_report(
        fit, Model()
    )


def test_confirmed_points_stand_beside_the_fit():
    text = calibrate_report(fitted(confirmed=True), Model())
    assert "| case | target | observed | the fit, in the search | the fit, confirmed | start A, confirmed |" in text
    assert "| all | *loss* |  | 0.250 | 0.300 ± 0.020 | 0.400 ± 0.030 |" in text
    assert "| 5,550 ± 71 | 5,550 ± 71 |" in text and "| none | 1.25 ± 0.35 | 1.25 ± 0.35 |" in text


@pytest.mark.parametrize("count, more", [(1, ""), (5, ""), (6, "… and 1 more."), (9, "… and 4 more.")])
def test_five_failures_are_quoted(count, more):
    text = calibrate_report(fitted(), Model(count))
    assert text.count("\nlost ") == min(count, 5) and "Each counts as far off as can be." in text
    assert text.endswith(f"{more}\n") if more else "more." not in text
