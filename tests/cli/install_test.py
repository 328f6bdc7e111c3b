"""cmake --install brings all that users need, and it works from wherever the prefix is moved."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from command_line import CLATTER, LONGEST, SMALL, SOURCE

BUILD = Path(CLATTER).parents[2]

# Scripts are for users, or for those who work on clatter with its sources: a new one is in one of the two.
FOR_USERS = (
    *("plot.py", "report.py", "clatter/**/*.py", "clatter/reports/*.css", "clatter/reports/*.js"),
    *("score_solver.py", "slurm/submit.sh", "slurm/sweep.sbatch"),
)
FOR_SOURCES = (
    *("README.md", "bench*", "check*.sh", "clang_syntax.py", "Containerfile", "effects_ladder.py", "fuzz.sh"),
    *("gallery.sh", "hard_cases.py", "long_checks.sh", "manual*", "packages.sh", "pyproject.toml", "readme_table.py"),
    *("regress.*", "reproduce.sh", "slurm/check.sh", "tarball.sh", "test.sh", "timed_process.py"),
)


def scripts(patterns):
    folder = SOURCE / "scripts"
    return {str(path.relative_to(folder)) for pattern in patterns for path in folder.glob(pattern) if path.is_file()}


def files_below(folder):
    """Files and links, not those that Python compiles."""
    paths = (path for path in folder.rglob("*") if path.is_symlink() or path.is_file())
    return {str(path.relative_to(folder)) for path in paths if "__pycache__" not in path.parts}


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = Path(kept.name).resolve()
        installed, cls.prefix = cls.folder / "here", cls.folder / "moved to there"
        done = subprocess.run(
            ["cmake", "--install", BUILD, "--prefix", installed], capture_output=True, text=True, timeout=LONGEST
        )
        assert done.returncode == 0, done.stderr
        manifest = done.stdout.splitlines()
        cls.places = [line.split(": ", 1)[1] for line in manifest if line.startswith("-- Installing: ")]
        cls.named = installed
        installed.rename(cls.prefix)
        cls.share, cls.documents = cls.prefix / "share" / "clatter", cls.prefix / "share" / "doc" / "clatter"

    def run_installed(self, name, *words, folder=None):
        return subprocess.run(
            [self.prefix / "bin" / name, *words],
            cwd=folder,
            capture_output=True,
            text=True,
            timeout=LONGEST,
            env={**os.environ, "PATH": f"{self.prefix / 'bin'}:{os.environ['PATH']}"},
        )

    def test_nothing_is_outside_the_prefix(self):
        self.assertTrue(self.places)
        self.assertEqual([place for place in self.places if not Path(place).is_relative_to(self.named)], [])
        self.assertEqual([path.name for path in self.folder.iterdir()], [self.prefix.name])
        self.assertLessEqual({path.name for path in self.prefix.iterdir()}, {"bin", "share"})

    def test_a_run_is_drawn_from_the_prefix(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "a.toml").write_text(SMALL, encoding="utf-8")
            for words in (("clatter", "run", "a.toml", "-q"), ("clatter-plot", "a.h5")):
                done = self.run_installed(*words, folder=folder)
                self.assertEqual((done.returncode, done.stderr), (0, ""), words)
            self.assertIn("</svg>", (Path(folder) / "a.svg").read_text(encoding="utf-8"))

    def test_configurations_are_all_there_and_one_is_planned(self):
        wanted = {path.name for kind in ("toml", "ini", "csv") for path in (SOURCE / "configs").glob(f"*.{kind}")}
        self.assertEqual(files_below(self.share / "configs"), wanted)
        for name in ("fig22.toml", "feeder.toml"):
            done = self.run_installed("clatter", "plan", self.share / "configs" / name)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_hard_scenes_are_there(self):
        scenes = self.share / "hard_scenes.jsonl"
        self.assertEqual(scenes.read_bytes(), (SOURCE / "tests/hard/hard_scenes.jsonl").read_bytes())

    def test_every_script_is_installed_or_is_for_those_who_have_the_sources(self):
        users, developers = scripts(FOR_USERS), scripts(FOR_SOURCES)
        self.assertEqual(users & developers, set())
        self.assertEqual(files_below(SOURCE / "scripts") - users - developers, set(), "neither for users nor for us")
        self.assertEqual(files_below(self.share / "scripts"), users)

    def test_scripts_have_their_modes_and_answer(self):
        for name in files_below(self.share / "scripts"):
            mode = (self.share / "scripts" / name).stat().st_mode & 0o777
            runs = (SOURCE / "scripts" / name).stat().st_mode & 0o100
            self.assertEqual(mode, 0o755 if runs else 0o644, name)
        for name in ("slurm/submit.sh", "slurm/sweep.sbatch"):
            done = subprocess.run([self.share / "scripts" / name, "--help"], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("usage:", done.stdout)

    def test_commands_are_links_that_lead_into_the_prefix(self):
        entries = {f"clatter-{name}" for name in ("plot", "report") if (SOURCE / "scripts" / f"{name}.py").exists()}
        verifier = {"clatter-verify"} if os.environ.get("CLATTER_VERIFY") else set()
        self.assertEqual(files_below(self.prefix / "bin"), {"clatter", *verifier, *entries})
        for path in self.prefix.rglob("*"):
            if path.is_symlink():
                self.assertFalse(path.readlink().is_absolute(), path)
                self.assertTrue(path.exists(), f"{path} leads nowhere")
                self.assertTrue(path.resolve().is_relative_to(self.prefix), path)
        for name in entries:
            self.assertEqual(self.run_installed(name, "--help").returncode, 0, name)

    def test_every_program_has_a_man_page(self):
        pages = files_below(self.prefix / "share/man/man1")
        self.assertEqual({f"{name}.1" for name in files_below(self.prefix / "bin")} - pages, set())

    def test_the_licence_says_what_the_sources_and_the_binary_are_under(self):
        text = (self.documents / "copyright").read_text(encoding="utf-8")
        self.assertTrue(text.startswith("Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n"))
        words = " ".join(line.strip() for line in text.splitlines() if line != " .")
        title, notice, *terms = (SOURCE / "LICENSE").read_text(encoding="utf-8").strip().split("\n\n")
        self.assertEqual(title, "MIT License")
        self.assertIn(notice.replace("Copyright (c)", "Copyright:"), words)
        self.assertIn(" ".join(" ".join(terms).split()), words)
        self.assertIn("GNU General Public License", words)
        self.assertNotIn("@LICENCE@", text.upper())

    def test_guides_lead_to_installed_guides_and_pictures(self):
        guides = sorted(self.documents.rglob("README.md"))
        self.assertIn(self.documents / "configs" / "README.md", guides)
        lost = [
            f"{guide.relative_to(self.documents)}: {target}"
            for guide in guides
            for target in re.findall(r"\]\((?!\w+:)([^)#\s]*(?:README\.md|\.svg))", guide.read_text(encoding="utf-8"))
            if not (guide.parent / target).exists()
        ]
        self.assertEqual(lost, [])

    def test_the_changelog_is_that_of_the_sources_and_has_no_time(self):
        packed = self.documents / "changelog.gz"
        text = subprocess.run(["gzip", "-dc", packed], capture_output=True, check=True).stdout
        self.assertEqual(text, (SOURCE / "CHANGELOG.md").read_bytes())
        self.assertEqual(packed.read_bytes()[3:8], bytes(5))  # flags: no name; the time


if __name__ == "__main__":
    unittest.main()
