"""The JSON schemas of study files: they are schemas, tell every rule, and decide what is read."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import jsonschema
import pytest
from clusterdem.errors import InputError
from clusterdem.studies.calibrate.schema import SCHEMA as CALIBRATE
from clusterdem.studies.schema import check
from clusterdem.studies.trade.schema import SCHEMA as TRADE

ROOT = Path(__file__).parents[2]
SCHEMAS = {"trade": TRADE, "calibrate": CALIBRATE}
STUDIES = [
    path for name in SCHEMAS for path in sorted((ROOT / f"inputs/{name}").glob("*.toml")) if "settings" not in path.stem
]
GOOD = {
    "trade": {"input": "in.run", "switches": {"dt": [1e-6, 2e-6]}},
    "calibrate": {
        "case": [{"name": "a", "input": "in.run", "target": [{"quantity": "count", "time": 1, "value": 3}]}],
        "parameter": [{"name": "K", "low": 0, "high": 1}],
    },
}


def tables_of(schema, where=""):
    """Every schema of a value inside a schema, with its place."""
    for name, one in schema.get("properties", {}).items():
        yield f"{where}.{name}", one
        yield from tables_of(one, f"{where}.{name}")
        yield from tables_of(one.get("items", {}), f"{where}.{name}[]")


@pytest.mark.parametrize("name", SCHEMAS)
def test_what_is_printed_is_a_schema_that_says_what_each_key_is_for(name, command):
    code, out, _ = command(name, "--schema")
    printed = json.loads(out)
    assert code == 0 and printed == json.loads(json.dumps(SCHEMAS[name]))
    jsonschema.Draft202012Validator.check_schema(printed)
    places = dict(tables_of(printed))
    assert len(places) > 20
    for place, one in places.items():
        assert one["errorMessage"], place
        if "type" not in one or one["type"] not in ("array", "object"):
            assert one["description"], place


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_shipped_studies_are_right_by_the_schema_alone(path):
    jsonschema.validate(tomllib.loads(path.read_text()), SCHEMAS[path.parent.name])


def test_shipped_studies_are_all_of_them():
    assert len(STUDIES) >= 12


@pytest.mark.parametrize("name", SCHEMAS)
def test_good_ones_pass(name):
    check(Path("s.toml"), GOOD[name], SCHEMAS[name])


def changed(name, place, value):
    """The good study with another value at a place such as ``case.0.name``."""
    table = json.loads(json.dumps(GOOD[name]))
    *steps, last = place.split(".")
    inner = table
    for step in steps:
        inner = inner[int(step)] if step.isdigit() else inner.setdefault(step, {})
    if value is None:
        del inner[last]
    else:
        inner[last] = value
    return table


SEEDS = "must be how many, or a list of positive whole numbers below 2^31 that all differ; fewer than {} show no spread between seeds"


@pytest.mark.parametrize(
    "name, place, value, said",
    [
        ("trade", "sedes", 3, "unknown key 'sedes' (did you mean 'seeds'?): the keys are input, seeds, ranks,"),
        ("trade", "zzz", 3, "unknown key 'zzz': the keys are input"),
        ("trade", "input", None, "input is missing: must be a text"),
        ("trade", "input", "", "input = '': must be a text"),
        ("trade", "seeds", 2, "seeds = 2: " + SEEDS.format(3)),
        ("trade", "seeds", 2.0, "seeds = 2.0: " + SEEDS.format(3)),
        ("trade", "seeds", [1, 2, 2**31], f"seeds = [1, 2, {2**31}]: " + SEEDS.format(3)),
        ("trade", "ranks", 4.0, "ranks = 4.0: must be a whole number, 1 or more"),
        ("trade", "launcher", 4, "launcher = 4: must be a text"),
        ("trade", "plane", "zz", "plane = 'zz': must be two of x, y, z, such as 'xz'"),
        ("trade", "cell", [1.0], "cell = [1.0]: must be the width and height of a map's cell, two positive numbers (m)"),
        ("trade", "cell", [1.0, 0], "cell 2 = 0: must be the width and height of a map's cell, two positive numbers (m)"),
        ("trade", "classes", [], "classes = []: must be a list of borders of size classes (µm)"),
        ("trade", "combine", "all", "combine = 'all': must be 'one at a time' or 'product'"),
        ("trade", "variables.seed", 3, "variables.seed = 3: is set by the study itself (seeds by the key seeds)"),
        ("trade", "variables.a b", 3, "variables.'a b' = 3: a LAMMPS variable's name holds letters, digits"),
        ("trade", "variables.a", " ", "variables.a = ' ': must be a number or one line of text, as after -var"),
        ("trade", "variables.a", "1\n2", "variables.a = '1\\n2': must be a number or one line of text, as after -var"),
        ("trade", "variables.a", True, "variables.a = True: must be a number or one line of text, as after -var"),
        ("trade", "switches.dt", 3, "switches.dt = 3: must be a list of values, the most careful first"),
        ("trade", "switches.inputs", [1, 2], "switches.inputs = [1, 2]: is set by the study itself"),
        ("trade", "observable", [{"name": "a"}], "observable 'a'.value is missing: must be a text"),
        ("trade", "observable", [{"nmae": "a", "value": "1"}], "observable 1: unknown key 'nmae' (did you mean 'name'?)"),
        (
            "trade", "observable", [{"name": "2a", "value": "1"}],
            "observable '2a'.name = '2a': must be a word of letters, digits and underscores that begins with no digit",
        ),
        ("trade", "observable", {"name": "a"}, "observable (name): must be written as [[observable]]"),
        ("trade", "axis", [{"name": "a", "settings": [{"dt": 1}]}], "axis 'a'.settings 1.name is missing: must be a text"),
        (
            "trade", "axis", [{"name": "a", "settings": [{"name": "b", "seed": 1}]}],
            "axis 'a'.settings 'b'.seed = 1: is set by the study itself",
        ),
        ("calibrate", "seeds", 1, "seeds = 1: " + SEEDS.format(2)),
        ("calibrate", "case.0.wieght", 1, "case 'a': unknown key 'wieght' (did you mean 'weight'?): the keys are input, name,"),
        ("calibrate", "case.0.name", None, "case 1 (input, target): needs a name, or published"),
        ("calibrate", "case.0.published", "case9", "case 'a'.published = 'case9': must be among case1, case2, case3"),
        ("calibrate", "case.0.solids", 0, "case 'a'.solids = 0: must be a number above 0"),
        ("calibrate", "case.0.limit", 1.5, "case 'a'.limit = 1.5: must be a whole number, 1 or more"),
        ("calibrate", "case.0.target.0.time", 0, "case 'a'.target 'count'.time = 0: must be a number above 0"),
        ("calibrate", "case.0.target.0.value", None, "case 'a'.target 'count' (quantity, time): needs one of value, below, above"),
        ("calibrate", "case.0.target.0.above", 1, "case 'a'.target 'count' (quantity, time, value, above): needs one of value,"),
        ("calibrate", "case.0.target.0.value", float("nan"), "case 'a'.target 'count'.value = nan: must be a number"),
        ("calibrate", "parameter.0.low", None, "parameter 'K'.low is missing: needs low and high, or choices"),
        ("calibrate", "parameter.0.choices", [1], "parameter 'K' (name, low, high, choices): has either choices, or low, high"),
        ("calibrate", "parameter.0.log", 1, "parameter 'K'.log = 1: must be true or false"),
        ("calibrate", "parameter.0.high", float("inf"), "parameter 'K'.high = inf: must be a number"),
        ("calibrate", "start.A", 3, "start.A = 3: must be a table with a value for every parameter"),
        ("calibrate", "search.population", 3, "search.population = 3: a generation needs 4 points or more, a whole number"),
        ("calibrate", "search.promote", 0, "search.promote = 0: must be a share, above 0 and at most 1"),
        ("calibrate", "local.polish", -1, "local.polish = -1: must be a whole number, 0 or more"),
        ("calibrate", "local.step", 1.5, "local.step = 1.5: must be a share, above 0 and at most 1"),
        ("calibrate", "confirm.best", 0, "confirm.best = 0: must be a whole number, 1 or more"),
        ("calibrate", "confirm.starts", "A", "confirm.starts = 'A': must be a list of starts"),
        ("calibrate", "search", 3, "search = 3: must be a table, written as [search]"),
        ("calibrate", "case", 3, "case = 3: must be written as [[case]]"),
        ("calibrate", "local.trials", 3, "local: unknown key 'trials'"),
    ],
)  # fmt: skip
def test_a_breach_is_told_by_file_key_value_and_rule(name, place, value, said):
    with pytest.raises(InputError) as refused:
        check(Path("dir/s.toml"), changed(name, place, value), SCHEMAS[name])
    assert str(refused.value).startswith(f"dir/s.toml: {said}")


@pytest.mark.parametrize(
    "name, place, value",
    [
        ("trade", "seeds", 3),
        ("trade", "seeds", [5, 1, 2**31 - 1]),
        ("trade", "ranks", 1),
        ("trade", "cell", [1, 1e-9]),
        ("trade", "variables.a_1", "two words"),
        ("trade", "observable", [{"name": "_a1", "value": "mean(vz)", "relative": False, "unit": ""}]),
        ("calibrate", "seeds", 2),
        ("calibrate", "search.population", 4),
        ("calibrate", "search.promote", 1),
        ("calibrate", "local.polish", 0),
        ("calibrate", "case.0.target.0.value", -3),
        ("calibrate", "variables.a", -1.5),
    ],
)
def test_what_lies_on_the_right_side_of_a_rule_passes(name, place, value):
    check(Path("s.toml"), changed(name, place, value), SCHEMAS[name])


@pytest.mark.parametrize(
    "name, text",
    [
        ("trade", 'input = "in.run"\n[switches]\ndt = [1, 2]\n'),
        ("calibrate", '[[case]]\nname = "a"\ninput = "in.run"\n[search.variables]\nheight = 1\n'),
    ],
)
def test_variables_of_the_command_line_are_checked_too(tmp_path, command, name, text):
    (tmp_path / "s.toml").write_text(text)
    code, _, err = command(name, tmp_path / "s.toml", "--var", "seed", "3")
    assert code == 2 and err.count("\n") == 1
    assert "s.toml: variables.seed = '3': is set by the study itself" in err
