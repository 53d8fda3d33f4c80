"""Study files: what they say, and how they are refused."""

from __future__ import annotations

import itertools

import pytest
from clusterdem.errors import InputError
from clusterdem.studies.trade.observe import DEFAULT
from clusterdem.studies.trade.settings import settings_of, together
from clusterdem.studies.trade.study import read_study
from hypothesis import given
from hypothesis import strategies as st

GOOD = """
input = "in.run"
[variables]
tend = 2e-4
[switches]
dt = [1e-6, 2e-6]
every = [1, 10, 100]
[[axis]]
name = "contact law"
settings = [{name = "Eq. 4", contact = "md"}, {name = "lean", contact = "linear", atoms = "cluster"}]
"""


@pytest.fixture
def study(tmp_path):
    (tmp_path / "in.run").write_text("")

    def read(text):
        (tmp_path / "study.toml").write_text(text)
        return read_study(tmp_path / "study.toml")

    return read


def test_defaults_and_numbers_as_written(study):
    found = study(GOOD)
    assert found.seeds == (1, 2, 3, 4, 5) and found.ranks == 1 and found.observables == DEFAULT
    assert found.variables == {"tend": "2e-4"}
    assert [option.variables for option in found.axes[0].options] == [{"dt": "1e-6"}, {"dt": "2e-6"}]
    assert found.axes[2].options[1].variables == {"contact": "linear", "atoms": "cluster"}


def test_one_axis_at_a_time(study):
    settings = settings_of(study(GOOD))
    assert [(s.axis, s.name) for s in settings] == [
        ("reference", "dt = 1e-6, every = 1, Eq. 4"),
        ("dt", "dt = 2e-6"),
        ("every", "every = 10"),
        ("every", "every = 100"),
        ("contact law", "lean"),
    ]
    assert settings[0].variables == {"tend": "2e-4", "dt": "1e-6", "every": "1", "contact": "md"}
    assert settings[4].variables == {
        "tend": "2e-4", "dt": "1e-6", "every": "1", "contact": "linear", "atoms": "cluster",
    }  # fmt: skip


def test_product(study):
    settings = settings_of(study('combine = "product"\n' + GOOD))
    assert len(settings) == 2 * 3 * 2 and settings[0].axis == "reference"
    pairs = [(s.variables["dt"], s.variables["every"], s.variables["contact"]) for s in settings]
    assert pairs == list(itertools.product(("1e-6", "2e-6"), ("1", "10", "100"), ("md", "linear")))


def test_together_takes_each_axis_its_own(study):
    found = study(GOOD)
    settings = settings_of(found)
    both = together(found, [settings[1], settings[4]])
    assert (both.axis, both.name) == ("dt + contact law", "dt = 2e-6, lean")
    assert both.variables["dt"] == "2e-6" and both.variables["every"] == "1" and both.variables["atoms"] == "cluster"


@given(st.lists(st.integers(2, 5), min_size=1, max_size=4), st.booleans())
def test_settings_are_as_many_as_counted_and_all_differ(tmp_path_factory, sizes, product):
    folder = tmp_path_factory.mktemp("study")
    (folder / "in.run").write_text("")
    text = f'input = "in.run"\ncombine = "{"product" if product else "one at a time"}"\n[switches]\n'
    text += "".join(f"v{i} = {list(range(size))}\n" for i, size in enumerate(sizes))
    (folder / "study.toml").write_text(text)
    settings = settings_of(read_study(folder / "study.toml"))
    expected = len(list(itertools.product(*map(range, sizes)))) if product else 1 + sum(size - 1 for size in sizes)
    assert len(settings) == expected == len({tuple(s.variables.items()) for s in settings})
    assert len({(s.axis, s.name) for s in settings}) == expected


@pytest.mark.parametrize(
    "change, words",
    [
        (("input", "script"), ["study.toml: unknown key 'script'", "the keys are input, seeds"]),
        (("in.run", "in.gone"), ["input = 'in.gone'", "no such file"]),
        (('input = "in.run"', "input = 3"), ["input = 3: must be a text"]),
        (("[variables]\ntend = 2e-4", "variables = 3"), ["variables = 3", "table of variables"]),
        (("[switches]", "[switches"), ["is not TOML", "line 5"]),
        (("dt = [1e-6, 2e-6]", "dt = 1e-6"), ["switches.dt = 1e-6", "list of values"]),
        (("dt = [1e-6, 2e-6]", "dt = [1e-6]"), ["axis 'dt'", "two settings or more"]),
        (("dt = [1e-6, 2e-6]", "dt = [1e-6, 1e-6]"), ["axis 'dt'", "all different"]),
        (("dt = [1e-6, 2e-6]", "dt = [1e-6, true]"), ["switches.dt 2 = True", "a number or one line of text"]),
        (("dt = [1e-6, 2e-6]", 'dt = [1e-6, ""]'), ["switches.dt 2 = ''", "a number or one line of text"]),
        (("dt = [1e-6, 2e-6]", '"d t" = [1, 2]'), ["'d t'", "letters, digits and underscores"]),
        (("dt = [1e-6, 2e-6]", "seed = [1, 2]"), ["switches.seed", "set by the study itself"]),
        (("dt = [1e-6, 2e-6]", "tend = [1, 2]"), ["'tend'", "already set by [variables]"]),
        (("contact = ", "every = "), ["'every'", "already set by axis 'every'"]),
        (('name = "contact law"', 'name = "dt"'), ["axis = ['dt', 'every', 'dt']", "all differ"]),
        (('name = "contact law"', ""), ["axis 1.name is missing: must be a text"]),
        (('{name = "lean", ', "{"), ["axis 'contact law'.settings 2.name is missing"]),
        (
            ("settings = [", "setings = ["),
            ["axis 'contact law': unknown key 'setings' (did you mean 'settings'?): the keys are name, settings"],
        ),
    ],
    ids=str,
)
def test_refusals_name_file_key_value_and_rule(study, change, words):
    assert change[0] in GOOD
    with pytest.raises(InputError) as refused:
        study(GOOD.replace(*change))
    for word in ["study.toml: ", *words]:
        assert word in str(refused.value)


@pytest.mark.parametrize(
    "line, words",
    [
        ("seeds = 2", ["seeds = 2", "fewer than 3"]),
        ("seeds = [1, 2, 2]", ["seeds = [1, 2, 2]", "that all differ"]),
        ("seeds = [1, 2, -3]", ["seeds = [1, 2, -3]", "positive whole numbers"]),
        ('seeds = "many"', ["seeds = 'many'", "how many"]),
        ("ranks = 0", ["ranks = 0", "1 or more"]),
        ("ranks = true", ["ranks = True", "whole number"]),
        ('combine = "all"', ["combine = 'all'", "'product'"]),
        (
            'observables = ["colour"]',
            ["observables = 'colour': unknown observable 'colour': the observables are", "clusters, mass"],
        ),
        ("observables = []", ["observables = []", "list of names"]),
        ("observables = [[1]]", ["observables 1 = [1]", "list of names"]),
        ("classes = [3, 2]", ["classes = [3, 2]", "ascending"]),
        ('classes = ["a"]', ["classes 1 = 'a'", "borders of size classes (µm)"]),
        ('plane = "xx"', ["plane = 'xx'", "two of x, y, z"]),
        ('observables_file = "gone.py"', ["observables_file = 'gone.py'", "no such file"]),
        ("cell = [0.01, 0]", ["cell 2 = 0", "two positive numbers (m)"]),
        ("cell = [0.01, inf]", ["cell 2 = inf", "two positive numbers"]),
        ("cell = 0.01", ["cell = 0.01", "width and height"]),
    ],
    ids=str,
)
def test_refusals_of_options(study, line, words):
    with pytest.raises(InputError) as refused:
        study(line + "\n" + GOOD)
    for word in words:
        assert word in str(refused.value)


def test_no_axis(study):
    with pytest.raises(InputError, match="no axis"):
        study('input = "in.run"\n')


def test_too_many_settings(study):
    text = 'input = "in.run"\ncombine = "product"\n[switches]\n'
    text += "".join(f"v{i} = {list(range(10))}\n" for i in range(5))
    with pytest.raises(InputError, match="100,000 settings are more than 10,000"):
        settings_of(study(text))


def test_no_such_study(tmp_path, command):
    code, _, err = command("trade", tmp_path / "gone.toml")
    assert code == 2 and err.count("\n") == 1 and "gone.toml: cannot be read: No such file" in err


def test_variables_and_seeds_of_the_command_line_win(study, tmp_path):
    study(GOOD)
    found = read_study(tmp_path / "study.toml", {"tend": "1e-4", "nx": "2"}, seeds=4)
    assert found.variables == {"tend": "1e-4", "nx": "2"} and found.seeds == (1, 2, 3, 4)
    with pytest.raises(InputError, match="'dt': this variable is already set by"):
        read_study(tmp_path / "study.toml", {"dt": "1e-4"})
    with pytest.raises(InputError, match="seeds = 2: .*fewer than 3 show no spread"):
        read_study(tmp_path / "study.toml", seeds=2)
