"""The command line as shell scripts meet it: exit codes, streams, files, round trips."""

import json
import os
import re
import subprocess
import unittest

import h5py
import numpy
from command_line import CLATTER, LONGEST, SMALL, CommandLine


class WrongCommandLines(CommandLine):
    def test_exit_2_with_the_way_out(self):
        config = self.write("a.toml", SMALL)
        cases = [
            ([], "no command; see `clatter --help`"),
            (["rnu", config], "unknown command 'rnu'; did you mean 'run'?"),
            (
                ["frobnicate"],
                "the commands are: run, plan, accuracy, branch, merge, export, certify, info, init, defaults, help",
            ),
            (
                ["--verbose"],
                "unknown option '--verbose' before the command; write it behind: clatter COMMAND ... --verbose",
            ),
            (["--verb", "run", config], "unknown option '--verb' before the command; write it behind"),
            (["--versoin"], "unknown option '--versoin' before the command; did you mean '--version'?"),
            (["--xyzzyxyzzy"], "unknown option '--xyzzyxyzzy' before the command; see `clatter --help`"),
            (["run"], "CONFIG is missing; write: clatter run CONFIG"),
            (["run", config, config], "unexpected argument 'a.toml'"),
            (["run", config, "--thr", "2"], "unknown option '--thr'; did you mean '--threads'?"),
            (["run", config, "--thread", "2"], "unknown option '--thread'; did you mean '--threads'?"),
            (["run", config, "--verb"], "unknown option '--verb'; did you mean '--verbose'?"),
            (["run", config, "-verb"], "unknown option '-verb'; did you mean '--verbose'?"),
            (["plan", config, "--js"], "unknown option '--js'; did you mean '--json'?"),
            (["merge", "--verb", "a.h5"], "unknown option '--verb'; did you mean '--verbose'?"),
            (["run", config, "--ouput", "a.h5"], "did you mean '--output'?"),
            (["run", config, "--frobnicate"], "unknown option '--frobnicate'; see `clatter help run`"),
            (["run", config, "-x"], "unknown option '-x'"),
            (["run", config, "--threads"], "required argument"),
            (["run", config, "--threads", "0"], "expected a whole number from 1 to 1024"),
            (["run", config, "--threads", "-3"], "expected a whole number from 1 to 1024"),
            (["run", config, "--threads", "1025"], "expected a whole number from 1 to 1024"),
            (["run", config, "--threads", "2.5"], "expected a whole number from 1 to 1024"),
            (["run", config, "--threads", "two"], "expected a whole number from 1 to 1024"),
            (["run", config, "--threads", "2", "--threads", "1"], "'--threads' is given twice"),
            (["run", config, "-o", "a.h5", "-o", "b.h5"], "'--output' is given twice"),
            (["run", config, "-o", config], "is the configuration itself"),
            (["run", config, "--progress", "sometimes"], "expected one of auto, always, never"),
            (["run", config, "-q", "-v"], "--quiet conflicts with --verbose"),
            (["run", config, "--quiet=yes"], "does not take any arguments"),
            (["run", config, "--set", "scene.R"], "is not KEY=VALUE"),
            (["run", config, "--set", "=2"], "is not KEY=VALUE"),
            (["run", config, "--set", "  =2"], "is not KEY=VALUE"),
            (["info"], "FILE.h5 is missing"),
            (["info", "a.h5", "--jsn"], "did you mean '--json'?"),
            (["info", "a.h5", "--json", "--config"], "--json conflicts with --config"),
            (["info", "a.h5", "--check", "--config"], "--config conflicts with --check"),
            (["export"], "FILE.h5 is missing"),
            (["export", "a.h5", "--ony", "x"], "did you mean '--only'?"),
            (["export", "a.h5", "--only", "x_max,"], "--only 'x_max,' has an empty name"),
            (["export", "a.h5", "--where", "nu"], "--where 'nu'; expected e.g. nu=1.0,"),
            (["export", "a.h5", "--where", "nu=1one"], "unknown unit 'one'"),
            (["export", "a.h5", "--where", "=1"], "--where '=1'; expected e.g. nu=1.0"),
            (["defaults", "toml"], "unexpected argument 'toml'"),
            (["defaults", "--in"], "unknown option '--in'; did you mean '--ini'?"),
        ]
        for command, words in cases:
            with self.subTest(command=command):
                self.assert_refused(2, words, *command)


class WrongConfigurations(CommandLine):
    def test_exit_2_with_file_line_and_column_and_no_output(self):
        cases = [
            ("[scene]\nxs = 1\nnuu = 1\n", "3:1: unknown key 'nuu' in [scene]; did you mean 'nu'?"),
            ("[scene]\nxs = 0\n", "2:6: xs = 0 is out of range; expected any number but 0"),
            ("[scene]\nxs = 1\nR = 1.5\n", "3:5: R = 1.5 is out of range; expected 0 ... 1"),
            ("[scene]\nxs = 1\nx0 = 2\n", "3:6: x0 = 2 and |xs| = 1"),
            ("[scene]\nf = 1\n", "1:2: 'xs' is missing"),
            ("[scene]\nxs = 1\n[time]\nwindow = 0\n", "4:10: window = 0 is out of range"),
        ]
        for text, words in cases:
            for name in ("wrong.toml", "wrong.ini"):
                with self.subTest(text=text, name=name):
                    self.write(name, text)
                    self.assert_refused(2, f"{name}:{words}", "run", name)
                    self.assert_refused(2, f"{name}:{words}", "run", name, "-o", "out.h5")

    def test_set_names_its_words(self):
        config = self.write("a.toml", SMALL)
        self.assert_refused(2, "--set scene.R=2: R = 2 is out of range", "run", config, "--set", "scene.R=2")
        self.assert_refused(2, "--set scene.Q=2: unknown key 'Q' in [scene]", "run", config, "--set", "scene.Q=2")

    def test_an_axis_in_the_scene_and_a_decimal_comma_are_told_apart(self):
        config = self.write("a.toml", SMALL)
        axis = "several values are an axis"
        for name in ("wrong.toml", "wrong.ini"):
            self.write(name, "[scene]\nxs = 1\nh = [0.05, 0.1]\n")
            self.assert_refused(2, f"{name}:3:5: h = ", "run", name)
            self.assert_refused(2, f"{axis}, and its line belongs in [sweep]", "run", name)
            self.write(name, "[scene]\nxs = 1\nh = 0,1\n")
            self.assert_refused(2, "a decimal comma? write 0.1", "run", name)
        self.assert_refused(2, axis + ": --set sweep.h='0.05, 0.1'", "run", config, "--set", "scene.h=0.05, 0.1")
        self.assert_refused(2, "a decimal comma? write 0.1", "run", config, "--set", "scene.h=0,1")

    def test_set_in_another_encoding_is_not_told_to_save_a_file(self):
        config = self.write("a.toml", SMALL)
        self.assert_refused(
            2, r"--set scene.R=\xff: the byte \xff is not UTF-8", "run", config, "--set", b"scene.R=\xff"
        )

    def test_results_beyond_the_disk_are_refused_at_once(self):
        config = self.write("a.toml", SMALL)
        axes = [f"--set=sweep.{axis}=linspace(0.1, 1, 1000)" for axis in ("nu", "h", "f")]
        text = SMALL.replace("f = -1.0\n", "").replace("h = 0.1\n", "")
        self.write("huge.toml", text)
        for command in ("run", "plan"):
            self.assert_refused(
                74,
                "not enough disk space: the results take",
                command,
                "huge.toml",
                *axes,
                "--set",
                "observe.trajectory=1000000",
            )
        result = self.clatter("run", config, "--set", "observe.trajectory=2")
        self.assertEqual(result.returncode, 0, result.stderr)


class Files(CommandLine):
    def test_exit_74_with_name_and_reason(self):
        config = self.write("a.toml", SMALL)
        (self.directory / "folder").mkdir()
        (self.directory / "nul.toml").write_bytes(b"[scene]\0")
        self.write("text.h5", "no HDF5")
        cases = [
            (["run", "none.toml"], "none.toml: cannot be read: No such file or directory"),
            (["run", "folder"], "folder: cannot be read: it is a directory"),
            (["run", "nul.toml"], "nul.toml: cannot be read: it holds NUL bytes"),
            (["run", config, "-o", "none/a.h5"], "none"),
            (["run", config, "-o", "folder"], "folder"),
            (["info", "none.h5"], "none.h5"),
            (["info", "text.h5"], "text.h5"),
            (["info", "folder"], "folder"),
        ]
        for command, words in cases:
            with self.subTest(command=command):
                self.assert_refused(74, words, *command)

    def test_a_damaged_output_is_said_to_be_so_without_doubt(self):
        self.clatter("run", self.write("a.toml", SMALL))
        whole = (self.directory / "a.h5").read_bytes()
        for length in (100, 2000, len(whole) - 100):  # in the second, a heap of texts is damaged
            (self.directory / "cut.h5").write_bytes(whole[:length])
            self.assert_refused(74, "'cut.h5': cannot be read: ", "info", "cut.h5")
            self.assertRegex(
                self.clatter("info", "cut.h5").stderr, r"; copy it again, or run its configuration again\n$"
            )

    def test_closed_standard_output_is_an_error(self):
        result = subprocess.run(
            [CLATTER, "defaults"], preexec_fn=lambda: os.close(1), stderr=subprocess.PIPE, text=True
        )
        self.assertEqual(result.returncode, 74, result.stderr)
        self.assertIn("standard output cannot be written", result.stderr)

    def test_full_standard_output_is_an_error(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run(
                [CLATTER, "defaults"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=LONGEST
            )
        self.assertEqual(result.returncode, 74)
        self.assertIn("standard output", result.stderr)


class Run(CommandLine):
    def run_ok(self, *words):
        result = self.clatter("run", *words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def bytes_of(self, name):
        return (self.directory / name).read_bytes()

    def test_the_output_is_named_by_the_configuration_and_stands_here(self):
        (self.directory / "folder").mkdir()
        self.write("folder/small.toml", SMALL)
        result = self.run_ok("folder/small.toml")
        self.assertEqual(self.files(), ["folder", "small.h5"])
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"^5 points, 0 failed, [0-9.e-]+ s, small\.h5\n$")

    def test_quiet_says_nothing_and_verbose_says_how(self):
        config = self.write("a.toml", SMALL)
        self.assertEqual(self.run_ok(config, "-q").stderr, "")
        details = self.run_ok(config, "-v", "--threads", "1").stderr
        for word in (
            "axes  ",
            "5 points, 0 failed",
            "groups  ",
            "settled: ",
            "threads          1\n",
            "impacts ",
            "forcing periods ",
            "evaluations ",
            "instruction set ",
            "host ",
            "command line ",
            "began ",
            "ended ",
        ):
            self.assertIn(word, details)

    def test_the_summary_has_the_time_of_the_whole_command(self):
        """Writing included: on one thread no command takes less time than its processor time."""
        config = self.write("a.toml", SMALL.replace("1.5, 5)", "1.5, 400000)"))
        command = [CLATTER, "run", config, "--threads", "1", "--set", "scene.xs=-9", "--progress", "never"]
        with subprocess.Popen(command, cwd=self.directory, stderr=subprocess.PIPE, text=True) as process:
            told = process.stderr.read()
            _, _, used = os.wait4(process.pid, 0)
        within = float(re.search(r"0 failed, (\S+) s, ", told)[1])
        self.assertGreater(within, 0.9 * (used.ru_utime + used.ru_stime))

    def test_the_same_bytes_for_every_number_of_threads(self):
        config = self.write("a.toml", SMALL)
        self.run_ok(config, "--threads", "1", "-o", "1.h5")
        self.run_ok(config, "--threads", "2", "-o", "2.h5")
        self.run_ok(config, "--threads=7", "-o3.h5")
        self.assertEqual(self.bytes_of("1.h5"), self.bytes_of("2.h5"))
        self.assertEqual(self.bytes_of("1.h5"), self.bytes_of("3.h5"))

    def test_the_defaults_run(self):
        for name, words in (("d.toml", ["defaults"]), ("d.ini", ["defaults", "--ini"])):
            result = self.clatter(*words)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.write(name, result.stdout)
            self.run_ok(name, "-o", name + ".h5")
        self.assertEqual(self.bytes_of("d.toml.h5"), self.bytes_of("d.ini.h5"))

    def test_the_configuration_in_the_file_gives_the_same_file(self):
        config = self.write("a.toml", SMALL)
        self.run_ok(config, "--set", "scene.R=0.5", "--set", "sweep.phase=0,pi", "--set", "title='\"ä\" \\'")
        result = self.clatter("info", "a.h5", "--config")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.write("again.toml", result.stdout)
        self.run_ok("again.toml")
        self.assertEqual(self.bytes_of("again.h5"), self.bytes_of("a.h5"))

    def test_a_finished_output_is_replaced_and_an_error_leaves_it_alone(self):
        config = self.write("a.toml", SMALL)
        self.run_ok(config)
        before = self.bytes_of("a.h5")
        self.assert_refused(2, "out of range", "run", config, "--set", "scene.R=2")
        self.assertEqual(self.bytes_of("a.h5"), before)
        self.run_ok(config, "--set", "scene.R=0.5")
        self.assertNotEqual(self.bytes_of("a.h5"), before)

    def test_failed_points_end_with_1_and_are_told_by_status_with_an_example(self):
        config = self.write("a.toml", SMALL)
        fail = ["--set", "scene.xs=-1", "--set", "time.max_impacts=1"]
        result = self.clatter("run", config, *fail)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertRegex(
            result.stderr, r"^5 points, 5 failed \(event_budget: 5, e\.g\. point 0 at nu = 0\.5\), [0-9.e-]+ s, "
        )
        self.assertIn("a.h5", self.files())
        one = self.clatter("run", config, *fail, "--set", "scene.nu=1").stderr
        self.assertRegex(one, r"(?m)^1 point, 1 failed \(event_budget: 1, e\.g\. point 0\), ")

    def test_each_status_of_failed_points_is_told(self):
        config = self.write("a.toml", SMALL)
        result = self.clatter(
            "run", config, "--set", "scene.xs=-1", "--set", "sweep.v0=1, 1e308", "--set", "time.max_impacts=3"
        )
        self.assertEqual(result.returncode, 1, result.stderr)
        with h5py.File(self.directory / "a.h5") as file:
            status = file["status"][()]
            nu, v0 = file["nu"][()], file["v0"][()]
        names = {16: "event_budget", 17: "not_finite", 18: "unresolved"}
        kinds = [value for value in names if (status == value).any()]
        self.assertGreater(len(kinds), 1, status)
        texts = []
        for value in kinds:
            i, j = numpy.argwhere(status == value)[0]
            texts.append(
                f"{names[value]}: {(status == value).sum()}, e.g. point {i * status.shape[1] + j} "
                f"at nu = {nu[i]:.10g}, v0 = {v0[j]:.10g}"
            )
        self.assertIn(f"{(status > 15).sum()} failed ({'; '.join(texts)})", result.stderr)

    def test_failed_points_of_shards_have_their_number_in_the_sweep(self):
        config = self.write("a.toml", SMALL)
        fail = ["--set", "scene.xs=-1", "--set", "time.max_impacts=1"]
        said = [self.clatter("run", config, *fail, "--shard", f"{k}/2").stderr for k in (0, 1)]
        self.assertIn("3 failed (event_budget: 3, e.g. point 0 at nu = 0.5)", said[0])
        self.assertIn("2 failed (event_budget: 2, e.g. point 1 at nu = 0.75)", said[1])
        merged = self.clatter("merge", "-o", "m.h5", "a.0-of-2.h5", "a.1-of-2.h5")
        self.assertEqual(merged.returncode, 1)
        self.assertIn("5 points of 2 shards, 5 failed (event_budget: 5, e.g. point 0 at nu = 0.5), m.h5", merged.stderr)

    def test_info_tells_the_contents(self):
        config = self.write("a.toml", SMALL)
        self.run_ok(config)
        text = self.clatter("info", "a.h5")
        self.assertEqual((text.returncode, text.stderr), (0, ""))
        for word in ("a small sweep", "clatter/1", "x_min", "[nu = 5]", "periodic"):
            self.assertIn(word, text.stdout)
        summary = json.loads(self.clatter("info", "--json", "a.h5").stdout)
        self.assertEqual(summary["attributes"]["title"], "a small sweep")
        self.assertEqual(sum(summary["status"].values()), 5)
        shapes = {variable["name"]: variable["shape"] for variable in summary["variables"]}
        self.assertEqual(shapes["x_min"], [5])

    def test_info_lets_no_control_characters_of_the_file_through(self):
        title = "a\x1b]0;owned\x07\n\x7f\u009b31m ä"
        config = self.write("a.toml", "title = " + json.dumps(title) + "\n" + SMALL.partition("\n")[2])
        self.run_ok(config)
        text = self.clatter("info", "a.h5").stdout
        self.assertIn(r"a\x1b]0;owned\x07\x0a\x7f\xc2\x9b31m ä", text)
        self.assertEqual([c for c in text if c < " " and c != "\n" or "\x7f" <= c < "\xa0"], [])
        summary = self.clatter("info", "a.h5", "--json").stdout
        self.assertEqual([c for c in summary if c < " " and c != "\n" or c == "\x7f"], [])
        self.assertEqual(json.loads(summary)["attributes"]["title"], title)
        config_text = self.clatter("info", "a.h5", "--config").stdout
        self.assertEqual(config_text, json.loads(summary)["attributes"]["config"])


if __name__ == "__main__":
    unittest.main()
