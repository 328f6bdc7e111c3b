"""What a page has beside its numbers: charts of the motion with units, the nearest motion by the values of all inputs,
linked keys, the results of each panel, and words for those who don't see the picture. Chromium shows it in
report_in_browser.py.
"""

import re
import unittest

import h5py
import numpy as np

from command_line import SOURCE
from report_runs import ReportRuns, data_of, doubles

from clatter.plots.data import Output
from clatter.plots.names import in_one_line, label
from clatter.reports.pictures import without_symbols

CONFIGS = SOURCE / "configs"
STARTS = ("sweep.x0=-1 mm, 1 mm", "sweep.v0=0 m/s, 0.1 m/s", "machine.frequency=26 Hz", "sweep.frequency=[26]")


class Charts(ReportRuns):
    def names(self, data):
        return [chart["names"] for chart in data["histories"]["charts"]]

    def rows(self, record, count):
        return doubles(record["values"]).reshape(count, -1)

    def test_a_machine_has_its_units(self):
        self.run_config(CONFIGS / "drive_si.toml", "d.h5", "sweep.frequency=[20, 25]")
        data = data_of(self.page("d.h5"))
        self.assertEqual(self.names(data), [["t (s)", "x (mm)"], ["x (mm)", "x\N{PRIME} (m/s)"]])
        self.assertEqual([chart["scales"] for chart in data["histories"]["charts"]], [[1.0, 1e3], [1e3, 1.0]])
        self.run_config(CONFIGS / "fig22.toml", "f.h5", "sweep.nu=[0.9, 1]")
        self.assertEqual(self.names(data_of(self.page("f.h5"))), [["τ", "x"], ["x", "x\N{PRIME}"]])

    def test_units_without_powers(self):
        for unit, text in (("m s-1", "m/s"), ("N s m-1", "N s/m"), ("m s-2", "m/s²"), ("m2 s-1 kg-1", "m²/(s kg)")):
            self.assertEqual(in_one_line(unit), text)
        for unit in ("s-1", "s"):
            self.assertEqual(in_one_line(unit), {"s-1": "1/s", "s": "s"}[unit])

    def test_a_loose_mass_has_both_displacements_and_its_place_in_the_housing(self):
        self.run_config(CONFIGS / "impact_damper.toml", "i.h5", "sweep.frequency=[10, 10.1]", "time.max_periods=200")
        data = data_of(self.page("i.h5"))
        self.assertEqual(self.names(data), [["t (s)", "x, y (mm)"], ["z (mm)", "z\N{PRIME} (m/s)"]])
        self.assertEqual(len(data["histories"]["records"]), 4)
        for record in data["histories"]["records"][2:]:  # the others have no loose mass
            tau, x, y, z, w = self.rows(record, 5)
            self.assertEqual(record["stops"], [-0.005, 0.005])
            self.assertTrue((np.diff(tau) >= 0).all())
            np.testing.assert_allclose(y, x + z, atol=1e-6)
            self.assertLess(np.abs(z).max(), 0.005 + 1e-9)
            hits = np.flatnonzero((np.diff(tau) == 0) & (np.diff(w) != 0))  # each has both of its sides
            self.assertGreater(len(hits), 4)
            np.testing.assert_allclose(np.abs(z[hits]), 0.005, rtol=1e-6)

    def test_the_nearest_motion_is_that_of_the_same_attractor_at_the_nearest_start(self):
        sample = ("sweep.x0=sobol(-3, 3, 512)", "sweep.v0=sobol(-6, 6, 512)", "sweep.linked=x0, v0")
        self.run_config(CONFIGS / "basins.toml", "s.h5", *sample)
        data = data_of(self.page("s.h5"))
        with h5py.File(self.directory / "s.h5") as file:
            x0, v0, attractor = (file[name][:] for name in ("x0", "v0", "attractor"))
        self.assertGreater(len(set(attractor)), 1)
        nearest, (kept,) = doubles(data["histories"]["nearest"]).astype(int), data["histories"]["indexes"]
        self.assertLess(len(kept), len(x0))
        away = np.hypot((x0[:, None] - x0[kept]) / np.ptp(x0), (v0[:, None] - v0[kept]) / np.ptp(v0))
        away[attractor[:, None] != attractor[kept]] = np.inf
        np.testing.assert_allclose(away[np.arange(len(x0)), nearest], away.min(axis=1), rtol=1e-12)
        self.assertFalse(doubles(data["histories"]["other"]).any())

    def test_linked_keys_are_among_the_values(self):
        linked = ("sweep.nu=[0.9, 1.0, 1.1]", "sweep.R=[0.5, 0.6, 0.7]", "sweep.linked=nu, R")
        text = (CONFIGS / "fig22.toml").read_text(encoding="utf-8")
        (self.directory / "l.toml").write_text(re.sub(r"\nR = .*", "", text), encoding="utf-8")
        self.run_config("l.toml", "l.h5", *linked)
        (axis,) = data_of(self.page("l.h5", "--no-histories"))["axes"]
        (key,) = axis["linked"]
        self.assertEqual((axis["name"], key["name"]), ("nu", "R"))
        np.testing.assert_array_equal(doubles(key["values"]), [0.5, 0.6, 0.7])

    def test_panels_tell_which_results_they_show(self):
        self.run_config(CONFIGS / "family_R.toml", "f.h5", "sweep.nu=linspace(1, 1.2, 5)")
        data = data_of(self.page("f.h5", "--no-histories"))
        names = {column["name"] for column in data["columns"]}
        results = [result for panel in data["panels"] for result in panel["results"]]
        self.assertLessEqual(set(results), names)
        self.assertIn(["v_min", "v_max"], [panel["results"] for panel in data["panels"]])
        self.assertEqual({tuple(panel["families"]) for panel in data["panels"]}, {(0,)})
        self.assertFalse(any(panel["cloud"] for panel in data["panels"]))

    def test_totals_of_a_panel_are_per_forcing_period_as_they_are_drawn(self):
        self.run_config(CONFIGS / "drill.toml", "d.h5", "sweep.frequency=linspace(40, 50, 21)", "sweep.load=[60]")
        data = data_of(self.page("d.h5", "--no-histories"))
        shown = [
            doubles(result["values"]) for panel in data["panels"] for result in panel["results"] if "values" in result
        ]
        with h5py.File(self.directory / "d.h5") as file:
            work = file["work_in"][:].ravel()
        self.assertGreater(work.max(), 2.5 * np.median(work))
        self.assertTrue(shown)
        for values in shown:
            self.assertLess(values.max(), 1.7 * np.median(values))
        totals = {"work_in", "loss_damping", "loss_impact[1]", "impulse[1]"}
        over = {column["name"]: column["over"] for column in data["columns"] if "over" in column}
        self.assertLessEqual(totals, set(over))  # beside the picture are those of the file, which commands give again
        self.assertEqual(set(over.values()), {"in the observed time"})
        self.assertNotIn("impact_power", over)

    def test_dots_at_two_starts_have_their_inputs(self):
        sample = ("sweep.x0=sobol(-3, 3, 32)", "sweep.v0=sobol(-6, 6, 32)", "sweep.linked=x0, v0")
        self.run_config(CONFIGS / "basins.toml", "s.h5", *sample)
        panels = data_of(self.page("s.h5", "--no-histories"))["panels"]
        self.assertEqual([panel["plane"] for panel in panels], [["x0", "v0"]] * len(panels))

    def test_the_words_of_a_picture_have_no_rest_of_a_symbol_or_unit(self):
        observe = "[observe]\nextrema = true\nimpacts = true\nsensitivity = 'gap, stiffness'\n"
        sweep = "[sweep]\nfrequency = 'linspace(20, 30, 9)'\n"
        scene = "[machine]\nmass = 0.2\nstiffness = 2000\ndamping_ratio = 0.03\nforce = 8\nR = 0.6\ngap = 0.0015\n"
        (self.directory / "a.toml").write_text(scene + sweep + observe, encoding="utf-8")
        self.run_config("a.toml", "a.h5")
        (words,) = re.findall(r'<img alt="Picture of .*?: (.*?)"', self.page("a.h5", "--no-histories"))
        for part in ("velocity", "velocity at impact"):
            self.assertIn(part, re.split(", | over ", words))
        self.assertIn("sensitivity of the speed of the fastest impact to the gap", words)
        self.assertIn("sensitivity of the speed of the fastest impact to the stiffness", words)
        self.assertNotRegex(words, r"[^\w ,]|_")
        for text, told in (
            ("velocity $x$′ (m s$^{-1}$)", "velocity"),
            ("velocity before impact $x$′$^{{-}}$\nupper stop", "velocity before impact, upper stop"),
            ("velocity ratio $|x$′$^{{-}}|$ / gap\n(s$^{-1}$)", "velocity ratio"),
            ("sensitivity ∂$T$/∂$k$ (s/(N m$^{-1}$)) in $10^{-5}$", "sensitivity"),
            ("initial velocity $x$′$(0)$", "initial velocity"),
            ("power lost in impacts (W)", "power lost in impacts"),
        ):
            self.assertEqual(without_symbols(text), told)

    def test_the_words_of_a_picture_say_of_what_extremes_sections_and_sensitivities_are(self):
        scene = "[scene]\nh = 0.1\nf = -1\nR = 0.7\n[sweep]\nnu = 'linspace(1, 1.2, 8)'\n"
        observe = "[observe]\nextrema = true\nimpacts = true\nsection = 3\nsensitivity = 'xs, R'\n"
        (self.directory / "map.toml").write_text(f"{scene}xs = 'linspace(2, 3, 7)'\n{observe}")
        (self.directory / "line.toml").write_text(scene.replace("R = 0.7", "R = 0.7\nxs = -3") + observe)
        told = {}
        for name in ("map", "line"):
            self.run_config(f"{name}.toml", f"{name}.h5")
            page = self.page(f"{name}.h5", "--no-histories")
            (told[name],) = re.findall(r'<img alt="Picture of .*?: (.*?)"', page)
            for words in ("to the stop", "to the restitution"):
                self.assertIn(f"sensitivity of the speed of the fastest impact {words}", told[name])
            self.assertNotRegex(
                told[name], r"\bto\b(?! the )|(^|, )(minimum|maximum|once)\b(?! (displacement|velocity))"
            )
        self.assertIn("maximum displacement, minimum velocity, maximum velocity", told["map"])
        self.assertTrue(told["map"].endswith(" over excitation frequency and stop"), told["map"])
        self.assertIn("displacement once a forcing period, velocity once a forcing period", told["line"])
        self.assertIn("impacts per period, lower stop", told["map"])

    def test_tables_and_axes_of_a_machine_have_their_units(self):
        loaded = ("sweep.frequency=linspace(20 Hz, 24 Hz, 5)", "sweep.load=0 N, 3 N", "observe.energy=true")
        self.run_config(CONFIGS / "rig.toml", "rig.h5", *loaded)
        page = self.page("rig.h5", "--no-histories")
        extremes = page[page.index("<h3>Extremes</h3>") :].split("</table>")[0]
        for name in (
            "impact_speed[1] (m/s)",
            "impulse[-1] per forcing period (N\u00a0s)",
            "impact_power (W)",
            "period (s)",
        ):
            self.assertIn(f"<tr><td>{name}</td>", extremes)
        self.assertRegex(extremes, r"<td>frequency = \d+\u00a0Hz, load = \d\u00a0N</td>")
        self.assertIn("<tr><td>period_ratio</td>", extremes)
        axes = {axis["name"]: axis["title"] for axis in data_of(page)["axes"]}
        self.assertEqual(axes, {"frequency": "excitation frequency (Hz)", "load": "constant load (N)"})
        output = Output(self.directory / "rig.h5")
        self.assertEqual(label(output, "load"), axes["load"])  # as in pictures
        self.run_config(CONFIGS / "rig.toml", "s.h5", *STARTS, "observe.attractor=true")
        motions = self.page("s.h5", "--no-histories")
        self.assertIn("<th scope=col>x (m)</th><th scope=col>x′ (m/s)</th>", motions)
        along = ("branch.along=frequency", "branch.range=16 Hz, 27 Hz", "machine.frequency=26 Hz")
        self.run_config(CONFIGS / "rig.toml", "b.h5", *along, command="branch")
        special = self.page("b.h5", "--no-histories")
        heads = [f"<th scope=col>{head}</th>" for head in ("frequency (Hz)", "x (m)", "v (m/s)", "impact speed (m/s)")]
        table = special[special.index("<h3>Special points</h3>") :].split("</thead>")[0]
        self.assertIn("".join(heads), table)

    def test_the_picture_has_a_role_a_label_and_words_and_only_the_place_is_told(self):
        self.run_config(CONFIGS / "rig.toml", "rig.h5")
        page = self.page("rig.h5", "--no-histories")
        with h5py.File(self.directory / "rig.h5") as file:
            title = file.attrs["title"]
        self.assertIn(f'<figure class=picture tabindex=0 role=group aria-label="Picture of {title}"', page)
        (words,) = re.findall(rf'<img alt="Picture of {re.escape(title)}: (.*?)"', page)
        self.assertRegex(words, "velocity.* over .*frequency|time")
        self.assertNotIn("$", words)
        self.assertEqual(page.count("aria-live"), 0)
        self.assertEqual(page.count("role=status"), 1)


if __name__ == "__main__":
    unittest.main()
