"""Runs the tests of the extension in Blender as a Python module: run.py ZIP PROFILE [NAME...]

Installs ZIP as a user does, into a profile that is new, and enables it. NAME: modules, classes or tests; all without.
"""

from __future__ import annotations

import os
import pathlib
import shutil
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent


def main() -> bool:
    archive, profile, *names = sys.argv[1:]
    shutil.rmtree(profile, ignore_errors=True)
    os.makedirs(profile)
    # Blender looks at it once, when it begins.
    os.environ["BLENDER_USER_RESOURCES"] = str(pathlib.Path(profile).resolve())
    import bpy

    print(f"Blender {bpy.app.version_string}, Python {sys.version.split()[0]}", flush=True)
    installed = bpy.ops.extensions.package_install_files(
        filepath=str(pathlib.Path(archive).resolve()), repo="user_default", enable_on_install=True
    )
    assert installed == {"FINISHED"}, installed
    sys.path.insert(0, str(HERE))
    loader = unittest.defaultTestLoader
    tests = loader.loadTestsFromNames(names) if names else loader.discover(str(HERE))
    outcome = unittest.TextTestRunner(verbosity=2).run(tests)
    return outcome.wasSuccessful() and outcome.testsRun > 0


good = main()
sys.stdout.flush()
sys.stderr.flush()
# Without what Blender does at the end of a process, in which extensions may hang.
os._exit(0 if good else 1)
