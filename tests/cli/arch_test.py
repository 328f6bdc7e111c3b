"""Instruction sets: how one is chosen, that each gives the same, and that none leaks into code for old machines."""

import os
import pathlib
import re
import subprocess
import unittest

import h5py
import numpy

from command_line import CLATTER, SMALL, CommandLine, require_program, runs_here

NAMES = ("scalar", "sse2", "avx2", "avx512")
EVERYTHING = (
    SMALL.replace("xs = -4.0", "xs = -3.5").replace("1.5, 5)", "1.5, 41)")
    + """impacts = true
harmonics = 3
harmonics_method = "exact"
"""
)


class Arch(CommandLine):
    def run_with(self, *words, variable=None, text=SMALL):
        config = self.write("a.toml", text)
        result = self.clatter("run", config, "-q", *words, environment={"CLATTER_ARCH": variable or ""})
        self.assertEqual((result.returncode, result.stderr), (0, ""), words)
        with h5py.File(self.directory / "a.h5") as file:
            return {name: file[name][...] for name in file if isinstance(file[name], h5py.Dataset)}

    def assert_same_bits(self, a, b):
        self.assertEqual(a.keys(), b.keys())
        for name in a:
            self.assertEqual(a[name].tobytes(), b[name].tobytes(), name)

    def test_every_name_is_taken_by_option_and_by_variable(self):
        for name in filter(runs_here, NAMES):
            self.assert_same_bits(self.run_with("--arch", name), self.run_with(variable=name))

    def test_one_that_the_machine_lacks_is_refused(self):
        config = self.write("a.toml", SMALL)
        for name in NAMES:
            if not runs_here(name):
                self.assert_refused(
                    2, f"--arch '{name}': this machine doesn't have it; its widest is ", "run", config, "--arch", name
                )

    def test_a_wrong_name_is_refused(self):
        config = self.write("a.toml", SMALL)
        expected = "expected one of scalar, sse2, avx2, avx512"
        for name in ("AVX2", "avx", "", " sse2", "best"):
            self.assert_refused(2, f"--arch '{name}'; {expected}\n", "run", config, "--arch", name)
        result = self.clatter("run", config, environment={"CLATTER_ARCH": "avx1024"})
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn(f"CLATTER_ARCH='avx1024'; {expected}\n", result.stderr)
        self.assertEqual(self.files(), ["a.toml"])

    def test_the_option_counts_before_the_variable(self):
        chosen = self.run_with("--arch", "scalar", variable="no such name", text=EVERYTHING)
        self.assert_same_bits(chosen, self.run_with("--arch", "scalar", text=EVERYTHING))
        lanes = self.run_with("--arch", "sse2", variable="scalar", text=EVERYTHING)
        self.assertNotEqual(lanes["v_max"].tobytes(), chosen["v_max"].tobytes())  # or this test couldn't fail

    def test_an_empty_variable_is_none(self):
        config = self.write("a.toml", SMALL)
        environment = {name: value for name, value in os.environ.items() if name != "CLATTER_ARCH"}
        subprocess.run([CLATTER, "run", config, "-q", "-o", "none.h5"], cwd=self.directory, env=environment, check=True)
        with h5py.File(self.directory / "none.h5") as file:
            x_max = file["x_max"][...]
        self.assertEqual(self.run_with(variable="")["x_max"].tobytes(), x_max.tobytes())

    def test_every_set_gives_the_same_motion(self):
        self.compare_sets(EVERYTHING)

    def test_every_set_gives_the_same_motion_between_soft_stops(self):
        soft = EVERYTHING.replace("xs = -3.5", "xs = -3.5\nstop_stiffness = 50.0\nstop_damping = 0.1")
        self.compare_sets("".join(line for line in soft.splitlines(True) if not line.startswith("R = ")))

    def compare_sets(self, text):
        default = self.run_with(text=text)
        periodic = default["status"] == 0
        self.assertGreater(periodic.sum(), 30)
        for name in filter(runs_here, NAMES):
            other = self.run_with("--arch", name, text=text)
            numpy.testing.assert_array_equal(other["status"], default["status"])
            for counted in ("impacts_per_period", "period_ratio"):
                numpy.testing.assert_array_equal(
                    other[counted][periodic], default[counted][periodic], f"{name}: {counted}"
                )
            for measured in (
                "x_min",
                "x_max",
                "v_min",
                "v_max",
                "v_before",
                "v_after",
                "impact_speed",
                "x_amplitude",
                "v_amplitude",
            ):
                numpy.testing.assert_allclose(
                    other[measured][periodic],
                    default[measured][periodic],
                    rtol=0,
                    atol=1e-12,
                    err_msg=f"{name}: {measured}",
                )


class Objects(unittest.TestCase):
    """The linker keeps one of equal functions: one that AVX code leaves behind could be what every machine runs."""

    def symbols(self, name):
        """Of each object with step functions: springs, motion without one, soft stops."""
        require_program("nm", "binutils")
        folder = pathlib.Path(CLATTER).parents[2] / "src" / "lanes"
        objects = list(folder.glob(f"CMakeFiles/*_{name}.dir/step_*block.cpp.o"))
        self.assertEqual(len(objects), 3, f"step functions for {name}")
        for path in objects:
            text = subprocess.run(["nm", "--defined-only", path], capture_output=True, text=True, check=True).stdout
            yield path.name, [line.split()[-2:] for line in text.splitlines()]

    def test_step_functions_define_nothing_that_code_of_another_set_could_be_merged_with(self):
        entries = set()
        for name, tag in (("avx2", r"5xsimd.*4avx2"), ("avx512", r"5xsimd.*avx512")):
            for path, symbols in self.symbols(name):
                functions = {symbol for kind, symbol in symbols if kind in "TWui"}
                entry = rf"_ZN7clatter5lanes\d+step(_\w+)?_{name}ERNS0_10BlockStateE"
                own = {symbol for symbol in functions if re.fullmatch(entry, symbol)}
                self.assertTrue(own, functions)
                entries |= own
                shared = [symbol for symbol in functions - own if not re.search(tag, symbol)]
                self.assertEqual(shared, [], f"{name}, {path}: the linker could take these for those of other objects")
        self.assertEqual(len(entries), 10, entries)  # those of soft stops observe nothing


if __name__ == "__main__":
    unittest.main()
