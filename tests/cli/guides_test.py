"""Links, paths, equations, authors and commands of the guides are right, and each check of them is checked, too."""

import pathlib
import re
import tempfile
import unittest

import guide_commands
import guides
from command_line import CLATTER, SOURCE

MOTION = """# motion

$$ x'' + x = f \\tag{3} $$

## References

- Budd, C. & Dux, F. (1994). Chattering.
"""


class Checks(unittest.TestCase):
    """Each finds what is wrong in a small tree, and nothing else."""

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.root = pathlib.Path(directory.name) / "project"
        self.root.mkdir()
        for folder in guides.FOLDERS:
            self.write(f"{folder}/README.md", f"# {folder}\n")
        self.write(guides.MOTION, MOTION)
        self.write("README.md", "# project\n")

    def write(self, name, text, mode=0o644):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(mode)

    def workplace(self):
        folder = self.root.parent / "workplace"
        folder.mkdir()
        return guide_commands.Workplace(self.root, CLATTER, folder)

    def test_links_and_anchors_that_lead_nowhere_are_found(self):
        self.write("src/README.md", "# A `b` c, d\n\n## Twice\n\n## Twice\n\n[up](../README.md) [here](#twice-1)\n")
        self.write(
            "README.md",
            "[there](src/README.md#a-b-c-d) [none](src/NONE.md) [no\nanchor](src/README.md#none)\n\n"
            "[outside](../x) [web](https://example.org/none) `[code](none)`\n\n```sh\n[[ a ]](none)\n```\n",
        )
        wrong = ["README.md:1: src/NONE.md", "README.md:1: src/README.md#none", "README.md:4: ../x"]
        self.assertEqual(guides.wrong_links(self.root), wrong)

    def test_paths_that_are_not_there_are_found(self):
        self.write("configs/a.toml", "")
        self.write(
            "README.md", "`src/motion`, `configs/*.toml`, `build/x`, `src/none/`\n\n```sh\nscripts/none.sh x\n```\n"
        )
        wrong = ["README.md:1: src/none/", "README.md:4: scripts/none.sh"]
        self.assertEqual(guides.wrong_paths(self.root), wrong)

    def test_lines_and_a_front_page_that_are_too_long_are_found(self):
        long, table, code = "a" * 120, "|" + "a" * 120, "```\n" + "a" * 121 + "\n```\n"
        self.write("src/README.md", f"{long}\n\n{table}\n\n{code}")
        self.write("README.md", f"{long[1:]}\n\n{table[:-1]}\n\n{table}\n\n{code}" + "\n" * 192)
        wrong = ["README.md: 201 lines", "README.md:5: 121 columns", "README.md:8: 121 columns"]
        self.assertEqual(guides.too_long(self.root), [*wrong, "src/README.md:1: 120 columns"])

    def test_equations_that_do_not_exist_are_found(self):
        self.write("src/a.hpp", "/// Motion (eq. 3), and (eqs.\n/// 2 ... 4).\nint x;  ///< eq. 7\nint y = 8;\n")
        self.write("src/README.md", "By (eq. 3) and\neq. 9.\n")
        wrong = ["src/a.hpp:1: eq. 2", "src/a.hpp:1: eq. 4", "src/a.hpp:3: eq. 7", "src/README.md:1: eq. 9"]
        self.assertEqual(guides.wrong_equations(self.root), wrong)
        self.write(guides.MOTION, MOTION.replace("\n## ", "\\tag{3}\n\n## "))
        self.assertEqual(guides.wrong_equations(self.root)[0], f"{guides.MOTION}: eq. 3 twice")

    def test_authors_without_a_reference_are_found(self):
        self.write("src/a.hpp", "/// Sums a chatter (Budd &\n/// Dux 1994; Budd & Nordmark 1994; Dux 1993).\n")
        self.write("tests/a.cpp", "// In Debian 12, 2000 scenes.\n")
        self.assertEqual(
            guides.wrong_authors(self.root), ["src/a.hpp:1: Budd & Nordmark 1994", "src/a.hpp:1: Dux 1993"]
        )

    def test_guides_that_comments_cite_and_nobody_has_are_found(self):
        self.write("src/a.hpp", '/// As README.md says, and notes.md.\nauto name = "other.md";\n')
        self.assertEqual(guides.wrong_guides_cited(self.root), ["src/a.hpp:1: notes.md"])

    def test_commands_that_fail_are_found(self):
        self.write(
            "README.md",
            "```sh\nclatter defaults > a.toml   # runs\nclatter info \\\n  none.h5\n```\n\n"
            '```toml\n[scene]\nxs = "none"\n```\n\n```python\nraise SystemExit("why")\n```\n',
        )
        first, second, third = guide_commands.wrong_blocks(self.workplace())
        self.assertRegex(first, r"^README.md:3: .*none\.h5")
        self.assertRegex(second, r"^README.md:8: .*xs")
        self.assertEqual(third, "README.md:13: why")

    def test_words_of_slow_commands_that_do_not_exist_are_found(self):
        self.write("scripts/test.sh", "#!/bin/sh\necho 'usage: test.sh [--quick] all'\n", 0o755)
        self.write("scripts/packages.sh", "PACKAGES=(g++ cmake)\n")
        self.write("CMakePresets.json", '{"configurePresets": [{"name": "release"}]}')
        self.write(
            "README.md",
            "```sh\nscripts/test.sh --quick all\nscripts/test.sh --quic\napt-get install -y g++ cmake clang\n"
            "cmake --preset release && cmake --build --preset debug\n```\n",
        )
        self.assertEqual(
            guide_commands.wrong_blocks(self.workplace()),
            ["README.md:3: --quic", "README.md:4: clang", "README.md:5: debug"],
        )

    def test_options_in_the_text_that_do_not_exist_are_found(self):
        self.write(
            "README.md", "`clatter run CONFIG [-o FILE.h5]`, `clatter run --thread 2`, `clatter jump`, `clatter`\n"
        )
        wrong = ["README.md:1: --thread in 'clatter run --thread 2'", "README.md:1: clatter help jump fails"]
        self.assertEqual(guide_commands.wrong_spans(self.workplace()), wrong)


class Guides(unittest.TestCase):
    maxDiff = None

    def test_links_and_anchors_lead_somewhere(self):
        self.assertEqual(guides.wrong_links(SOURCE), [])

    def test_files_and_folders_that_are_named_are_there(self):
        self.assertEqual(guides.wrong_paths(SOURCE), [])

    def test_lines_are_no_longer_than_they_should_be(self):
        self.assertEqual(guides.too_long(SOURCE), [])

    def test_equations_that_are_cited_exist(self):
        self.assertEqual(guides.wrong_equations(SOURCE), [])

    def test_authors_that_are_cited_are_among_the_references(self):
        self.assertEqual(guides.wrong_authors(SOURCE), [])

    def test_comments_cite_no_guide_that_is_not_there(self):
        self.assertEqual(guides.wrong_guides_cited(SOURCE), [])

    def test_every_room_has_a_guide_that_the_guide_of_the_source_names(self):
        text = (SOURCE / "src" / "README.md").read_text(encoding="utf-8")
        rooms = sorted(path.name for path in (SOURCE / "src").iterdir() if path.is_dir())
        self.assertEqual([room for room in rooms if not (SOURCE / "src" / room / "README.md").exists()], [])
        self.assertEqual([room for room in rooms if f"({room}/README.md)" not in text], [])

    def test_every_configuration_is_in_the_gallery(self):
        text = (SOURCE / "configs" / "README.md").read_text(encoding="utf-8").split("## Gallery")[1]
        shown = set(re.findall(r"`(\w+\.(?:toml|ini))`", text))
        for first, last in re.findall(r"`fig(\d+)\.toml` … `fig(\d+)\.toml`", text):
            shown |= {f"fig{number:02}.toml" for number in range(int(first), int(last))}
        there = {path.name for path in (SOURCE / "configs").iterdir() if path.suffix in (".toml", ".ini")}
        self.assertEqual(shown, there)

    def test_every_command_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            workplace = guide_commands.Workplace(SOURCE, CLATTER, pathlib.Path(folder))
            workplace.furnish()
            self.assertEqual(guide_commands.wrong_blocks(workplace), [])

    def test_commands_within_the_text_have_their_options(self):
        with tempfile.TemporaryDirectory() as folder:
            workplace = guide_commands.Workplace(SOURCE, CLATTER, pathlib.Path(folder))
            self.assertEqual(guide_commands.wrong_spans(workplace), [])


if __name__ == "__main__":
    unittest.main()
