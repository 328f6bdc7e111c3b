"""Building depends on more than the sources: the folder that they are in, and the origin of the commit."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["CLATTER_SOURCE"])
CLATTER = Path(os.environ["CLATTER"])
ROOMS_OF_MOTION = "math|motion|stepping|steady|point|lanes"
SHARED = {
    "impact_map.cpp",
    "resting.cpp",
    "soft_contacts.cpp",
}  # of branches: a function each, called once a special point
ONCE_A_RUN = {"clatter::point::MotionRecorder::~MotionRecorder()"}  # so it may be slow
PROBE = """
add_executable(probe probe.cpp)
target_link_libraries(probe PRIVATE hdf5)
"""


def run(*command, folder=None):
    result = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert result.returncode == 0, (command, result.stdout)
    return result.stdout


def libraries(build):
    """The libraries that a build folder links the program with."""
    text = (build / "build.ninja").read_text(encoding="utf-8")
    statement = re.search(
        r"^build apps/clatter/clatter: (?:.*\n)(?:  .*\n)*?  LINK_LIBRARIES = (.*)$", text, re.MULTILINE
    )
    return statement[1].split()


def shared_symbols(objects):
    """The functions of motion in an object file that other files may have, too: templates and inline ones."""
    table = run("nm", "--defined-only", "--demangle", objects)
    names = re.findall(r"^\S+ [WV] (.*clatter::.*)$", table, re.MULTILINE)
    return {
        name
        for name in set(names) - ONCE_A_RUN
        if re.search(rf"clatter::({ROOMS_OF_MOTION}|observables::\w+::Observer)\b", name)
    }


class Build(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_blank_in_the_path_changes_no_library_and_hdf5_links(self):
        """CMake's own search for HDF5 lost libraries there: its compiler wrapper is a shell script."""
        source = self.folder / "my work" / "it's clatter"
        for part in ("apps", "src"):
            shutil.copytree(SOURCE / part, source / part)
        for name in ("CMakePresets.json", "LICENSE", "CHANGELOG.md", "CITATION.cff"):
            shutil.copy(SOURCE / name, source)
        lists = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")
        (source / "CMakeLists.txt").write_text(lists + PROBE, encoding="utf-8")
        (source / "probe.cpp").write_text(
            "#include <hdf5_hl.h>\nint main() { return H5open() < 0 || H5close() < 0; }\n"
        )
        run("cmake", "--preset", "release", "-DCLATTER_TESTS=OFF", folder=source)
        build = source / "build" / "release"
        run("cmake", "--build", build, "--target", "probe", "clatter_version")
        run(build / "probe")
        version = (build / "src" / "results" / "version.cpp").read_text()
        self.assertRegex(version, r'git_commit\(\) { return "(unknown|[0-9a-f]{40})"; }')
        self.assertEqual(libraries(build), libraries(CLATTER.parents[2]))

    def test_code_with_fewer_optimisations_shares_no_template_with_other_code(self):
        """Of two copies of a template the linker keeps one, perhaps the one with fewer optimisations."""
        build = CLATTER.parents[2]
        less, others = set(), {}
        for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
            words = entry["command"].split()
            compiled = words[words.index("-o") + 1]  # perhaps of several files
            if compiled.startswith(("src/", "apps/")) and compiled.endswith(".o"):
                kept = [word for word in words if re.fullmatch(r"-O\d", word)]
                symbols = shared_symbols(build / compiled)
                if kept[-1:] == ["-O1"]:
                    less |= symbols
                elif Path(entry["file"]).name not in SHARED:
                    others[compiled] = symbols
        if "CMAKE_BUILD_TYPE:STRING=Release" in (build / "CMakeCache.txt").read_text(encoding="utf-8"):
            self.assertTrue(less)  # else all is compiled alike
        self.assertGreater(len(others), 40)
        self.assertEqual({name: less & symbols for name, symbols in others.items() if less & symbols}, {})

    @unittest.skipUnless(shutil.which("git"), "there is no git here")
    def test_the_commit_is_that_of_git_or_of_the_archive(self):
        parts = (".gitattributes", "src/results/version.cmake", "src/results/version.cpp.in")
        repository, archive = self.folder / "a repository", self.folder / "an archive"
        for part in parts:
            (repository / part).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCE / part, repository / part)
        script = repository / parts[1]
        # These sources may be an archive themselves.
        script.write_text(re.sub(r'"[0-9a-f]{40}"', '"$Format:%H$"', script.read_text()))
        archive.mkdir()

        def git(*words):
            return run("git", "-c", "user.name=a", "-c", "user.email=a@b.c", *words, folder=repository).strip()

        git("init", "-q")
        self.assertEqual(self.commit(repository), "unknown")
        git("add", ".")
        git("commit", "-q", "-m", "all")
        head = git("rev-parse", "HEAD")
        git("archive", "-o", archive / "a.tar", "HEAD")
        run("tar", "-xf", "a.tar", folder=archive)
        self.assertEqual(self.commit(repository), head)
        self.assertEqual(self.commit(archive), head)
        (repository / parts[-1]).write_text("@GIT_COMMIT@\n")
        self.assertEqual(self.commit(repository), head + "-dirty")

    def commit(self, source):
        """The commit that a build of this folder would report."""
        output = self.folder / "version.cpp"
        template = self.folder / "template"
        template.write_text("@GIT_COMMIT@")
        run(
            "cmake",
            "-D",
            f"SOURCE_DIR={source}",
            "-D",
            f"TEMPLATE={template}",
            "-D",
            f"OUTPUT={output}",
            "-P",
            source / "src" / "results" / "version.cmake",
        )
        return output.read_text().strip()


if __name__ == "__main__":
    unittest.main()
