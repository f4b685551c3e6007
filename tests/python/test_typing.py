"""The package and its tests are typed, as strictly as mypy can be, and wrong uses of it are found."""

from __future__ import annotations

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = HERE.parents[1] / "bindings/python/src/bespoke"


@unittest.skipUnless(importlib.util.find_spec("mypy"), "there is no mypy")
class Typing(unittest.TestCase):
    def test_package_tests_and_a_users_file(self) -> None:
        self.assertTrue((PACKAGE / "py.typed").is_file())
        with tempfile.TemporaryDirectory() as cache:
            command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, "--no-error-summary"]
            # Types that are there for some versions of NumPy only.
            command += ["--ignore-missing-imports", "--disable-error-code", "import-untyped"]
            files = [str(PACKAGE), *(str(path) for path in sorted(HERE.glob("*.py")))]
            checked = subprocess.run(command + files, capture_output=True, text=True, cwd=HERE, env=os.environ)
        self.assertEqual((checked.returncode, checked.stdout), (0, ""), checked.stdout + checked.stderr)


if __name__ == "__main__":
    unittest.main()
