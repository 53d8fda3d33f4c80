"""The schema of a calibration's study file."""

from __future__ import annotations

from ...published.cases import CASES
from ..schema import (
    Schema,
    flag,
    number,
    positive,
    rule,
    script,
    seeds,
    share,
    shared,
    study,
    table,
    tables,
    text,
    texts,
    value,
    variables,
    whole,
    word,
)  # fmt: skip

EQUAL, BELOW, ABOVE = "value", "below", "above"
FEWEST_SEEDS = 2
FEWEST_POINTS = 4

_needs_one = rule(
    f"needs one of {EQUAL}, {BELOW}, {ABOVE}", oneOf=[{"required": [kind]} for kind in (EQUAL, BELOW, ABOVE)]
)
_target: Schema = {
    "quantity": text("name of an observable"),
    "time": positive("when it was observed (s)"),
    "part": text("which of its numbers, where it has several"),
    EQUAL: number("what was observed"),
    BELOW: number("a bound: it was below"),
    ABOVE: number("a bound: it was above"),
    "error": positive("its standard deviation: a share of 1, or the observable's unit where that is not relative"),
    "weight": positive("how many observations it counts for (default 1)"),
}
_named = rule("needs a name, or published", anyOf=[{"required": ["name"]}, {"required": ["published"]}])
_case: Schema = {
    "input": script(),
    "name": text("its name in tables"),
    "published": rule(f"must be among {', '.join(CASES)}", "what the paper prints of this case", enum=list(CASES)),
    "weight": positive("how much it counts beside the other cases (default 1)"),
    "solids": positive("mass of solids to which observed numbers of clusters belong (kg)"),
    "limit": whole(1, "core-seconds that a run of it may take, over the stages' own"),
    "variables": variables("LAMMPS variables of its runs"),
    "target": tables("case.target", _target, ["quantity", "time"], allOf=[_needs_one]),
}
_of_a_range: Schema = {"anyOf": [{"required": [key]} for key in ("low", "high", "log")]}
_either: Schema = {
    "if": {"required": ["choices"]},
    "then": {"not": _of_a_range, "errorMessage": "has either choices, or low, high and log"},
    "else": rule("needs low and high, or choices", required=["low", "high"]),
}
_options = "needs one value or more, all different"
_parameter: Schema = {
    "name": word("its name: the variable that it sets, or its place {name} in a variable's value"),
    "low": number("least value"),
    "high": number("largest value"),
    "log": flag("whether equal ratios count as equal steps"),
    "choices": rule(_options, "its values", type="array", items=value(), minItems=1, uniqueItems=True),
}


def _stage(name: str, about: str, properties: Schema) -> Schema:
    common = {
        "variables": variables("LAMMPS variables of its runs, over the study's"),
        "seeds": seeds(FEWEST_SEEDS),
        "limit": whole(1, "core-seconds that a run may take; one that takes longer counts as far off"),
    }
    return table(common | properties, f"must be a table, written as [{name}]") | {"description": about}


_points = f"a generation needs {FEWEST_POINTS} points or more, a whole number"
_point = rule("must be a table with a value for every parameter", type="object", additionalProperties=value())

SCHEMA: Schema = study(
    "clusterdem calibrate: parameters of input scripts fitted to observed numbers",
    {
        **shared(FEWEST_SEEDS),
        "case": tables("case", _case, ["input"], allOf=[_named])
        | {"description": "an input script and what was observed of it"},
        "parameter": tables("parameter", _parameter, ["name"], allOf=[_either])
        | {"description": "what is fitted: a number in a range, or a choice"},
        "start": rule(
            "must be a table, written as [start]", "known points, by name", type="object", additionalProperties=_point
        ),
        "search": _stage(
            "search",
            "the global search",
            {
                "trials": whole(1, "points tried, the starts included"),
                "population": rule(_points, "points of a generation", type="integer", minimum=FEWEST_POINTS),
                "promote": share("share of the trials that go on from the first seed to all"),
            },
        ),
        "local": _stage(
            "local",
            "sensitivities about the best point",
            {
                "step": share("step to either side, as a share of a parameter's range"),
                "polish": whole(0, "Gauss-Newton steps to be tried"),
                "choices": flag("whether other options of the choices are tried, too"),
            },
        ),
        "confirm": _stage(
            "confirm",
            "the best points run again",
            {
                "best": whole(1, "how many of the best"),
                "starts": texts("must be a list of starts", "starts to compare with"),
            },
        ),
    },
)
