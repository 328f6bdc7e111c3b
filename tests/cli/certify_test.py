"""`clatter certify`: certificates of outputs, as JSON lines; `clatter-verify` proves them elsewhere.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import json
import math
import unittest

import h5py
import numpy as np

from accuracy_runs import STEADY
from command_line import SMALL, SOURCE, CommandLine

IMPACTS = """[scene]
f = -1.0
h = 0.1
R = 0.7
xs = -0.5
[sweep]
nu = [0.6, 1.0, 1.1]
[observe]
impact_log = true
extrema = true
stability = true
word = true
"""

SOFT = """[scene]
f = -1.0
h = 0.1
xs = -0.5
stop_stiffness = 30
stop_damping = 0.1
[sweep]
nu = [0.6, 1.1]
[observe]
extrema = true
"""

HOUSED = """[scene]
f = 1.0
h = 0.05
nu = 0.9
loose_mass = 0.3
loose_gap = 0.6
loose_R = 0.6
{}
[observe]
extrema = true
word = true
stability = true
impact_log = true
"""

MACHINE = """[machine]
mass = "2 kg"
stiffness = "8 N/m"
damping = "0.4 N s/m"
force = "4 N"
gap = "0.3 m"
[sweep]
frequency = "linspace(0.2 Hz, 0.4 Hz, 3)"
[observe]
extrema = true
"""


class Certify(CommandLine):
    def run_text(self, name, text, *words):
        result = self.clatter("run", self.write(f"{name}.toml", text), "-q", *words)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return f"{name}.h5"

    def certify(self, *words, code=0):
        """The certificates, and what is said on stderr."""
        result = self.clatter("certify", *words)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        lines = [json.loads(line) for line in result.stdout.splitlines()]
        if not lines:  # no point has a claim
            return [], result.stderr.strip()
        begin, *certificates, end = lines
        self.assertEqual(begin, {"format": "clatter-certificates-1", "certificates": "begin"})
        self.assertEqual(end, {"format": "clatter-certificates-1", "certificates": len(certificates)})
        return certificates, result.stderr.strip()

    def test_every_point_is_counted_and_most_have_a_certificate(self):
        path = self.directory / "fig23.h5"
        self.assertEqual(self.clatter("run", SOURCE / "configs/fig23.toml", "-q", "-o", path).returncode, 0)
        certificates, said = self.certify(path)
        with h5py.File(path) as file:
            status = file["status"][()]
        periodic, others = (status == 0).sum(), (status != 0).sum()
        self.assertEqual(
            said,
            f"501 points: {periodic} certificates ({periodic} periodic), {others} without a claim ({others} aperiodic)",
        )
        self.assertEqual([c["point"] for c in certificates], np.flatnonzero(status == 0).tolist())
        self.assertEqual({c["format"] for c in certificates}, {"clatter-certificate-1"})

    def test_claims_are_the_results_of_the_file(self):
        path = self.run_text("a", IMPACTS)
        certificates, _ = self.certify(path)
        with h5py.File(self.directory / path) as file:
            ends = np.cumsum(file["impact_count"][()])
            for certificate, end, count in zip(certificates, ends, file["impact_count"][()]):
                point = certificate["point"]
                log = file["impact_v_before"][end - count : end]
                claimed = [event["v"][0] for event in certificate["events"]]
                np.testing.assert_allclose(sorted(claimed), sorted(log), rtol=1e-9)
                for name in ("x_min", "x_max"):
                    value, error = certificate[name]
                    self.assertLess(abs(file[name][point] - value), error)
                self.assertEqual(certificate["word"], file["impact_word"][point].decode())
                self.assertEqual(certificate["at"], {"nu": file["nu"][point]})
                self.assertEqual(certificate["scene"]["nu"], file["nu"][point])
                for multiplier, re in zip(certificate["multipliers"], file["multiplier_re"][point]):
                    self.assertLess(abs(multiplier[0] - re), multiplier[2])

    def test_events_lie_in_order_between_start_and_end(self):
        for text in (IMPACTS, SOFT):
            for certificate in self.certify(self.run_text("a", text, "-o", "a.h5", "--force"))[0]:
                times = [event["time"][0] for event in certificate["events"]]
                begin = certificate["start"]["time"]
                end = begin + certificate["periods"] * 2 * math.pi / certificate["scene"]["nu"]
                self.assertEqual(times, sorted(times))
                self.assertLess(begin, times[0])
                self.assertLess(times[-1], end)
                for event in certificate["events"]:
                    self.assertLess(event["time"][1], 1e-9)

    def test_soft_stops_are_touched_and_left(self):
        for certificate in self.certify(self.run_text("soft", SOFT))[0]:
            self.assertEqual(certificate["scene"]["upper"], {"position": 0.5, "stiffness": 30.0, "damping": 0.1})
            kinds = [event["event"] for event in certificate["events"]]
            self.assertEqual(kinds, ["touch", "separation"] * (len(kinds) // 2))
            self.assertGreater(len(kinds), 0)

    def test_walls_of_a_loose_mass_are_told_from_stops_beside_these(self):
        for keys, names in (
            ("", {("stop", "w")}),
            ("stop_lower = -0.9\nstop_upper = 0.8\nR = 0.7", {("stop", "v"), ("wall", "w")}),
        ):
            path = self.run_text("housed", HOUSED.format(keys), "-o", "housed.h5", "--force")
            (certificate,), _ = self.certify(path)
            impacts = [event for event in certificate["events"] if event["event"] == "impact"]
            found = {tuple(name for name in ("stop", "wall", "v", "w") if name in event) for event in impacts}
            self.assertEqual(found, names)
            self.assertEqual(len(certificate["multipliers"]), 4)
            with h5py.File(self.directory / path) as file:
                self.assertEqual(certificate["word"], file["impact_word"][()].decode())
                if keys:
                    log = file["impact_v_before"][()]
                    claimed = [event["w" if "wall" in event else "v"][0] for event in impacts]
                    np.testing.assert_allclose(sorted(claimed), sorted(log), rtol=1e-8)

    def test_what_both_masses_do_at_once_has_no_claim(self):
        transient = '{}\n[time]\nmode = "transient"\nduration = 3\n'
        held = transient.format("load = -2.0\nloose_load = -1.0\nstop_lower = 0\nR = 0.2\nloose_x0 = -0.55")
        at_once = transient.format("f = 0.1\nload = 2.0\nstop_upper = 0.5\nR = 0.5\nx0 = 0.5\nloose_v0 = 0.5")
        for keys, reason in ((held, "with both masses held at once"), (at_once, "with two events at one instant")):
            text = HOUSED.format(keys).replace("f = 1.0\n", "" if "f = 0.1" in keys else "f = 1.0\n")
            path = self.run_text("none", text.replace("stability = true\n", ""), "-o", "none.h5", "--force")
            certificates, said = self.certify(path)
            self.assertEqual((certificates, said), ([], f"1 point: 0 certificates, 1 without a claim (1 {reason})"))

    def test_a_mass_that_rests_begins_with_its_release(self):
        path = self.run_text("rest", "[scene]\nf=-1.0\nh=0.1\nR=0.7\nnu=0.3\nxs=0.05\n[observe]\nword=true\n")
        (certificate,), _ = self.certify(path)
        self.assertEqual(set(certificate["start"]), {"time", "released"})
        kinds = [event["event"] for event in certificate["events"]]
        self.assertEqual([kind for kind in kinds if kind != "impact"], ["chatter", "rest"] * 2)
        self.assertEqual(kinds[-1], "rest")
        self.assertEqual(certificate["multipliers"], [[0.0, 0.0, 0.0]] * 2)

    def test_a_transient_has_an_end(self):
        path = self.run_text(
            "t", '[scene]\nf=1.0\nh=0.1\nR=0.5\nnu=0.5\nxs=0.5\nv0=0.25\n[time]\nmode="transient"\nduration=20.5\n'
        )
        (certificate,), said = self.certify(path)
        self.assertEqual(said, "1 point: 1 certificate (1 transient)")
        self.assertEqual(certificate["start"], {"time": 0.0, "x": 0.0, "v": 0.25})
        self.assertEqual(certificate["end"]["time"], 20.5)
        self.assertEqual(certificate["claim"], "transient")

    def test_a_machine_is_stated_in_si_beside_the_scene_that_is_computed(self):
        certificates, _ = self.certify(self.run_text("m", MACHINE))
        self.assertEqual([c["at"] for c in certificates], [{"frequency": f} for f in (0.2, 0.30000000000000004, 0.4)])
        for certificate in certificates:
            self.assertEqual(certificate["machine"]["mass"], 2.0)
            self.assertEqual(certificate["machine"]["frequency"], certificate["at"]["frequency"])
            self.assertEqual(certificate["scene"]["k"], 1.0)
            self.assertAlmostEqual(certificate["scene"]["h"], 0.05, 14)
            self.assertAlmostEqual(certificate["scene"]["nu"], math.pi * certificate["at"]["frequency"], 14)

    def test_followed_points_start_from_the_end_of_the_one_before(self):
        """Where none of them is chaotic: what follows that, one motion or its mirror image, rounding decides."""
        path, axis = self.directory / "hysteresis.h5", "sweep.nu=linspace(1, 1.3, 151)"
        done = self.clatter("run", SOURCE / "configs/hysteresis.toml", "--set", axis, "-q", "-o", path)
        self.assertEqual(done.returncode, 0, done.stderr)
        certificates, said = self.certify(path)
        self.assertNotIn("not reproduced", said)
        self.assertEqual({c["at"]["direction"] for c in certificates}, {"up", "down"})

    def branch(self, text):
        result = self.clatter("branch", self.write("b.toml", text), "-q", "-o", "b.h5", "--force")
        self.assertEqual(result.returncode, 0, result.stderr)
        return "b.h5"

    def test_points_and_special_points_of_a_branch(self):
        certificates, said = self.certify(self.branch((SOURCE / "configs/branch.toml").read_text(encoding="utf-8")))
        with h5py.File(self.directory / "b.h5") as file:
            nu, branch, stable = (file[name][()] for name in ("nu", "branch", "stable"))
            kinds = [kind.decode() for kind in file["special_kind"]]
            special_nu, word = file["special_nu"][()], [word.decode() for word in file["special_word"]]
        points = [c for c in certificates if c["claim"] == "periodic"]
        special = [c for c in certificates if c["claim"] == "special"]
        self.assertTrue(said.startswith(f"{len(nu) + len(kinds)} points: {len(certificates)} certificates (1 flip, "))
        self.assertGreater(len(points), 0.98 * len(nu))
        self.assertIn(0, stable[[c["point"] for c in points]])
        for certificate in points:
            self.assertEqual(certificate["branch"], branch[certificate["point"]])
            self.assertAlmostEqual(certificate["at"]["nu"], nu[certificate["point"]], 12)
        self.assertEqual([c["kind"] for c in special], kinds)
        for certificate in special:
            number = certificate["special"]
            self.assertAlmostEqual(certificate["parameter"][0], special_nu[number], 12)
            self.assertLess(certificate["parameter"][1], 1e-11)
            self.assertEqual(certificate["slopes"], {"nu": 1.0})
            letters = "".join({"lower": "L", "upper": "U"}[event["stop"]] for event in certificate["events"])
            self.assertIn(word[number], letters + letters)

    def test_slopes_of_what_is_followed(self):
        shaken = """[scene]
h = 0.1
base_amplitude = 0.7
xs = 0.9
R = 0.6
nu = 0.8
[branch]
along = "base_amplitude"
range = [0.4, 1.4]
"""
        certificates, _ = self.certify(self.branch(shaken))
        for certificate in certificates:
            if certificate["claim"] == "special":
                self.assertEqual(set(certificate["slopes"]), {"f"})
                f, slope = certificate["scene"]["f"], certificate["slopes"]["f"]
                self.assertAlmostEqual(f, slope * certificate["parameter"][0], 12)  # eq. 40: in proportion
        machine = MACHINE.replace("[sweep]", "[branch]").replace("frequency = ", "# ")
        machine = machine.replace("[machine]", '[machine]\nfrequency = "0.25 Hz"\nR = 0.7')
        machine = machine.replace("[branch]", '[branch]\nalong = "gap"\nrange = ["0.2 m", "0.6 m"]')
        certificates, _ = self.certify(self.branch(machine))
        self.assertGreater(len(certificates), 10)
        for certificate in certificates:
            self.assertEqual(set(certificate["at"]), {"gap"})
            if certificate["claim"] == "special":
                slopes = certificate["slopes"]
                self.assertEqual((slopes["lower"]["position"], slopes["upper"]["position"]), (-1.0, 1.0))

    def test_a_branch_has_no_axis(self):
        path = self.branch((SOURCE / "configs/branch.toml").read_text(encoding="utf-8"))
        self.assert_refused(2, "a branch has no axis; use --sample", "certify", path, "--where", "nu=1")
        _, said = self.certify(path, "--sample", "3")
        self.assertTrue(said.startswith("6 points: "), said)

    def test_choices(self):
        path = self.run_text("a", SMALL)
        self.assertEqual([c["point"] for c in self.certify(path, "--where", "nu=1.25")[0]], [3])
        _, said = self.certify(path, "--sample", "2")
        self.assertTrue(said.startswith("2 points: "), said)
        _, said = self.certify(path, "--sample", "100")
        self.assertTrue(said.startswith("5 points: "), said)

    def test_motion_without_a_force_has_no_claim(self):
        path = self.run_text("free", "[scene]\nxs = 1\nv0 = 2\n[observe]\nextrema = true\n")
        certificates, said = self.certify(path)
        self.assertEqual((certificates, said), ([], "1 point: 0 certificates, 1 without a claim (1 without a force)"))

    def test_output_file(self):
        path = self.run_text("a", SMALL)
        text = self.clatter("certify", path, "-o", "-").stdout
        self.assertEqual(self.certify(path, "-o", "a.jsonl")[0], [])
        self.assertEqual((self.directory / "a.jsonl").read_text(), text)
        self.assert_refused(74, "cannot write 'a.jsonl': there is a file", "certify", path, "-o", "a.jsonl")
        self.certify(path, "-o", "a.jsonl", "--force")

    def test_a_point_of_another_status_is_not_reproduced(self):
        path = self.run_text("a", SMALL)
        with h5py.File(self.directory / path, "a") as file:
            file["status"][0] = 1
        _, said = self.certify(path, code=1)
        self.assertTrue(said.endswith(", 1 not reproduced (1 status)"), said)

    def test_wrong_input(self):
        path = self.run_text("a", SMALL)
        self.run_text("dopri5", SMALL + '[integrator]\nmethod = "dopri5"\n')
        self.write("text.h5", "no HDF5")
        for code, words, command in (
            (2, "--sample '0'; expected a whole number from 1 on", [path, "--sample", "0"]),
            (2, "--sample '-3'; expected a whole number from 1 on", [path, "--sample", "-3"]),
            (2, "--where: 'h' is neither an axis nor a result of 'a.h5'; its axes are nu", [path, "--where", "h=1"]),
            (2, "--where nu=0.95: the axis has no such value; the nearest are ", [path, "--where", "nu=0.95"]),
            (2, "expected e.g. nu=1.0", [path, "--where", "nu"]),
            (2, "is the input; name another file", [path, "-o", path]),
            (2, "'dopri5.h5' isn't of the exact method", ["dopri5.h5"]),
            (74, "No such file or directory", ["none.h5"]),
            (74, "text.h5", ["text.h5"]),
            (74, "there is no directory 'none'", [path, "-o", "none/a.jsonl"]),
        ):
            with self.subTest(words):
                self.assert_refused(code, words, "certify", *command)

    def test_other_outputs_are_refused(self):
        config = self.write("a.toml", SMALL)
        self.clatter("run", config, "--shard", "0/2", "-q")
        self.assert_refused(74, "is shard 0/2 of a sweep; join all with `clatter merge`", "certify", "a.0-of-2.h5")
        soon_over = self.write("c.toml", STEADY + "max_impacts = 1\n")
        self.assertEqual(self.clatter("accuracy", soon_over, "-q", "-o", "c.h5").returncode, 1)
        self.assert_refused(74, "holds what accuracy costs, not motions", "certify", "c.h5")


if __name__ == "__main__":
    unittest.main()
