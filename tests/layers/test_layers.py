# SPDX-License-Identifier: GPL-2.0-or-later
"""Folders include one another only as their README.md says, and never in a circle."""
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^#include "(?:([\w.]+)/)?([^"/]+)"', re.MULTILINE)


def allowed(folder: Path) -> list[str]:
    """The folders that README.md of `folder` names behind `May include:`."""
    found = re.search(r"^May include: (.*)\.$", (folder / "README.md").read_text(), re.MULTILINE)
    if not found:
        raise ValueError(f"{folder}/README.md: wanted a line `May include: ...`")
    return [] if found.group(1) == "nothing of ours" else found.group(1).split(", ")


def includes(folder: Path, folders: list[str], places: dict[str, Path]) -> list[tuple[str, ...]]:
    """Of each include of a file of ours: the file, the folder and the name included.

    `places`: of those folders that are not beside this one.
    """
    ours = {path.name for name in folders
            for path in places.get(name, folder.parent / name).glob("*.h")}
    result = []
    for path in sorted(folder.iterdir()):
        if path.suffix not in (".h", ".cpp"):
            continue
        for where, name in INCLUDE.findall(path.read_text()):
            if where in folders or (not where and name in ours):
                result.append((path.name, where, name))
    return result


def faults(root: Path, below: tuple[Path, ...] = ()) -> list[str]:
    """A sentence for each arrow that no README.md allows, and for each circle of allowed ones.

    `below`: folders elsewhere that those of `root` may know.
    """
    folders = sorted(path.parent.name for path in root.glob("*/README.md"))
    arrows = {name: allowed(root / name) for name in folders}
    arrows.update({path.name: allowed(path) for path in below})
    places = {path.name: path for path in below}
    result = []
    for name in folders:
        for unknown in sorted(set(arrows[name]) - set(arrows)):
            result.append(f"{name}/README.md allows {unknown}, which is no folder")
        for file, where, header in includes(root / name, sorted(arrows), places):
            if not where:
                result.append(f"{name}/{file} includes {header} without its folder")
            elif where != name and where not in arrows[name]:
                result.append(f"{name}/{file} includes {where}/{header}, wanted only "
                              f"{', '.join(arrows[name]) or 'its own folder'}")
    level: dict[str, int] = {}
    while len(level) < len(arrows):
        ready = [n for n in arrows if n not in level and all(b in level for b in arrows[n])]
        if not ready:
            result.append(f"a circle among {', '.join(n for n in arrows if n not in level)}")
            break
        level.update({n: len(level) for n in ready})
    return result


class Layers(unittest.TestCase):
    def test_arrows_point_downwards(self):
        self.assertEqual(faults(ROOT / "src_plugin"), [])
        self.assertEqual(faults(ROOT / "postproc", (ROOT / "src_plugin" / "core",)), [])

    def test_every_folder_of_sources_has_its_readme(self):
        for tree in ("src_plugin", "postproc"):
            for path in (ROOT / tree).rglob("*.h"):
                self.assertTrue((path.parent / "README.md").exists(), path)

    def tree(self, files: dict[str, str]) -> Path:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for name, text in files.items():
            path = Path(folder.name) / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        return Path(folder.name)

    def test_an_arrow_upwards_is_found(self):
        root = self.tree({"low/README.md": "May include: nothing of ours.\n",
                          "high/README.md": "May include: low.\n",
                          "high/a.h": '#include "low/b.h"\n#include <vector>\n',
                          "low/b.h": '#include "high/a.h"\n#include "high.h"\n'})
        self.assertEqual(faults(root), ["low/b.h includes high/a.h, wanted only its own folder"])

    def test_a_circle_is_found(self):
        root = self.tree({"one/README.md": "May include: two.\n",
                          "two/README.md": "May include: one.\n"})
        self.assertEqual(faults(root), ["a circle among one, two"])

    def test_a_folder_is_named(self):
        root = self.tree({"one/README.md": "May include: nothing of ours.\n",
                          "one/a.h": "", "one/b.cpp": '#include "a.h"\n'})
        self.assertEqual(faults(root), ["one/b.cpp includes a.h without its folder"])


if __name__ == "__main__":
    sys.exit(unittest.main())
