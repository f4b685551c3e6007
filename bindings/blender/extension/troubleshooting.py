"""What to do where something fails: the project's page about it, which lies in this extension."""

from __future__ import annotations

import functools
import itertools
import pathlib
import re
import textwrap

import bespoke
import bpy

PAGE = "troubleshooting.md"
WARNINGS = "results-with-a-warning"
# Of a popup: what a laptop's screen takes.
_WIDTH, _LETTERS, _MOST = 640, 96, 44


def anchor(status: bespoke.Status) -> str:
    """Of the section about a status."""
    return f"bespoke_status_{status.name.lower()}"


@functools.cache
def _sections() -> dict[str, list[str]]:
    """The lines below each heading, by its anchor."""
    sections: dict[str, list[str]] = {}
    lines: list[str] = []
    for line in pathlib.Path(__file__).with_name(PAGE).read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            lines = sections.setdefault(re.sub(r"[^\w -]", "", line[3:]).strip().lower().replace(" ", "-"), [line[3:]])
        else:
            lines.append(line)
    return sections


def section(name: str, message: str = "") -> list[str]:
    """The lines of a section as they are shown, without the messages that it lists. Of the warnings, the paragraph that
    is about this message."""
    if name not in _sections():
        return []
    text = "\n".join(_sections()[name]).split("\n\n")
    if name == WARNINGS:
        text = _about(text, message) or text[:2]
    shown: list[str] = []
    for block in text:
        if block.startswith(">") or block.startswith("See where: `--"):
            continue
        for item in re.split(r"\n(?=\d+\. |[*-] )", block.strip()):
            words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", " ".join(item.split())).replace("`", "")
            shown += textwrap.wrap(words, _LETTERS, subsequent_indent="   " if item[:1].isdigit() else "")
        shown.append("")
    return shown[:_MOST]


def _about(blocks: list[str], message: str) -> list[str]:
    """The paragraphs that follow on the message, or on it and others."""
    for k, block in enumerate(blocks):
        if not block.startswith("> `"):
            continue
        parts = [re.escape(part) for part in block[3:].rstrip("`").split("...")]
        if re.search(".*?".join(parts), message):
            rest = list(itertools.dropwhile(lambda block: block.startswith(">"), blocks[k:]))
            return list(itertools.takewhile(lambda block: not block.startswith(">"), rest))
    return []


class BESPOKE_OT_help(bpy.types.Operator):
    """What it means, how to see where it went wrong, and what to do about it"""

    bl_idname = "bespoke.help"
    bl_label = "What to Do"
    bl_options = {"INTERNAL"}

    anchor: bpy.props.StringProperty()
    message: bpy.props.StringProperty()

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Shows the section."""
        return context.window_manager.invoke_popup(self, width=_WIDTH)

    def execute(self, _context: bpy.types.Context) -> set[str]:
        """The section as a report, for who calls this from a script."""
        lines = section(self.anchor, self.message)
        if not lines:
            self.report({"ERROR"}, f"docs/{PAGE} has no section #{self.anchor}")
            return {"CANCELLED"}
        self.report({"INFO"}, "\n".join(lines))
        return {"FINISHED"}

    def draw(self, _context: bpy.types.Context) -> None:
        """The popup."""
        column = self.layout.column(align=True)
        column.scale_y = 0.75
        for line in section(self.anchor, self.message):
            column.label(text=line)
        column.label(text=f"docs/{PAGE}#{self.anchor}", icon="HELP")


def register() -> None:
    """With the class."""
    bpy.utils.register_class(BESPOKE_OT_help)


def unregister() -> None:
    """Without."""
    bpy.utils.unregister_class(BESPOKE_OT_help)
