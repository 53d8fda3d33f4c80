"""The cheapest setting that is accurate enough, in words and as an input that runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...io.output import write_text
from .observables import OBSERVABLES
from .report import percent, seconds
from .study import Study
from .weigh import Weighed


def in_words(weighed: Sequence[Weighed], best: Weighed, tolerance: float) -> str:
    """One or two sentences."""
    reference = weighed[0]
    head = f"Cheapest within {percent(tolerance)} %: "
    if best is reference:
        return f"{head}the reference itself, {seconds(reference.core_seconds)} core-seconds."
    errors = {name: error for name, error in best.errors.items() if error is not None}
    worst = max(errors, key=lambda name: (errors[name].counted, errors[name].value))
    inside = "inside" if errors[worst].inside else "beyond"
    return (
        f"{head}{best.setting.name}, {seconds(best.core_seconds)} core-seconds instead of "
        f"{seconds(reference.core_seconds)} ({reference.core_seconds / best.core_seconds:.2f} times faster). Its largest "
        f"error: {OBSERVABLES[worst].label} {percent(errors[worst].value)} %, {inside} the spread between seeds of "
        f"{percent(errors[worst].spread)} %."
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
