"""How clatter-verify reads: in time and memory that a line can't drive up, and up to an error that it tells of.

Environment: CLATTER and CLATTER_VERIFY, the programs.
"""

import json
import os
import resource
import subprocess
import unittest

from certified_runs import VERIFY
from command_line import LONGEST, SANITIZED
from malformed_certificates import RIGHT
from verifying import Verifying

IMPACT = '{"event":"impact","stop":"lower","time":[1.5,0],"v":[-1.5,0]}'


def with_member(name, value):
    """The right one with one more member, or one that is of some other value, written as JSON."""
    rest = {key: member for key, member in RIGHT.items() if key != name}
    return f'{json.dumps(rest)[:-1]}, "{name}": {value}}}\n'


class VerifyReading(Verifying):
    def test_time_grows_no_faster_than_a_list_of_objects(self):
        line = with_member("at", "[" + ",".join(["{}"] * 1_900_000) + "]")
        seconds = (
            100  # of the processor, whatever else runs: it takes 2, and 90 times the 8 of 200,000 when it grew faster
        )
        self.assertEqual(self.within(resource.RLIMIT_CPU, seconds, line).returncode, 0)

    def test_reading_is_a_part_of_the_time_for_a_claim(self):
        line = with_member(
            "events", "[" + ",".join([IMPACT] * 199_000) + "]"
        )  # 1 s and more; the other claim takes 5 ms
        result = self.verify("-", "--limit", "0.25", text=line + json.dumps(RIGHT))
        self.assertEqual((result.returncode, result.stdout.count("\n")), (3, 2))
        self.assertEqual(
            result.stdout,
            "stdin:1: undecided: no verdict within 0.25 s; --limit gives it more\n1 proved, 0 refuted, 1 undecided\n",
        )

    @unittest.skipIf(SANITIZED, "a sanitizer takes memory of its own")
    def test_memory_is_bounded_by_the_values_that_a_certificate_may_have(self):
        most = 2**24 // 3 - 1000
        for line in (
            with_member("at", "[" + ",".join(["[]"] * most) + "]"),
            with_member("at", "[" + ",".join(['{"a":0}'] * 1_000_001) + "]"),
        ):
            result = self.within(resource.RLIMIT_AS, 2**27, line)
            self.assertEqual((result.returncode, result.stdout), (2, "0 proved, 0 refuted, 0 undecided\n"))
            self.assertEqual(
                result.stderr,
                "stdin:1: the line holds more than 2000000 values; write a certificate of fewer events\n",
            )
        longest = with_member("events", "[" + ",".join([IMPACT] * 199_000) + "]")
        self.assertEqual(self.within(resource.RLIMIT_AS, 2**29, longest).returncode, 1)

    @staticmethod
    def within(resources, most, line):
        """The end of a program that reads the line and may have so much of the resource, such as bytes of memory."""
        return subprocess.run(
            [VERIFY, "-", "--threads", "1"],
            input=line,
            capture_output=True,
            text=True,
            timeout=LONGEST,
            check=False,
            preexec_fn=lambda: resource.setrlimit(resources, (most, most)),
        )

    def test_a_line_nests_only_as_deep_as_people_need(self):
        for depth, code in ((7, 0), (8, 2)):
            result = self.verify("-", text=with_member("at", "[" * depth + "]" * depth))
            self.assertEqual(result.returncode, code)
        self.assertIn("stdin:1: the line nests more than 8 objects and arrays; write one as", result.stderr)

    def test_numbers_are_compared_to_their_last_digit(self):
        tiny = "0" * 290 + "1"
        for friction, static, R in (
            ("0.1", "0.1", "1"),
            ("0.1", "0.10", "1." + "0" * 390),
            ("0.1", "0.1" + tiny, "0." + "9" * 390),
            ("0.1", 0.1, 1),  # the double is above 0.1
            ("1e-1", "0.1e0", "10e-1"),
        ):
            levels = {"friction": friction, "friction_static": static}
            scene = {**RIGHT["scene"], **levels, "lower": {"position": "-5" + "." + tiny, "R": R}}
            scene["upper"] = {"position": "-5.0", "R": R}
            start, end = {"time": "0." + tiny, "x": 0, "v": 0}, {
                "time": "0." + tiny[:-1] + "2",
                "x": [0, 9],
                "v": [0, 9],
            }
            result = self.verify("-", text=json.dumps({**RIGHT, "scene": scene, "start": start, "end": end}))
            self.assertEqual((result.returncode, result.stderr), (3, "for people, and not proved: point\n"))

    def test_an_error_while_reading_is_no_end(self):
        def said_of(name, number):
            return (
                f"clatter-verify: cannot read '{name}' to its end: {os.strerror(number)}\n",
                "0 proved, 0 refuted, 0 undecided\n",
                74,
            )

        for path, number in ((str(self.directory), 21), ("/proc/self/mem", 5)):
            result = self.verify(path)
            self.assertEqual((result.stderr, result.stdout, result.returncode), said_of(path, number))
            source = os.open(path, os.O_RDONLY)
            try:
                result = self.from_stdin(stdin=source)
            finally:
                os.close(source)
            self.assertEqual((result.stderr, result.stdout, result.returncode), said_of("stdin", number))
        result = self.from_stdin(preexec_fn=lambda: os.close(0))
        self.assertEqual((result.stderr, result.stdout, result.returncode), said_of("stdin", 9))

    @staticmethod
    def from_stdin(**how):
        return subprocess.run([VERIFY, "-"], capture_output=True, text=True, timeout=LONGEST, check=False, **how)

    def test_what_was_read_before_an_error_counts(self):
        self.write("right.jsonl", json.dumps(RIGHT) + "\n")
        self.assertEqual(self.verify(str(self.directory), "right.jsonl").stdout, "1 proved, 0 refuted, 0 undecided\n")
        wrong = json.dumps({**RIGHT, "end": {**RIGHT["end"], "x": [1, 1e-3]}})
        self.assertEqual(self.verify(str(self.directory), "-", text=wrong).returncode, 1)


if __name__ == "__main__":
    unittest.main()
