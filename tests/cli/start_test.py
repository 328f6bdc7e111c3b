"""At its start the program loads nothing from the working directory, and no libraries that it never calls."""

import os
import re
import subprocess
import unittest

from command_line import CLATTER, LONGEST, SMALL, CommandLine, require_program


class Start(CommandLine):
    def setUp(self):
        super().setUp()
        require_program("readelf", "binutils")
        require_program("ldd", "libc-bin")

    def dynamic(self, entry):
        """The values in brackets of the program's dynamic entries of this name."""
        text = subprocess.run(
            ["readelf", "--dynamic", "--wide", CLATTER], capture_output=True, text=True, check=True
        ).stdout
        return re.findall(rf"\({entry}\).*\[(.*)\]", text)

    def test_no_run_path_has_an_empty_entry(self):
        for path in self.dynamic("RUNPATH") + self.dynamic("RPATH"):
            self.assertNotIn("", path.split(":"), path)

    def test_libraries_of_the_network_are_not_loaded(self):
        done = subprocess.run(["ldd", CLATTER], capture_output=True, text=True, check=True)
        self.assertIn("libc.so", done.stdout)
        for library in ("curl", "ssl", "crypto", "ldap", "krb5", "gnutls"):
            self.assertNotIn(f"lib{library}", done.stdout)

    def test_a_library_in_the_working_directory_is_not_taken(self):
        config = self.write("a.toml", SMALL)
        for name in self.dynamic("NEEDED"):
            self.write(name, "not a library")
        environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}
        done = subprocess.run(
            [CLATTER, "run", config],
            cwd=self.directory,
            env=environment,
            capture_output=True,
            text=True,
            timeout=LONGEST,
        )
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
