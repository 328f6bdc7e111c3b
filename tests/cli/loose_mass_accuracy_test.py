"""A loose mass by all methods: `clatter accuracy` against 50 digits, and `clatter run` with general methods.

Environment: CLATTER, the program.
"""

import unittest

import h5py
import numpy as np

from accuracy_runs import AccuracyRuns, objects

DAMPER = "[scene]\nh = 0.005\nf = 0.01\nnu = 1.0\nloose_mass = 0.02\nloose_gap = 0.4\nloose_R = 0.8\n"
PRESSED = "[scene]\nh = 0.1\nf = 0.4\nnu = 0.6\nloose_mass = 0.5\nloose_lower = -0.1\nloose_upper = 1.0\n"
PRESSED += "loose_R = 0.3\nloose_load = -0.3\n"
RUBBING = "[scene]\nh = 0.05\nf = 1.0\nnu = 1.1\nxs = 0.8\nR = 0.6\nfriction = 0.05\n"
RUBBING += "loose_mass = 0.2\nloose_gap = 0.5\nloose_R = 0.6\nloose_friction = 0.01\n"
SPEED = 0.418893828273064  # z' at impacts of the steady motion of DAMPER (Masri & Caughey 1966)


class LooseMassAccuracy(AccuracyRuns):
    def rows_of(self, text, *words):
        self.write("a.toml", text)
        return objects(self.accuracy("a.toml", "-o", "a.h5", "--json", "-q", "--force", *words).stdout)

    def assert_errors_fall(self, rows, method, key, settings, most):
        """The errors of a method fall with its setting, by a power of it of about 1, or up to `most` by chance."""
        chosen = [row for row in rows if row["method"] == method and row["setting"] in settings]
        self.assertEqual(len(chosen), len(settings))
        x, y = (np.log([row[name] for row in chosen]) for name in ("setting", key))
        power = np.polyfit(x, y, 1)[0]
        self.assertTrue(0.7 < power < most, (method, key, power))

    def test_errors_fall_with_tolerance_and_step(self):
        for text in (DAMPER + "loose_v0 = 0.3\n", PRESSED):
            rows = self.rows_of(text + '[time]\nmode = "transient"\nduration = 100.0\n')
            exact = rows[0]
            self.assertEqual((exact["method"], exact["missed"], exact["doubled"]), ("exact", 0, 0))
            self.assertGreater(exact["impacts"], 10)
            for key in ("error_contact_time", "error_contact_speed", "error_extrema", "error_harmonics"):
                self.assertLess(exact[key], 1e-12, key)
                self.assert_errors_fall(rows, "dopri5", key, (1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11), 1.3)
            self.assert_errors_fall(rows, "moreau", "error_extrema", (1e-3, 1e-4, 1e-5), 2)

    def test_times_in_which_a_wall_presses_are_rests(self):
        rows = self.rows_of(PRESSED + '[time]\nmode = "transient"\nduration = 100.0\n')
        self.assertLess(rows[0]["error_rest"], 1e-12)
        self.assertEqual(rows[0]["rests_missed"], 0)
        self.assert_errors_fall(rows, "dopri5", "error_rest", (1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11), 1.3)
        with h5py.File(self.directory / "a.h5") as file:
            self.assertGreater(file["reference_rests"][()], 3)

    def test_contacts_rests_and_sticks_of_both_masses_are_compared(self):
        rows = self.rows_of(RUBBING + '[time]\nmode = "transient"\nduration = 60.0\n')
        exact = rows[0]
        self.assertEqual((exact["missed"], exact["doubled"], exact["rests_missed"]), (0, 0, 0))
        self.assertGreater(exact["impacts"], 30)
        for key in ("error_contact_time", "error_contact_speed", "error_rest", "error_extrema", "error_harmonics"):
            self.assertLess(exact[key], 1e-12, key)
        self.assert_errors_fall(rows, "dopri5", "error_extrema", (1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11), 1.3)
        self.assert_errors_fall(rows, "moreau", "error_extrema", (1e-3, 1e-4, 1e-5), 2)
        with h5py.File(self.directory / "a.h5") as file:  # which pictures name in their titles
            self.assertIn("loose_friction = ", file.attrs["scene_names"])

    def test_steady_motion_is_found_again_in_50_digits(self):
        rows = self.rows_of(DAMPER + "loose_v0 = 0.3\n[time]\nwindow = 4\n")
        found = {row["method"]: row for row in rows if row["setting"] is None or row["setting"] == 1e-12}
        self.assertLess(found["harmonics_exact"]["error_harmonics"], 1e-12)
        repeat = found["steady_repetition"]
        self.assertEqual(repeat["observed_periods"], 1)
        self.assertEqual((repeat["missed"], repeat["doubled"]), (0, 0))
        self.assertLess(repeat["error_contact_speed"], 1e-9)
        self.assertLess(repeat["error_contact_time"], 1e-9)

    def test_without_lanes_it_says_so(self):
        self.write("a.toml", DAMPER + 'loose_v0 = 0.3\n[time]\nmode = "transient"\nduration = 50.0\n')
        answer = self.accuracy("a.toml", "-o", "a.h5", "-q", "-v", arch="sse2").stdout
        self.assertIn("not in lanes", answer)
        self.assertIn("compared with 50 digits", answer)

    def test_general_methods_end_in_the_closed_form(self):
        time = (
            "[time]\ntolerance = 1e-8\n[observe]\nimpact_log = true\nstability = true\nenergy = true\nextrema = true\n"
        )
        for method, setting, error in (("dopri5", "tolerance = 1e-12", 1e-9), ("exact", "", 1e-9)):
            self.write("a.toml", f'{DAMPER}{time}[integrator]\nmethod = "{method}"\n{setting}\n')
            result = self.clatter("run", "a.toml", "-o", "a.h5", "-q", "--force")
            self.assertEqual(result.returncode, 0, result.stderr)
            with h5py.File(self.directory / "a.h5") as file:
                np.testing.assert_allclose(np.abs(file["impact_v_before"][:]), SPEED, atol=error)
                np.testing.assert_allclose([file["z_min"][()], file["z_max"][()]], [-0.4, 0.4], atol=1e-12)
                self.assertLess(abs(file["energy_residual"][()]), 1e-9)
        self.write("a.toml", DAMPER + '[time]\nmode = "transient"\nduration = 2000.0\n[observe]\nimpact_log = true\n')
        words = ("--set", "integrator.method=moreau", "--set", "integrator.step=1e-4")
        self.assertEqual(self.clatter("run", "a.toml", "-o", "a.h5", "-q", "--force", *words).returncode, 0)
        with h5py.File(self.directory / "a.h5") as file:
            np.testing.assert_allclose(np.abs(file["impact_v_before"][-20:]), SPEED, atol=2e-3)


if __name__ == "__main__":
    unittest.main()
