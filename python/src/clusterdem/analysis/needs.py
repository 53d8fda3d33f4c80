"""What a scene needs: which terms of E_in* decided its events, and which forces it felt."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..frame import Floats

NEGLIGIBLE, MINOR = 0.01, 0.1
"""Shares below which a run could do without a term, and below which a run without it is worth a try."""

COLUMNS = (
    "tests share_st share_cc share_mf breakups_by_st breakups_by_cc whole_by_st whole_by_mf "
    "merges_by_st merges_by_mf F_drag F_contact weight breakups merges born"
).split()


@dataclass(frozen=True)
class Term:
    """One term of E_in*.

    Parameters
    ----------
    name : str
        As in the model, such as ``N_st``.
    share : float
        Mean share in the power behind a breakup, 0 to 1.
    breakups, merges : float
        Events that it decided, as a share of all.
    whole : float
        Share of the tested clusters that it alone kept from breaking.
    """

    name: str
    share: float
    breakups: float
    whole: float
    merges: float

    @property
    def decides(self) -> float:
        """The largest share of anything that it decided."""
        return max(self.breakups, self.whole, self.merges)


@dataclass(frozen=True)
class Needs:
    """What a run needed.

    Parameters
    ----------
    terms : tuple of Term
        N_st, N_cc, N_smf.
    breakups, merges, born : int
        Events.
    drag, contact : float
        Mean force on a cluster at a check, in units of its weight.
    """

    terms: tuple[Term, ...]
    breakups: int
    merges: int
    born: int
    drag: float
    contact: float


def _ratio(part: float, whole: float) -> float:
    return part / whole if whole > 0 else 0.0


def needs_of(series: Mapping[str, Floats]) -> Needs | None:
    """Read the needs off the last row of a run's table; None where it has no such columns (older runs) or no check."""
    if not set(COLUMNS) <= set(series):
        return None
    end = {name: float(series[name][-1]) for name in COLUMNS}
    if not end["weight"] > 0:
        return None
    shares = end["share_st"] + end["share_cc"] + end["share_mf"]
    terms = tuple(
        Term(
            name,
            _ratio(end[f"share_{key}"], shares),
            _ratio(end.get(f"breakups_by_{key}", 0.0), end["breakups"]),
            _ratio(end.get(f"whole_by_{key}", 0.0), end["tests"]),
            _ratio(end.get(f"merges_by_{key}", 0.0), end["merges"]),
        )
        for name, key in (("N_st", "st"), ("N_cc", "cc"), ("N_smf", "mf"))
    )
    drag, contact = (end[name] / end["weight"] for name in ("F_drag", "F_contact"))
    return Needs(terms, round(end["breakups"]), round(end["merges"]), round(end["born"]), drag, contact)


def percent(share: float) -> str:
    """A share with two significant digits, never rounded to nothing."""
    return "none" if share == 0 else f"{100 * share:.0f} %" if share >= 0.095 else f"{100 * share:.2g} %"


def _verdict(share: float, off: str) -> str:
    if share < NEGLIGIBLE:
        return f"this run could do without ({off})"
    return f"a minor part, try {off}" if share < MINOR else "needed"


def _of_breakups(term: Term, off: str) -> str:
    said = f"{term.name} decided {percent(term.breakups)} of the breakups"
    if term.whole >= NEGLIGIBLE:
        said += f" and kept {percent(term.whole)} of the clusters whole at a check"
    return f"{said}, and is {percent(term.share)} of the power behind them: {_verdict(max(term.decides, term.share), off)}."


def statements(needs: Needs) -> list[str]:
    """One plain sentence per term of the size law, merging and each force."""
    st, cc, mf = needs.terms
    said = []
    if needs.breakups:
        said += [_of_breakups(st, "terms cc mf"), _of_breakups(cc, "-var ncc 0")]
    else:
        said.append("No cluster broke.")
    held = f"N_smf kept {percent(mf.whole)} of the clusters whole at a check and decided {percent(mf.merges)} of the merges"
    said.append(f"{held}: {_verdict(mf.decides, 'terms st cc')}.")
    if needs.merges == 0:
        said.append("Nothing merged: this run could do without merging (-var merge no).")
    else:
        ratio = _ratio(needs.merges, needs.born - needs.breakups)
        text = f"Merges took back {percent(ratio)} of the clusters that breakups made" if ratio else "Clusters merged"
        said.append(f"{text} ({needs.merges:,} merges): {_verdict(ratio or 1.0, '-var merge no')}.")
    forces = {"drag": needs.drag, "the forces of contacts": needs.contact}
    loads = ", ".join(f"{name} {value:.2g}" for name, value in forces.items() if value > 0)
    if loads:
        said.append(f"Mean forces on a cluster, in units of its weight: {loads}.")
    if needs.contact == 0:
        said.append("Contact forces were zero, or nothing in the size law looked at them.")
    elif needs.contact < NEGLIGIBLE * max(needs.drag, 1.0):
        said.append("Contacts hardly move the clusters: the simplest contact law will do (-var contact frictionless).")
    return said


def table(needs: Needs) -> list[list[str]]:
    """Rows of text, the heading first."""
    rows = [["term", "share of the power", "breakups decided", "clusters kept whole", "merges decided"]]
    for term in needs.terms:
        rows.append([term.name, *(percent(v) for v in (term.share, term.breakups, term.whole, term.merges))])
    return rows
