"""The program ``bespoke``, which dresses characters in GLB, glTF and VRM files: ``python -m bespoke dress --help``."""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys


def main() -> int:
    """Runs the program with the arguments of this one. The exit status."""
    name = "bespoke.exe" if os.name == "nt" else "bespoke"
    program = pathlib.Path(__file__).parent / "bin" / name
    if not program.is_file():
        print(
            f"bespoke: the program is not in this package ({program}); a wheel made by `make wheel` has it, "
            "and `make build/bespoke` builds it alone",
            file=sys.stderr,
        )
        return 1
    command = [str(program), *sys.argv[1:]]
    if os.name == "nt":
        return subprocess.run(command, check=False).returncode
    # In place of the interpreter, so that signals and the exit status are the program's own.
    os.execv(command[0], command)


if __name__ == "__main__":
    sys.exit(main())
