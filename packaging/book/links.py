"""Links of the repository's texts, in the book: what is no page of it becomes plain text.

The sources lie beside the texts in the repository, and not in the book. Whether they exist is checked by the links test.
"""

import posixpath
import re

LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(([^)\s#]+)(#[^)]*)?\)")
# The header has a reference of its own.
ELSEWHERE = {"include/bespoke.h": "reference.md"}


def on_page_markdown(markdown, page, config, files):
    folder = posixpath.dirname(page.file.src_uri)

    def replaced(link):
        text, target, anchor = link.group(1), link.group(2), link.group(3) or ""
        if ":" in target:
            return link.group(0)
        path = posixpath.normpath(posixpath.join(folder, target))
        if files.get_file_from_path(path) is not None:
            return link.group(0)
        if path in ELSEWHERE:
            return f"[{text}]({posixpath.relpath(ELSEWHERE[path], folder or '.')}{anchor})"
        return text

    return LINK.sub(replaced, markdown)
