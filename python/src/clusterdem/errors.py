"""The errors of the package, both kinds of ValueError: a file that breaks a rule, an argument that does."""

from __future__ import annotations

from pathlib import Path


class InputError(ValueError):
    """A file that breaks a rule.

    Parameters
    ----------
    path : str or Path
        The file at fault.
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


class ArgumentError(ValueError):
    """An argument that breaks a rule.

    Parameters
    ----------
    argument : str
        Its name.
    rule : str
        The rule that it breaks, in one line.
    """

    def __init__(self, argument: str, rule: str) -> None:
        super().__init__(argument, rule)
        self.argument = argument
        self.rule = rule

    def __str__(self) -> str:
        return f"{self.argument}: {self.rule}".replace("\n", " ")
