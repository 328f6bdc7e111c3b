"""The command line as shell scripts meet it: exit codes, streams, files, round trips."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

CLATTER = os.environ["CLATTER"]
SOURCE = pathlib.Path(os.environ.get("CLATTER_SOURCE", pathlib.Path(__file__).parents[2]))

SMALL = """title = "a small sweep"
[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -4.0
[sweep]
nu = "linspace(0.5, 1.5, 5)"
[observe]
extrema = true
period = true
"""


class CommandLine(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def clatter(self, *words, environment=None):
        return subprocess.run([CLATTER, *words], cwd=self.directory, capture_output=True, text=True, timeout=300,
                              env={**os.environ, **(environment or {})})

    def write(self, name, text):
        (self.directory / name).write_text(text, encoding="utf-8")
        return name

    def files(self):
        return sorted(path.name for path in self.directory.iterdir())

    def assert_refused(self, code, words, *command):
        """The command ends with this code and one line on stderr that says why; nothing on stdout, no new file."""
        before = self.files()
        result = self.clatter(*command)
        self.assertEqual(result.returncode, code, (command, result.stderr))
        self.assertIn(words, result.stderr, command)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertEqual(result.stdout, "", command)
        self.assertEqual(self.files(), before, command)


class WrongCommandLines(CommandLine):
    def test_exit_2_with_the_way_out(self):
        config = self.write("a.toml", SMALL)
        cases = [
            ([], "no command; see `clatter --help`"),
            (["rnu", config], "unknown command 'rnu'; did you mean 'run'?"),
            (["frobnicate"], "the commands are: run, plan, info, defaults, help"),
            (["--verbose"], "unknown option '--verbose' before the command"),
            (["run"], "CONFIG is missing; write: clatter run CONFIG"),
            (["run", config, config], "unexpected argument 'a.toml'"),
            (["run", config, "--thr", "2"], "unknown option '--thr'; did you mean '--threads'?"),
            (["run", config, "--thread", "2"], "unknown option '--thread'; did you mean '--threads'?"),
            (["run", config, "--ouput", "a.h5"], "did you mean '--output'?"),
            (["run", config, "--frobnicate"], "unknown option '--frobnicate'; see `clatter help run`"),
            (["run", config, "-x"], "unknown option '-x'"),
            (["run", config, "--threads"], "required argument"),
            (["run", config, "--threads", "0"], "permitted: a whole number from 1 to 1024"),
            (["run", config, "--threads", "-3"], "permitted: a whole number from 1 to 1024"),
            (["run", config, "--threads", "1025"], "permitted: a whole number from 1 to 1024"),
            (["run", config, "--threads", "2.5"], "permitted: a whole number from 1 to 1024"),
            (["run", config, "--threads", "two"], "permitted: a whole number from 1 to 1024"),
            (["run", config, "--threads", "2", "--threads", "1"], "'--threads' is given twice"),
            (["run", config, "-o", "a.h5", "-o", "b.h5"], "'--output' is given twice"),
            (["run", config, "-o", config], "is the configuration itself"),
            (["run", config, "--progress", "sometimes"], "permitted: auto, always, never"),
            (["run", config, "-q", "-v"], "--quiet beside --verbose"),
            (["run", config, "--quiet=yes"], "does not take any arguments"),
            (["run", config, "--set", "scene.R"], "is no KEY=VALUE"),
            (["run", config, "--set", "=2"], "is no KEY=VALUE"),
            (["run", config, "--set", "  =2"], "is no KEY=VALUE"),
            (["info"], "FILE.h5 is missing"),
            (["info", "a.h5", "--jsn"], "did you mean '--json'?"),
            (["info", "a.h5", "--json", "--config"], "--json beside --config"),
            (["defaults", "toml"], "unexpected argument 'toml'"),
            (["defaults", "--in"], "unknown option '--in'; did you mean '--ini'?"),
            (["help", "rnu"], "did you mean 'run'?"),
        ]
        for command, words in cases:
            with self.subTest(command=command):
                self.assert_refused(2, words, *command)

    def test_what_comes_later_is_unknown_today(self):
        config = self.write("a.toml", SMALL)
        for command in ("accuracy", "merge"):
            self.assert_refused(2, f"unknown command '{command}'", command, config)
        for option in ("--shard", "--resume", "--restart", "--max-time"):
            self.assert_refused(2, f"unknown option '{option}'", "run", config, option)
        help_texts = "".join(self.clatter("help", topic).stdout for topic in ("run", "info", "defaults", "configuration"))
        help_texts += self.clatter("--help").stdout + self.clatter("defaults").stdout
        for word in ("shard", "resume", "restart", "max-time", "dopri5", "moreau", "accuracy", "merge"):
            self.assertNotIn(word, help_texts)


class WrongConfigurations(CommandLine):
    def test_exit_2_with_file_line_and_column_and_no_output(self):
        cases = [
            ("[scene]\nxs = 1\nnuu = 1\n", "3:1: unknown key 'nuu' in [scene]; did you mean 'nu'?"),
            ("[scene]\nxs = 0\n", "2:6: xs = 0 is out of range; permitted: any number but 0"),
            ("[scene]\nxs = 1\nR = 1.5\n", "3:5: R = 1.5 is out of range; permitted: 0 ... 1"),
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

    def test_set_in_another_encoding_is_not_told_to_save_a_file(self):
        config = self.write("a.toml", SMALL)
        self.assert_refused(2, r"--set scene.R=\xff: the byte \xff is not UTF-8", "run", config, "--set", b"scene.R=\xff")

    def test_results_beyond_the_memory_are_refused_at_once(self):
        config = self.write("a.toml", SMALL)
        axes = [f"--set=sweep.{axis}=linspace(0.1, 1, 1000)" for axis in ("nu", "h", "f")]
        text = SMALL.replace("f = -1.0\n", "").replace("h = 0.1\n", "")
        self.write("huge.toml", text)
        self.assert_refused(2, "the results of 1000000000 points", "run", "huge.toml", *axes,
                            "--set", "observe.trajectory=1000000")
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

    def test_full_standard_output_is_an_error(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run([CLATTER, "defaults"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
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
        for word in ("axes  ", "5 points, 0 failed", "groups  ", "settled by ", "threads          1\n", "impacts ",
                     "forcing periods ", "evaluations ", "instruction set ", "host ", "command line ", "began ", "ended "):
            self.assertIn(word, details)

    def test_the_bar_appears_on_demand_and_without_a_terminal_only_then(self):
        config = self.write("a.toml", SMALL)
        self.assertNotIn("points/s", self.run_ok(config).stderr)
        self.assertNotIn("points/s", self.run_ok(config, "--progress", "never").stderr)
        bar = self.clatter("run", config, "--progress", "always", environment={"NO_COLOR": "1"}).stderr
        self.assertRegex(bar, r"5/5 points .* points/s .* left")
        self.assertNotIn("\033[3", bar)

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

    def test_failed_points_end_with_1_and_are_named_by_number(self):
        config = self.write("a.toml", SMALL)
        result = self.clatter("run", config, "--set", "scene.xs=-1", "--set", "time.max_impacts=1")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertRegex(result.stderr, r"^5 points, 5 failed \(number 0, 1, 2, 3, 4; see status\), ")
        self.assertIn("a.h5", self.files())

    def test_info_tells_what_is_inside(self):
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


class Plan(CommandLine):
    def plan(self, text, *words):
        config = self.write("p.toml", text)
        result = self.clatter("plan", config, "--json", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(self.files(), ["p.toml"])  # runs nothing, writes nothing
        return json.loads(result.stdout)

    def test_groups_add_up_and_give_their_reasons(self):
        plan = self.plan(SMALL, "--threads", "3")
        self.assertEqual((plan["schema"], plan["points"], plan["threads"]), ("clatter-plan/1", 5, 3))
        self.assertEqual(plan["dimensions"], [[{"key": "nu", "length": 5, "first": 0.5, "last": 1.5}]])
        self.assertEqual(plan["observed"], ["extrema", "period"])
        self.assertEqual([group["points"] for group in plan["groups"]], [4, 1])  # only nu = 1 reaches the stops
        without, with_stops = ({e["effect"]: e for e in group["effects"]} for group in plan["groups"])
        self.assertEqual(list(without), ["damping", "forcing", "resonance", "load", "lower stop", "upper stop", "dissipation",
                                         "chatter and rest"])
        self.assertFalse(without["upper stop"]["required"])
        self.assertRegex(without["upper stop"]["why"], r"^\|x\| <= \S+ < 4 for all time: out of reach$")
        self.assertTrue(with_stops["upper stop"]["required"])
        self.assertFalse(with_stops["chatter and rest"]["required"])
        self.assertEqual(plan["groups"][0]["periods"], [4, 4])  # the closed form, one period observed at each
        self.assertLess(*plan["groups"][1]["periods"])
        self.assertEqual(plan["output_bytes"], 5 * (1 + 8 + 8 + 8 * 8))
        self.assertEqual(plan["warnings"], [])

    def test_says_the_same_before_a_verbose_run(self):
        config = self.write("a.toml", SMALL)
        text = self.clatter("plan", config, "--threads", "1").stdout
        run = self.clatter("run", config, "-v", "--threads", "1").stderr
        without_times = [line for line in text.splitlines() if " s on " not in line]
        self.assertGreater(len(without_times), 20)
        for line in without_times:
            self.assertIn(line, run)

    def test_simulated_periods_lie_within_the_plan(self):
        for mode in ("required", "all"):
            config = self.write("p.toml", SMALL)
            words = ("--set", f"integrator.effects={mode}", "--set", "time.max_periods=700")
            plan = json.loads(self.clatter("plan", config, "--json", *words).stdout)
            self.assertEqual(plan["all_effects"], mode == "all")
            run = self.clatter("run", config, "-v", *words).stderr
            periods = float(run.split("\nforcing periods ")[1].split()[0])
            self.assertGreaterEqual(periods, sum(group["periods"][0] for group in plan["groups"]))
            self.assertLessEqual(periods, sum(group["periods"][1] for group in plan["groups"]))

    def test_warns_of_what_looks_unintended(self):
        far = self.plan(SMALL, "--set", "scene.xs=6")["warnings"]
        self.assertEqual(len(far), 2)
        self.assertRegex(far[0], r"^the lower stop is never reached .* 5 < 6 .*; if impacts are meant, move it nearer")
        huge = self.plan(SMALL, "--set", "sweep.x0=linspace(-1, 1, 1000000)", "--set", "sweep.nu=1, 1.1",
                         "--set", "observe.trajectory=10000000")["warnings"]
        self.assertTrue(any("larger than the memory" in warning for warning in huge), huge)
        nothing = self.plan(SMALL, "--set", "observe.extrema=false", "--set", "observe.period=false")["warnings"]
        self.assertTrue(any("nothing is observed" in warning for warning in nothing), nothing)
        lasting = self.plan(SMALL, "--set", "scene.h=0", "--set", "scene.R=1", "--set", "sweep.nu=1.3")["warnings"]
        self.assertTrue(any("never fades" in warning for warning in lasting), lasting)

    def test_a_followed_branch_knows_its_first_start_only(self):
        plan = self.plan(SMALL, "--set", "sweep.follow=nu")
        self.assertEqual(plan["follow"], "nu")
        self.assertEqual([group["points"] for group in plan["groups"]], [1, 4])
        reasons = {e["effect"]: e["why"] for e in plan["groups"][1]["effects"]}
        self.assertIn("start isn't known", reasons["lower stop"])


class Help(CommandLine):
    def test_is_data_on_stdout(self):
        for words in (["--help"], ["-h"], ["--version"], ["help"], ["help", "run"], ["run", "--help"], ["help", "plan"], ["info", "-h"],
                      ["defaults", "--help"], ["help", "help"], ["help", "configuration"]):
            result = self.clatter(*words)
            self.assertEqual((result.returncode, result.stderr), (0, ""), words)
            self.assertTrue(result.stdout, words)
            self.assertLessEqual(max(map(len, result.stdout.splitlines())), 120, words)
        self.assertRegex(self.clatter("--version").stdout, r"^clatter \d+\.\d+\.\d+ \(commit \S+, .+\)\n$")

    def test_the_readme_holds_the_reference_of_the_configuration(self):
        reference = self.clatter("help", "configuration").stdout
        self.assertIn(reference.strip(), (SOURCE / "README.md").read_text(encoding="utf-8"))

    def test_the_readme_shows_the_plan_of_a_figure(self):
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        shown = readme.split("$ clatter plan configs/fig22.toml\n")[1].split("```")[0].splitlines()
        plan = self.clatter("plan", str(SOURCE / "configs" / "fig22.toml")).stdout.splitlines()
        self.assertEqual(len(shown), len(plan))
        for ours, theirs in zip(plan, shown):
            if " s on " not in ours and not ours.startswith("memory "):  # what differs from machine to machine
                self.assertEqual(ours, theirs)


if __name__ == "__main__":
    unittest.main()
