"""A set of branches that is begun again from any of them has that branch, and those that it meets, again.

A branch is followed both ways from any of its points, and so is each branch that it meets in a special point. So the
special points of all these are found again, whichever branch the set is begun with. And a machine has the branches of
the scene that it is.
"""

import random
import re
import subprocess
import tempfile
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
from coincidences import Failures, Way, machine
from random_scenes import followed_scenes, slipping_scenes
from starts_on_contacts import alike

OBSERVED = "[observe]\nimpacts = true\nenergy = true\nharmonics = 1\n"
MOST = 600  # points of a set; a longer one is cut, and isn't compared: begun elsewhere it may have more points
# Motion isn't begun with that x0 and v0, to 16 digits, don't tell: of such multipliers, or so near to a special point.
STRETCHED, BESIDE = 1e8, 1e-9
CUT = object()
BORN = ("flip", "symmetry breaking")
# Whether a maximum is told depends on where the steps are, which only those of a machine share.
COMPARED = ("fold", "flip", "symmetry breaking", "graze", "crossing-sliding", "grazing-sliding", "switching-sliding")


def branching_scenes(count, seed):
    draw = random.Random(f"sets {seed}")
    kinds = (iter([alike(draw) for _ in range(count)]), iter(followed_scenes(count, seed)))
    kinds += (iter(slipping_scenes(count, seed)),)
    return [next(kinds[i % len(kinds)]) for i in range(count)]


def parameter_of(text):
    return re.search(r'^along = "(\w+)"', text, re.MULTILINE)[1]


class Sets:
    """Compares the sets of scenes; and of texts, which may be of any configuration, with themselves alone."""

    def __init__(self, program, scenes, texts=()):
        self.program, self.failures, self.count = program, Failures(), 0
        with tempfile.TemporaryDirectory() as folder:
            self.folder = Path(folder)
            for i, scene in enumerate(scenes):
                self.compare(i, scene)
            for i, text in enumerate(texts):
                self.begin_again(i, text, parameter_of(text))

    def configuration(self, scene, way=Way(), begun=None):
        """Along the frequency on both sides of that of a scene, begun with it or with another one."""
        values, given = way.keys_of(begun or scene), way.keys_of(scene)
        key = "nu" if "nu" in values else "frequency"
        low, high = 0.85 * given[key], 1.15 * given[key]
        branch = f'[branch]\nalong = "{key}"\nrange = [{low!r}, {high!r}]\nswitch = 1\nmax_points = {MOST}\n'
        lines = "".join(f"{name} = {value!r}\n" for name, value in values.items())
        return f"{way.section}{lines}[time]\nmax_periods = 600\nmax_impacts = 20000\n{OBSERVED}{branch}", key

    def follow(self, text, key, scale=1.0, words=()):
        """The special points by branch, the points of each branch, and the file; CUT if they are too many, None if
        nothing is to be followed.
        """
        self.count += 1
        name = self.folder / f"{self.count}.toml"
        name.write_text(text, encoding="utf-8")
        output = name.with_suffix(".h5")
        command = [self.program, "branch", name, "-o", output, "-q", *words]
        subprocess.run(command, capture_output=True, check=False, timeout=300)
        if not output.exists():
            return None
        with h5py.File(output) as data:
            branch = data["branch"][()]
            if len(branch) >= MOST:
                return CUT
            kinds = [kind.decode() for kind in data["special_kind"][()]]
            at, of = data["special_" + key][()] * scale, data["special_branch"][()]
            specials = [(k, float(a), {int(n) for n in row if n >= 0}) for k, a, row in zip(kinds, at, of)]
        return specials, branch, output

    def compare(self, i, scene):
        text, key = self.configuration(scene)
        found = self.begin_again(i, text, key)
        if found is None:
            return
        everything, branch, output = found
        # begun with the motion that the scene settled on: the other one may settle on another, if chaos decides
        begun, period = self.settled(scene, output)
        other, name = self.configuration(scene, machine(), begun)
        in_si = self.follow(other, name, 2 * np.pi, ("--set", f"branch.period={period}"))
        met = set(range(int(branch.max()) + 1))
        self.same("as a machine", i, in_si, everything, met, text)
        if in_si and in_si is not CUT:
            self.same("as a scene", i, found, in_si[0], set(range(int(in_si[1].max()) + 1)), other)

    def begin_again(self, i, text, key):
        """The set, unless it has no special points, or too many of them."""
        found = self.follow(text, key)
        if found is None or found is CUT:
            return None
        everything, branch, output = found
        specials = [special for special in everything if special[0] in COMPARED]
        if not 0 < len(specials) <= 12:
            return None
        for number in range(min(4, int(branch.max()) + 1)):
            points = np.flatnonzero(branch == number)
            middle = self.middle(output, points) if len(points) >= 8 else None
            if middle is None or not self.is_start(output, key, middle, [s for s in everything if number in s[2]]):
                continue
            words = ("--from", output, "--where", f"point={middle}")
            met = {number}
            for kind, at, numbers in specials:
                if number in numbers:
                    reached = numbers if kind in BORN else self.reached(output, number, numbers, key, at)
                    met |= set(reached)
            self.same(f"begun again from branch {number}", i, self.follow(text, key, words=words), specials, met, text)
        return found

    @staticmethod
    def settled(scene, output):
        """A scene begun with the motion of branch 0 nearest to its frequency, and how many periods that has."""
        with h5py.File(output) as data:
            of_branch = np.flatnonzero(data["branch"][()] == 0)
            at = of_branch[np.argmin(np.abs(data["nu"][()][of_branch] - scene.nu))]
            nu, x, v, periods = (float(data[name][at]) for name in ("nu", "x", "v", "period_ratio"))
        return replace(scene, nu=nu, phase=0.0, x0=x, v0=v), int(periods)

    @staticmethod
    def middle(output, points):
        """The point in the middle of a branch by its length. Where a slip begins points may be dense, and the nearest
        of them are no starts: a slip of 1e-8 rad moves a mass by less than the rounding of its place.
        """
        with h5py.File(output) as data:
            length = data["arclength"][()][points]
        return points[np.argmin(np.abs(length - (length[0] + length[-1]) / 2))]

    @staticmethod
    def is_start(output, key, point, specials):
        with h5py.File(output) as data:
            at, parts = data[key][point], (data["multiplier_re"][point], data["multiplier_im"][point])
        is_beside = any(abs(at - special) <= BESIDE * at for _, special, _ in specials)
        return not is_beside and np.hypot(*parts).max() <= STRETCHED

    @staticmethod
    def reached(output, number, numbers, key, at):
        """Which branches are followed from the special point where they meet one: motion that comes to one that repeats
        sooner, or is symmetric, at a graze or a change of halts isn't. There its repetitions may each have the change
        or not, so that motions of any number of them begin, more than two branches, and only that of the least period
        is followed. Where no impact has any speed left, motion without impacts touches a stop, and leads to and from
        motion of the force's period alone.
        """
        with h5py.File(output) as data:
            speed = data["special_impact_speed"][np.argmin(np.abs(data["special_" + key][()] - at))]
            first = {n: np.flatnonzero(data["branch"][()] == n)[0] for n in numbers}
            period, symmetric, word = (
                {n: data[name][point] for n, point in first.items()} for name in ("period_ratio", "symmetric", "word")
            )
        least = min(period.values())

        def is_reached(other):
            if speed <= 1e-9 and not (b"-" in (word[number], word[other]) and period[other] == 1):
                return False
            if len(numbers) > 2 and not period[other] == least < period[number]:
                return False
            return period[other] <= period[number] and not (symmetric[number] == 1 and symmetric[other] == 0)

        return [other for other in numbers if is_reached(other)]

    def same(self, relation, i, again, specials, met, text):
        """All special points of these branches are in another set."""
        if again is CUT:
            return
        self.failures.compared += 1
        for kind, at, numbers in specials:
            near = again and any(k == kind and abs(a - at) <= 1e-7 * at for k, a, _ in again[0])
            if numbers & met and not near:
                self.failures.add(relation.rstrip("0123456789 "), i, f"{relation}: no {kind} at nu = {at!r}", text)
