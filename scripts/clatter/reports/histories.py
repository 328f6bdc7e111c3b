"""The motion of some points of an output: stored in it, or computed for the page by the program."""

import subprocess

import numpy as np

from .._command import run_child, temporary_folder
from .._program import program
from ..plots.data import Output
from ..plots.motion import motion
from .commands import keys_along
from .points import packed, shared_out, spread

MOST = 200  # points whose motion is in a page
SAMPLES = 241  # of a motion that is computed for it
ROWS = 100_000  # of all motions in the page
PERIODS = 8  # of a motion without a period
SECONDS = 600  # that the program may take


class NoHistories(Exception):
    """Why there is no motion; the message is a sentence for the page."""


def histories(output, may_run):
    """Indexes along each axis, and the motion of every point that they make: {"indexes": [...], "records": [...]}."""
    if output.is_branch or output.is_accuracy:
        raise NoHistories("This kind of file has no motion of single points.")
    kept = [spread(length, most) for length, most in zip(output.shape, shared_out(MOST, output.shape))]
    part, places = output, kept
    if any(name not in output for name in ("tau", "x", "v")):
        if not may_run:
            raise NoHistories("The file has no motion, and none was computed (--no-histories).")
        if output.follow:
            raise NoHistories(
                "Each point of this sweep started from the end of the one before, so its motion can't be computed "
                "alone; observe.trajectory stores it."
            )
        part, places = computed(output, kept), [range(len(indexes)) for indexes in kept]
    shape = tuple(len(indexes) for indexes in kept)
    points = [tuple(indexes[i] for indexes, i in zip(places, place)) for place in np.ndindex(shape)]
    return {
        "indexes": [list(map(int, indexes)) for indexes in kept],
        "axes": [list(map(in_json, output.values(axis)[indexes])) for axis, indexes in zip(output.axes, kept)],
        "records": [record(part, point, max(500, ROWS // len(points))) for point in points],
    }


def in_json(value):
    """A number as JSON has it; it knows no infinite ones, which are texts here, as a command takes them."""
    value = float(value)
    return value if np.isfinite(value) else str(value)


def record(output, index, rows):
    """Time, displacement and velocity of the last rows of a point, each impact with both sides; None without rows."""
    tau, x, v = motion(output, index)
    known = np.isfinite(tau) & np.isfinite(x)
    tau, x, v = tau[known], x[known], v[known]
    if len(tau) < 2:
        return None
    first = max(0, len(tau) - rows)
    lower, upper = (float(stop[index]) for stop in output.reach())
    stops = [stop for stop in (lower, upper) if np.isfinite(stop)]
    values = np.concatenate([tau[first:], x[first:], v[first:]]).astype("<f4")  # fewer digits, so that they deflate
    return {"values": packed(values), "stops": stops}


def computed(output, kept):
    """The output of a run at these points that keeps the motion and nothing else."""
    with temporary_folder("clatter-report-") as folder:
        config, file = folder / "configuration.toml", folder / "motion.h5"
        config.write_text(output.config_text, encoding="utf-8")
        found = program()
        if not found:
            raise NoHistories("The motion wasn't computed: there is no program clatter on PATH; CLATTER may name it.")
        words = [found, "run", str(config), "-o", str(file), "--quiet", *settings(output, kept)]
        try:
            done = run_child(words, SECONDS, stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            raise NoHistories(f"The motion wasn't computed: that took over {SECONDS} s.") from None
        except OSError as error:
            raise NoHistories(f"The motion wasn't computed: {words[0]} doesn't run ({error.strerror}).") from None
        if not file.exists():
            reason = done.stderr.strip().replace(f"{config}:", "").removeprefix("clatter: ")
            raise NoHistories(f"The motion wasn't computed, since the program says: {reason or done.returncode}")
        return Output(file)


def settings(output, kept):
    """Words that change the configuration: the axes at these indexes, and only the motion kept."""
    changes = {f"observe.{key}": "false" for key, value in output.config.get("observe", {}).items() if value is True}
    changes.update({"observe.trajectory": SAMPLES, "observe.impact_log": "true", "time.window": PERIODS})
    for axis, indexes in zip(output.axes, kept):
        for key in keys_along(output, axis):
            changes[f"sweep.{key}"] = "[" + ", ".join(repr(float(v)) for v in output.values(key)[indexes]) + "]"
    return [word for key, value in changes.items() for word in ("--set", f"{key}={value}")]
