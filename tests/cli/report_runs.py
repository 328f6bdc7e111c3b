"""Reports of outputs, the commands that they show for their points, and what these give beside the file's numbers."""

import base64
import csv
import json
import math
import os
import re
import subprocess
import tomllib
import zlib

import h5py
import numpy as np

from command_line import CLATTER, LONGEST, CommandLine, without_progress
from script_runs import run_script

OF_WHOLE_SWEEPS = ("attractor",)  # results that number what all points have in common
OF_BRANCHES = ("x_min", "x_max", "v_min", "v_max", "impact_speed")  # that a run of one period has, too
# In place of the picture of a page, where its commands alone matter: to draw one takes longer than all else.
NO_PICTURE = ("<svg/>", [], "nothing")


class ReportRuns(CommandLine):
    """Makes outputs and their pages in a folder of its own."""

    def report(self, *words, environment=None, run=run_script):
        environment = {"PATH": "/usr/bin:/bin", "CLATTER": CLATTER, **(environment or {})}
        return run("report.py", *words, cwd=self.directory, environment=environment)

    def page(self, *words, name="report.html", **how):
        done = self.report("-o", name, *words, **how)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, f"{name}\n", ""))
        return (self.directory / name).read_text(encoding="utf-8")

    def run_config(self, config, file, *sets, command="run"):
        words = [word for change in sets for word in ("--set", change)]
        done = self.clatter(command, str(config), "-o", file, "-q", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def check(self, file, places=None):
        """Runs the commands of these points of a file, or of some, and compares what they give with the file."""
        data = data_of(self.page(file))
        count = math.prod(data["shape"])
        for flat in places or sorted({0, count // 5, count // 3, (7 * count) // 11, count - 1}):
            place = tuple(int(part) for part in np.unravel_index(flat, data["shape"])) if data["shape"] else ()
            command = command_at(data, place)
            with self.subTest(command):
                self.assert_repeats(command, file, tuple(kept[i] for kept, i in zip(data["whole"], place)))
        return data

    def assert_repeats(self, command, file, index):
        """The command gives the numbers of the point at these indexes of the file."""
        text = in_shell(command, self.directory)
        if is_branch(self.directory / file):
            self.assert_branch_point(file, index[0])
        elif "export" in command:
            self.assert_row(file, index, printed(text))
        else:
            self.assert_point(file, index)

    def alone(self, file):
        """The results of the file that the command of a point has written."""
        return results_at(self.directory / f"{file.removesuffix('.h5')}_point.h5", ())

    def assert_point(self, file, index):
        """The run of a point alone has the bits of the sweep, without the results of effects that it lacks."""
        there, here = results_at(self.directory / file, index), self.alone(file)
        lacks = {name for name in {*there} ^ {*here} if not name.startswith("contact_")}  # of soft stops
        self.assertLessEqual(lacks, {"loss_friction", "stick_fraction"})
        self.assertEqual([there[name] for name in lacks], [0] * len(lacks))
        for name, value in here.items():
            np.testing.assert_array_equal(value, there[name], name)

    def assert_row(self, file, index, row):
        """The row that is printed has the bits of the sweep."""
        there = {name: value for name, value in results_at(self.directory / file, index).items() if name in row}
        self.assertGreater(len(there), 4)
        for name, value in there.items():
            if name == "status":
                self.assertEqual(row[name], meanings(self.directory / file)[int(value)])
            elif isinstance(value, str):
                self.assertEqual(row[name], value)
            else:
                np.testing.assert_array_equal(float(row[name]), float(value), name)

    def assert_branch_point(self, file, place):
        """A run of one period from the state of a branch has its numbers to 1e-9 of the motion. At the ends of branches
        an impact may be about to vanish in a graze, which takes the root of rounding."""
        here, (there, is_end) = self.alone(file), branch_point(self.directory / file, place)
        self.assertLessEqual({"x_min", "x_max", "v_min", "v_max"}, set(here))
        for name, value in ((name, value) for name, value in there.items() if name in here):
            scale = abs(there["x_max" if name.startswith("x") else "v_max"])
            error = (1e-5 if is_end else 1e-9) * scale
            np.testing.assert_allclose(here[name], value, rtol=0, atol=error, err_msg=name)


def data_of(page):
    """The numbers of the only file of a page. What isn't JSON, such as Infinity, is refused."""
    text = re.search(r"<script type=application/json>(.*?)</script>", page, re.DOTALL)[1]
    return json.loads(text, parse_constant=refuse)


def refuse(constant):
    raise ValueError(f"{constant} is no JSON")


def doubles(text):
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), "<f8")


def command_at(data, place):
    """The command that the page shows at these indexes along the axes of its points."""
    flat = np.ravel_multi_index(place, data["shape"]) if place else 0
    parts = []
    for part in data["command"]:
        if isinstance(part, str):
            parts.append(part)
        else:
            value = float(doubles(part["values"])[place[part["axis"]] if "axis" in part else flat])
            parts.append(repr(value).removesuffix(".0"))
    return "".join(parts)


def in_shell(command, folder):
    """What a command prints that is typed here by a user who has clatter on PATH."""
    programs = folder / "programs"
    programs.mkdir(exist_ok=True)
    if not (programs / "clatter").exists():
        (programs / "clatter").symlink_to(os.path.realpath(CLATTER))
    environment = {**os.environ, "PATH": f"{programs}:/usr/bin:/bin"}
    done = subprocess.run(
        ["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True, timeout=LONGEST
    )
    summary = re.fullmatch(
        r"(?:.* warning: .*\n)*\d+ points?, (\d+) failed.*\n", without_progress(done.stderr)
    )  # with a failed point the code may be 1
    if not summary or done.returncode > min(1, int(summary[1])):
        raise AssertionError(f"{command} ends with {done.returncode}: {done.stderr}")
    return done.stdout


def results_at(path, index):
    """Every number and text of a point of an output, by names as `clatter export` has them."""
    found = {}
    with h5py.File(path) as file:
        axes = [dim[0].name.lstrip("/") for dim in file["status"].dims]
        given = [*axes, *tomllib.loads(file.attrs["config"])["sweep"]]
        for name, item in file.items():
            dims = [dim[0].name.lstrip("/") for dim in item.dims if len(dim)]
            if dims[: len(axes)] != axes or name in given or name.startswith("motion") or not dims and item.ndim:
                continue
            found[name] = item.asstr()[index] if h5py.check_string_dtype(item.dtype) else item[index]
            if dims[len(axes) :] == ["stop"]:
                found.update({f"{name}[{stop}]": value for stop, value in zip(file["stop"][:], found.pop(name))})
    return {name: value for name, value in found.items() if name not in OF_WHOLE_SWEEPS}


def meanings(path):
    """The name of each status."""
    with h5py.File(path) as file:
        status = file["status"].attrs
        return dict(zip(map(int, status["flag_values"]), status["flag_meanings"].split()))


def is_branch(path):
    with h5py.File(path) as file:
        return "arclength" in file


def printed(text):
    """The only row of the table that a command prints."""
    rows = list(csv.DictReader(line for line in text.splitlines() if line and not line.startswith("#")))
    if len(rows) != 1:
        raise AssertionError(f"{len(rows)} rows: {text}")
    return rows[0]


def branch_point(path, place):
    """The numbers of a point of a branch that a run has, too, and whether its branch ends there."""
    with h5py.File(path) as file:
        ends = np.flatnonzero(np.diff(file["branch"][:], prepend=-1, append=-1))
        return {name: float(file[name][place]) for name in OF_BRANCHES}, place in ends or place + 1 in ends
