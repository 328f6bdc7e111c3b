"""clatter-verify proves what clatter certifies, and refutes what is wrong, though it shares no source with it.

Environment: CLATTER and CLATTER_VERIFY, the programs; CLATTER_SOURCE, the source directory; CLATTER_VERIFIED, the
number of random scenes, and of them all points of shipped configurations if it is above 1000.
"""

import collections
import json
import os
import shutil
import subprocess
import time
import unittest

from carrying_scenes import carrying_scenes
from certified_runs import VERIFY, certificates_in, certified, random_certificates, verified
from command_line import LONGEST, SOURCE, CommandLine
from forgeries import FORGERIES, forged
from malformed_certificates import MALFORMED, RIGHT
from random_scenes import close_scenes, compliant_scenes, pressing_scenes, random_scenes, rubbed_scenes
from shipped import COARSER

SCENES = int(os.environ.get("CLATTER_VERIFIED", "150"))
IS_LONG = SCENES > 1000
AT_ONCE = 2000  # scenes of a configuration, which may have 1 MiB
FIGURES = [f"fig{number}" for number in range(14, 24)]

RESTS = """[scene]
f = -1.0
h = 0.1
R = 0.7
[sweep]
nu = "linspace(0.4, 1.2, 9)"
xs = "linspace(0.05, 0.25, 3)"
"""

SOFT = """[scene]
f = -1.0
h = 0.1
xs = -0.5
stop_stiffness = 30
stop_damping = 0.1
[sweep]
nu = "linspace(0.5, 1.5, 21)"
"""

ROUGH = """[scene]
f = 1.0
h = 0.05
R = 0.7
xs = 0.5
friction_static = 0.25
[sweep]
nu = "linspace(0.6, 1.8, 7)"
friction = [0.1, 0.2]
"""

QUIET = """[scene]
f = 0.2
h = 0.1
nu = 0.7
{}
xs = 1
x0 = 0.9
[sweep]
load = [-5, 0, 5]
[observe]
word = true
"""

TRANSIENT = """[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -0.5
[sweep]
nu = "linspace(0.7, 1.3, 4)"
[time]
mode = "transient"
duration = 25
"""

INELASTIC = """[scene]
f = 1.0
h = 0.1
R = 0
xs = 0.3
[sweep]
nu = "linspace(0.3, 3.3, 7)"
load = [0, 0.5]
friction = [0, 0.1]
"""

HOUSED = """[scene]
h = 0.05
f = 1.0
loose_mass = 0.3
loose_gap = 0.6
[sweep]
nu = [0.5, 0.8]
loose_R = [0.4, 0.8]
"""

HOUSED_TRANSIENT = """[scene]
h = 0.05
f = 1.0
loose_mass = 0.3
loose_lower = -0.5
loose_load = -0.6
nu = 0.8
[sweep]
loose_R = [0, 0.4, 0.8]
[time]
mode = "transient"
duration = 20
"""


@unittest.skipUnless(VERIFY, "Arb wasn't found when the build was configured, so there is no clatter-verify")
class Verify(CommandLine):
    def verify(self, *words, text=None):
        return subprocess.run(
            [VERIFY, *words],
            input=text,
            cwd=self.directory,
            capture_output=True,
            text=True,
            timeout=LONGEST,
            check=False,
        )

    def certificates(self, name, config, *words, settings=()):
        """The file of the certificates of a configuration, a text or a path, with other settings."""
        if isinstance(config, str):
            config = self.write(f"{name}.toml", config)
        output, file = self.directory / f"{name}.h5", self.directory / f"{name}.jsonl"
        sets = (word for setting in settings for word in ("--set", setting))
        result = self.clatter("run", config, "-q", "-o", output, *sets)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        certified(output, file, *words)
        return file

    def assert_proved(self, found, at_least, undecided=0):
        self.assertEqual((found["refuted"], found["malformed"]), (0, 0), found["claims"])
        self.assertLessEqual(found["undecided"], undecided, found["claims"])
        self.assertGreaterEqual(found["proved"], at_least)

    def test_every_periodic_point_of_the_figures_is_proved(self):
        files = [self.certificates(name, SOURCE / f"configs/{name}.toml") for name in FIGURES]
        self.assert_proved(verified(*files), 1900)  # their number depends on the instruction set

    def test_points_of_every_shipped_configuration_are_proved(self):
        others = sorted(set(SOURCE.glob("configs/*.toml")) - {SOURCE / f"configs/{name}.toml" for name in FIGURES})
        sample = () if IS_LONG else ("--sample", "12")
        files = []
        for config in others:
            if config.stem.startswith("accuracy"):
                continue
            settings = () if IS_LONG else COARSER.get(config.stem, ())
            file = self.certificates(config.stem, config, *sample, settings=settings)
            if file.stat().st_size > 0:  # else no point of it has a claim: it has no force
                files.append(file)
        self.assertGreater(len(files), 20)
        self.assert_proved(verified(*files), 200)

    def test_branches_are_proved_with_their_special_points(self):
        """Each unstable point, too; beside grazes of soft stops a few special points stay undecided."""
        for config in sorted(SOURCE.glob("configs/*.toml")):
            if "\n[branch]" not in config.read_text(encoding="utf-8"):
                continue
            with self.subTest(config.name):
                result = self.clatter("branch", config, "-q", "-o", "b.h5", "--force")
                self.assertEqual(result.returncode, 0, result.stderr)
                file = self.directory / f"{config.stem}.branch.jsonl"
                certified(self.directory / "b.h5", file, *(() if IS_LONG else ("--sample", "30")))
                undecided = 12 if config.stem == "soft_branch" else 0
                # of special points with a loose mass there is no claim
                self.assert_proved(verified(file), 25 if config.stem == "energy_sink_branch" else 30, undecided)

    def test_random_scenes_are_proved(self):
        few = SCENES // 4
        for name, scenes in (
            ("any", random_scenes(SCENES, seed=43)),
            ("compliant", compliant_scenes(few, seed=44)),
            ("close", close_scenes(few, seed=45)),
            ("pressing", pressing_scenes(few, seed=46)),
            ("rough", rubbed_scenes(2 * few, seed=47)),
            ("carrying", carrying_scenes(few if IS_LONG else 20, seed=48)),
        ):
            for first in range(0, len(scenes), AT_ONCE):
                self.prove_scenes(f"{name}_{first}", scenes[first : first + AT_ONCE])

    def prove_scenes(self, name, scenes):
        for file in random_certificates(self.directory / name, scenes):
            with self.subTest(file):
                count = len(certificates_in(file))
                self.assertGreater(count, len(scenes) // 4)
                self.assert_proved(verified(file), 0.98 * count, undecided=count // 50)
        shutil.rmtree(self.directory / name)

    def test_every_forgery_is_refuted(self):
        lines, kinds = [], []
        for name, config in (
            ("rests", RESTS),
            ("soft", SOFT),
            ("transient", TRANSIENT),
            ("rough", ROUGH),
            ("inelastic", INELASTIC),
            ("housed", HOUSED),
            ("housed_transient", HOUSED_TRANSIENT),
        ):
            file = self.certificates(name, config)
            self.assert_proved(verified(file), 1)
            for certificate in certificates_in(file):
                for kind, forgery in forged(certificate):
                    lines.append(json.dumps(forgery)), kinds.append(kind)
        self.clatter("branch", SOURCE / "configs/branch.toml", "-q", "-o", "b.h5")
        certified(self.directory / "b.h5", self.directory / "b.jsonl", "--sample", "20")
        for certificate in certificates_in(self.directory / "b.jsonl"):
            if certificate["claim"] == "special":
                for kind, forgery in forged(certificate):
                    lines.append(json.dumps(forgery)), kinds.append(kind)
        (self.directory / "forged.jsonl").write_text("\n".join(lines) + "\n", encoding="utf-8")
        found = verified(self.directory / "forged.jsonl")
        verdicts = {claim["line"]: claim["verdict"] for claim in found["claims"]}
        missed = collections.Counter(
            kind for number, kind in enumerate(kinds, 1) if verdicts.get(number, "proved") != "refuted"
        )
        self.assertEqual(missed, {})
        self.assertEqual(set(kinds), {forge.__name__ for forge in FORGERIES})

    def test_where_motion_without_impacts_stays_is_proved_and_other_words_are_refuted(self):
        files = [self.certificates(stop[:4], QUIET.format(stop)) for stop in ("stop_stiffness = 20", "R = 0.5")]
        certificates = [certificate for file in files for certificate in certificates_in(file)]
        words = ["(L)", "-", "(U)"]
        self.assertEqual([certificate["word"] for certificate in certificates], [*words, *words])
        for certificate in certificates:
            for word in (*words, "L", ""):
                result = self.verify("-", text=json.dumps({**certificate, "word": word}))
                self.assertEqual(result.returncode, 0 if word in (certificate["word"], "") else 1, result.stdout)
                if result.returncode:
                    self.assertIn(f"word: claimed '{word}', found '{certificate['word']}'", result.stdout)

    def test_a_scene_that_is_symmetric_to_24_digits_only_proves_no_symmetry(self):
        for certificate in certificates_in(self.certificates("soft", SOFT)):
            if certificate.get("symmetric") and certificate["events"]:
                break
        self.assertEqual(self.verify("-", text=json.dumps(certificate)).returncode, 0)
        certificate["scene"]["upper"]["damping"] = "0.1000000000000000055511152"
        result = self.verify("-", text=json.dumps(certificate))
        self.assertRegex(result.stdout, "symmetric: (claimed true, found false|the scene isn't, to its last digit)")

    def test_a_start_that_its_own_period_stretches_is_claimed_no_closer_than_it_is_known(self):
        """The whole period contracts to 1e-43, but its last contacts stretch rounding to 1e-8 of the start."""
        scene = {
            "R_upper": 1.0,
            "f": 1.0,
            "nu": 0.7148252167432724,
            "phase": -0.00815187300817577,
            "stiffness": -0.04505265424297162,
            "stop_damping_lower": 0.2863966953943423,
            "stop_lower": -0.731740573404287,
            "stop_stiffness_lower": 81492.90561961803,
            "stop_upper": 0.06380606063950439,
            "v0": -0.6280902265490824,
            "x0": -0.9019230710144587,
        }
        lines = "".join(f"{key} = {value!r}\n" for key, value in scene.items())
        file = self.certificates("stretched", f"[scene]\n{lines}[observe]\nextrema = true\nperiod = true\n")
        if file.read_text(encoding="utf-8"):  # else it is counted as lost in rounding
            self.assert_proved(verified(file), 0, undecided=1)

    def test_each_malformed_certificate_is_told_with_its_place_and_the_way_out(self):
        for certificate, words in MALFORMED:
            line = certificate if isinstance(certificate, str) else json.dumps(certificate)
            result = self.verify("-", text=f"\n{line}\n")
            self.assertEqual(result.returncode, 2, line[:200])
            self.assertRegex(result.stderr, f"^stdin:2: .*{words}")
            self.assertEqual(result.stderr.count("\n"), 1)

    def test_exit_codes_and_counts(self):
        right, wrong = json.dumps(RIGHT), json.dumps({**RIGHT, "end": {**RIGHT["end"], "x": [1, 1e-3]}})
        near = {"event": "impact", "stop": "lower", "time": [0.0999, 1], "v": [0, 1]}
        self.assertEqual(self.verify("-", text=right).stdout, "1 proved, 0 refuted, 0 undecided\n")
        result = self.verify("-", text=f"{right}\n{wrong}\n{right}\n")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(
            result.stdout, r"^stdin:2: point 3: refuted: end, x: claimed 1 to 0.001, found .*\n2 proved, 1 refuted, 0 "
        )
        result = self.verify("-", text=json.dumps({**RIGHT, "events": [near]}))
        self.assertRegex(result.stdout, "refuted: event 1, impact at the lower stop: claimed, found no further event")

    def test_what_is_refuted_counts_before_all_else_and_no_file_hides_another(self):
        wrong = json.dumps({**RIGHT, "end": {**RIGHT["end"], "x": [1, 1e-3]}})
        self.write("wrong.jsonl", wrong + "\n")
        self.write("right.jsonl", json.dumps(RIGHT) + "\n")
        self.write("no.json", "{\n")
        self.write("no.txt", "text\n")
        for names, code, counts in (
            (("wrong.jsonl", "missing.jsonl"), 1, "0 proved, 1 refuted"),
            (("missing.jsonl", "no.txt", "wrong.jsonl", "right.jsonl"), 1, "1 proved, 1 refuted"),
            (("no.json", "wrong.jsonl"), 1, "0 proved, 1 refuted"),
            (("right.jsonl", "missing.jsonl", "no.json"), 74, "1 proved, 0 refuted"),
            (("no.txt", "right.jsonl"), 2, "1 proved, 0 refuted"),
            (("no.json", "right.jsonl"), 2, "1 proved, 0 refuted"),
        ):
            with self.subTest(names):
                result = self.verify(*names)
                self.assertEqual(result.returncode, code, result.stderr)
                self.assertIn(counts, result.stdout)

    def test_what_a_file_says_gives_the_terminal_no_orders(self):
        orders = "\x1b[2J\x9b2J\u202e\u200f\u2066\u0007"
        named = json.dumps(
            {**RIGHT, "name": f"a ν{orders}", "end": {**RIGHT["end"], "x": [1, 1e-3]}}, ensure_ascii=False
        )
        unknown = json.dumps({**RIGHT, orders: 1}, ensure_ascii=False)
        lines = [named, unknown, '{"a": "\x9b"\u202e}', '{"word": \x1b[2J}', json.dumps({**RIGHT, "claim": orders})]
        raw = "\n".join(lines).encode() + b'\n{"a": \x9b\xff}\n'
        for words in ((), ("--json",)):
            result = subprocess.run([VERIFY, "-", *words], input=raw, capture_output=True, timeout=LONGEST, check=False)
            self.assertEqual(result.returncode, 1)
            shown = (result.stdout + result.stderr).decode()  # UTF-8
            self.assertEqual([c for c in shown if not c.isprintable() and c != "\n"], [])
            self.assertEqual(len(result.stderr.splitlines()), 5 + (not words))
        self.assertIn("a ν", self.verify("-", text=named).stdout)

    def test_an_editors_mark_of_utf_8_is_no_mistake(self):
        self.assertEqual(self.verify("-", text="\ufeff" + json.dumps(RIGHT)).returncode, 0)

    def test_a_file_that_was_cut_isnt_proved(self):
        file = self.certificates("soft", SOFT)
        lines = file.read_text(encoding="utf-8").splitlines(keepends=True)
        self.assertGreater(len(lines), 10)
        self.assertEqual(self.verify("-", text="".join(lines)).returncode, 0)
        self.assertEqual(self.verify("-", text="".join(lines * 2)).returncode, 0)
        self.assertEqual(self.verify("-", text="".join(lines[1:-1])).returncode, 0)  # lines that aren't from a file
        for cut in (lines[:-1], lines[:-2], lines[:2], lines[:5] + lines):
            result = self.verify("-", text="".join(cut))
            self.assertEqual(result.returncode, 2)
            self.assertRegex(result.stderr, "stdin:\\d+: the line is followed by no count of the certificates, so some")
        for cut in (lines[:3] + lines[4:], lines[:-1] + lines[5:], lines[2:], lines[:1] + lines[-1:]):
            result = self.verify("-", text="".join(cut))
            self.assertEqual(result.returncode, 2)
            self.assertRegex(
                result.stderr, "stdin:\\d+: the line counts \\d+ certificates before it, and there are \\d+; "
            )
        end = json.dumps({"format": "clatter-certificates-1", "certificates": -1})
        self.assertIn("certificates: is out of range; write 0 to", self.verify("-", text=lines[1] + end).stderr)

    def test_a_claim_has_its_time_and_a_line_its_length(self):
        right = json.dumps(RIGHT)
        for end in ("1e300", 1e15):
            far = json.dumps({**RIGHT, "end": {**RIGHT["end"], "time": end}})
            begin = time.monotonic()
            result = self.verify("-", "--limit", "0.5", text=f"{far}\n{right}\n")
            self.assertLess(time.monotonic() - begin, 10)
            self.assertEqual(result.returncode, 3)
            self.assertIn("undecided: no verdict within 0.5 s; --limit gives it more", result.stdout)
            self.assertIn("1 proved, 0 refuted, 1 undecided", result.stdout)
        long = " " * 17 * 2**20
        result = self.verify("-", text=f"{long}{right}\n{right}\n")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(
            result.stderr, "^stdin:1: the line has 178\\d+ bytes; write a certificate in 16777216 at most\n"
        )
        self.assertIn("1 proved", result.stdout)

    def test_a_byte_0_hides_nothing_behind_it(self):
        result = self.verify("-", text=json.dumps(RIGHT) + '\0, "simmetric": true}')
        self.assertEqual((result.returncode, result.stdout), (2, "0 proved, 0 refuted, 0 undecided\n"))
        self.assertEqual(result.stderr, "stdin:1: the line has a byte 0; leave it out\n")

    def test_members_for_people_are_named(self):
        line = json.dumps({**RIGHT, "name": "a", "at": {"nu": 7}, "machine": {"mass": [1]}, "branch": 2})
        result = self.verify("-", text=line)
        self.assertEqual((result.returncode, result.stdout), (0, "1 proved, 0 refuted, 0 undecided\n"))
        self.assertEqual(result.stderr, "for people, and not proved: at, branch, machine, name, point\n")
        names = json.loads(self.verify("-", "--json", text=line).stdout)["for_people"]
        self.assertEqual(names, ["at", "branch", "machine", "name", "point"])

    def test_wrong_command_lines_and_files(self):
        (self.directory / "empty.jsonl").write_text("\n", encoding="utf-8")
        (self.directory / "wrong.h5").write_text("\n[scene]\nx\ny\n", encoding="utf-8")
        for words, code, said in (
            ((), 2, "no file is named; give"),
            (("--unknown",), 2, "unrecognised option '--unknown'; see clatter-verify --help"),
            (("missing.jsonl",), 74, "cannot read 'missing.jsonl': No such file"),
            (("empty.jsonl",), 2, "'empty.jsonl' holds no certificate; make some by clatter certify"),
            (
                ("wrong.h5",),
                2,
                "wrong.h5:2: isn't the JSON of a certificate; name a file that clatter certify wrote\n$",
            ),
            (("empty.jsonl", "--threads", "0"), 2, "--threads must be 1 to 1024"),
            (("empty.jsonl", "--limit", "0"), 2, "--limit must be above 0"),
            (("empty.jsonl", "--limit", "nan"), 2, "--limit must be above 0"),
            (("empty.jsonl", "--threads", "x"), 2, "the argument .* is invalid; see clatter-verify --help"),
        ):
            result = self.verify(*words)
            self.assertEqual(result.returncode, code, words)
            self.assertRegex(result.stderr, f"^clatter-verify: {said}")
        self.assertEqual(self.verify("--help").returncode, 0)
        self.assertRegex(self.verify("--version").stdout, r"^clatter-verify \d+\.\d+\.\d+\n$")

    def test_the_same_verdicts_for_any_number_of_threads(self):
        file = self.certificates("soft", SOFT)
        texts = {self.verify(file, "--json", "--threads", str(threads)).stdout for threads in (1, 2, 7)}
        self.assertEqual(len(texts), 1)


if __name__ == "__main__":
    unittest.main()
