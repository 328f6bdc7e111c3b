"""The motion of some points of an output: stored in it, or computed for the page by the program."""

import subprocess

import numpy as np

from .._command import run_child, temporary_folder
from .._program import program
from ..plots.data import Output
from ..plots.motion import motion
from ..plots.names import in_one_line, unit_of
from ..plots.style import is_geometric
from .points import keys_along, packed, shared_out, spread

MOST = 200  # points whose motion is in a page
SAMPLES = 241  # of a motion that is computed for it
TELLING = ("attractor", "impact_word", "status")  # results that tell motions apart, the first that a file has
FAR = 1e6  # beyond all inputs
ROWS = 100_000  # of all motions in the page
PERIODS = 8  # of a motion without a period
SECONDS = 600  # that the program may take


class NoHistories(Exception):
    """Why there is no motion; the message is a sentence for the page."""


def histories(output, points, may_run):
    """Indexes along each axis, the motion of every point that they make, which of them is nearest to each point of the
    page, and how they are charted."""
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
    indexes = [tuple(own[i] for own, i in zip(places, place)) for place in np.ndindex(shape)]
    return {
        "indexes": [list(map(int, own)) for own in kept],
        "axes": [list(map(in_json, output.values(axis)[own])) for axis, own in zip(output.axes, kept)],
        "charts": charts(part),
        "records": [record(part, index, max(500, ROWS // len(indexes))) for index in indexes],
        **nearest_records(output, points, kept),
    }


def in_json(value):
    """A number as JSON has it; it knows no infinite ones, which are texts here, as a command takes them."""
    value = float(value)
    return value if np.isfinite(value) else str(value)


def record(output, index, rows):
    """The last rows of a point's motion, each impact with both sides: time, displacement and velocity; of a loose mass
    time, both displacements, place and velocity in the housing. None without rows."""
    numbers = np.stack(housing_motion(output, index) if output.has_loose_mass else motion(output, index))
    numbers = numbers[:, np.isfinite(numbers[:2]).all(axis=0)]
    if numbers.shape[1] < 2:
        return None
    bounds = output.walls() if output.has_loose_mass else output.reach()
    stops = [float(stop[index]) for stop in bounds if np.isfinite(stop[index])]
    shown = numbers[:, max(0, numbers.shape[1] - rows) :].ravel().astype("<f4")  # fewer digits, so that they deflate
    return {"values": packed(shown), "stops": stops}


def housing_motion(output, index):
    """Time, displacements of the main and the loose mass, place and velocity of the loose one in the housing."""
    tau, x, z, w = (output.values(name)[index] for name in ("tau", "x", "z", "w"))
    if "impact_count" in output:
        times, sides, before, after = output.wall_impacts(index)
        wall = np.where(sides < 0, *(wall[index] for wall in output.walls()))
        place, both = np.repeat(np.searchsorted(tau, times), 2), np.stack([before, after], axis=1).ravel()
        x = np.insert(x, place, np.repeat(np.interp(times, tau, x), 2))
        z, w = np.insert(z, place, np.repeat(wall, 2)), np.insert(w, place, both)
        tau = np.insert(tau, place, np.repeat(times, 2))
    return tau, x, x + z, z, w


def charts(output):
    """The charts of a motion: rows of a record across and along, their names with units, and the factors to these;
    where stops or walls are drawn."""
    time, prime = ("t" if output.is_si else "τ"), "\N{PRIME}"
    if output.has_loose_mass:
        return [
            chart(output, (0, time, "tau"), ((1, "x", "x"), (2, "y", "x"))),
            chart(output, (3, "z", "z"), ((4, f"z{prime}", "w"),), "across"),
        ]
    return [
        chart(output, (0, time, "tau"), ((1, "x", "x"),), "along"),
        chart(output, (1, "x", "x"), ((2, f"x{prime}", "v"),), "across"),
    ]


def chart(output, across, along, stops=""):
    """A chart: `across` and each of `along` is (row, symbol, variable)."""
    sides = [(across[1], across[2]), (", ".join(sign for _, sign, _ in along), along[0][2])]
    units = ["mm" if unit_of(output, name) == "mm" else output[name].units for _, name in sides]
    return {
        "rows": [across[0], [row for row, _, _ in along]],
        "names": [f"{sign} ({in_one_line(unit)})" if unit != "1" else sign for (sign, _), unit in zip(sides, units)],
        "scales": [1e3 if unit == "mm" else 1.0 for unit in units],
        "stops": stops,
    }


def nearest_records(output, points, kept):
    """Which record is nearest to each point of the page, by the values of all inputs, in parts of their ranges, and of
    one motion if there is one; and of which motion each record is."""
    told = next((name for name in TELLING if name in output), "")
    kinds = output.values(told).astype(str) if told else np.zeros(output.shape, str)
    own, theirs = np.asarray(kinds[np.ix_(*points.kept)]), np.ravel(kinds[np.ix_(*kept)])
    inputs = [
        (axis, scaled(output.values(key))) for axis, name in enumerate(output.axes) for key in keys_along(output, name)
    ]
    least, nearest = np.full(own.shape, np.inf), np.zeros(own.shape)
    for number, place in enumerate(np.ndindex(*map(len, kept))):
        away = np.where(own == theirs[number], 0.0, FAR)
        for axis, values in inputs:
            along = [-1 if other == axis else 1 for other in range(own.ndim)]
            away = away + ((values[points.kept[axis]] - values[kept[axis][place[axis]]]) ** 2).reshape(along)
        nearest[away < least] = number
        least = np.minimum(least, away)
    return {"nearest": packed(nearest), "other": packed(least >= FAR)}


def scaled(values):
    """Values of an input from 0 to 1, infinite ones at an end; by their logarithms if their ratios are equal."""
    values = np.log(values) if is_geometric(values) else values.astype(float)
    known = values[np.isfinite(values)]
    low, high = (known.min(), known.max()) if known.size else (0.0, 0.0)
    return np.nan_to_num((np.clip(values, low, high) - low) / ((high - low) or 1.0))


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
