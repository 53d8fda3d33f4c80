"""The study file of a calibration (TOML): cases with what was observed, parameters, and how hard to look."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ...errors import InputError
from ...observables import How, find
from ...published.cases import CLASS_BORDERS, solids_of
from ..file import StudyReader, Variables, load_table
from ..schema import unknown
from .parameters import PLACE, Choice, Parameter, Point, Real
from .schema import ABOVE, BELOW, EQUAL, FEWEST_SEEDS, SCHEMA
from .targets import ERROR, Target, evenly, published_targets


@dataclass(frozen=True)
class Case:
    """One input script and what was observed of it.

    Parameters
    ----------
    path, input : Path
        The study file; the input script.
    name : str
        Its name in tables.
    targets : tuple of Target
        What was observed.
    weight : float
        How much it counts beside the other cases.
    solids : float or None
        Mass of solids to which observed numbers of clusters belong (kg).
    variables : dict of str to str
        Variables of its runs, with places for parameters.
    ranks : int
        MPI ranks of a run.
    limit : int or None
        Core-seconds that a run of it may take, over the stages' own.
    launcher : str or None
        What starts a run (:mod:`clusterdem.studies.launch`).
    seeds : tuple of int
        Seeds of the run to be planned; set run by run.
    """

    path: Path
    input: Path
    name: str
    targets: tuple[Target, ...]
    weight: float
    solids: float | None
    variables: Variables
    ranks: int
    limit: int | None = None
    launcher: str | None = None
    seeds: tuple[int, ...] = ()


@dataclass(frozen=True)
class Stage:
    """How the runs of one stage are made.

    Parameters
    ----------
    variables : dict of str to str
        Over those of the study.
    seeds : tuple of int
        Seeds.
    limit : int or None
        Core-seconds that a run may take.
    """

    variables: Variables
    seeds: tuple[int, ...]
    limit: int | None


@dataclass(frozen=True)
class Search(Stage):
    """The global search.

    Parameters
    ----------
    trials : int
        Points tried, the starts included.
    population : int, optional
        Points of a generation, whose runs can go side by side; by default as CatCMA has it, 4 + 3 ln(parameters).
    promote : float
        Share of the trials that go on from the first seed to all seeds.
    """

    trials: int = 60
    population: int | None = None
    promote: float = 0.3


@dataclass(frozen=True)
class Local(Stage):
    """The neighbourhood of the best point: sensitivities by central differences.

    Parameters
    ----------
    step : float
        Step to either side, as a share of a parameter's range.
    polish : int
        Gauss-Newton steps to be tried.
    choices : bool
        Whether other options of the choices are tried, too.
    """

    step: float = 0.08
    polish: int = 1
    choices: bool = True


@dataclass(frozen=True)
class Confirm(Stage):
    """The best points run again, usually on the whole domain with careful settings."""

    best: int = 1
    starts: tuple[str, ...] = ()


@dataclass(frozen=True)
class Calibration:
    """What a study file says.

    Parameters
    ----------
    path : Path
        The study file.
    cases : tuple of Case
        What is observed.
    parameters : tuple of Parameter
        What is fitted.
    starts : dict of str to Point
        Points to begin with, by name.
    search, local, confirm
        The stages; the last two may be absent.
    how : How
        How observables are measured: size classes, plane.
    """

    path: Path
    cases: tuple[Case, ...]
    parameters: tuple[Parameter, ...]
    starts: dict[str, Point]
    search: Search
    how: How = How()
    local: Local | None = None
    confirm: Confirm | None = None


def read_calibration(
    path: str | Path, variables: Variables | None = None, trials: int | None = None, **over: Any
) -> Calibration:
    """Read and check a study file; the message of a refusal names key, value and rule.

    Parameters
    ----------
    path : str or Path
        The file.
    variables : dict of str to str, optional
        Variables of every run, over those of the file and of its stages.
    trials : int, optional
        Trials of the search, in place of those of the file.
    **over
        Values of the keys ``ranks`` and ``launcher`` in place of the file's.
    """
    path = Path(path)
    study = _Reader(path, load_table(path, SCHEMA, variables, **over)).calibration(variables or {})
    return study if trials is None else replace(study, search=replace(study.search, trials=trials))


class _Reader(StudyReader):
    how: How = How()

    def calibration(self, over: Variables) -> Calibration:
        self.own_observables()
        scripts = [self.input(case) for case in self.table.get("case", [])]
        self.how = How(borders=self.classes(scripts), plane=self.table.get("plane", "xz"))
        parameters = self.parameters()
        cases = self.cases()
        for case in cases:
            self.check_places(case, parameters)
        search, local, confirm = (self.stage(name, over) for name in ("search", "local", "confirm"))
        starts = {
            name: self.point(f"start.{name}", one, parameters) for name, one in self.table.get("start", {}).items()
        }
        return Calibration(
            self.path,
            cases,
            parameters,
            starts,
            Search(*search, **self.own("search", "trials", "population", "promote")),
            self.how,
            Local(*local, **self.own("local", "step", "polish", "choices")) if "local" in self.table else None,
            Confirm(*confirm, **self.confirm(starts)) if "confirm" in self.table else None,
        )

    def own(self, stage: str, *keys: str) -> dict[str, Any]:
        return {key: value for key, value in self.table.get(stage, {}).items() if key in keys}

    def stage(self, name: str, over: Variables) -> tuple[Variables, tuple[int, ...], int | None]:
        given = self.table.get(name, {})
        fallback = self.table.get("search", {}).get("variables", {}) if name == "local" else {}
        variables = self.variables(given.get("variables", fallback))
        seeds = given.get("seeds", self.table.get("seeds", FEWEST_SEEDS))
        return variables | over, self.seeds(seeds), given.get("limit")

    def confirm(self, starts: Mapping[str, Point]) -> dict[str, Any]:
        found = self.own("confirm", "best")
        names = self.table["confirm"].get("starts", [])
        if not set(names) <= set(starts):
            rule = f"must be a list of starts ({', '.join(starts) or 'there are none'})"
            raise self.refuse("confirm.starts", names, rule)
        return found | {"starts": tuple(names)}

    def parameters(self) -> tuple[Parameter, ...]:
        found: list[Parameter] = []
        for table in self.table.get("parameter", []):
            name = table["name"]
            if name in [one.name for one in found]:
                raise self.refuse("parameter.name", name, "stands there twice")
            found.append(self.choice(name, table["choices"]) if "choices" in table else self.real(name, table))
        if not found:
            raise InputError(self.path, "no parameter: [[parameter]] must name what is fitted")
        return tuple(found)

    def choice(self, name: str, given: list[Any]) -> Choice:
        options = tuple(str(value) for value in given)
        if len(set(options)) < len(options):
            raise self.refuse(f"parameter {name!r}.choices", given, "must all differ")
        return Choice(name, options)

    def real(self, name: str, table: dict[str, Any]) -> Real:
        low, high, log = float(table["low"]), float(table["high"]), table.get("log", False)
        where = f"parameter {name!r}."
        if not low < high:
            raise self.refuse(f"{where}low, high", [low, high], "low must be below high")
        if log and low <= 0:
            raise self.refuse(f"{where}low", low, "must be above 0 where log = true")
        return Real(name, low, high, log)

    def cases(self) -> tuple[Case, ...]:
        found: list[Case] = []
        common = self.variables(self.table.get("variables", {}))
        ranks, launcher = self.table.get("ranks", 1), self.launcher()
        for table in self.table.get("case", []):
            name = table.get("name", table.get("published"))
            if name in [case.name for case in found]:
                raise self.refuse("case.name", name, "stands there twice")
            where = f"case {name!r}"
            variables = common | self.variables(table.get("variables", {}))
            solids = self.solids(table)
            targets = tuple(self.targets(where, table))
            if solids is None and any(target.quantity == "clusters" for target in targets):
                rule = (
                    "a number of clusters belongs to a mass of solids: solids = kg, so that parts of a domain compare"
                )
                raise InputError(self.path, f"{where}: {rule}")
            weight, limit = float(table.get("weight", 1.0)), table.get("limit")
            script = self.input(table)
            found.append(Case(self.path, script, name, targets, weight, solids, variables, ranks, limit, launcher))
        if not found:
            raise InputError(self.path, "no case: [[case]] must name an input and what was observed of it")
        return tuple(found)

    def solids(self, table: dict[str, Any]) -> float | None:
        if "solids" in table:
            return float(table["solids"])
        return solids_of(table["published"]) if "published" in table else None

    def targets(self, where: str, table: dict[str, Any]) -> list[Target]:
        found: list[Target] = []
        if "published" in table:
            published = table["published"]
            if self.how.borders != CLASS_BORDERS:
                rule = f"published = {published!r} has the paper's own"
                raise self.refuse("classes", [1e6 * border for border in self.how.borders], rule)
            found += published_targets(published)
        found += evenly([self.target(where, one) for one in table.get("target", [])])
        if not found:
            raise InputError(self.path, f"{where}: nothing observed: published = NAME, or [[case.target]]")
        return found

    def target(self, where: str, table: dict[str, Any]) -> Target:
        name = self.observable(f"{where}.target.quantity", table["quantity"])
        given = f"{where}.target {name!r}"
        quantity = find(name)
        parts = quantity.parts(self.how)
        kind = next(kind for kind in (EQUAL, BELOW, ABOVE) if kind in table)
        part, value = table.get("part"), table[kind]
        if name in ("size_classes", "mass_classes") and not self.how.borders:
            raise self.refuse(
                "classes", None, f"must name the borders of the size classes (µm), of which {name} has a target"
            )
        if parts and part not in parts:
            raise self.refuse(f"{given}.part", part, f"must be among {', '.join(parts)}")
        if not parts and part is not None:
            raise self.refuse(f"{given}.part", part, f"{name} is a single number")
        if quantity.relative and value <= 0:
            raise self.refuse(f"{given}.{kind}", value, "must be above 0, as ratios count")
        return Target(
            name,
            float(table["time"]),
            parts.index(part) if parts else 0,
            float(value),
            kind,
            float(table.get("error", ERROR[quantity.relative])),
            float(table.get("weight", 1.0)),
            part or "",
        )

    def check_places(self, case: Case, parameters: tuple[Parameter, ...]) -> None:
        names = [parameter.name for parameter in parameters]
        for variable, text in case.variables.items():
            for place in PLACE.findall(text):
                if place not in names:
                    raise self.refuse(f"variables.{variable}", text, f"{{{place}}} is no parameter")

    def point(self, where: str, given: dict[str, Any], parameters: tuple[Parameter, ...]) -> Point:
        names = [parameter.name for parameter in parameters]
        for name in given:
            if name not in names:
                raise InputError(self.path, f"{where}: {unknown('parameter', name, names)}")
        point: Point = {}
        for parameter in parameters:
            key, value = f"{where}.{parameter.name}", given.get(parameter.name)
            if value is None:
                raise self.refuse(key, value, "must have a value for every parameter")
            if isinstance(parameter, Choice):
                if str(value) not in parameter.options:
                    raise self.refuse(key, value, f"must be among {', '.join(parameter.options)}")
                point[parameter.name] = str(value)
                continue
            if isinstance(value, str):
                raise self.refuse(key, value, "must be a number")
            if not parameter.low <= value <= parameter.high:
                raise self.refuse(key, value, f"must lie between {parameter.low:g} and {parameter.high:g}")
            point[parameter.name] = parameter.rounded(float(value))
        return point
