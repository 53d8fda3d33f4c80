"""Study files of a calibration: the shipped ones are right, bad ones name word, value and rule."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from clusterdem.errors import InputError
from clusterdem.studies.calibrate.parameters import Choice, Real, fill, moved, units
from clusterdem.studies.calibrate.study import read_calibration
from clusterdem.studies.calibrate.targets import Target, deviations, published_targets, read_off

ROOT = Path(__file__).parents[2]
STUDIES = sorted((ROOT / "inputs/calibrate").glob("*.toml"))
GOOD = f"""
[variables]
law = "trancong {{c}} 1.1"
[[case]]
input = "{ROOT}/inputs/case1.in"
published = "case1"
[[parameter]]
name = "K_3"
low = 0.01
high = 0.1
log = true
[[parameter]]
name = "c"
low = 0.4
high = 1
[[parameter]]
name = "begin"
choices = ["gas", "rest"]
[start]
A = {{ K_3 = 0.0399, c = 0.8, begin = "gas" }}
[search]
trials = 4
[confirm]
starts = ["A"]
"""


@pytest.fixture
def read(tmp_path):
    def of(text, **options):
        path = tmp_path / "study.toml"
        path.write_text(text)
        return read_calibration(path, **options)

    return of


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.stem)
def test_shipped_studies_are_right(path):
    study = read_calibration(path)
    assert "A" in study.starts and study.local and study.confirm
    for case in study.cases:
        assert case.solids is not None and case.targets


def test_there_are_the_four_studies():
    assert [path.stem for path in STUDIES] == ["case1", "case2", "case3", "joint"]


def test_what_a_study_says(read):
    study = read(GOOD, variables={"height": "0.1"}, trials=7)
    assert study.parameters == (
        Real("K_3", 0.01, 0.1, True),
        Real("c", 0.4, 1.0),
        Choice("begin", ("gas", "rest")),
    )
    assert study.search.trials == 7 and study.search.variables == {"height": "0.1"}
    assert study.local is None and study.confirm.starts == ("A",)
    assert study.starts == {"A": {"K_3": 0.0399, "c": 0.8, "begin": "gas"}}


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[variables]", "[variable]", ["unknown key 'variable'", "the keys are"]),
        ("trials = 4", "trials = 0", ["search.trials = 0", "whole number, 1 or more"]),
        ("trials = 4", "promote = 1.5", ["search.promote = 1.5", "at most 1"]),
        ("trials = 4", "tries = 4", ["search: unknown key 'tries'"]),
        ("[confirm]", "[local]\nchoices = 1\n[confirm]", ["local.choices = 1", "true or false"]),
        ("trials = 4", "population = 3", ["search.population = 3", "4 points or more"]),
        ("trials = 4", "seeds = 1", ["search.seeds = 1", "fewer than 2"]),
        ("trials = 4", "limit = -1", ["search.limit = -1", "whole number, 1 or more"]),
        ("high = 0.1", "high = 0.001", ["parameter 'K_3'.low, high = [0.01, 0.001]", "low must be below high"]),
        ("low = 0.01", "low = 0", ["parameter 'K_3'.low = 0.0", "above 0 where log = true"]),
        ("low = 0.4", 'low = "a"', ["parameter 'c'.low = 'a'", "must be a number"]),
        ("low = 0.4", "low = nan", ["parameter 'c'.low = nan", "must be a number"]),
        ("low = 0.4", "lowest = 0.4", ["parameter 'c': unknown key 'lowest' (did you mean 'low'?)"]),
        ('name = "c"', 'name = "K_3"', ["parameter.name = 'K_3'", "twice"]),
        ('name = "c"', 'name = "a b"', ["parameter 'a b'.name = 'a b'", "must be a word"]),
        ('["gas", "rest"]', "[]", ["parameter 'begin'.choices = []", "one value or more"]),
        (
            '["gas", "rest"]',
            '["gas", "rest"]\nlow = 1',
            ["parameter 'begin' (name, choices, low)", "either choices, or low"],
        ),
        ("{c}", "{d}", ["variables.law = 'trancong {d} 1.1'", "{d} is no parameter"]),
        ("case1.in", "case9.in", ["case9.in'", "no such file"]),
        ('"case1"\n', '"case7"\n', ["published = 'case7'", "must be among case1, case2, case3"]),
        ('published = "case1"', 'name = "mine"', ["case 'mine'", "nothing observed"]),
        ("c = 0.8", "c = 2", ["start.A.c = 2", "must lie between 0.4 and 1"]),
        ("c = 0.8, ", "", ["start.A.c = None", "a value for every parameter"]),
        ('begin = "gas" }', 'begin = "run" }', ["start.A.begin = 'run'", "must be among gas, rest"]),
        ('starts = ["A"]', 'starts = ["B"]', ["confirm.starts = ['B']", "list of starts (A)"]),
    ],
)
def test_bad_files_are_refused_with_word_value_and_rule(read, old, new, said):
    assert old in GOOD
    with pytest.raises(InputError) as refusal:
        read(GOOD.replace(old, new, 1))
    for words in said:
        assert words in str(refusal.value)


@pytest.mark.parametrize(
    ("target", "said"),
    [
        (
            'quantity = "weight"\ntime = 1\nvalue = 1',
            ["case 'mine'.target.quantity = 'weight'", "the observables are count, clusters"],
        ),
        ('quantity = "mean_diameter"\ntime = 1', ["needs one of value, below, above"]),
        ('quantity = "mean_diameter"\ntime = 0\nvalue = 1', ["case 'mine'.target 'mean_diameter'.time = 0", "above 0"]),
        ('quantity = "mean_diameter"\ntime = 1\nvalue = -1', ["target 'mean_diameter'.value = -1", "above 0"]),
        (
            'quantity = "size_classes"\ntime = 1\nvalue = 1\npart = "big"',
            ["target 'size_classes'.part = 'big'", "<300"],
        ),
        (
            'quantity = "mean_diameter"\ntime = 1\nvalue = 1\npart = "1"',
            ["target 'mean_diameter'.part = '1'", "single number"],
        ),
        ('quantity = "clusters"\ntime = 1\nvalue = 1', ["belongs to a mass of solids", "solids = kg"]),
    ],
)
def test_bad_targets_are_refused(read, target, said):
    own = GOOD.replace('published = "case1"', f'name = "mine"\n[[case.target]]\n{target}')
    with pytest.raises(InputError) as refusal:
        read(own)
    for words in said:
        assert words in str(refusal.value)


def test_own_observations(read):
    own = GOOD.replace(
        'published = "case1"',
        """name = "mine"
solids = 2e-3
[[case.target]]
quantity = "clusters"
time = 0.02
value = 9000
error = 0.2
[[case.target]]
quantity = "size_classes"
part = "<300"
time = 0.02
below = 40
[[case.target]]
quantity = "size_classes"
part = ">900"
time = 0.02
value = 1""",
    )
    first, second, third = read(own).cases[0].targets
    assert (first.error, first.weight, first.label) == (0.2, 1.0, "N(0.02)")
    assert (second.kind, second.value, second.weight, second.label) == ("below", 40.0, 0.5, "share <300(0.02)")
    assert third.part == 3


def test_values_and_their_places_in_a_range():
    parameters = (Real("K", 0.01, 1, log=True), Choice("x", ("a", "b")), Real("c", 0.4, 1))
    point = {"K": 0.1, "x": "b", "c": 0.4}
    assert units(parameters, point) == pytest.approx([0.5, 0.0])
    assert moved(parameters, point, np.array([1.2, 0.5])) == {"K": 1.0, "x": "b", "c": 0.7}
    assert parameters[0].value(1 / 3) == 0.04642  # four digits: what is run is what is reported


def test_parameters_fill_their_places_or_set_the_variable_of_their_name():
    assert fill({"law": "trancong {c} {a}", "tend": "1"}, {"c": 0.8, "a": 1.1, "up": "own"}) == {
        "law": "trancong 0.8 1.1",
        "tend": "1",
        "up": "own",
    }


def test_deviations_are_ratios_or_points_and_bounds_are_one_sided():
    targets = [
        Target("clusters", 1, 0, 100.0),
        Target("size_classes", 1, 0, 30.0),
        Target("mean_diameter", 1, 0, 3e-4, "below"),
        Target("mean_diameter", 1, 0, 3e-4, "above"),
    ]
    assert deviations(targets, np.array([200.0, 25.0, 6e-4, 6e-4])) == pytest.approx([np.log(2), -5, np.log(2), 0])


@pytest.mark.parametrize(
    "kind, number, apart",
    [
        ("value", 25.0, -5.0), ("value", 36.0, 6.0), ("below", 25.0, 0.0), ("below", 36.0, 6.0),
        ("above", 25.0, -5.0), ("above", 36.0, 0.0),
    ],
)  # fmt: skip
def test_a_bound_counts_on_its_own_side(kind, number, apart):
    assert Target("size_classes", 1, 0, 30.0, kind).deviation(number) == apart


def test_the_local_stage_runs_as_the_search_unless_it_says_otherwise(read):
    searched = GOOD.replace("trials = 4", "variables = { height = 0.2 }\n[local]")
    assert read(searched).local.variables == {"height": "0.2"} and read(searched).confirm.variables == {}
    assert read(searched.replace("[local]", "[local]\nvariables = { height = 1 }")).local.variables == {"height": "1"}


def test_errors_that_no_target_names(read):
    """Ten percent, or three points of a share, as the page says; of the paper's numbers too."""
    own = "[[case.target]]\ntime = 0.02\nvalue = 3\nquantity = "
    text = GOOD.replace(
        'published = "case1"', f'name = "mine"\n{own}"mean_diameter"\n{own}"size_classes"\npart = "<300"'
    )
    assert [target.error for target in read(text).cases[0].targets] == [0.1, 3.0]
    assert {(t.quantity, t.error) for t in published_targets("case1")} == {
        ("clusters", 0.1), ("mean_diameter", 0.1), ("size_classes", 3.0),
    }  # fmt: skip


def test_clusters_belong_to_the_whole_mass():
    """A tenth of the mass holds a tenth of the clusters: per mass they are as many."""
    targets = [Target("clusters", 0.02, 0, 100.0), Target("clusters", 0.03, 0, 100.0)]
    numbers = {"times": [[0.01], [0.0201]], "clusters": [[5.0], [1000.0]]}
    found = read_off(targets, numbers, solids=0.1)
    assert found[0] == pytest.approx(100.0) and np.isnan(found[1])  # 1 % in time is the same frame, 0.03 is none


def test_published_numbers_count_by_kind():
    targets = published_targets("case3")
    assert [(t.label, t.kind) for t in targets] == [
        ("N(0.05)", "value"),
        ("mean d in strip 1(0.05)", "below"),
        ("mean d in strip 6(0.05)", "above"),
    ]
    assert sum(t.weight for t in published_targets("case1")) == pytest.approx(3)  # N, mean, classes
