"""The settings that a study compares: axes changed one at a time, or every combination."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

from ...errors import InputError
from ..runs import Setting
from .study import Axis, Study

REFERENCE = "reference"
MOST = 10_000
"""Most settings of a study; a product of axes grows fast."""


def _merge(study: Study, chosen: Sequence[int]) -> Setting:
    variables = dict(study.variables)
    changed: list[tuple[Axis, int]] = []
    for axis, index in zip(study.axes, chosen):
        variables |= axis.options[index].variables
        if index:
            changed.append((axis, index))
    if not changed:
        return Setting(REFERENCE, ", ".join(axis.options[0].name for axis in study.axes), variables)
    axes = " + ".join(axis.name for axis, _ in changed)
    return Setting(axes, ", ".join(axis.options[index].name for axis, index in changed), variables)


def settings_of(study: Study) -> list[Setting]:
    """All settings of a study, the most careful one (the reference) first."""
    sizes = [len(axis.options) for axis in study.axes]
    count = math.prod(sizes) if study.product else 1 + sum(size - 1 for size in sizes)
    if count > MOST:
        raise InputError(study.path, f"{count:,} settings are more than {MOST:,}: leave out axes or settings")
    if study.product:
        return [_merge(study, chosen) for chosen in itertools.product(*map(range, sizes))]
    still = [0] * len(sizes)
    settings = [_merge(study, still)]
    for axis, size in enumerate(sizes):
        for index in range(1, size):
            settings.append(_merge(study, [*still[:axis], index, *still[axis + 1 :]]))
    return settings


def together(study: Study, chosen: Sequence[Setting]) -> Setting:
    """One setting that leaves the reference on every axis on which one of the chosen does."""
    indices = [0] * len(study.axes)
    for number, axis in enumerate(study.axes):
        for setting in chosen:
            if setting.axis == axis.name:
                indices[number] = [option.name for option in axis.options].index(setting.name)
    return _merge(study, indices)
