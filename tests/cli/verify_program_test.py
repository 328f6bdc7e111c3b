"""The command line of clatter-verify: what it reads, verdicts and exit codes, and how it ends.

Environment: CLATTER and CLATTER_VERIFY, the programs.
"""

import json
import subprocess
import unittest

from certified_runs import VERIFY
from command_line import LONGEST
from malformed_certificates import MALFORMED, RIGHT
from verifying import SOFT, Verifying


class VerifyProgram(Verifying):
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
            result = self.verify("-", "--limit", "0.5", text=f"{far}\n{right}\n")
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
