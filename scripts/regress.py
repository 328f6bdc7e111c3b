#!/usr/bin/python3
"""Writes baselines for scripts/regress.sh, and compares outputs with them; --help says more."""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tomllib
import typing

import numpy

from clatter.hdf5_files import UNREADABLE, FileProblem, open_output, values_of

ROWS = 11  # of each variable in a text baseline: its points are far from tangencies, past which the last bits decide
SETTLING = (
    "impact_total",
    "simulated_periods",
    "settling_estimate",
)  # how long it took to get there: work, and no property of the motion
STARTS = ("motion_points", "motion_share", "motion_share_low", "motion_share_high")  # counts of starts, or their shares
SMALL = 1e-4  # the least scale of a variable
FEW = 0.002  # of the starts lie so close to the boundary of a basin that rounding decides which motion they end in
REFERENCES = ("DIMENSION_LIST", "REFERENCE_LIST")  # attributes that point at other variables
APERIODIC, UNDECIDED = 1, 4


class Variable(typing.NamedTuple):
    type: str
    shape: tuple
    step: int  # every how many rows are there
    rows: numpy.ndarray  # points of the sweep; of a single point, and of what isn't swept, the first dimension
    swept: bool = False
    attributes: dict = {}


class Output(typing.NamedTuple):
    config: str  # its sha256
    variables: dict
    is_text: bool
    follow: int | None = None  # the dimension along which each point starts from the end of the one before
    direction: str = "up"  # along it


def read_h5(path):
    variables = {}
    with open_output(path) as file:
        sweep = file["status"].shape
        for name, dataset in file.items():
            if b"netCDF dimension but not a netCDF variable" in dataset.attrs.get("NAME", b""):
                continue  # a length, which the variables along it have, too
            swept = dataset.attrs.get("CLASS") != b"DIMENSION_SCALE" and dataset.shape[: len(sweep)] == sweep
            number = math.prod(sweep) if swept and sweep else (dataset.shape or (1,))[0]
            values = values_of(dataset)
            rows = values.reshape(number, values.size // max(number, 1))
            kind = "string" if rows.dtype.kind == "U" else str(rows.dtype)
            attributes = {key: str(value) for key, value in dataset.attrs.items() if key not in REFERENCES}
            rows = rows if kind == "string" else rows.astype(float)
            variables[name] = Variable(kind, values.shape, 1, rows, swept, attributes)
        return Output(file.attrs["config_sha256"], variables, False, *followed(file))


def followed(file):
    """The dimension along which each point starts from the end of the one before, or None, and the direction."""
    sweep = tomllib.loads(file.attrs["config"])["sweep"]
    direction = sweep.pop("direction", "up")
    axes = ["direction"] * (direction == "both") + [key for key in sweep if key not in ("linked", "follow")]
    alone = len(axes) == len(file["status"].shape)  # no axis is linked to another
    return axes.index(sweep["follow"]) if alone and sweep.get("follow") in axes else None, direction


def running_order(shape, follow, direction):
    """The numbers of the points, [position along a branch][branch], as they are run one after the other."""
    points = numpy.arange(math.prod(shape)).reshape(shape)
    if direction == "both":
        there, back = (numpy.moveaxis(way, follow - 1, 0) for way in points)
        return numpy.concatenate([there, back[::-1]]).reshape(2 * len(there), -1)
    along = numpy.moveaxis(points, follow, 0)
    return (along[::-1] if direction == "down" else along).reshape(len(along), -1)


def text_of(output):
    lines = [
        "# By scripts/regress.sh. A line is a variable of the output: name, type, shape, every how many rows, how "
        "many, their values",
        f"config_sha256 {output.config}",
    ]
    for name, (kind, shape, _, rows, *_) in output.variables.items():
        if name not in SETTLING:
            step = max(1, math.ceil(len(rows) / ROWS))
            kept = rows[::step]
            values = [json.dumps(value) if kind == "string" else f"{value:.15g}" for value in kept.ravel().tolist()]
            lines.append(
                " ".join([name, kind, "x".join(map(str, shape)) or "scalar", str(step), str(len(kept)), *values])
            )
    return "\n".join(lines) + "\n"


def read_text(path):
    _, config, *lines = path.read_text(encoding="ascii").splitlines()
    variables = {}
    for name, kind, lengths, step, number, *values in map(str.split, lines):
        shape = () if lengths == "scalar" else tuple(map(int, lengths.split("x")))
        rows = numpy.array(list(map(json.loads, values)), str) if kind == "string" else numpy.array(values, float)
        variables[name] = Variable(kind, shape, int(step), rows.reshape(int(number), -1))
    return Output(config.split()[1], variables, True)


def difference(a, b):
    """Of each two numbers; NaN equals itself."""
    with numpy.errstate(invalid="ignore"):  # inf - inf
        return numpy.where((a == b) | (numpy.isnan(a) & numpy.isnan(b)), 0, numpy.abs(a - b))


def scale(values):
    """What a tolerance for numbers of the order of 1 is multiplied by: the largest modulus of a variable that is small
    throughout, as millimetres in m are, but no less than SMALL, below which are rounding errors of zeros."""
    finite = numpy.abs(values[numpy.isfinite(values)])
    return min(1.0, max(SMALL, finite.max(initial=0.0)))


class Comparison:
    """Of an output with its baseline: the differences, and those that are permitted."""

    def __init__(self, base, new, tolerance):
        self.differences, self.permitted = [], []
        self.variables, self.largest, self.where = 0, 0.0, "-"
        self.tolerance = tolerance
        step = base.variables["status"].step
        # if the baseline's isn't aperiodic there, status itself differs
        self.chaotic = numpy.isin(new.variables["status"].rows[::step, 0], (APERIODIC, UNDECIDED))
        self.points = len(self.chaotic)
        self.found = []  # of each variable: its name, where values differ, by how much, and the variable
        left_out = SETTLING if base.is_text else ()
        for name in sorted((base.variables.keys() | new.variables.keys()) - set(left_out)):
            if name not in new.variables:
                self.differences.append(f"{name} is missing")
            elif name not in base.variables:
                self.differences.append(f"{name} is new")
            else:
                self.compare(name, base.variables[name], new)
        self.judge(self.chaotic_starts(base, new))
        if self.differences and base.config != new.config:
            self.differences.append("config_sha256: another configuration")

    def compare(self, name, old, new):
        now = new.variables[name]
        if (old.type, old.shape) != (now.type, now.shape):
            self.differences.append(f"{name} is {now.type}{list(now.shape)}, not {old.type}{list(old.shape)}")
            return
        if old.attributes and old.attributes != now.attributes:
            self.differences.append(f"attributes of {name}")
        a, b = old.rows, now.rows[:: old.step]
        if a.shape != b.shape:
            self.differences.append(f"{name} has {len(b)} rows, not {len(a)}")
            return
        is_text = now.type == "string"
        apart = numpy.where(a == b, 0, math.inf) if is_text else difference(a, b)
        sized = numpy.ones(1) if is_text else a
        if name.endswith("_phase"):  # that of a zero amplitude is noise, and pi is -pi
            amplitudes = new.variables.get(name.replace("_phase", "_amplitude"))  # impacts have none
            amplitude = amplitudes.rows[:: old.step] if amplitudes else numpy.ones(a.shape)
            error = numpy.abs(amplitude) * numpy.abs(numpy.remainder(apart + math.pi, 2 * math.pi) - math.pi)
            if ((apart > self.tolerance) & (error <= self.tolerance * scale(amplitude))).any():
                self.permitted.append(f"{name} by whole turns or of no amplitude")
            apart, sized = numpy.where(apart == 0, 0, error), amplitude
        beyond = ~(apart <= self.tolerance * scale(sized))  # a number beside NaN, too
        if name in STARTS and beyond.any():
            total = math.prod(new.variables["status"].shape) if name == "motion_points" else 1
            if (apart <= 10 * FEW * total).all():
                self.permitted.append(f"{name} by a few starts")
                return
        if name in ("motion_x", "motion_v"):  # states of chaos are any of it
            chaos = new.variables["motion_period_ratio"].rows[:: old.step] == 0
            apart, beyond = numpy.where(chaos, 0, apart), beyond & ~chaos
        if name in SETTLING:
            if beyond.any():
                self.permitted.append(f"{name} at {numpy.count_nonzero(beyond)} points")
            return
        self.found.append((name, apart, beyond, old.step, now))

    def unlike(self):
        """The points that differ in something but their status."""
        unlike = numpy.zeros(self.points, dtype=bool)
        for name, _, beyond, _, variable in self.found:
            if variable.swept and name != "status":
                seen = beyond.any(axis=1)
                unlike |= seen if len(seen) == self.points else seen.any()
        return unlike

    def boundary_starts(self):
        """The points that end in another motion, if they are few."""
        beyond = next((beyond for name, _, beyond, _, _ in self.found if name == "attractor"), None)
        if beyond is None:
            return numpy.zeros(self.points, dtype=bool)
        moved = beyond.any(axis=1) & ~self.chaotic
        if not 0 < numpy.count_nonzero(moved) <= FEW * self.points:
            return numpy.zeros(self.points, dtype=bool)
        self.permitted.append(f"the motions of {numpy.count_nonzero(moved)} starts at boundaries of basins")
        return moved

    def chaotic_starts(self, base, new):
        """The points that may differ: aperiodic ones, starts at boundaries of basins, and along a followed branch those
        after them, as far as all of them differ, since the chaos before decides for one of several motions."""
        self.boundary = self.boundary_starts()
        may = self.chaotic | self.boundary
        status = base.variables["status"]
        shape = status.shape if status.step == 1 else (self.points,)
        if new.follow is None or (status.step > 1 and len(status.shape) > 1):
            return may
        unlike, order = self.unlike(), running_order(shape, new.follow, new.direction)
        for before, after in zip(order[:-1], order[1:]):
            may[after] |= may[before] & unlike[after]
        return may

    def judge(self, may):
        """Sums up the differences at all points but those that may differ."""
        count = numpy.count_nonzero(self.unlike() & self.chaotic)
        if count:
            self.permitted.append(f"values at {count} aperiodic points")
        count = numpy.count_nonzero(self.unlike() & may & ~self.chaotic & ~self.boundary)
        if count:
            self.permitted.append(f"values at {count} points that start from chaos")
        for name, apart, beyond, step, variable in self.found:
            if variable.swept and name != "status":
                left_out = numpy.broadcast_to(may, len(apart))
                apart[left_out], beyond[left_out] = 0, False
            self.variables += 1
            if beyond.any():
                self.differences.append(f"{name} at {numpy.count_nonzero(beyond)} of {beyond.size}")
            if apart.size:
                worst = numpy.argmax(apart)  # the first NaN, if any
                row, column = numpy.unravel_index(worst, apart.shape)
                if not (apart.flat[worst] <= self.largest or math.isnan(self.largest)):
                    place = numpy.unravel_index(row * step * apart.shape[1] + column, variable.shape)
                    self.largest = apart.flat[worst]
                    self.where = f"{name}[{','.join(map(str, place))}]" if place else name


def line(name, points, variables, largest, where, h5diff, verdict, note):
    return (
        f"{name:<12} {points:>6}  {variables:>9}  {largest:>8}  {where:<20}  {h5diff:<7}  {verdict:<8}  {note}".rstrip()
    )


def h5diff_of(base, output, tolerance):
    """The verdict of h5diff on two files, only after they are checked: it would follow links out of them."""
    found = subprocess.run(
        ["h5diff", "-c", "-d", str(tolerance), "--exclude-attribute", "/", base.absolute(), output.absolute()],
        check=False,
        capture_output=True,
        text=True,
        errors="replace",
    )
    # For other shapes, "not comparable", it ends with 0; so are, even in equal files, dimensions without values.
    lines = [line for line in found.stdout.splitlines() if not line.endswith("is an empty dataset")]
    return "differs" if found.returncode or lines else "same"


def table_row(baseline, output, tolerance):
    """The line of the table, and whether the output agrees."""
    name = output.stem
    is_text = (baseline / f"{name}.txt").exists()
    base = baseline / f"{name}.{'txt' if is_text else 'h5'}"
    for what, path in (("baseline", base), ("output", output)):
        if not path.exists():
            return line(name, *"-----", "differs", f"no {what}"), False
    try:
        found = Comparison(read_text(base) if is_text else read_h5(base), read_h5(output), tolerance)
    except (FileProblem, *UNREADABLE) as error:
        return line(name, *"-----", "differs", f"can't be read: {error}"), False
    h5diff = "-" if is_text else h5diff_of(base, output, tolerance)
    if h5diff == "differs" and not found.differences and not found.permitted:
        found.differences = ["h5diff finds what isn't seen here"]
    agrees = not found.differences
    note = "but for " + ", ".join(found.permitted) if agrees and found.permitted else "; ".join(found.differences)
    return (
        line(
            name,
            found.points,
            found.variables,
            f"{found.largest:.1e}" if found.largest else "0",
            found.where,
            h5diff,
            "agrees" if agrees else "differs",
            note,
        ),
        agrees,
    )


def table(arguments):
    print(line("output", "points", "variables", "largest", "where", "h5diff", "verdict", "differences"))
    agreeing = 0
    for name in arguments.names:
        row, agrees = table_row(arguments.baseline, arguments.outputs / f"{name}.h5", arguments.tolerance)
        print(row)
        agreeing += agrees
    print(f"{agreeing} of {len(arguments.names)} agree within {arguments.tolerance:g}", file=sys.stderr)
    return 0 if agreeing == len(arguments.names) else 1


def text(arguments):
    for output in sorted(arguments.outputs.glob("*.h5")):
        (arguments.baseline / f"{output.stem}.txt").write_text(text_of(read_h5(output)), encoding="ascii")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    commands = parser.add_subparsers(required=True)
    command = commands.add_parser(
        "table", help="compares outputs with a baseline and prints a table; ends with 1 if any differs"
    )
    command.add_argument("baseline", type=pathlib.Path, help="folder of NAME.h5 or NAME.txt")
    command.add_argument("outputs", type=pathlib.Path, help="folder of NAME.h5")
    command.add_argument("tolerance", type=float)
    command.add_argument("names", nargs="+", metavar="NAME")
    command.set_defaults(run=table)
    command = commands.add_parser("text", help="makes a text baseline of outputs")
    command.add_argument("outputs", type=pathlib.Path, help="folder of NAME.h5")
    command.add_argument("baseline", type=pathlib.Path, help="folder for NAME.txt")
    command.set_defaults(run=text)
    arguments = parser.parse_args()
    return arguments.run(arguments)


if __name__ == "__main__":
    sys.exit(main())
