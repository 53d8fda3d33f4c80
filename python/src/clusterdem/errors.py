"""The one error that bad input raises: which file, which line, which rule."""

from __future__ import annotations

from pathlib import Path


class InputError(Exception):
    """Input that breaks a rule.

    Parameters
    ----------
    path : str or Path
        The file (or option) at fault.
    rule : str
        The rule that it breaks, in one line.
    line : int, optional
        Line number in the file, counted from 1.
    """

    def __init__(self, path: str | Path, rule: str, line: int | None = None) -> None:
        super().__init__(path, rule, line)
        self.path = str(path)
        self.rule = rule
        self.line = line

    def __str__(self) -> str:
        where = self.path if self.line is None else f"{self.path}:{self.line}"
        return f"{where}: {self.rule}".replace("\n", " ")
