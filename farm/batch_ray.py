"""A batch on a Ray cluster: every outfit of a manifest on every avatar, a slice a task.

    python farm/batch_ray.py closet.json                          # on this machine
    python farm/batch_ray.py closet.json --address auto           # on the cluster that this machine belongs to

The nodes need the package bespoke and the manifest's folder in the same place, as on a shared drive. A task whose worker dies is
started again, on whatever node, and goes on with the pairs that are not in its report. The exit codes are those of `bespoke batch`.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import subprocess
import sys
import time
from typing import Any


def dress(manifest: str, part: int, parts: int, retry: bool) -> tuple[int, str]:
    """Dresses one slice on one core: the exit code, and what was said."""
    command = [sys.executable, "-m", "bespoke", "batch", manifest, "--slice", f"{part}/{parts}", "--jobs", "1"]
    done = subprocess.run(command + ["--retry"] * retry, stderr=subprocess.PIPE, text=True, errors="replace", check=False)
    return done.returncode, done.stderr


def lines(manifest: pathlib.Path, parts: int) -> list[dict[str, Any]]:
    """All that the slices have reported, of each pair the last; a line that was not written to its end counts for nothing."""
    last: dict[str, dict[str, Any]] = {}
    for part in range(1, parts + 1):
        end = "report.jsonl" if parts == 1 else f"report.{part}of{parts}.jsonl"
        report = manifest.with_suffix("." + end)
        for text in report.read_text(errors="replace").splitlines() if report.is_file() else []:
            try:
                line = json.loads(text)
            except ValueError:
                continue
            last[line["pair"]] = line
    return list(last.values())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("manifest", type=pathlib.Path)
    parser.add_argument("--address", help="of the cluster; none: this machine alone")
    parser.add_argument("--slices", type=int, default=0, help="tasks; by default one for each avatar")
    parser.add_argument("--again", type=int, default=3, help="how often a task is started again whose worker has died")
    parser.add_argument("--retry", action="store_true", help="tries those again that had no result")
    words = parser.parse_args()

    manifest = words.manifest.resolve()
    parts = words.slices or len(json.loads(manifest.read_text())["avatars"])
    import ray  # After the command line has been read: it takes seconds.

    ray.init(address=words.address, include_dashboard=False)
    task = ray.remote(num_cpus=1, max_retries=words.again)(dress)
    begun = time.monotonic()
    running = {task.remote(str(manifest), part, parts, words.retry): part for part in range(1, parts + 1)}
    codes = []
    while running:
        done, _ = ray.wait(list(running))
        part = running.pop(done[0])
        try:
            code, said = ray.get(done[0])
        except ray.exceptions.RayError as error:
            code, said = 1, f"its worker has died {words.again + 1} times: {error}"
        codes.append(code)
        print(f"slice {part}/{parts}:", said.strip().replace("\n", "\n    "), flush=True)
    pairs = lines(manifest, parts)
    dressed, flawed = (sum(line["exit"] == code for line in pairs) for code in (0, 3))
    print(
        f"{dressed} dressed, {flawed} not as designed, {len(pairs) - dressed - flawed} without a result, "
        f"in {time.monotonic() - begun:.0f} s"
    )
    # A wrong command line, then no result, then a result that is not as designed.
    return next((code for code in (2, 130, 1, 3) if code in codes), max(codes, default=0))


if __name__ == "__main__":
    sys.exit(main())
