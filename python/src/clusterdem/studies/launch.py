"""What starts a run on several ranks or through a queue: words that stand before the engine's own."""

from __future__ import annotations

import os
import re
import shlex
from pathlib import Path
from string import Formatter

from ..errors import ArgumentError
from .schema import unknown

SEVERAL_RANKS = "mpirun -np {np}"
"""The launcher of runs on more than one rank, where none is given; one rank needs none."""

PLACES = ("np", "name", "folder")
"""Replaced in a launcher: the ranks, the run's name (as its folder's), the folder in which it runs."""

DECIDES = re.compile(r"OMP_|OMPI_|LAMMPS_|LD_")
"""How variables of the environment begin that decide how an engine runs."""


def check_launcher(template: str) -> None:
    """Refuse a launcher that is no command, or has places that nothing fills.

    Raises
    ------
    ArgumentError
        With the rule.
    """
    try:
        words = shlex.split(template)
        fields = [field for word in words for _, field, form, kind in Formatter().parse(word) if field is not None]
    except ValueError as error:
        raise ArgumentError("launcher", f"is no command ({str(error).lower()}); a brace is written {{{{") from None
    if not words:
        raise ArgumentError("launcher", "must name a command, such as 'srun -n {np}'")
    for field in fields:
        if field not in PLACES:
            raise ArgumentError("launcher", unknown("place", field, PLACES))


def launch(template: str | None, ranks: int, folder: Path) -> tuple[str, ...]:
    """The words that start a run in a folder; none for one rank without a launcher."""
    if template is None:
        template = SEVERAL_RANKS if ranks > 1 else ""
    filled = {"np": ranks, "name": folder.stem, "folder": folder}
    return tuple(word.format(**filled) for word in shlex.split(template))


def environment() -> dict[str, str]:
    """What of the environment decides how an engine runs, by name."""
    return {name: value for name, value in sorted(os.environ.items()) if DECIDES.match(name)}


def pasted(command: tuple[str, ...], folder: Path) -> str:
    """A line for a shell that does what a study does: the folder, the environment, the command, where output goes."""
    there = shlex.quote(str(folder))
    given = [f"{name}={shlex.quote(value)}" for name, value in environment().items()]
    words = " ".join([*(["env", *given] if given else []), shlex.join(command)])
    return f"(mkdir -p {there} && cd {there} && {words} </dev/null >screen.txt 2>&1)"
