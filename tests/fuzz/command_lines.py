"""Lines of the plugin's commands, right ones and wrong ones."""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import strategies as st


@dataclass(frozen=True)
class Command:
    """A command: its first words, required arguments, keywords with values, lines before and after it."""

    start: str
    required: str
    keywords: tuple[str, ...]
    before: str = ""
    after: str = ""

    def script(self, words: list[str]) -> str:
        return f"{self.before}{' '.join([self.start, *words])}\n{self.after}run 2\n"


GAS = "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2\n"
SIZE = "fix size all cluster/breakmerge 1 1e-4 2000 drag drag K 0.0266\n"
PAIR = "pair_style gran/cluster 10 0.3 0.33 cutoff 1.5876e-3\n"
COEFF = "pair_coeff * *\n"

COMMANDS = {
    "drag": Command(
        start="fix drag all drag/cluster",
        required="1.2 1.53e-5",
        keywords=(
            "velocity 0 0 2",
            "velocity v_u 0 v_w",
            "profile gas.txt x",
            "field gas.vtk",
            "field gas.vtk edge x clamp edge z periodic",
            "field gas.*.vtk loop 2.0",
            "fluctuation 0.75 0 0.75 cell 30 1 30 0.005 12345",
            "fluctuation 1 0 1 own frozen 5",
            "fluctuation 1 0 1 own 1e-6 7",
            "fluctuation 0.75 0 0.75 cell 30 1 30 0.005 12345 stagger",
            "fluctuation 1 0 1 own 1e-6 7 stagger",
            "field eddies.vtk fluctuation 1 0 1 own field 7 stagger exponential",
            "law trancong 0.8 1.1",
            "law schiller/naumann",
            "law stokes",
            "law wen/yu 0.9",
            "law difelice 0.8",
            "law difelice cells 4 1 4",
            "law wen/yu cells 2 1 2",
            "law gidaspow 0.9",
            "law gidaspow cells 4 1 4",
            "law gidaspow cells 2 1 2 pressure yes",
            "pressure no",
            "law none",
            "plane xz",
            "unshielded 0.1 particle 1e-4 2000",
            "unshielded 0",
            "particle 1e-4 2000",
            "integrator exponential",
            "table no",
            "refresh 2",
        ),
    ),
    "breakmerge": Command(
        start="fix size all cluster/breakmerge",
        required="1 1e-4 2000 drag drag K 0.0266",
        before=GAS,
        keywords=(
            "K emms 0.01",
            "kind 1 1e-4 2000",
            "void 0.5",
            "limits 3 2000",
            "umf 6e-3",
            "umf wen/yu",
            "epsmf 0.4",
            "grid 4 1 4",
            "nst cell grid 4 1 4",
            "nst cluster",
            "nsmf paper",
            "up cell grid 3 1 3",
            "up superficial grid 2 1 2",
            "up vector grid 2 1 2",
            "ncc 0.5",
            "terms st mf",
            "terms cc",
            "test contact",
            "test end",
            "hysteresis 0.1",
            "break no",
            "merge no",
            "merge 0.2",
            "refused break",
            "region room",
            "carry d_own mean",
            "carry d_own split",
            "carry d_own sum",
            "carry i_mark copy",
            "carry q split",
            "gravity 9.81 z",
            "claim 2.5e-3",
            "plane none",
            "spacing 2",
        ),
    ),
    "nve": Command(
        start="fix move all nve/cluster",
        required="",
        keywords=("gravity 9.81 0 0 -1", "gravity -1 1 1 1", "gravity 0 1 0 0", "drag drag"),
        before="unfix move\n",
        after=GAS + SIZE,
    ),
    "pair_style": Command(
        start="pair_style gran/cluster",
        required="10 0.3 0.33",
        keywords=(
            "tangential md",
            "tangential linear",
            "tangential none",
            "delta_max poisson 0.25",
            "delta_max kt 8.57",
            "direction displacement",
            "direction velocity",
            "cutoff 1.5876e-3",
        ),
        after=COEFF + GAS + SIZE,
    ),
    "pair_coeff": Command(
        start="pair_coeff", required="* *", keywords=("1", "*1", "1*1"), before=PAIR, after=GAS + SIZE
    ),
    "timestep": Command(
        start="fix step all cluster/timestep",
        required="1e-6",
        keywords=(
            "contact 0.6",
            "contact off",
            "stiffness 10",
            "overlap 0.5",
            "energy 1e-6",
            "energy off",
            "test balance",
            "test kinetic",
            "floor 1e-9",
            "retries 3",
            "predict no",
        ),
        before="unfix move\n" + PAIR + COEFF,
        after="fix move all nve\n" + GAS + SIZE,
    ),
}

NUMBERS = [
    "1e400",
    "-1e400",
    "nan",
    "-nan",
    "NAN",
    "inf",
    "-inf",
    "infinity",
    "-0",
    "0",
    "-0.0",
    "0.0",
    "-1",
    "+1",
    "1",
    "2",
    "0.5",
    "1.5",
    "1e-300",
    "1e-400",
    "4.9e-324",
    "1e15",
    "1e150",
    "1e300",
    "1.7976931348623157e308",
    "2147483646",
    "2147483647",
    "2147483648",
    "-2147483649",
    "4294967297",
    "9223372036854775807",
    "9223372036854775808",
    "9" * 40,
    "9" * 400,
    "0." + "0" * 400 + "1",
    "0x10",
    "0x1p3",
    "010",
    "1e",
    "1e+",
    "e5",
    "1.5.2",
    "1,5",
    "--1",
    "1_000",
    "1d0",
    ".",
    "-",
]
WORDS = [
    '""',
    '"two words"',
    "'single'",
    "Größe",
    "値",
    "\N{MINUS SIGN}1",
    "\N{FULLWIDTH DIGIT ONE}",
    "1\N{NO-BREAK SPACE}2",
    "a" * 3000,
    "{}",
    "{0}",
    "{:d}",
    "%s%n%d",
    "*",
    "1*",
    "v_",
    "v_none",
    "v_u",
    "v_w",
    "v_bad",
    "c_none",
    "f_drag",
    "NULL",
    "yes",
    "no",
    "off",
    "/",
    ".",
    "gas.txt",
    "gas.vtk",
    "gas.*.vtk",
    "eddies.vtk",
    "missing.txt",
    "~",
    "\\",
    "|",
    ";",
    "emms",
    "st",
    "cc",
    "frozen",
    "own",
    "cell",
    "drag",
    "move",
    "all",
    "(1+2)",
    "=",
]
FAULTS = ["replace", "replace", "replace", "replace three", "drop", "double", "swap", "insert", "cut"]


def lines(command: Command):
    """Words of a line of the command: right, or with one to three faults."""
    all_words = sorted({word for text in (command.required, *command.keywords) for word in text.split()})
    foreign = st.sampled_from(NUMBERS) | st.sampled_from(WORDS) | st.sampled_from(all_words)

    @st.composite
    def build(draw):
        chosen = draw(st.lists(st.sampled_from(command.keywords), max_size=4))
        words = command.required.split() + [word for text in chosen for word in text.split()]
        for _ in range(draw(st.integers(0, 3))):
            if not words:
                break
            k = draw(st.integers(0, len(words) - 1))
            fault = draw(st.sampled_from(FAULTS))
            if fault == "replace":
                words[k] = draw(foreign)
            elif fault == "replace three":
                words[k : k + 3] = [draw(foreign)] * 3
            elif fault == "drop":
                del words[k]
            elif fault == "double":
                words.insert(k, words[k])
            elif fault == "swap":
                other = draw(st.integers(0, len(words) - 1))
                words[k], words[other] = words[other], words[k]
            elif fault == "insert":
                words.insert(k, draw(foreign))
            else:
                del words[k:]
        return words

    return build()
