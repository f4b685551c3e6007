"""What the package says of its options and enums, so that nothing of it is written twice."""

from __future__ import annotations

import ast
import dataclasses
import enum
import functools
import inspect
import pathlib
from typing import Any

import bespoke


@functools.cache
def _tree(file: str) -> ast.Module:
    return ast.parse(pathlib.Path(file).read_text(encoding="utf-8"))


@functools.cache
def members(kind: type) -> dict[str, str]:
    """The comment of each field or member of a class of the package, as one line."""
    found: dict[str, str] = {}
    for node in _tree(inspect.getfile(kind)).body:
        if not isinstance(node, ast.ClassDef) or node.name != kind.__name__:
            continue
        for item, after in zip(node.body, node.body[1:]):
            target = item.targets[0] if isinstance(item, ast.Assign) else getattr(item, "target", None)
            is_comment = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant)
            if isinstance(target, ast.Name) and is_comment:
                found[target.id] = " ".join(str(after.value.value).split())
    return found


@dataclasses.dataclass(frozen=True)
class Option:
    """An option of the library."""

    name: str
    default: Any
    """None where there is none."""
    comment: str
    is_expert: bool


@functools.cache
def options() -> dict[str, Option]:
    """All options by their names. Errors: ImportError, where the native library cannot be loaded."""
    defaults = bespoke.read_default_options()
    comments = members(bespoke.Options)
    found = {}
    for field in dataclasses.fields(bespoke.Options):
        comment = comments[field.name]
        is_expert = comment.startswith("Expert. ")
        text = comment.removeprefix("Expert. ")
        found[field.name] = Option(field.name, getattr(defaults, field.name), text, is_expert)
    return found


def described(kind: type[enum.IntEnum]) -> list[tuple[str, str, str, int]]:
    """The members of an enum as Blender takes them for a property."""
    comments = members(kind)
    return [(m.name, label(m.name), description(comments.get(m.name, "")), int(m)) for m in kind]


def label(name: str) -> str:
    """`NEAR_CONTACT` or `fit_distance` as a person reads it."""
    return name.replace("_", " ").title()


def description(comment: str) -> str:
    """A comment as Blender wants it for a tooltip: it puts the full stop itself, and knows no marks."""
    return comment.rstrip(".").replace("`", "")
