"""Pages in LAMMPS' form on this site: links to LAMMPS' own commands lead to its manual; its scripts are coloured."""

from docutils import nodes
from pygments.lexer import RegexLexer
from pygments.token import Comment, Keyword, Name, Number, Punctuation, String, Text
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment

MANUAL = "https://docs.lammps.org"


class LammpsLexer(RegexLexer):
    """A LAMMPS input script: commands, variables, numbers, strings, comments."""

    name = "LAMMPS"
    aliases = ["LAMMPS", "lammps"]
    tokens = {
        "root": [
            (r"#.*", Comment),
            (r"^(\s*)([a-z_]+)\b", Keyword),
            (r"&\s*\n", Punctuation, "continued"),
            (r"\$\{[^}]+\}|\$[a-z(]|\bv_\w+|[cf]_\w+", Name.Variable),
            (r'"[^"]*"', String),
            (r"(?<![\w/])[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?(?![\w/])", Number),
            (r"\n", Text),
            (r"\s+", Text),
            (r"[\w/]+|.", Text),
        ],
        # what follows a continued line is no command
        "continued": [(r"\s+", Text, "#pop"), (r"", Text, "#pop")],
    }


def to_manual(app: Sphinx, env: BuildEnvironment, node: nodes.Element, text: nodes.TextElement) -> nodes.Node | None:
    """`:doc:` of a page that only LAMMPS has, in a page of src/CLUSTER/doc."""
    page = node.get("reftarget", "")
    if node.get("reftype") != "doc" or not env.current_document.docname.startswith("src/CLUSTER/doc/"):
        return None
    return nodes.reference("", "", text, internal=False, refuri=f"{MANUAL}/{page.lstrip('/')}.html")


def setup(app: Sphinx) -> dict[str, bool]:
    for name in LammpsLexer.aliases:
        app.add_lexer(name, LammpsLexer)
    app.connect("missing-reference", to_manual)
    return {"parallel_read_safe": True}
