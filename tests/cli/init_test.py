"""`clatter init`: the models of the guide in its words, and configurations that run as they are written.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import re
import unittest

from command_line import SOURCE, CommandLine


class Init(CommandLine):
    def test_lists_the_models_of_the_guide_in_its_order_and_words(self):
        guide = (SOURCE / "configs" / "README.md").read_text(encoding="utf-8")
        table = re.search(r"\| my machine has \| start from \|\n\|---\|---\|\n((?:\|.*\n)+)", guide)[1]
        rows = re.findall(r"^\| (.+?) \| \[`(\w+)\.toml`\]\(#[\w-]+\) \|$", table, re.MULTILINE)
        self.assertEqual(len(rows), len(table.splitlines()))
        result = self.clatter("init")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        models = result.stdout.split("\n\n")[0].splitlines()[1:]
        self.assertEqual([tuple(re.split(r" {2,}", line.strip())) for line in models], [(n, text) for text, n in rows])

    def test_writes_each_shipped_configuration_with_its_comments(self):
        listed = self.clatter("init").stdout
        for path in sorted((SOURCE / "configs").glob("*.toml")):
            self.assertRegex(listed, rf"\b{path.stem}\b")
            text = path.read_text(encoding="utf-8")
            for table in re.findall(r'force_table = "(\w+\.csv)"', text):  # its rows come with it
                rows = (path.parent / table).read_text(encoding="utf-8")
                text = text.replace(f'"{table}"', f"'''\n{rows}'''")
            self.assertEqual(self.clatter("init", path.stem, "-o", "-").stdout, text)

    def test_the_file_runs(self):
        result = self.clatter("init", "drill")
        said = "drill.toml: written; change it, and run it by: clatter run drill.toml\n"
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", said))
        shipped = (SOURCE / "configs" / "drill.toml").read_bytes()
        self.assertEqual((self.directory / "drill.toml").read_bytes(), shipped)
        ran = self.clatter("run", "drill.toml", "-q", "--set", "sweep.frequency=50 Hz")
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.assertTrue((self.directory / "drill.h5").exists())

    def test_never_writes_over_a_file_and_offers_a_free_name(self):
        for name in ("drill.toml", "drill2.toml"):
            self.write(name, "mine")
        for words, free in (((), "drill3.toml"), (("-o", "drill2.toml"), "drill22.toml")):
            result = self.clatter("init", "drill", *words)
            self.assertEqual((result.returncode, result.stdout), (74, ""))
            self.assertIn("there is a file, which is kept; take another name: -o " + free, result.stderr)
            self.assertEqual(self.clatter("init", "drill", "-o", free).returncode, 0)
            (self.directory / free).unlink()
        (self.directory / "link.toml").symlink_to("nowhere.toml")
        self.assertEqual(self.clatter("init", "drill", "-o", "link.toml").returncode, 74)
        self.assertEqual({(self.directory / name).read_text() for name in ("drill.toml", "drill2.toml")}, {"mine"})
        self.assertEqual({path.name for path in self.directory.iterdir()}, {"drill.toml", "drill2.toml", "link.toml"})

    def test_wrong_words(self):
        for words, code, said in (
            (("init", "drll"), 2, "unknown model 'drll'; did you mean 'drill'?"),
            (("init", "drill.toml"), 2, "unknown model 'drill.toml'; did you mean 'drill'?"),
            (("init", "pendulum"), 2, "unknown model 'pendulum'; expected one of drive_si, one_stop, drill,"),
            (("init", "-o", "mine.toml"), 2, "-o without a model; write e.g. clatter init drill -o mine.toml"),
            (("init", "drill", "one_stop"), 2, "unexpected argument 'one_stop'"),
            (("init", "drill", "-o", "no/such.toml"), 74, "there is no directory 'no'"),
        ):
            result = self.clatter(*words)
            self.assertEqual((result.returncode, result.stdout), (code, ""), words)
            self.assertIn(said, result.stderr)
            self.assertEqual(list(self.directory.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
