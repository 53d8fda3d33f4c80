"""What an input script reads: itself, its includes, its data files; and which variables it knows."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from glob import glob
from pathlib import Path

from ..errors import InputError
from .file import Variables

REFERENCE = re.compile(r"\$\{(\w+)\}|\bv_(\w+)|\$(\w)")
DEFINITION = re.compile(r"\s*variable\s+(\w+)\s+(index|string)\s+[\"']*([^\"'\s]*)")


@dataclass
class Script:
    """An input script with the variables of a run filled in.

    Parameters
    ----------
    files : list of Path
        Every file that it names and that exists, itself first; of a pattern such as gas.*.vtk all that match.
    names : set of str
        Variables that any line refers to or defines.
    """

    files: list[Path] = field(default_factory=list)
    names: set[str] = field(default_factory=set)


def _commands(path: Path) -> list[tuple[int, str]]:
    """Lines with their numbers, ``&`` joined, comments cut."""
    commands, begun, text = [], 0, ""
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
        begun = begun or number
        line = line.split("#", 1)[0].rstrip()
        if line.endswith("&"):
            text += line[:-1] + " "
            continue
        commands.append((begun, text + line))
        begun, text = 0, ""
    return [*commands, (begun, text)] if text else commands


def _filled(text: str, known: Variables) -> str:
    for _ in range(10):  # values may hold variables; ten levels deep is deeper than any script
        after = re.sub(r"\$\{(\w+)\}", lambda name: known.get(name[1], name[0]), text)
        if after == text:
            break
        text = after
    return text


def read_script(path: Path, given: Variables) -> Script:
    """Follow a script and its includes.

    Parameters
    ----------
    path : Path
        The script.
    given : dict of str to str
        Variables of the command line; as in LAMMPS they win over the script's own index variables.
    """
    script = Script()
    _follow(path, dict(given), script)
    return script


def _follow(path: Path, known: Variables, script: Script) -> None:
    if path in script.files:
        return
    script.files.append(path)
    for number, line in _commands(path):
        script.names |= {name for groups in REFERENCE.findall(line) for name in groups if name}
        if definition := DEFINITION.match(line):
            script.names.add(definition[1])
            known.setdefault(definition[1], definition[3])
        words = re.split(r"[\s\"']+", _filled(line.strip(), known))
        for before, word in zip([""] + words, words):
            named = Path(word)
            if before == "include" and not (named.is_absolute() and named.is_file()):
                rule = f"include {word}: no such file; runs have folders of their own: write include ${{inputs}}/FILE"
                raise InputError(path, rule, number)
            if before == "include":
                _follow(named, known, script)
            elif word.startswith("/"):
                found = [Path(name) for name in sorted(glob(word))] if set(word) & set("*?[") else [named]
                script.files += [file for file in found if file.is_file() and file not in script.files]
