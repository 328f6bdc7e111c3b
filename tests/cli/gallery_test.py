"""The pictures that the guides show are those that scripts/gallery.sh makes of shipped configurations.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from command_line import SOURCE
from plot_checks import Svg

GALLERY = SOURCE / "scripts" / "gallery.sh"


class Gallery(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = Path(kept.name)
        cls.result = subprocess.run([GALLERY, cls.folder], capture_output=True, text=True, timeout=300)

    def test_it_makes_all_pictures_of_the_guides_and_no_other(self):
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))
        made = {path.name for path in self.folder.iterdir()}
        self.assertEqual(made, {path.name for path in SOURCE.glob("configs/*.svg")})
        guides = [(SOURCE / name).read_text(encoding="utf-8") for name in ("README.md", "configs/README.md")]
        shown = {name for guide in guides for name in re.findall(r"!\[[^]]*\]\((?:configs/)?([\w.]+)\)", guide)}
        self.assertEqual(made, shown)

    def test_the_pictures_of_the_guides_say_and_hold_the_same(self):
        for path in self.folder.iterdir():
            with self.subTest(path.name):
                new, kept = Svg(path), Svg(SOURCE / "configs" / path.name)
                self.assertEqual(new.texts(), kept.texts())
                self.assertEqual([len(p.curves()) for p in new.panels], [len(p.curves()) for p in kept.panels])
                self.assertEqual([len(p.images()) for p in new.panels], [len(p.images()) for p in kept.panels])
                self.assertLess(path.stat().st_size, 300_000)

    def test_wrong_command_lines(self):
        for words, message in ((["--nonsense"], "unknown option"), (["a", "b"], "one directory at most")):
            result = subprocess.run([GALLERY, *words], capture_output=True, text=True, cwd=self.folder)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn(message, result.stderr)


if __name__ == "__main__":
    unittest.main()
