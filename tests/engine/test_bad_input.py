"""Every refusal names the word, the value and the rule; parse errors point at the word."""

import pytest
from lammps_run import clusters, diameter, head, pair, run

DRAG = "fix drag all drag/cluster 1.2 1.53e-5"
SIZE = "fix size all cluster/breakmerge"
GOOD = "1 1e-4 2000 drag drag K 1"

DRAG_ERRORS = [
    ("fix drag all drag/cluster -1 1.53e-5", "rho_g value: -1 (must be a number > 0 [mass/volume])"),
    ("fix drag all drag/cluster 1.2 zero", "nu_g value: zero (must be a number > 0 [length^2/time])"),
    ("fix drag all drag/cluster 1.2", "missing nu_g"),
    ("fix drag all drag/cluster 1e400 1.53e-5", "rho_g value: 1e400 (must be a number > 0 [mass/volume])"),
    ("fix drag all drag/cluster 1.2 1e-400", "nu_g value: 1e-400 (must be a number > 0 [length^2/time])"),
    (f"{DRAG} velocity 0 0 -1e400", "velocity uz value: -1e400 (must be a finite number or v_name [velocity])"),
    (f"{DRAG} fluctuation 1 0 1 own 1 {'9' * 400}", "(must be an integer from 1 to"),
    (f"{DRAG} velocity 0 0", "missing velocity uz"),
    (f"{DRAG} velocity 0 0 up", "velocity uz value: up (must be a finite number or v_name [velocity])"),
    (f"{DRAG} velocity 0 0 nan", "velocity uz value: nan"),
    (
        f"{DRAG} law newton",
        "law value: newton (must be trancong | schiller/naumann | stokes | wen/yu | gidaspow | difelice | none)",
    ),
    (f"{DRAG} law trancong 1.5 1", "law trancong c value: 1.5 (must be a number > 0 and <= 1)"),
    (f"{DRAG} law trancong 0.8", "missing law trancong dA/dn"),
    (f"{DRAG} law wen/yu 0", "law wen/yu voidage value: 0"),
    (f"{DRAG} plane xx", "plane value: xx (must be xy | xz | yz)"),
    (f"{DRAG} unshielded 1.1", "unshielded value: 1.1 (must be a number from 0 to 1)"),
    (f"{DRAG} integrator euler", "integrator value: euler (must be explicit | exponential)"),
    (f"{DRAG} fluctuation -1 0 0 own frozen 1", "fluctuation amplitude value: -1 (must be a number >= 0 [velocity])"),
    (f"{DRAG} fluctuation 1 0 1 box frozen 1", "fluctuation value: box (must be cell | own)"),
    (f"{DRAG} fluctuation 1 0 1 cell 0 1 30 frozen 1", "fluctuation cell count value: 0 (must be an integer from 1 to"),
    (
        f"{DRAG} fluctuation 1 0 1 cell 1000000 1000000 1000001 frozen 1",
        "value: 1000001 (must be at most 1e+15 cells in all)",
    ),
    (f"{DRAG} fluctuation 1 0 1 own 0 1", "fluctuation PERIOD value: 0 (must be frozen, field or a time > 0)"),
    (f"{DRAG} fluctuation 1 0 1 own frozen -5", "fluctuation SEED value: -5 (must be an integer from 1 to"),
    (f"{DRAG} table maybe", "table value: maybe (must be no | yes)"),
    (f"{DRAG} speed 1", "Unknown fix drag/cluster keyword: speed"),
    (f"{DRAG} profile none.txt x", "none.txt"),
    (f"{DRAG} profile in.lmp r", "profile axis value: r (must be x | y | z)"),
    (f"{DRAG} velocity 0 0 v_none\nrun 0", "Variable none for fix drag/cluster drag does not exist"),
    (f"{DRAG} unshielded 0.5\nrun 0", "unshielded 0.5 needs the primary particle"),
]

SIZE_ERRORS = [
    ("0 1e-4 2000 K 1", "Nevery value: 0 (must be an integer from 1 to"),
    ("1 0 2000 K 1", "d_p value: 0 (must be a number > 0 [length])"),
    ("1 1e-4", "missing rho_p"),
    ("1 1e-4 2000 drag drag", "the keyword K is required"),
    ("1 1e-4 2000 K 1", "the term st needs the keyword drag FIX-ID"),
    ("1 1e-4 2000 K 1 terms mf", "umf wen/yu needs the gas of the keyword drag FIX-ID"),
    ("1 1e-4 2000 K 0 drag drag", "K value: 0 (must be a number > 0"),
    ("1 1e-4 2000 K -1 drag drag", "K value: -1 (must be a number > 0"),
    ("1 1e-4 2000 K emms 0 drag drag", "K emms U_p value: 0 (must be a number > 0 [velocity])"),
    (f"{GOOD} void 1", "void value: 1 (must be a number >= 0 and < 1)"),
    (f"{GOOD} limits 0 10", "limits lower value: 0"),
    (f"{GOOD} limits 10 3", "limits upper value: 3 (must be an integer from 10 to"),
    (f"{GOOD} umf -1", "umf value: -1 (must be a number > 0 [velocity, or wen/yu])"),
    (f"{GOOD} epsmf 1", "epsmf value: 1"),
    (f"{GOOD} nst all", "nst value: all (must be particle | cluster | cell)"),
    (f"{GOOD} nst cell", "need the keyword grid nx ny nz"),
    (f"{GOOD} nsmf none", "nsmf value: none (must be emms | paper)"),
    (f"{GOOD} up gas", "up value: gas (must be own | cell | superficial | vector)"),
    (f"{GOOD} ncc -1", "ncc value: -1 (must be a number >= 0)"),
    (f"{GOOD} terms", "missing terms"),
    (f"{GOOD} terms xx", "terms value: xx (must be any of st, cc, mf)"),
    (f"{GOOD} test never", "test value: never (must be always | contact | end)"),
    (f"{GOOD} hysteresis -0.1", "hysteresis value: -0.1 (must be a number >= 0)"),
    (f"{GOOD} break maybe", "break value: maybe (must be no | yes)"),
    (f"{GOOD} merge often", "merge value: often (must be yes, no, or a number > 0)"),
    (f"{GOOD} refused merge", "refused value: merge (must be leave | break)"),
    (f"{GOOD} gravity 0 z", "gravity g value: 0"),
    (f"{GOOD} gravity 9.81 up", "gravity axis value: up (must be x | y | z)"),
    (f"{GOOD} plane xy", "plane value: xy (must be xz | none)"),
    (f"{GOOD} spacing 0.5", "spacing value: 0.5 (must be a number >= 1)"),
    (f"{GOOD} colour red", "Unknown fix cluster/breakmerge keyword: colour"),
]

RUN_ERRORS = [
    ("1 1e-4 2000 drag gas K 1", "drag fix ID gas does not exist"),
    ("1 1e-4 2000 drag move K 1", "drag fix move is of style nve, not drag/cluster"),
    (f"{GOOD} claim 1e-3", "claim 0.001 [length] is below the largest cluster diameter"),
    (f"{GOOD} claim 1.6e-3", "the room that two halves of the largest cluster need"),
    (f"{GOOD} claim 4e-3", "use 'comm_modify cutoff"),
    ("1 1e-4 2000 drag drag K emms 1e-9", "K emms 1e-09 gives K = -"),
    (f"{GOOD} limits 3 300", "holds 400 primary particles, above the upper limit 300"),
    ("1 9.9e-5 2000 drag drag K 1", "not a whole number within 1e-6"),
]


def base(cluster=None) -> str:
    rows = cluster or clusters((400, (0.02, 0.02), (0.0, 0.0)))
    return head() + rows + pair() + "fix move all nve\n"


@pytest.mark.parametrize("line, message", DRAG_ERRORS)
def test_drag(tmp_path, line, message):
    refused(tmp_path, base() + line + "\n", message, caret="run 0" not in line and "missing" not in message)


@pytest.mark.parametrize("words, message", SIZE_ERRORS)
def test_breakmerge(tmp_path, words, message):
    general = any(text in message for text in ("required", "needs", "need the", "missing"))
    refused(tmp_path, base() + f"{DRAG}\n{SIZE} {words}\n", message, caret=not general)


@pytest.mark.parametrize("words, message", RUN_ERRORS)
def test_breakmerge_at_run(tmp_path, words, message):
    refused(tmp_path, base() + f"{DRAG}\n{SIZE} {words}\nrun 0\n", message, caret=False)


def refused(folder, script, message, caret):
    r = run(folder, script, check=False)
    assert r.code != 0
    assert message in r.output, r.output[-1500:]
    if caret:
        assert any(line.strip() and set(line.strip()) == {"^"} for line in r.output.splitlines()), r.output[-800:]


def test_the_exact_diameter_is_told(tmp_path):
    rows = "create_atoms 1 single 0.02 0.0015 0.02\nset atom 1 diameter 928e-6\nset atom 1 density 1000\n"
    refused(
        tmp_path,
        base(rows) + f"{DRAG}\n{SIZE} {GOOD}\nrun 0\n",
        f"which is 399.59 primary particles, not a whole number within 1e-6: 400 particles at voidage 0.5 need diameter {diameter(400):.10g}",
        caret=False,
    )


def test_wrong_diameter_for_the_mass(tmp_path):
    rows = clusters((400, (0.02, 0.02), (0.0, 0.0))) + "set atom 1 diameter 9e-4\n"
    refused(
        tmp_path,
        base(rows) + f"{DRAG}\n{SIZE} {GOOD}\nrun 0\n",
        "has diameter 0.0009, which does not fit its 400 primary particles",
        False,
    )


def test_order(tmp_path):
    script = head() + clusters((400, (0.02, 0.02), (0.0, 0.0))) + f"{DRAG}\n{SIZE} {GOOD}\n" + pair() + "run 0\n"
    refused(tmp_path / "first", script, "must be defined after the pair_style command", False)
    script = base() + f"{DRAG}\n{SIZE} {GOOD}\npair_style none\n" + pair() + "run 0\n"
    refused(tmp_path / "again", script, "must be defined after the pair_style command", False)


def test_other_scenes_that_are_refused(tmp_path):
    atomic = head().replace("sphere", "atomic") + "pair_style zero 0.01\npair_coeff * *\nmass 1 1\n"
    refused(tmp_path / "atomic", atomic + DRAG + "\n", "requires atom style sphere", False)
    refused(tmp_path / "atomic2", atomic + f"{SIZE} 1 1e-4 2000 K 1 terms cc\n", "requires atom style sphere", False)
    flat = (
        "units si\ndimension 2\natom_style sphere\nregion box block 0 1 0 1 -0.1 0.1\ncreate_box 1 box\ncomm_modify vel yes\n"
        + pair()
    )
    refused(tmp_path / "flat", flat + f"{SIZE} 1 1e-4 2000 K 1 terms cc\n", "use dimension 3 with 'plane xz'", False)
    still = base().replace("comm_modify  vel yes", "comm_modify  vel no") + f"{DRAG}\n{SIZE} {GOOD}\nrun 0\n"
    refused(tmp_path / "still", still, "requires ghost atoms store velocity", False)
    small = base().replace("block 0 0.04", "block 0 0.009").replace("0.02 0.0015", "0.004 0.0015")
    refused(tmp_path / "small", small + f"{DRAG}\n{SIZE} {GOOD}\nrun 0\n", "an event would meet its own image", False)


def test_gas_profile_rows(tmp_path):
    for k, (text, message) in enumerate(
        [
            ("0 0 0 1\n0.1 0 1\n", "data row 2: a row needs 4 numbers"),
            ("0 0 0 1\n0 0 0 2\n", "data row 2: positions must ascend"),
            ("0 0 0 one\n", "data row 1"),
            ("0 0 0 nan\n", "data row 1"),
            ("# nothing\n", "has no data row"),
        ]
    ):
        folder = tmp_path / str(k)
        folder.mkdir()
        (folder / "gas.txt").write_text(text)
        refused(folder, base() + f"{DRAG} profile gas.txt x\n", message, False)


@pytest.mark.parametrize(
    "variable, message",
    [
        # what LAMMPS itself finds, and what it lets through
        ("equal sqrt(1-step)", "Variable w: Sqrt of negative value in variable formula"),
        ("equal 1/(step-1)", "Variable w: Divide by 0 in variable formula"),
        ("equal 1e308*10", "Fix drag/cluster drag: variable w gave inf at step 0: the gas velocity must be finite"),
        ("atom 1e308*10*x", "Fix drag/cluster drag: the drag force is not finite at step 0: check the gas velocity"),
    ],
)
def test_a_variable_that_is_not_a_number(tmp_path, variable, message):
    refused(tmp_path, base() + f"variable w {variable}\n{DRAG} velocity 0 0 v_w\nrun 3\n", message, False)
