"""The checks of the sources: scripts/check.sh finds whatever is wrong with a small tree, and .ci/run calls it."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import yaml

SOURCE = Path(os.environ["CLATTER_SOURCE"])
QUICK = ("clang-format", "shellcheck", "black", "flake8", "arrows", "g++")
LONG = ("clang++", "clang-tidy", "asan", "tsan")
BY_NAME = ("packages", "report")
CPP = "int twice(int x) { return 2 * x; }\n"


def read(name):
    return (SOURCE / name).read_text(encoding="utf-8")


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def write(self, name, text, mode=0o644):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(mode)


class Check(Folder):
    """check.sh in a tree of a few files, with the rules of the whole one."""

    def setUp(self):
        super().setUp()
        for name in (
            ".clang-format",
            ".flake8",
            "CMakePresets.json",
            "scripts/check.sh",
            "scripts/clang_syntax.py",
            "scripts/packages.sh",
        ):
            self.write(name, read(name), 0o755)
        warnings = re.search(
            r"add_compile_options\(-Wall.*?\)\nif\(CLATTER_WERROR\).*?endif\(\)\n", read("CMakeLists.txt"), re.S
        )
        self.write(
            "CMakeLists.txt",
            f"""cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
{warnings[0]}
add_library(small src/sweep/a.cpp)
add_custom_target(clatter_version)
""",
        )
        self.write(".ci/run", "#!/usr/bin/env bash\nscripts/check.sh\n", 0o755)
        self.write("apps/clatter/main.cpp", "int main() {}\n")
        self.write("src/sweep/a.cpp", CPP)
        self.write("tests/cli/arrows_test.py", read("tests/cli/arrows_test.py"))
        self.write("src/README.md", read("src/README.md"))
        self.write("scripts/a.py", 'print("a")\n')
        # If a package is missing, a test installs nothing.
        self.write(
            "bin/apt-get", "#!/bin/sh\necho 'scripts/test.sh installs what this test needs' >&2\nexit 1\n", 0o755
        )

    def check(self, *words):
        path = f"{self.root / 'bin'}:{os.environ['PATH']}"
        return subprocess.run(
            [self.root / "scripts" / "check.sh", *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=300,
            env={**os.environ, "PATH": path},
        )

    def assert_found(self, gate, name, text, words):
        """With this file in the tree the gate fails and says why."""
        self.write(name, text)
        result = self.check(gate)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(words, result.stdout)
        self.assertRegex(result.stdout, rf"(?m)^{re.escape(gate)} +FAILED after \d+ s$")

    def test_a_clean_tree_passes_the_quick_gates(self):
        black = subprocess.run(["black", "-q", "--line-length", "120", self.root / "tests"], check=False)
        self.assertEqual(black.returncode, 0)  # this one file may not be formatted yet
        result = self.check("--quick")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(re.findall(r"(?m)^(\S+) +passed after \d+ s$", result.stdout), list(QUICK))

    def test_cpp_that_is_not_formatted_is_found(self):
        self.assert_found("clang-format", "src/sweep/b.hpp", "int  b( int x );\n", "src/sweep/b.hpp:1:")

    def test_a_mistake_in_a_shell_script_is_found(self):
        self.assert_found("shellcheck", "scripts/b.sh", "#!/usr/bin/env bash\nrm $1/*\n", "SC2086")

    def test_a_mistake_in_a_batch_script_is_found(self):
        self.assert_found("shellcheck", "scripts/slurm/b.sbatch", "#!/usr/bin/env bash\nrm $1/*\n", "SC2086")

    def test_a_mistake_in_the_script_of_ci_is_found(self):
        self.assert_found("shellcheck", ".ci/run", "#!/usr/bin/env bash\nrm $1/*\n", "SC2086")

    def test_python_that_is_not_formatted_is_found(self):
        self.assert_found("black", "scripts/b.py", "print( 'b' )\n", "scripts/b.py")

    def test_an_unused_import_is_found(self):
        self.assert_found("flake8", "tests/cli/b.py", "import os\n", "tests/cli/b.py:1:1: F401")

    def test_an_include_against_the_arrows_is_found(self):
        self.assert_found(
            "arrows", "src/sweep/b.hpp", '#include "outputs/merge.hpp"\n', "src/sweep/b.hpp:1: outputs/merge.hpp"
        )

    def test_a_warning_of_either_compiler_is_found(self):
        for compiler in ("g++", "clang++"):
            with self.subTest(compiler):
                self.assert_found(
                    compiler, "src/sweep/a.cpp", "int less(double x) { return x; }\n", "float-conversion]"
                )

    def test_all_gates_of_a_call_run_though_one_fails(self):
        self.write("scripts/b.py", "import os\nprint( 'b' )\n")
        result = self.check("black", "clang-format", "flake8")
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertEqual(
            re.findall(r"(?m)^(\S+) +(\w+) after \d+ s$", result.stdout),
            [("black", "FAILED"), ("clang-format", "passed"), ("flake8", "FAILED")],
        )

    def test_help_names_every_gate_and_installs_nothing(self):
        result = self.check("--help")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(re.findall(r"(?m)^  ([a-z]\S+)  +\w", result.stdout), [*QUICK, *LONG, *BY_NAME])
        self.assertRegex(result.stdout, rf"--quick +all but {re.escape(', '.join(LONG))};")
        self.assertRegex(result.stdout, r"(?m)^  --packages +packages,")

    def test_packages_are_a_gate_and_an_option(self):
        self.write("scripts/check_packages.sh", '#!/bin/sh\necho "tried $*"\n', 0o755)
        result = self.check("--packages")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("tried \n", result.stdout)
        self.assertRegex(result.stdout, r"(?m)^packages +passed")

    def test_an_unknown_word_is_refused_before_anything_runs(self):
        for words in (["black2"], ["--fast"], ["--quick", "none"], [""]):
            result = self.check(*words)
            self.assertEqual(result.returncode, 2, words)
            self.assertEqual(result.stdout, f"check.sh: unknown argument '{words[-1]}'; try --help\n")


class CiRun(Folder):
    def run_with(self, code_of_tests):
        """The calls of .ci/run, and its exit code, if the tests end with this one."""
        self.write(".ci/run", read(".ci/run"), 0o755)
        for name, code in (("test.sh", code_of_tests), ("check.sh", 0), ("check_packages.sh", 0)):
            self.write(f"scripts/{name}", f'#!/bin/sh\necho "{name} $*" >>"{self.root}/calls"\nexit {code}\n', 0o755)
        done = subprocess.run([self.root / ".ci" / "run"], check=False)
        return (self.root / "calls").read_text().splitlines(), done.returncode

    def test_it_calls_the_tests_and_then_the_quick_gates_and_makes_the_tarball(self):
        self.assertEqual(self.run_with(0), (["test.sh ", "check.sh --quick", "check_packages.sh --tarball"], 0))

    def test_it_ends_with_tests_that_fail(self):
        self.assertEqual(self.run_with(8), (["test.sh "], 8))


class Metadata(unittest.TestCase):
    def test_a_citation_has_what_its_format_asks_for_and_the_version_of_the_build(self):
        citation = yaml.safe_load(read("CITATION.cff"))
        self.assertEqual(citation["cff-version"], "1.2.0")
        self.assertLessEqual({"authors", "cff-version", "message", "title"}, set(citation))
        self.assertEqual(
            citation["version"], re.search(r"project\(clatter VERSION ([\d.]+)", read("CMakeLists.txt"))[1]
        )
        self.assertIn(f"{citation['license']} License", read("LICENSE"))
        self.assertIn(citation["authors"][0]["name"], read("LICENSE"))
        (paper,) = citation["references"]
        self.assertLessEqual({"authors", "title", "type"}, set(paper))
        self.assertIn(f"doi:{paper['doi']}", read("README.md"))
        for author in paper["authors"]:
            self.assertEqual(set(author), {"family-names", "given-names"})

    def test_lines_have_one_length_in_all_settings(self):
        lengths = {
            ".clang-format": r"ColumnLimit: (\d+)",
            ".flake8": r"max-line-length = (\d+)",
            ".editorconfig": r"max_line_length = (\d+)",
            "scripts/check.sh": r"line_length=(\d+)",
        }
        self.assertEqual(
            {name: re.search(pattern, read(name))[1] for name, pattern in lengths.items()},
            dict.fromkeys(lengths, "120"),
        )


if __name__ == "__main__":
    unittest.main()
