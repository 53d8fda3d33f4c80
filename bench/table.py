"""Rows of the tables in README.md."""

from __future__ import annotations


def row(*cells: object) -> str:
    """One row."""
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def head(*cells: object) -> str:
    """The first row and the line below it."""
    return row(*cells) + "\n" + row(*["---"] * len(cells))
