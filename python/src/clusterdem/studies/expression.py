"""Observables of one's own as an expression of columns: one line of a study file.

Names are columns of the dump (SI units); ``run.NAME``, or ``run["NAME"]``, is a number of the whole run at that step: a column
of its table NAME.N.txt or of its thermo output, ``dt`` or ``core_seconds`` (:meth:`clusterdem.Run.numbers_at`).
"""

from __future__ import annotations

import ast
import warnings
from collections.abc import Mapping

import numpy as np

from ..errors import ArgumentError, InputError
from ..frame import Floats, Frame
from ..observables import How, Observable
from .schema import unknown

FUNCTIONS = {
    name: getattr(np, name)
    for name in (
        "mean", "sum", "std", "var", "min", "max", "median", "percentile", "average",
        "sqrt", "abs", "exp", "log", "log10", "sin", "cos", "arctan2", "hypot", "where", "minimum", "maximum",
    )
}  # fmt: skip
"""numpy's, under numpy's names."""

CONSTANTS = {"pi": np.pi}
_GRAMMAR = (
    ast.Expression, ast.BinOp, ast.UnaryOp, ast.Compare, ast.Constant, ast.operator, ast.unaryop, ast.cmpop, ast.Load,
)  # fmt: skip


class _Names(ast.NodeVisitor):
    """The columns, and the numbers of the run, that an expression names; refuses what is no formula."""

    def __init__(self) -> None:
        self.columns: list[str] = []
        self.run: list[str] = []

    def visit_Name(self, node: ast.Name) -> None:
        if node.id not in CONSTANTS:
            self.columns.append(node.id)

    def visit_Call(self, node: ast.Call) -> None:
        if not isinstance(node.func, ast.Name) or node.func.id not in FUNCTIONS:
            raise ArgumentError("value", unknown("function", ast.unparse(node.func), FUNCTIONS))
        for given in (*node.args, *(word.value for word in node.keywords)):
            self.visit(given)

    def visit_Attribute(self, node: ast.Attribute) -> None:
        self._of_run(node, node.value, node.attr)

    def visit_Subscript(self, node: ast.Subscript) -> None:
        self._of_run(node, node.value, node.slice.value if isinstance(node.slice, ast.Constant) else None)

    def _of_run(self, node: ast.AST, of: ast.AST, name: object) -> None:
        if not isinstance(of, ast.Name) or of.id != "run" or not isinstance(name, str):
            rule = f"{ast.unparse(node)} is neither a column nor run.NAME, a number of the whole run"
            raise ArgumentError("value", rule)
        self.run.append(name)

    def generic_visit(self, node: ast.AST) -> None:
        if not isinstance(node, _GRAMMAR):
            raise ArgumentError("value", f"{ast.unparse(node)} is no formula of columns, numbers and functions")
        super().generic_visit(node)


class _OfRun:
    """``run.NAME`` and ``run["NAME"]`` in an expression."""

    def __init__(self, numbers: Mapping[str, float]) -> None:
        self.numbers = numbers

    def __getitem__(self, name: str) -> float:
        return self.numbers[name]

    __getattr__ = __getitem__


def expression(name: str, value: str, label: str = "", unit: str = "", relative: bool = True) -> Observable:
    """The observable that an expression gives.

    Parameters
    ----------
    name : str
        By which the study calls it.
    value : str
        The expression; it must give one number of a frame.
    label, unit, relative
        As of :class:`clusterdem.observables.Observable`.

    Raises
    ------
    ArgumentError
        If it is no formula.

    Examples
    --------
    >>> expression("speed", "mean(sqrt(vx**2 + vz**2))", unit="m/s").columns
    ('vx', 'vz')
    """
    try:
        tree = ast.parse(value.strip(), mode="eval")
    except SyntaxError as error:
        raise ArgumentError("value", f"is no expression: {error.msg}, at character {error.offset}") from None
    found = _Names()
    found.visit(tree)
    columns, of_run = tuple(dict.fromkeys(found.columns)), tuple(dict.fromkeys(found.run))
    code = compile(tree, name, "eval")

    def measure(frame: Frame, how: How) -> Floats:
        known = {column: frame[column] for column in columns}
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # means of nothing are NaN, as everywhere
            try:
                given = {"__builtins__": {}, "run": _OfRun(frame.run), **FUNCTIONS, **CONSTANTS}
                result = np.asarray(eval(code, given, known), dtype=np.float64)  # of the grammar above
            except (ValueError, TypeError) as error:
                if not len(frame):  # the largest of none
                    return np.array([np.nan])
                raise InputError(frame.path, f"observable {name!r}, {value!r}: {error}") from None
        if result.ndim:
            rule = f"observable {name!r}, {value!r}: gives a number for each cluster, must give one: mean(…), sum(…)"
            raise InputError(frame.path, rule)
        return result.reshape(1)

    return Observable(
        name, label or name, unit, measure, relative=relative, columns=columns, of_run=of_run, source=value
    )
