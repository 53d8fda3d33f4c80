"""The study file of a calibration (TOML): cases with what was observed, parameters, and how hard to look."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ...errors import InputError
from ...observables import REGISTRY, How, find
from ...published.cases import CASES, CLASS_BORDERS, solids_of
from ..file import StudyReader, Variables, load_table
from .parameters import PLACE, Choice, Parameter, Point, Real
from .targets import ABOVE, BELOW, EQUAL, ERROR, Target, evenly, published_targets

KEYS = (
    "variables", "seeds", "ranks", "classes", "plane", "observables_file", "parameter", "case", "start", "search", "local", "confirm",
)  # fmt: skip
CASE_KEYS = ("name", "input", "published", "weight", "solids", "limit", "variables", "target")
TARGET_KEYS = ("quantity", "time", "part", EQUAL, BELOW, ABOVE, "error", "weight")
PARAMETER_KEYS = ("name", "low", "high", "log", "choices")
STAGE_KEYS = ("variables", "seeds", "limit")
FEWEST_SEEDS = 2
FEWEST_POINTS = 4


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


def read_calibration(path: str | Path, variables: Variables | None = None, trials: int | None = None) -> Calibration:
    """Read and check a study file; the message of a refusal names key, value and rule.

    Parameters
    ----------
    path : str or Path
        The file.
    variables : dict of str to str, optional
        Variables of every run, over those of the file and of its stages.
    trials : int, optional
        Trials of the search, in place of those of the file.
    """
    path = Path(path)
    study = _Reader(path, load_table(path)).calibration(variables or {})
    return study if trials is None else replace(study, search=replace(study.search, trials=trials))


class _Reader(StudyReader):
    how: How = How()

    def calibration(self, over: Variables) -> Calibration:
        self.only(KEYS, self.table)
        self.own_observables(self.table)
        scripts = [self.input(case) for case in self.tables("case", self.table)]
        self.how = How(borders=self.classes(self.table, scripts), plane=self.plane(self.table))
        parameters = self.parameters()
        ranks = self.count("ranks", self.table.get("ranks", 1))
        common = self.variables("variables", self.table.get("variables", {}))
        cases = self.cases(common, ranks)
        for case in cases:
            self.check_places(case, parameters)
        search, local, confirm = (self.stage(name, over) for name in ("search", "local", "confirm"))
        given = self.subtable("search")
        starts = {
            name: self.point(f"start.{name}", point, parameters) for name, point in self.subtable("start").items()
        }
        found = Search(
            search.variables,
            search.seeds,
            search.limit,
            self.count("search.trials", given.get("trials", Search.trials)),
            self.population(given.get("population")),
            self.share("search.promote", given.get("promote", Search.promote)),
        )
        return Calibration(
            self.path,
            cases,
            parameters,
            starts,
            found,
            self.how,
            self.local(local) if "local" in self.table else None,
            self.confirm(confirm, starts) if "confirm" in self.table else None,
        )

    def subtable(self, name: str) -> dict[str, Any]:
        given = self.table.get(name, {})
        if not isinstance(given, dict):
            raise self.refuse(name, given, f"must be a table, written as [{name}]")
        return given

    def tables(self, name: str, table: dict[str, Any], where: str = "") -> list[dict[str, Any]]:
        given = table.get(name, [])
        if not isinstance(given, list) or not all(isinstance(one, dict) for one in given):
            raise self.refuse(where + name, given, f"must be written as [[{where}{name}]]")
        return given

    def number(self, key: str, given: object, above: float | None = None) -> float:
        if isinstance(given, bool) or not isinstance(given, (int, float)) or abs(float(given)) == float("inf"):
            raise self.refuse(key, given, "must be a number")
        if float(given) != float(given) or (above is not None and not given > above):
            raise self.refuse(
                key, given, f"must be a number above {above:g}" if above is not None else "must be a number"
            )
        return float(given)

    def share(self, key: str, given: object) -> float:
        value = self.number(key, given, above=0)
        if value > 1:
            raise self.refuse(key, given, "must be a share, above 0 and at most 1")
        return value

    def parameters(self) -> tuple[Parameter, ...]:
        found: list[Parameter] = []
        for table in self.tables("parameter", self.table):
            name = table.get("name")
            if not isinstance(name, str) or not name.isidentifier():
                raise self.refuse("parameter.name", name, "must be a word of letters, digits and underscores")
            where = f"parameter {name!r}"
            self.only(PARAMETER_KEYS, table, f"{where}: ")
            if name in [one.name for one in found]:
                raise self.refuse("parameter.name", name, "stands there twice")
            found.append(self.choice(where, name, table) if "choices" in table else self.real(where, name, table))
        if not found:
            raise InputError(self.path, "no parameter: [[parameter]] must name what is fitted")
        return tuple(found)

    def choice(self, where: str, name: str, table: dict[str, Any]) -> Choice:
        given = table["choices"]
        if not isinstance(given, list):
            raise self.refuse(f"{where} choices", given, "must be a list of values")
        options = tuple(self.value(where, name, value) for value in given)
        if not options or len(set(options)) < len(options):
            raise self.refuse(f"{where} choices", given, "needs one value or more, all different")
        if extra := sorted(set(table) - {"name", "choices"}):
            raise self.refuse(where, extra, "a parameter has either choices, or low, high and log")
        return Choice(name, options)

    def real(self, where: str, name: str, table: dict[str, Any]) -> Real:
        low, high = (self.number(f"{where} {key}", table.get(key)) for key in ("low", "high"))
        log = table.get("log", False)
        if not isinstance(log, bool):
            raise self.refuse(f"{where} log", log, "must be true or false")
        if not low < high:
            raise self.refuse(f"{where} low, high", [low, high], "low must be below high")
        if log and low <= 0:
            raise self.refuse(f"{where} low", low, "must be above 0 where log = true")
        return Real(name, low, high, log)

    def cases(self, common: Variables, ranks: int) -> tuple[Case, ...]:
        found: list[Case] = []
        for table in self.tables("case", self.table):
            name = table.get("name", table.get("published"))
            if not isinstance(name, str) or not name:
                raise self.refuse("case.name", name, "must be a text")
            if name in [case.name for case in found]:
                raise self.refuse("case.name", name, "stands there twice")
            where = f"case {name!r}: "
            self.only(CASE_KEYS, table, where)
            variables = common | self.variables(f"{where}variables", table.get("variables", {}))
            solids = self.solids(where, table)
            targets = tuple(self.targets(where, table))
            if solids is None and any(target.quantity == "clusters" for target in targets):
                rule = (
                    "a number of clusters belongs to a mass of solids: solids = kg, so that parts of a domain compare"
                )
                raise InputError(self.path, f"{where}{rule}")
            weight = self.number(f"{where}weight", table.get("weight", 1.0), above=0)
            limit = table.get("limit")
            limit = None if limit is None else self.count(f"{where}limit", limit)
            found.append(Case(self.path, self.input(table), name, targets, weight, solids, variables, ranks, limit))
        if not found:
            raise InputError(self.path, "no case: [[case]] must name an input and what was observed of it")
        return tuple(found)

    def solids(self, where: str, table: dict[str, Any]) -> float | None:
        if "solids" in table:
            return self.number(f"{where}solids", table["solids"], above=0)
        published = table.get("published")
        return solids_of(published) if published in CASES else None

    def targets(self, where: str, table: dict[str, Any]) -> list[Target]:
        found: list[Target] = []
        if "published" in table:
            published = table["published"]
            if published not in CASES:
                raise self.refuse(f"{where}published", published, f"must be among {', '.join(CASES)}")
            if self.how.borders != CLASS_BORDERS:
                rule = f"published = {published!r} has the paper's own"
                raise self.refuse("classes", [1e6 * border for border in self.how.borders], rule)
            found += published_targets(published)
        own = [self.target(where, one) for one in self.tables("target", table, "case.")]
        found += evenly(own)
        if not found:
            raise InputError(self.path, f"{where}nothing observed: published = NAME, or [[case.target]]")
        return found

    def target(self, where: str, table: dict[str, Any]) -> Target:
        self.only(TARGET_KEYS, table, f"{where}target: ")
        name = table.get("quantity")
        if not isinstance(name, str) or name not in REGISTRY:
            raise self.refuse(f"{where}target.quantity", name, f"must be among {', '.join(REGISTRY)}")
        quantity = find(name)
        parts = quantity.parts(self.how)
        kinds = [kind for kind in (EQUAL, BELOW, ABOVE) if kind in table]
        if len(kinds) != 1:
            raise self.refuse(f"{where}target", kinds, "needs one of value, below, above")
        part = table.get("part")
        if name in ("size_classes", "mass_classes") and not self.how.borders:
            raise self.refuse(
                "classes", None, f"must name the borders of the size classes (µm), of which {name} has a target"
            )
        if parts and part not in parts:
            raise self.refuse(f"{where}target.part", part, f"must be among {', '.join(parts)}")
        if not parts and part is not None:
            raise self.refuse(f"{where}target.part", part, f"{name} is a single number")
        given = f"{where}target"
        value = self.number(f"{given}.{kinds[0]}", table[kinds[0]], above=0 if quantity.relative else None)
        return Target(
            name,
            self.number(f"{given}.time", table.get("time"), above=0),
            parts.index(part) if parts else 0,
            value,
            kinds[0],
            self.number(f"{given}.error", table.get("error", ERROR[quantity.relative]), above=0),
            self.number(f"{given}.weight", table.get("weight", 1.0), above=0),
            part or "",
        )

    def check_places(self, case: Case, parameters: tuple[Parameter, ...]) -> None:
        names = [parameter.name for parameter in parameters]
        for variable, text in case.variables.items():
            for place in PLACE.findall(text):
                if place not in names:
                    raise self.refuse(f"variables.{variable}", text, f"{{{place}}} is no parameter")

    def point(self, where: str, given: object, parameters: tuple[Parameter, ...]) -> Point:
        if not isinstance(given, dict):
            raise self.refuse(where, given, "must be a table with a value for every parameter")
        self.only(tuple(parameter.name for parameter in parameters), given, f"{where}: ")
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
            number = self.number(key, value)
            if not parameter.low <= number <= parameter.high:
                raise self.refuse(key, value, f"must lie between {parameter.low:g} and {parameter.high:g}")
            point[parameter.name] = parameter.rounded(number)
        return point

    def stage(self, name: str, over: Variables) -> Stage:
        given = self.subtable(name)
        keys = {
            "search": (*STAGE_KEYS, "trials", "population", "promote"),
            "local": (*STAGE_KEYS, "step", "polish", "choices"),
            "confirm": (*STAGE_KEYS, "best", "starts"),
        }[name]
        self.only(keys, given, f"{name}: ")
        fallback = self.subtable("search").get("variables", {}) if name == "local" else {}
        variables = self.variables(f"{name}.variables", given.get("variables", fallback))
        seeds = given.get("seeds", self.table.get("seeds", FEWEST_SEEDS))
        limit = given.get("limit")
        return Stage(
            variables | over,
            self.seeds(seeds, FEWEST_SEEDS, f"{name}.seeds"),
            None if limit is None else self.count(f"{name}.limit", limit),
        )

    def population(self, given: object) -> int | None:
        if given is not None and self.count("search.population", given) < FEWEST_POINTS:
            raise self.refuse("search.population", given, f"a generation needs {FEWEST_POINTS} points or more")
        return None if given is None else self.count("search.population", given)

    def local(self, stage: Stage) -> Local:
        given = self.subtable("local")
        polish = given.get("polish", Local.polish)
        if type(polish) is not int or polish < 0:
            raise self.refuse("local.polish", polish, "must be a whole number, 0 or more")
        step = self.share("local.step", given.get("step", Local.step))
        choices = given.get("choices", Local.choices)
        if not isinstance(choices, bool):
            raise self.refuse("local.choices", choices, "must be true or false")
        return Local(stage.variables, stage.seeds, stage.limit, step, polish, choices)

    def confirm(self, stage: Stage, starts: Mapping[str, Point]) -> Confirm:
        given = self.subtable("confirm")
        names = given.get("starts", [])
        if not isinstance(names, list) or not all(isinstance(name, str) and name in starts for name in names):
            raise self.refuse(
                "confirm.starts", names, f"must be a list of starts ({', '.join(starts) or 'there are none'})"
            )
        best = self.count("confirm.best", given.get("best", Confirm.best))
        return Confirm(stage.variables, stage.seeds, stage.limit, best, tuple(names))
