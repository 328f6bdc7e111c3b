"""Folders of src include only their right-hand neighbours: apps -> {results, study} -> config -> sweep ->
{integrators, observables, lanes} -> dynamics -> numbers, and results, config -> storage."""

import os
import re
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["CLATTER_SOURCE"])
BELOW = {  # folder: what it may include besides itself
    "numbers": set(),
    "dynamics": {"numbers"},
    "integrators": {"dynamics", "numbers"},
    "observables": {"dynamics", "numbers"},
    "lanes": {"dynamics", "numbers"},
    "sweep": {"integrators", "observables", "lanes", "dynamics", "numbers"},
    "study": {"sweep", "integrators", "observables", "lanes", "dynamics", "numbers"},
    "storage": set(),
    "config": {"storage", "sweep", "integrators", "observables", "lanes", "dynamics", "numbers"},
    "results": {"config", "storage", "sweep", "integrators", "observables", "lanes", "dynamics", "numbers"},
    "apps": {
        "results",
        "config",
        "storage",
        "study",
        "sweep",
        "integrators",
        "observables",
        "lanes",
        "dynamics",
        "numbers",
    },
}
KNOWN_TO = {  # library header: the only folder that sees it
    r"fftw3": {"observables"},
    r"omp\.h": {"sweep"},
    r"hdf5|H5": {"results"},
    r"toml": {"config"},
    r"zlib": {"storage"},
    r"boost/program_options": {"config", "apps"},
    r"boost/multiprecision": {"numbers"},
    r"nettle": {"results"},
    r"xsimd": {"lanes"},
}


def wrong_includes(root):
    """Every include against the arrows below `root`, as 'file:line: include'."""
    wrong = []
    for path in sorted([*root.glob("src/*/*.?pp"), *root.glob("apps/*/*.?pp")]):
        folder = path.relative_to(root).parts[0 if path.is_relative_to(root / "apps") else 1]
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            include = re.match(r'\s*#\s*include\s*(["<])([^">]+)', line)
            if not include:
                continue
            target = include[2].split("/")[0]
            against = target in BELOW and target != folder and target not in BELOW[folder]
            foreign = any(re.match(library, include[2]) and folder not in seen for library, seen in KNOWN_TO.items())
            if against or foreign:
                wrong.append(f"{path.relative_to(root)}:{number}: {include[2]}")
    return wrong


class Arrows(unittest.TestCase):
    def test_no_include_points_against_the_arrows(self):
        self.assertEqual(wrong_includes(SOURCE), [])

    def test_an_include_against_the_arrows_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in {
                "src/dynamics/a.hpp": '#include "numbers/number.hpp"\n#include "sweep/run.hpp"\n',
                "src/observables/b.hpp": '#include "integrators/exact.hpp"\n',
                "src/sweep/c.cpp": "#include <hdf5.h>\n#include <omp.h>\n",
            }.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            self.assertEqual(
                wrong_includes(root),
                [
                    "src/dynamics/a.hpp:2: sweep/run.hpp",
                    "src/observables/b.hpp:1: integrators/exact.hpp",
                    "src/sweep/c.cpp:1: hdf5.h",
                ],
            )


if __name__ == "__main__":
    unittest.main()
