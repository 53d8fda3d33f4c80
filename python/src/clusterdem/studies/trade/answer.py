"""The cheapest setting that is accurate enough, in words and as an input that runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...io.output import write_text
from ...observables import find
from .errors import CONFIDENCE
from .report import percent, seconds
from .study import Study
from .weigh import Weighed, untold


def in_words(weighed: Sequence[Weighed], best: Weighed, tolerance: float) -> str:
    """Some sentences: the answer, and what cannot be told."""
    return " ".join([*_not_told(weighed, best, tolerance), _answer(weighed[0], best, tolerance)])


def _not_told(weighed: Sequence[Weighed], best: Weighed, tolerance: float) -> list[str]:
    """Cheaper settings that might be within the tolerance, each with the error that leaves it open."""
    found = []
    for w in untold(weighed, best, tolerance):
        worst = max(
            (e.value + CONFIDENCE * e.uncertainty, name)
            for name, e in w.errors.items()
            if e is not None and e.within(tolerance) is None
        )[1]
        error = w.errors[worst]
        assert error is not None
        found.append(
            f"{w.setting.name} ({find(worst).label} {percent(error.value)} ± {percent(error.uncertainty)} %, "
            f"{seconds(w.core_seconds)} core-seconds)"
        )
    return (
        [f"Cannot be told within {percent(tolerance)} %, more seeds are needed: {'; '.join(found)}."] if found else []
    )


def _answer(reference: Weighed, best: Weighed, tolerance: float) -> str:
    head = f"Cheapest within {percent(tolerance)} %: "
    if best is reference:
        return f"{head}the reference itself, {seconds(reference.core_seconds)} core-seconds."
    errors = {name: error for name, error in best.errors.items() if error is not None}
    worst = max(errors, key=lambda name: errors[name].value + CONFIDENCE * errors[name].uncertainty)
    return (
        f"{head}{best.setting.name}, {seconds(best.core_seconds)} core-seconds instead of "
        f"{seconds(reference.core_seconds)} ({reference.core_seconds / best.core_seconds:.2f} times faster). Its largest "
        f"error: {find(worst).label} {percent(errors[worst].value)} ± {percent(errors[worst].uncertainty)} %; single seeds "
        f"differ by {percent(errors[worst].spread)} %."
    )


def as_input(study: Study, best: Weighed, words: str) -> str:
    """An input script that sets the variables and includes the study's script; -var still overrides it."""

    def define(name: str, value: str) -> str:
        quoted = f'"{value}"' if " " in value else value
        return f"variable {name:<8} index {quoted}"

    inputs = str(study.input.parent)
    lines = [f"# {study.path.name}: {study.input.name} at the setting named below; by clusterdem trade."]
    lines += [f"# {sentence}" for sentence in words.replace(". ", ".\n").splitlines()]
    lines += [define(name, value) for name, value in best.setting.variables.items()]
    lines += [define("inputs", inputs), f"include  ${{inputs}}/{study.input.name}"]
    return "\n".join(lines) + "\n"


def write_answer(path: Path, study: Study, best: Weighed, words: str) -> Path:
    """Write the input script."""
    return write_text(path, as_input(study, best, words))
