"""scripts/regress.sh: the committed baseline holds on every instruction set, and whatever isn't as it was is found.

Two configurations of many starts take longer than all others together, on the narrow sets up to ten times as long. With
all of them they are run on the widest set only; on the others with some, which have to give what the widest does.
Nor are those run again that can't have a point in lanes. scripts/long_checks.sh starts runs all of them on every set.
"""

import os
import re
import shutil
import subprocess
import unittest

import h5py
import numpy

from command_line import CLATTER, SOURCE
from regress_runs import ARCHES, RegressRuns

TEXT = SOURCE / "tests" / "regression"
NEEDS_H5DIFF = unittest.skipUnless(shutil.which("h5diff"), "there is no h5diff here (of hdf5-tools)")
SOME_STARTS = {
    "basins": ("x0=linspace(-3, 3, 81)", "v0=linspace(-6, 6, 81)"),
    "zones": ("nu=linspace(0.5, 1.5, 41)", "x0=sobol(-3, 3, 64)", "v0=sobol(-6, 6, 64)"),
}
NEVER_IN_LANES = r"loose_|force_shape|force_table|stop_amplitude_|R_of_speed|R_exponent|\[branch\]"
ALL_STARTS = "CLATTER_ALL_STARTS" in os.environ  # by scripts/long_checks.sh


def without_lanes():
    """The configurations that every instruction set runs by the same code."""
    texts = {path.stem: path.read_text(encoding="utf-8") for path in (SOURCE / "configs").glob("*.toml")}
    return {name for name, text in texts.items() if re.search(rf"(?m)^({NEVER_IN_LANES})", text)}


class Regress(RegressRuns):
    def program_but_for_starts(self):
        """A clatter that runs everything but the configurations of many starts, and those that no set changes."""
        names = {path.stem for path in self.outputs.iterdir()} - SOME_STARTS.keys() - without_lanes()
        return self.program(**dict.fromkeys(names, f'"{CLATTER}" "$@"'))

    def text(self, checksums, **edits):
        """The committed baseline, but for edits of some texts, with checksums that fit or as they were."""
        baseline = self.folder / "baseline"
        shutil.rmtree(baseline, ignore_errors=True)
        shutil.copytree(TEXT, baseline)
        for name, edit in edits.items():
            path = baseline / f"{name}.txt"
            edited = edit(path.read_text())
            path.unlink()
            if edited is not None:
                path.write_text(edited)
        if checksums:
            subprocess.run("LC_ALL=C; sha256sum -- *.txt >SHA256SUMS", shell=True, cwd=baseline, check=True)
        return baseline

    def test_the_committed_baseline_holds_on_every_instruction_set(self):
        for arch in ARCHES:
            with self.subTest(arch):
                ready = arch == ARCHES[-1]  # its outputs are there
                program = CLATTER if ALL_STARTS else self.program() if ready else self.program_but_for_starts()
                rows = self.assert_all_agree(self.regress(TEXT, CLATTER=program, CLATTER_ARCH=arch))
                self.assertEqual(rows.keys(), {path.stem for path in self.outputs.iterdir()})

    def test_some_starts_end_alike_on_every_instruction_set(self):
        for arch in reversed(ARCHES):
            for name, axes in SOME_STARTS.items():
                (self.folder / arch).mkdir(exist_ok=True)
                config, output = SOURCE / "configs" / f"{name}.toml", self.folder / arch / f"{name}.h5"
                words = [word for axis in axes for word in ("--set", f"sweep.{axis}")]
                subprocess.run([CLATTER, "run", config, "-q", "--arch", arch, "-o", output, *words], check=True)
            if arch == ARCHES[-1]:
                continue  # what the others are compared with
            with self.subTest(arch):
                words = ["table", self.folder / ARCHES[-1], self.folder / arch, "1e-9", *SOME_STARTS]
                compare = ["/usr/bin/python3", SOURCE / "scripts" / "regress.py", *words]
                result = subprocess.run(compare, capture_output=True, text=True)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                rows = self.rows(result)
                self.assertEqual({name: row[5] for name, row in rows.items()}, dict.fromkeys(SOME_STARTS, "agrees"))

    def test_a_text_that_was_changed_torn_or_lost_is_found_with_its_checksum_and_without(self):
        def digit(text):
            self.assertEqual(text.count(" 1.82001335208523"), 1)
            return text.replace(" 1.82001335208523", " 1.82001335508523")

        edits = {
            "fig22": digit,
            "fig21": lambda text: text[:700],
            "fig20": lambda text: text[: text.rindex("x_min")],
            "fig23": lambda text: "",
            "fig18": lambda text: None,
        }
        for name, edit in edits.items():
            self.assert_refused(self.regress(self.text(False, **{name: edit})), "isn't what its SHA256SUMS says")
        self.assert_differ(
            self.regress(self.text(True, **edits), CLATTER=self.program()),
            fig22="x_max at 1 of 11",
            fig21="can't be read",
            fig20="x_min is new",
            fig23="can't be read",
            fig18="no baseline",
        )

    @NEEDS_H5DIFF
    def test_another_scene_sweep_or_observable_and_a_failed_run_are_found(self):
        settings = {
            "fig18": "scene.R=0.69",
            "fig21": "sweep.nu=linspace(0.5, 1.5, 500)",
            "fig22": "scene.R=0.69",
            "fig23": "observe.period=false",
            "fig20": "observe.impacts=true",
            "fig19": "scene.R=2",
        }
        expected = {
            "fig18": "another configuration",
            "fig21": "uint8[500], not uint8[501]",
            "fig22": "v_max at ",
            "fig23": "period is missing",
            "fig20": "v_before is new",
            "fig19": "no output",
        }
        for baseline in (TEXT, self.edited()):
            self.assert_differ(self.regress(baseline, CLATTER=self.changed(**settings)), **expected)

    @NEEDS_H5DIFF
    def test_outputs_agree_with_themselves(self):
        rows = self.assert_all_agree(self.regress(self.outputs, CLATTER=self.program_but_for_starts()))
        self.assertEqual({(row[2], row[4]) for row in rows.values()}, {("0", "same")})
        self.assertEqual(rows["fig22"][:2], ["501", "10"])

    @NEEDS_H5DIFF
    def test_only_permitted_differences_pass(self):
        def put(name, index, value):
            return lambda file: file[name].__setitem__(index, value)

        with h5py.File(self.outputs / "fig22.h5") as file:
            chaotic = int(numpy.argmax(file["status"][()] == 1))
        with h5py.File(self.outputs / "fig12.h5") as file:
            phase = file["v_phase"][7, 1]
        with h5py.File(self.outputs / "fig17.h5") as file:
            impact = file["impact_phase"][0]
        baseline = self.edited(
            fig20=lambda file: put("x_max", 7, file["x_max"][7] + 1e-12)(file),
            fig21=lambda file: put("x_max", 7, file["x_max"][7] + 5e-10)(file),
            fig22=put("x_max", chaotic, 1.0),
            fig18=put("simulated_periods", (), 1e3),
            fig12=put("v_phase", (7, 1), phase + 2 * numpy.pi),
            fig13=put("x_phase", (7, 2), 1.0),
            fig17=put("impact_phase", 0, impact - 2 * numpy.pi),
        )
        rows = self.assert_all_agree(self.regress(baseline, CLATTER=self.program()))
        self.assertEqual(
            {name: (row[4], row[6]) for name, row in rows.items() if row[4] != "same"},
            {
                "fig22": ("differs", "but for values at 1 aperiodic points"),
                "fig18": ("differs", "but for simulated_periods at 1 points"),
                "fig12": ("differs", "but for v_phase by whole turns or of no amplitude"),
                "fig13": ("differs", "but for x_phase by whole turns or of no amplitude"),
                "fig17": ("differs", "but for impact_phase by whole turns or of no amplitude"),
            },
        )
        self.assertEqual(rows["fig20"][2:4], ["1.0e-12", "x_max[7]"])

        shutil.rmtree(baseline)
        baseline = self.edited(
            fig20=put("x_max", 7, 3.0),
            fig21=put("x_max", 7, numpy.nan),
            fig22=put("status", chaotic, 0),
            fig23=put("x_max", 7, numpy.inf),
            follow_up=put("nu", 7, 0.7),
            stability=put("status", 7, 1),
            follow_down=lambda file: file["x_max"].attrs.__setitem__("units", "m"),
            fig12=put("v_phase", (7, 1), phase + 1e-6),
            fig17=put("impact_phase", 0, impact + 1e-6),
            drive_si=lambda file: put("x_max", 7, file["x_max"][7] + 5e-11)(file),  # of some mm
            regimes=put("impact_word", (50, 40), "LLLUU"),
            transient=lambda file: file["sample"].attrs.__setitem__("more", 1),
            asymmetric=lambda file: file.create_group("more"),
        )
        (baseline / "fig02.h5").write_bytes((baseline / "fig02.h5").read_bytes()[:20000])
        (baseline / "fig03.h5").unlink()
        shutil.copy(baseline / "fig04.h5", baseline / "fig24.h5")
        result = self.regress(baseline, CLATTER=self.program())
        self.assert_differ(
            result,
            fig20="x_max at 1 of 501",
            fig21="x_max at 1 of 501",
            fig22="status at 1 of 501",
            fig23="x_max at 1 of 501",
            follow_up="nu at 1 of 251",
            stability="status at 1 of 501",
            follow_down="attributes of x_max",
            fig12="v_phase at 1 of 2364",
            fig17="impact_phase at 1 of 2",
            drive_si="x_max at 1 of 501",
            regimes="impact_word at 1 of 8181",
            transient="h5diff finds what isn't seen here",
            asymmetric="'more' is a group or a type, not a variable",
            fig02="can't be read",
            fig03="no baseline",
            fig24="no output",
        )
        self.assertEqual(
            [self.rows(result)[name][2] for name in ("fig20", "fig21", "fig23")], ["1.7e+00", "nan", "inf"]
        )

    def test_chaos_decides_what_the_points_after_it_along_follow_settle_to_until_they_agree_again(self):
        with h5py.File(self.outputs / "follow_up.h5") as file:
            last = numpy.flatnonzero(file["status"][()])[-1]

        def mirror(points):
            def edit(file):
                for point in points:
                    file["x_max"][point], file["x_min"][point] = 3.9, -4.0

            return edit

        for points, verdict, note in (
            ([last + 1, last + 2], "agrees", "but for values at 2 points that start from chaos"),
            ([last + 2, last + 3], "differs", "x_max at 2 of 251; x_min at 2 of 251"),
        ):
            shutil.rmtree(self.folder / "baseline", ignore_errors=True)
            row = self.rows(self.regress(self.edited(follow_up=mirror(points)), CLATTER=self.program()))["follow_up"]
            self.assertEqual((row[5], row[6]), (verdict, note))

    @NEEDS_H5DIFF
    def test_the_line_of_the_guide(self):
        """It tells equal, slightly and grossly different files apart; h5diff alone ignores a different point count."""
        text = (SOURCE / "scripts" / "README.md").read_text()
        begin = text.index("<!-- begin: h5diff -->\n```bash\n")
        line = text[begin : text.index("```\n<!-- end -->", begin)].split("```bash\n")[1]
        edits = {
            "equal": lambda file: None,
            "slight": lambda file: file["x_max"].__setitem__(7, file["x_max"][7] + 1e-12),
            "gross": lambda file: file["x_max"].__setitem__(7, 3.0),
            "commit": lambda file: file.attrs.__setitem__("git_commit", "another"),
            "no number": lambda file: file["x_max"].__setitem__(7, numpy.nan),
        }
        seen, settings = {}, {"points": "sweep.nu=linspace(0.5, 1.5, 500)", "missing": "observe.extrema=false"}
        baseline, new = self.folder / "baseline.h5", self.folder / "new.h5"
        shutil.copy(self.outputs / "fig22.h5", baseline)
        for name in (*edits, *settings, "torn", "trajectory"):
            if name in settings:
                subprocess.run(
                    [CLATTER, "run", SOURCE / "configs" / "fig22.toml", "-q", "-o", new, "--set", settings[name]],
                    check=True,
                )
            elif name == "torn":
                new.write_bytes(baseline.read_bytes()[:20000])
            elif name == "trajectory":
                shutil.copy(self.outputs / "fig18.h5", baseline)
                shutil.copy(baseline, new)
            else:
                shutil.copy(baseline, new)
                with h5py.File(new, "r+") as file:
                    edits[name](file)
            result = subprocess.run(["bash", "-c", line], cwd=self.folder, capture_output=True, text=True)
            seen[name] = result.returncode
            self.assertEqual(bool(result.stdout), bool(result.returncode), name)
        self.assertEqual(
            seen,
            {
                "equal": 0,
                "slight": 0,
                "gross": 1,
                "commit": 0,
                "no number": 1,
                "points": 1,
                "missing": 1,
                "torn": 1,
                "trajectory": 0,
            },
        )

    def test_wrong_use_names_the_remedy(self):
        empty = self.folder / "empty"
        empty.mkdir()
        self.assert_refused(self.regress(), "which baseline?")
        self.assert_refused(self.regress(empty), "--write h5")
        self.assert_refused(self.regress(self.folder / "none"), "--write h5")
        self.assert_refused(self.regress(empty, "--write"), "h5 or text")
        self.assert_refused(self.regress(empty, "--writ"), "unknown option '--writ'")
        self.assert_refused(self.regress(empty, "other"), "one directory")
        self.assert_refused(self.regress(TEXT, CLATTER="/nowhere/clatter"), "/nowhere/clatter is missing")
        self.assert_refused(self.regress(self.outputs, "--write", "text"), "would hold h5 and text")
        self.assert_refused(
            self.regress(empty, "--write", "text", CLATTER=self.program(fig22="exit 70")), "fig22 has no output"
        )
        self.assertEqual(list(empty.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
