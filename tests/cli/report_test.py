"""clatter-report: a page has the numbers of the file and commands that give them again; texts of files stay texts."""

import base64
import html
import re
import unittest
import zlib

import h5py
import numpy as np

from command_line import SMALL, SOURCE
from report_runs import ReportRuns, data_of, doubles
from script_runs import start_script


class Report(ReportRuns):
    def small(self, *sets):
        (self.directory / "a.toml").write_text(SMALL, encoding="utf-8")
        self.run_config("a.toml", "a.h5", *sets)

    def test_all_numbers_of_a_map_are_those_of_the_file(self):
        self.run_config(
            SOURCE / "configs/map_nu_xs.toml", "m.h5", "sweep.nu=linspace(0.8, 1.2, 21)", "observe.word=true"
        )
        data = data_of(self.page("m.h5"))
        self.assertEqual(data["shape"], [21, 60])
        with h5py.File(self.directory / "m.h5") as file:
            for axis in data["axes"]:
                np.testing.assert_array_equal(doubles(axis["values"]), file[axis["name"]][:])
            names = {column["name"] for column in data["columns"]}
            self.assertLessEqual({"x_max", "period", "v_before[-1]", "v_before[1]", "impact_word", "status"}, names)
            for column in data["columns"]:
                name, _, part = column["name"].rstrip("]").partition("[")
                there = file[name][:]
                if part:
                    there = there[..., list(file["stop"][:]).index(int(part))]
                shown = doubles(column["values"]).reshape(21, 60)
                if there.dtype.kind == "O":
                    texts = np.vectorize(lambda code, t=column["texts"]: t[str(int(code))])(shown)
                    np.testing.assert_array_equal(texts, there.astype(str))
                else:
                    np.testing.assert_array_equal(shown, there)

    def test_a_click_in_a_panel_of_a_map_names_a_point_of_both_axes(self):
        self.run_config(SOURCE / "configs/map_nu_xs.toml", "m.h5", "sweep.nu=linspace(0.8, 1.2, 9)")
        for panel in data_of(self.page("m.h5", "--no-histories"))["panels"]:
            self.assertEqual(panel["axes"], [0, 1])
            left, top, right, bottom = panel["box"]
            self.assertTrue(0 <= left < right <= 1 and 0 <= top < bottom <= 1, panel)
            self.assertTrue(panel["limits"][0] < 0.8 < 1.2 < panel["limits"][1], panel)

    def test_motion_is_computed_at_points_of_the_sweep(self):
        self.small()
        data = data_of(self.page("a.h5"))
        columns = {column["name"]: doubles(column["values"]) for column in data["columns"]}
        histories = data["histories"]
        self.assertEqual(histories["indexes"], [[0, 1, 2, 3, 4]])
        self.assertEqual(histories["axes"], [[0.5, 0.75, 1.0, 1.25, 1.5]])
        for place, record in enumerate(histories["records"]):
            tau, x, _ = np.frombuffer(zlib.decompress(base64.b64decode(record["values"])), "<f8").reshape(3, -1)
            self.assertEqual(record["stops"], [-4.0, 4.0])
            self.assertAlmostEqual(x.max(), columns["x_max"][place], delta=2e-3)
            self.assertAlmostEqual(tau[-1], columns["period"][place], delta=1e-5)

    def test_without_the_program_the_page_says_that_motion_is_missing(self):
        self.small()
        page = self.page("a.h5", environment={"CLATTER": str(self.directory / "none")})
        self.assertNotIn("histories", data_of(page))
        self.assertIn("The motion wasn&#x27;t computed", page)
        self.assertIn("--no-histories", self.page("a.h5", "--no-histories"))

    def test_a_million_points_make_less_than_5_mb_and_the_page_says_which_it_has(self):
        self.run_config(
            *(SOURCE / "configs/map_nu_xs.toml", "m.h5", "sweep.nu=linspace(0.5, 1.5, 1000)"),
            *("sweep.xs=linspace(2, 12, 1000)", "time.max_periods=50", "observe.impacts=false"),
        )
        page = self.page("m.h5")
        self.assertLess(len(page), 5_000_000)
        data = data_of(page)
        self.assertGreater(min(data["shape"]), 100)
        self.assertLessEqual(max(data["shape"]), 200)
        rows, columns = data["shape"]
        self.assertIn(f"numbers of {rows} × {columns} points, evenly spread over the 1000 × 1000 of the file", page)
        with h5py.File(self.directory / "m.h5") as file:
            shown = {column["name"]: doubles(column["values"]) for column in data["columns"]}
            np.testing.assert_array_equal(
                shown["x_max"].reshape(rows, columns), file["x_max"][:][np.ix_(*data["whole"])]
            )

    def test_special_points_and_motions_are_tables(self):
        self.run_config(SOURCE / "configs/branch.toml", "b.h5", command="branch")
        page = self.page("b.h5")
        with h5py.File(self.directory / "b.h5") as file:
            for kind, nu in zip(file["special_kind"].asstr()[:], file["special_nu"][:]):
                self.assertIn(f"<tr><td>{kind}</td><td class=number>{float(nu)!r}</td>", page)
            self.assertEqual(data_of(page)["shape"], [len(file["nu"])])
        starts = ("sweep.x0=linspace(-3, 3, 11)", "sweep.v0=linspace(-6, 6, 11)")
        self.run_config(SOURCE / "configs/basins.toml", "s.h5", *starts)
        self.assertIn("<h3>Motions</h3>", self.page("s.h5"))

    def test_other_kinds_of_files_have_pages_too(self):
        self.run_config(SOURCE / "configs/transient.toml", "t.h5")
        self.run_config(SOURCE / "configs/hysteresis.toml", "h.h5", "sweep.nu=linspace(0.9, 1, 5)")
        self.run_config(SOURCE / "configs/accuracy_smooth.toml", "q.h5", "time.window=1", command="accuracy")
        page = self.page("t.h5", "h.h5", "q.h5")
        self.assertEqual(page.count("<section class=file"), 3)
        self.assertIn("started from the end of the one before", page)
        self.assertIn("Methods and settings", page)

    def test_texts_of_a_file_are_only_texts_of_the_page(self):
        hostile = "</script><script>alert(1)</script><img src=x onerror=alert(2)>"
        self.small(f"title={hostile}")
        page = self.page("a.h5")
        self.assertEqual(page.count("<script"), 2)  # the numbers, and the page's own
        self.assertNotIn("<img src=x", page)
        self.assertIn(html.escape(hostile), page)
        policy = re.search(r'Content-Security-Policy content="(.*?)"', page)[1]
        self.assertTrue(policy.startswith("default-src 'none'; "), policy)
        self.assertNotIn("unsafe", policy)
        loaded = re.findall(r'(?:src|href)="?([a-z]+:[^"]{9})', page)
        self.assertEqual({place.split(":")[0] for place in loaded}, {"data"})

    def test_the_same_file_gives_the_same_page(self):
        self.small()
        self.assertEqual(self.page("a.h5"), self.page("a.h5", name="again.html", run=start_script))

    def test_only_a_report_is_replaced(self):
        self.small()
        self.page("a.h5")
        self.page("a.h5")
        (self.directory / "mine.html").write_text("<!doctype html>\nmine\n")
        done = self.report("a.h5", "-o", "mine.html")
        self.assertEqual((done.returncode, done.stdout), (74, ""))
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("mine.html: is no report, so it is kept", done.stderr)
        self.assertEqual((self.directory / "mine.html").read_text(), "<!doctype html>\nmine\n")
        done = self.report("a.h5", "-o", "none/a.html")
        self.assertEqual(done.returncode, 74)
        self.assertIn("there is no folder none", done.stderr)
        self.assertEqual(
            sorted(path.name for path in self.directory.iterdir()), "a.h5 a.toml mine.html report.html".split()
        )

    def test_a_file_that_is_no_output_is_named(self):
        (self.directory / "no.h5").write_text("no")
        done = self.report("no.h5")
        self.assertEqual(done.returncode, 74)
        self.assertRegex(done.stderr, r"^clatter-report: no.h5: is not an HDF5 file; .*\n$")
        self.assertEqual(self.report().returncode, 2)


if __name__ == "__main__":
    unittest.main()
