"""The raw layer: structs, numbers and functions are those of C."""

from __future__ import annotations

import ctypes
import inspect
import pathlib
import re
import unittest

import bespoke
from bespoke import _library, _native

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Layout(unittest.TestCase):
    def test_structs_lie_as_in_c(self) -> None:
        pins = (ROOT / "tests/capi/layout.inc").read_text()
        structs = re.findall(r"^STRUCT\((\w+), (\d+)\)$", pins, re.M)
        self.assertGreater(len(structs), 10)
        for name, size in structs:
            self.assertEqual(ctypes.sizeof(getattr(_native, name)), int(size), name)
        fields = re.findall(r"^FIELD\((\w+), (\w+), (\d+), (\d+)\)$", pins, re.M)
        for name, field, offset, size in fields:
            found = getattr(getattr(_native, name), field)
            self.assertEqual((found.offset, found.size), (int(offset), int(size)), f"{name}.{field}")
        listed = sum(len(getattr(_native, name)._fields_) for name, _ in structs)
        self.assertEqual(listed, len(fields))

    def test_numbers_are_those_of_c(self) -> None:
        pins = (ROOT / "tests/capi/layout.inc").read_text()
        values = re.findall(r"^VALUE\((\w+), (\d+)\)$", pins, re.M)
        self.assertGreater(len(values), 80)
        enums = {}
        for name, one in inspect.getmembers(bespoke) + inspect.getmembers(bespoke._enums):
            if inspect.isclass(one) and issubclass(one, bespoke._enums._Number):
                prefix = re.sub(r"(?<!^)([A-Z])", r"_\1", one.__name__.lstrip("_")).upper()
                for member in one:
                    enums[f"BESPOKE_{prefix}_{member.name}"] = int(member)
        for name, value in values:
            found = enums[name] if name in enums else getattr(_native, name)
            self.assertEqual(found, int(value), name)

    def test_every_function_is_there_and_used(self) -> None:
        header = (ROOT / "include/bespoke.h").read_text()
        declared = set(re.findall(r"^[\w ]+\*?\s*\*?(bespoke_\w+)\(", header, re.M))
        self.assertEqual(declared, set(_native.FUNCTIONS))
        folder = pathlib.Path(_native.__file__).parent
        sources = "".join(p.read_text() for p in folder.glob("*.py") if p.name != "_native.py")
        # The controls do the same, also for a session that is closed meanwhile.
        for name in declared - {"bespoke_session_cancel", "bespoke_session_read_progress"}:
            plain = name.replace("bespoke_session_", "").replace("_source_", "_{side}_").replace("_target_", "_{side}_")
            plain = plain.replace("_garment_skin", "_{side}_skin") if plain.startswith("set_") else plain
            names = (name, f"bespoke_session_{plain}", f'self._mesh("{name[len("bespoke_session_"):]}"')
            self.assertTrue(any(one in sources for one in names), f"nothing calls {name}")

    def test_numbers_that_are_not_known_arrive(self) -> None:
        later = bespoke.Status(4711)
        self.assertEqual((int(later), later.name), (4711, "NUMBER_4711"))
        self.assertEqual(_library.status_name(later), "BESPOKE_STATUS_UNKNOWN")
        self.assertEqual(_library.status_name(bespoke.Status.BUSY), "BESPOKE_STATUS_BUSY")
        layer = bespoke.Element(bespoke.Subject(258), bespoke.ElementKind.TRIANGLE, 7)
        self.assertEqual((layer.layer, layer.follower), (2, None))
        follower = bespoke.Element(bespoke.Subject(bespoke.Subject.FOLLOWER + 3), bespoke.ElementKind.TRIANGLE, 7)
        self.assertEqual((follower.layer, follower.follower), (None, 3))
        with self.assertRaises(ValueError):
            bespoke.Status("OK")  # type: ignore[arg-type]

    def test_everything_public_is_documented(self) -> None:
        for name in bespoke.__all__:
            one = getattr(bespoke, name)
            if not (inspect.isclass(one) or inspect.isfunction(one)):
                continue
            self.assertTrue(one.__doc__, name)
            if not inspect.isclass(one):
                continue
            for member, value in vars(one).items():
                if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    self.assertTrue(inspect.getdoc(value), f"{name}.{member}")
        # What stands beneath a field or member.
        for module in ("_enums", "_options", "_values", "_joints"):
            lines = inspect.getsource(getattr(bespoke, module)).split("\n")
            for line, following in zip(lines, lines[1:]):
                if re.match(r"    [A-Z_0-9]+ = \d+$|    [a-z_]+: [^=]+ = None$", line):
                    self.assertTrue(following.startswith('    """'), f"{module}: {line}")


if __name__ == "__main__":
    unittest.main()
