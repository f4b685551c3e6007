"""What kind of wheel it is: for every Python, and for one system."""

from __future__ import annotations

import os
import pathlib
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class Hook(BuildHookInterface):  # type: ignore[type-arg]
    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        platform = os.environ.get("BESPOKE_WHEEL_PLATFORM")
        if version == "editable":
            return
        library = pathlib.Path(self.root, "src/bespoke/libbespoke.so")
        if not platform or not library.is_file():
            raise RuntimeError("a wheel holds the native library: `make wheel` in the project's folder builds both")
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{platform}"
