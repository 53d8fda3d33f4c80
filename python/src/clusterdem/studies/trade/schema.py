"""The schema of a trade's study file."""

from __future__ import annotations

from ..schema import Schema, rule, script, shared, study, tables, text, texts, value, variable_names

ONE_AT_A_TIME, PRODUCT = "one at a time", "product"
FEWEST_SEEDS = 3

_values = rule("must be a list of values, the most careful first", type="array", items=value())
_setting = rule(
    "must be a list of {name = …, VARIABLE = …}; each needs a name",
    type="object",
    properties={"name": text("by which tables call it")},
    required=["name"],
    propertyNames=variable_names(),
    additionalProperties=value(),
)
_edge = rule(
    "must be the width and height of a map's cell, two positive numbers (m)", type="number", exclusiveMinimum=0
)

SCHEMA: Schema = study(
    "clusterdem trade: settings of an input script, error against computing time",
    {
        "input": script(),
        **shared(FEWEST_SEEDS),
        "combine": rule(
            f"must be {ONE_AT_A_TIME!r} or {PRODUCT!r}",
            "one axis is changed at a time (default), or all combinations are run",
            enum=[ONE_AT_A_TIME, PRODUCT],
        ),
        "observables": texts("must be a list of names", "what runs are compared by", minItems=1),
        "cell": rule(
            _edge["errorMessage"],
            "width and height of a map's cell (m; default: a 30th of the box)",
            type="array",
            items=_edge,
            minItems=2,
            maxItems=2,
        ),
        "switches": rule(
            "must be a table NAME = [values], the most careful first",
            "variables with their values, the most careful first",
            type="object",
            propertyNames=variable_names(),
            additionalProperties=_values,
        ),
        "axis": tables(
            "axis",
            {
                "name": text("what is chosen"),
                "settings": rule(_setting["errorMessage"], "the most careful first", type="array", items=_setting),
            },
            ["name", "settings"],
        ),
    },
    required=["input"],
)
