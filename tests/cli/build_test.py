"""What building depends on besides the sources: the folder that they are in, and where the commit comes from."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["CLATTER_SOURCE"])
CLATTER = Path(os.environ["CLATTER"])
PROBE = """
add_executable(probe probe.cpp)
target_link_libraries(probe PRIVATE hdf5)
"""


def run(*command, folder=None):
    result = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert result.returncode == 0, (command, result.stdout)
    return result.stdout


def libraries(build):
    """What a build folder links the program with."""
    text = (build / "build.ninja").read_text(encoding="utf-8")
    statement = re.search(r"^build apps/clatter/clatter: (?:.*\n)(?:  .*\n)*?  LINK_LIBRARIES = (.*)$", text, re.MULTILINE)
    return statement[1].split()


class Build(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_blank_in_the_path_changes_no_library_and_hdf5_links(self):
        """CMake's own search for HDF5 lost libraries there: its compiler wrapper is a shell script."""
        source = self.folder / "my work" / "it's clatter"
        for part in ("apps", "cmake", "src"):
            shutil.copytree(SOURCE / part, source / part)
        shutil.copy(SOURCE / "CMakePresets.json", source)
        lists = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")
        (source / "CMakeLists.txt").write_text(lists + PROBE, encoding="utf-8")
        (source / "probe.cpp").write_text("#include <hdf5_hl.h>\nint main() { return H5open() < 0 || H5close() < 0; }\n")
        run("cmake", "--preset", "release", "-DCLATTER_TESTS=OFF", folder=source)
        build = source / "build" / "release"
        run("cmake", "--build", build, "--target", "probe", "clatter_version")
        run(build / "probe")
        self.assertIn('git_commit() { return "unknown"; }', (build / "src" / "io" / "version.cpp").read_text())
        self.assertEqual(libraries(build), libraries(CLATTER.parents[2]))


if __name__ == "__main__":
    unittest.main()
