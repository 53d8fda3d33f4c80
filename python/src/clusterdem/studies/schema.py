"""Study files as a JSON schema (2020-12): what every key means, and the rule by which it is checked.

``description`` tells what a key is for, ``errorMessage`` (as editors read it) the rule that its value must keep. Both
studies share the keys of :func:`shared`; their own stand in ``trade/schema.py`` and ``calibrate/schema.py``.
"""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator, ValidationError
from jsonschema.validators import extend

from ..errors import InputError

Schema = dict[str, Any]

OWN_VARIABLES = ("seed", "inputs", "outdir")
"""Variables that the study itself sets for every run."""

WORD = r"^[A-Za-z_][A-Za-z0-9_]*$"


def rule(message: str, description: str = "", **keywords: Any) -> Schema:
    """A schema with the rule that its errors tell."""
    return {**({"description": description} if description else {}), **keywords, "errorMessage": message}


def table(properties: Schema, message: str, required: Iterable[str] = (), **keywords: Any) -> Schema:
    """A table with these keys and no others."""
    keys: Schema = {"properties": properties, "required": list(required), "additionalProperties": False}
    return rule(message, type="object", **keys, **keywords)


def tables(name: str, properties: Schema, required: Iterable[str] = (), **keywords: Any) -> Schema:
    """Tables written as [[name]], each with these keys and no others."""
    message = f"must be written as [[{name}]]"
    return rule(message, type="array", items=table(properties, message, required, **keywords))


def text(description: str = "") -> Schema:
    """A text that is not empty."""
    return rule("must be a text", description, type="string", minLength=1)


def word(description: str = "") -> Schema:
    """A name."""
    message = "must be a word of letters, digits and underscores that begins with no digit"
    return rule(message, description, type="string", pattern=WORD)


def number(description: str = "") -> Schema:
    """A finite number."""
    return rule("must be a number", description, type="number")


def positive(description: str = "") -> Schema:
    """A number above zero."""
    return rule("must be a number above 0", description, type="number", exclusiveMinimum=0)


def share(description: str = "") -> Schema:
    """A number above zero, at most one."""
    message = "must be a share, above 0 and at most 1"
    return rule(message, description, type="number", exclusiveMinimum=0, maximum=1)


def whole(fewest: int, description: str = "") -> Schema:
    """A whole number."""
    return rule(f"must be a whole number, {fewest} or more", description, type="integer", minimum=fewest)


def flag(description: str = "") -> Schema:
    """Yes or no."""
    return rule("must be true or false", description, type="boolean")


def texts(message: str, description: str = "", **keywords: Any) -> Schema:
    """A list of texts."""
    return rule(message, description, type="array", items=rule(message, type="string"), **keywords)


def value() -> Schema:
    """What may stand after -var NAME."""
    one_line: Schema = {"pattern": r"\S", "not": {"type": "string", "pattern": "\n"}}
    return rule("must be a number or one line of text, as after -var", type=["number", "string"], **one_line)


def variable_names() -> Schema:
    """Names of LAMMPS variables, but those that the study sets."""
    letters = rule("a LAMMPS variable's name holds letters, digits and underscores only", pattern="^[A-Za-z0-9_]+$")
    own: Schema = {"not": {"enum": list(OWN_VARIABLES)}}
    return {"allOf": [letters, rule("is set by the study itself (seeds by the key seeds)", **own)]}


def variables(description: str) -> Schema:
    """A table of LAMMPS variables."""
    names = {"propertyNames": variable_names(), "additionalProperties": value()}
    return rule("must be a table of variables NAME = VALUE", description, type="object", **names)


def script() -> Schema:
    """The LAMMPS input script."""
    return text("the LAMMPS input script, relative to the study file; it needs a variable seed")


def seeds(fewest: int) -> Schema:
    """How many, or which."""
    one = {"type": "integer", "minimum": 1, "exclusiveMaximum": 2**31}
    several = {"type": "array", "items": one, "minItems": fewest, "uniqueItems": True}
    message = (
        f"must be how many, or a list of positive whole numbers below 2^31 that all differ; fewer than {fewest} show no "
        "spread between seeds"
    )
    how_many = {"type": "integer", "minimum": fewest, "exclusiveMaximum": 10**6}
    return rule(message, "seeds of every setting: how many (1, 2, …), or which", anyOf=[how_many, several])


def shared(fewest_seeds: int) -> Schema:
    """The keys that every study has."""
    borders = rule("must be a list of borders of size classes (µm)", type="number")
    return {
        "seeds": seeds(fewest_seeds),
        "ranks": whole(1, "MPI ranks of a run (default 1)"),
        "launcher": text(
            "what starts a run, such as 'srun -n {np}'; {np} is replaced by the ranks, {name} by the run's name, {folder} "
            "by its folder (default 'mpirun -np {np}' where ranks are more than 1)"
        ),
        "variables": variables("LAMMPS variables of every run, each given as -var NAME VALUE"),
        "observable": tables(
            "observable",
            {
                "name": word("by which the study calls it"),
                "value": text(
                    "an expression of columns of the dump and, as run.NAME, of the run's table or thermo output, such "
                    "as 'mean(sqrt(vx**2 + vz**2))'"
                ),
                "label": text("its name in tables and figures (default: the name)"),
                "unit": rule("must be a text", "the unit of its numbers (default: none)", type="string"),
                "relative": flag("whether ratios count between two values (default), or differences"),
            },
            ["name", "value"],
        ),
        "observables_file": text("a Python file that registers observables, relative to the study file"),
        "classes": rule(
            borders["errorMessage"], "borders of the size classes (µm)", type="array", items=borders, minItems=1
        ),
        "plane": rule(
            "must be two of x, y, z, such as 'xz'",
            "the plane of maps and profiles (default xz)",
            enum=[a + b for a in "xyz" for b in "xyz" if a != b],
        ),
    }


def study(title: str, properties: Schema, **keywords: Any) -> Schema:
    """The schema of a whole study file."""
    head = {"$schema": Draft202012Validator.META_SCHEMA["$id"], "title": title}
    return head | table(properties, "must be a study file", **keywords)


def _is_number(checker: object, given: object) -> bool:
    return isinstance(given, (int, float)) and not isinstance(given, bool) and math.isfinite(given)


CHECKER = extend(  # no NaN and no infinity, which TOML knows; 4.0 is no whole number
    Draft202012Validator,
    type_checker=Draft202012Validator.TYPE_CHECKER.redefine_many(
        {"number": _is_number, "integer": lambda checker, given: type(given) is int}
    ),
)


def check(path: Path, given: Schema, schema: Schema) -> None:
    """Check the table of a study file.

    Raises
    ------
    InputError
        For the first breach: file, key, value and rule; for a typo also the nearest key.
    """
    errors = list(CHECKER(schema).iter_errors(given))
    if errors:  # a misspelt key is told before the one that it was meant for is missed
        first = next((error for error in errors if error.validator == "additionalProperties"), errors[0])
        raise InputError(path, _told(given, first))


def _told(given: Schema, error: ValidationError) -> str:
    where, inside = _place(given, error.absolute_path), error.instance
    if error.validator == "additionalProperties":
        known = list(error.schema["properties"])
        name = next(name for name in inside if name not in known)
        return f"{where + ': ' if where else ''}{unknown('key', name, known)}"
    message = error.schema.get("errorMessage", error.message)
    if error.validator == "required":
        name = next(name for name in error.validator_value if name not in inside)
        message = error.schema.get("properties", {}).get(name, {}).get("errorMessage", message)
        return f"{_joined(where, name)} is missing: {message}"
    if "propertyNames" in error.absolute_schema_path:
        parent: Any = given
        for step in error.absolute_path:
            parent = parent[step]
        return f"{_joined(where, inside)} = {parent[inside]!r}: {message}"
    if isinstance(inside, dict):
        return f"{where} ({', '.join(inside)}): {message}"
    return f"{where} = {inside!r}: {message}"


def _joined(where: str, name: str) -> str:
    name = name if re.fullmatch(r"[\w-]+", name) else repr(name)
    return f"{where}.{name}" if where else name


def _place(given: Any, path: Iterable[str | int]) -> str:
    """A place in a study file: keys with dots; one of several tables by its name, else by its number from 1."""
    where = ""
    for step in path:
        given = given[step]
        if isinstance(step, str):
            where = _joined(where, step)
            continue
        names = [given.get(key) for key in ("name", "quantity", "published")] if isinstance(given, dict) else []
        where += next((f" {name!r}" for name in names if isinstance(name, str)), f" {step + 1}")
    return where


def unknown(what: str, name: object, known: Iterable[str]) -> str:
    """That there is no such word, which is nearest, and which there are."""
    words = list(known)
    near = difflib.get_close_matches(str(name), words, 1)
    meant = f" (did you mean {near[0]!r}?)" if near else ""
    return f"unknown {what} {name!r}{meant}: the {what}s are {', '.join(words)}"
