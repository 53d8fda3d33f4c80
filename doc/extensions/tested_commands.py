"""The directive `tested-commands`: the site's pages with the commands that tests/docs runs, and those that are not run."""

from pathlib import Path

from command_blocks import CommandBlock, command_blocks
from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


class TestedCommands(SphinxDirective):
    """A section per page, in the order of their paths."""

    def run(self) -> list[nodes.Node]:
        by_page: dict[str, list[CommandBlock]] = {}
        for block in command_blocks(Path(self.env.srcdir)):
            by_page.setdefault(block.page, []).append(block)
        return [node for page, blocks in by_page.items() for node in self.of_page(page, blocks)]

    def of_page(self, page: str, blocks: list[CommandBlock]) -> list[nodes.Node]:
        tested = sum(block.tested for block in blocks)
        name = page.removesuffix(".md")
        link = addnodes.pending_xref(
            "", nodes.literal("", page), refdomain="std", reftype="doc", reftarget=f"/{name}", refexplicit=True
        )
        count = f": {tested} of {len(blocks)} blocks are run"
        content: list[nodes.Node] = [nodes.paragraph("", "", link, nodes.Text(count))]
        for block in blocks:
            text = block.body.rstrip()
            if not block.tested:
                content.append(nodes.paragraph("", "", nodes.emphasis("", f"Not run: {block.reason}.")))
            content.append(nodes.literal_block(text, text, language="bash"))
        return content


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_directive("tested-commands", TestedCommands)
    return {"parallel_read_safe": True}
