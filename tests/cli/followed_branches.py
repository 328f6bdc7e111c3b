"""Branches of random scenes, and runs of their points.

usage: followed_branches.py [SCENES [SEED]]     (environment: CLATTER, the program)
"""

import math
import os
import sys
import tempfile

import numpy as np
from combinations import report
from random_scenes import followed_scenes, is_beyond_soft
from scene_runs import OBSERVED, Program

LARGEST_STEP = 0.02  # of a branch, over the width of its range: the default of branch.largest_step


class BranchCampaign:
    """Follows branches of random scenes along nu, and runs their points again."""

    def __init__(self, program, scenes, stream=None):
        self.scenes, self.stream, self.failures, self.points = scenes, stream, [], 0
        self.ended = {}
        with tempfile.TemporaryDirectory() as folder:
            self.program = Program(program, folder)
            for i, scene in enumerate(scenes):
                self.follow(i, scene)

    def fail(self, relation, i, text):
        self.failures.append((relation, i, text, self.scenes[i]))

    def follow(self, i, scene):
        found = self.program.branch(scene, [0.7 * scene.nu, 1.4 * scene.nu])
        if found is None:
            return  # the scene settles on nothing that can be followed
        names = [text.decode() for text in found["special_kind"]]
        for number in range(int(found["branch"].max(initial=-1)) + 1):
            on = found["branch"] == number
            special = [
                (names[k], found["special_nu"][k]) for k, of in enumerate(found["special_branch"]) if number in of
            ]
            self.jumps(i, number, found["nu"][on], scene.nu)
            self.turns(i, number, found["nu"][on], special)
            self.crosses(i, number, found["nu"][on], found["multiplier_re"][on], found["multiplier_im"][on], special)
            if scene.loose_mass:
                self.leaves(i, number, found["nu"][on], found["multiplier_re"][on], found["multiplier_im"][on], special)
        self.twice(i, found)
        self.run_again(i, scene, found)

    def jumps(self, i, number, nu, at_start):
        """No point is farther from the last one than the largest step, its end neither."""
        longest = 1.05 * LARGEST_STEP * 0.7 * at_start
        for k in np.flatnonzero(abs(np.diff(nu)) > longest):
            self.fail("jumps", i, f"branch {number} from nu = {nu[k]} to {nu[k + 1]}")

    def turns(self, i, number, nu, special):
        """Where the parameter turns round there is a fold, or the branch is born."""
        steps = np.diff(nu)
        steps[abs(steps) <= 1e-13 * nu[1:]] = 0  # rounding, as a slip vanishes with the root of the way to there
        for k in np.flatnonzero(steps[:-1] * steps[1:] < 0):
            near = 2 * (abs(steps[k]) + abs(steps[k + 1]))
            kinds = ("fold", "flip", "symmetry breaking", "graze", "chatter limit")
            if not any(kind in kinds and abs(at - nu[k + 1]) <= near for kind, at in special):
                self.fail("turns", i, f"branch {number} at nu = {nu[k + 1]}: {special}")

    def crosses(self, i, number, nu, real, imaginary, special):
        """Where a multiplier passes -1 there is a flip or a loss of symmetry."""
        plain = np.all(imaginary == 0, axis=1) & np.all(np.isfinite(real), axis=1)
        least = real.min(axis=1)
        for k in range(len(nu) - 1):
            if not (plain[k] and plain[k + 1]) or (least[k] < -1) == (least[k + 1] < -1):
                continue
            if max(abs(least[k]), abs(least[k + 1])) > 1.5:
                continue  # a graze in between
            low, high = sorted((nu[k], nu[k + 1]))
            if not any(
                kind in ("flip", "symmetry breaking", "graze", "chatter limit") and low - 1e-6 <= at <= high + 1e-6
                for kind, at in special
            ):
                self.fail("crosses", i, f"branch {number} at nu = {low} ... {high}: {special}")

    def leaves(self, i, number, nu, real, imaginary, special):
        """Where another number of multipliers is outside the unit circle there is a special point: a pair that is not
        real leaves it in a Neimark-Sacker bifurcation."""
        size = np.hypot(real, imaginary)
        outside, pairs = np.sum(size > 1, axis=1), np.sum((size > 1) & (imaginary != 0), axis=1)
        for k in np.flatnonzero(outside[:-1] != outside[1:]):
            if not np.all(size[k : k + 2] < 10):
                continue  # a graze in between
            low, high = sorted((nu[k], nu[k + 1]))
            if abs(pairs[k] - pairs[k + 1]) == 2 and abs(outside[k] - outside[k + 1]) == 2:
                kinds = ("Neimark-Sacker",)
            else:
                kinds = ("fold", "flip", "symmetry breaking", "graze", "Neimark-Sacker")
            near = 2 * np.max(np.abs(np.diff(nu[max(0, k - 1) : k + 3]))) + 1e-6  # a fold lies beyond both
            if not any(kind in kinds and low - near <= at <= high + near for kind, at in special):
                self.fail("leaves", i, f"branch {number} at nu = {low} ... {high}: {special}")

    def twice(self, i, found):
        """No motion is on two branches, but where they meet: a branch doesn't pass through the middle of another."""
        for number in range(int(found["branch"].max(initial=-1)) + 1):
            on = np.flatnonzero(found["branch"] == number)
            if len(on) <= 10:
                continue
            middle = on[len(on) // 2]
            for other in range(number):
                passes = np.flatnonzero((found["branch"] == other) & (found["word"] == found["word"][middle]))
                if self.goes_through(found, passes, middle):
                    self.fail("twice", i, f"a point of branches {number} and {other} at nu = {found['nu'][middle]}")

    @staticmethod
    def goes_through(found, points, at):
        """Whether the curve through points, a cubic of nu between two of them, goes through another point."""
        nu, there = found["nu"][points], found["nu"][at]
        names = ("x", "v", "z", "w") if "z" in found else ("x", "v")
        for k in np.flatnonzero((nu[1:-2] - there) * (nu[2:-1] - there) <= 0):
            four = nu[k : k + 4]
            if not (np.all(np.diff(four) > 0) or np.all(np.diff(four) < 0)):
                continue
            weights = [np.prod([(there - b) / (a - b) for b in four if b != a]) for a in four]
            curved = max(abs(found[name][points[k : k + 4]] @ [-1, 3, -3, 1]) for name in names)
            off = max(abs(found[name][points[k : k + 4]] @ weights - found[name][at]) for name in names)
            if curved < 1e-4 and off < 1e-2 * curved + 1e-9:
                return True
        return False

    @staticmethod
    def at_point(scene, found, point):
        """The scene at a point of a branch, at forcing phase 0."""
        of_loose = {"loose_x0": found["z"][point], "loose_v0": found["w"][point]} if scene.loose_mass else {}
        state = {"x0": found["x"][point], "v0": found["v"][point], "phase": 0.0}
        return scene.changed(nu=found["nu"][point], **state, **of_loose)

    @staticmethod
    def is_inside(scene):
        """Whether a start is clear of rigid stops, and of walls."""
        s = scene
        return (s.stop_lower < s.x0 < s.stop_upper or is_beyond_soft(s)) and s.loose_lower < s.loose_x0 < s.loose_upper

    @staticmethod
    def may_jump(found, point):
        """Whether a point is one at which dry friction begins to hold the mass, or no longer does, or at which rounding
        decides which of two events comes first."""
        jumps = (b"release tangency", b"simultaneous events", b"rebound threshold")
        changes = [b"sliding" in kind or kind in jumps for kind in found["special_kind"]]
        return np.any(np.abs(found["special_nu"][changes] - found["nu"][point]) <= 1e-9)

    def run_again(self, i, scene, found):
        """Points of branches are motions: they come back after their period, in units of time in which that is 2 pi."""
        for ratio in np.unique(found["period_ratio"]):
            if ratio != round(ratio):
                continue
            of = np.flatnonzero((found["period_ratio"] == ratio) & np.isfinite(found["x"]))
            of = of[:: max(1, len(of) // 20)]
            scenes = [self.at_point(scene, found, k).in_time(found["nu"][k]) for k in of]
            inside = [k for k, s in enumerate(scenes) if self.is_inside(s)]
            if not inside:
                continue
            inside = [k for k in inside if not self.may_jump(found, of[k])]
            time = f'mode = "transient"\nduration = {2 * math.pi * ratio!r}\n'
            nudge = 1e-11  # multipliers don't tell how far changes are stretched between two rests, or after one
            nudged = [
                scenes[k].changed(
                    v0=scenes[k].v0 + nudge * (1 if scenes[k].v0 >= 0 else -1), f=scenes[k].f * (1 + nudge)
                )
                for k in inside
            ]
            runs, aside = (self.program.run(starts, time, OBSERVED) for starts in ([scenes[k] for k in inside], nudged))
            names = ("x", "v", "z", "w") if scene.loose_mass else ("x", "v")
            for row, k in enumerate(inside):
                s, point = scenes[k], of[k]
                growth = 1 + np.abs(found["multiplier_re"][point]).max() + np.abs(found["multiplier_im"][point]).max()
                stretched = max(abs(runs[name][row, -1] - aside[name][row, -1]) for name in names) / nudge
                growth = max(growth, stretched)
                if not growth < 1e3:
                    continue
                self.points += 1
                begin = dict(zip(("x", "v", "z", "w"), (s.x0, s.v0, s.loose_x0, s.loose_v0)))
                off = max(abs(runs[name][row, -1] - begin[name]) for name in names)
                ends = [name + end for name in ("xyz" if scene.loose_mass else "x") for end in ("_min", "_max")]
                extrema = max(abs(runs[name][row] - found[name][point]) for name in ends)
                allowed = 1e-7 * growth * (1 + abs(s.x0) + abs(s.v0))
                if not (off <= allowed and extrema <= allowed):
                    self.fail(
                        "run",
                        i,
                        f"branch {found['branch'][point]} at nu = {found['nu'][point]}: off by {off}, "
                        f"extrema by {extrema}",
                    )


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    campaign = BranchCampaign(os.environ["CLATTER"], followed_scenes(count, seed))
    print(f"{campaign.points} points run again")
    print(report(campaign.failures))
    sys.exit(bool(campaign.failures))


if __name__ == "__main__":
    main()
