"""Relations between the points of a sweep: followed ones and runs from where the one before ended, starts and the
motions they are numbered by.

usage: sweep_relations.py [SCENES [SEED]]     (environment: CLATTER, the program)
"""

import math
import os
import sys
import tempfile

import numpy as np
from combinations import report
from random_scenes import followed_scenes, is_beyond_soft
from scene_runs import STEADY, Program, keys_of, numbers, sizes

TIME = 'mode = "steady"\nmax_periods = 600\n'
PERIODIC = (0, 3)
NUDGE = 1e-11


class SweepCampaign:
    """Looks for differences; `points` counts the points that were compared."""

    def __init__(self, program, scenes):
        self.scenes, self.failures, self.points = scenes, [], 0
        with tempfile.TemporaryDirectory() as folder:
            self.program = Program(program, folder)
            for i, scene in enumerate(scenes):
                self.followed(i, scene)
                self.starts(i, scene)

    def fail(self, relation, i, text):
        self.failures.append((relation, i, text, self.scenes[i]))

    def sweep(self, scene, axes, observe, more=""):
        """The results of a sweep of one dimension over some keys, in their order; the others stay as they are."""
        fixed = "".join(f"{key} = {value!r}\n" for key, value in keys_of(scene).items() if key not in axes)
        lists = "".join(f"{key} = {numbers(values)}\n" for key, values in axes.items())
        count = len(next(iter(axes.values())))
        linked = f"linked = \"{', '.join(axes)}\"\n" if len(axes) > 1 else ""
        return self.program.points(f"[scene]\n{fixed}[sweep]\n{lists}{linked}{more}", count, TIME, observe)

    def followed(self, i, scene):
        """Each point of a followed sweep is the run that begins where the point before ended."""
        along = scene.nu * np.linspace(1, 1.15, 9)
        runs = self.sweep(scene, {"nu": along}, STEADY, 'follow = "nu"\n')
        begun = [scene] + [scene.changed(x0=runs["x"][k, -1], v0=runs["v"][k, -1]) for k in range(len(along) - 1)]
        begun = [one.changed(nu=float(nu)) for one, nu in zip(begun, along)]
        usable = [
            k
            for k, one in enumerate(begun)
            if k > 0 and runs["status"][k - 1] in PERIODIC and math.isfinite(one.x0) and not is_beyond_soft(one)
        ]
        if not usable:
            return
        # a mass on a stop is left as it is, so that it stays on it
        alone = self.program.run([begun[k] for k in usable], TIME, STEADY)
        aside = self.program.run([begun[k].changed(v0=begun[k].v0 * (1 + NUDGE)) for k in usable], TIME, STEADY)
        size = 1 + sizes(runs, "x") + sizes(runs, "v")
        for j, k in enumerate(usable):
            if not self.same(alone, j, aside, j, 1e-6 * size[k]):
                continue  # rounding decides which motion it settles on
            self.points += 1
            if not self.same(runs, k, alone, j, 1e-7 * size[k]):
                told = [(r["status"][p], r["period_ratio"][p], r["x_max"][p]) for r, p in ((runs, k), (alone, j))]
                self.fail("follow", i, f"nu = {along[k]!r}: {told[0]} for {told[1]}")

    @staticmethod
    def same(runs, k, others, j, allowed):
        """Whether two points are the same periodic motion, or the same failure."""
        if runs["status"][k] != others["status"][j]:
            return False
        if runs["status"][k] not in PERIODIC:
            return runs["status"][k] != 1
        names = ("x_min", "x_max", "v_min", "v_max")
        near = all(abs(runs[name][k] - others[name][j]) <= allowed for name in names)
        return near and np.array_equal(runs["period_ratio"][k], others["period_ratio"][j], equal_nan=True)

    def starts(self, i, scene):
        """Starts have the same number just if they end in the same motion, or where friction holds the mass for good."""
        low, high = max(scene.stop_lower, -2.0), min(scene.stop_upper, 2.0)
        x0 = [low + (high - low) * share for share in (0.5, 0.1, 0.9, 0.3, 0.7, 0.45)]
        v0 = [0.0, 1.3, -0.8, -2.1, 0.4, 3.0]
        runs = self.sweep(scene, {"x0": x0, "v0": v0}, STEADY + "attractor = true\n")
        number, status = runs["attractor"], runs["status"]
        state = np.column_stack([runs["x"][:, 0], runs["v"][:, 0], runs["period_ratio"], runs["x_max"], runs["x_min"]])
        state = np.nan_to_num(state)  # a mass that stands still has no period
        size = 1 + np.abs(state[:, :2]).max(axis=1)
        stuck = runs["stick_fraction"] == 1 if scene.friction else np.zeros(len(x0), bool)
        for a in range(len(x0)):
            for b in range(a):
                if status[a] not in PERIODIC or status[b] not in PERIODIC or min(number[a], number[b]) < 0:
                    continue
                self.points += 1
                off = np.abs(state[a] - state[b]).max() / size[a]
                if (number[a] == number[b]) != (off < 1e-8 or (stuck[a] and stuck[b])):
                    self.fail("attractor", i, f"{number[a]} and {number[b]}: {state[a]} and {state[b]}")
        for a in np.flatnonzero(np.isin(status, PERIODIC) & (number < 0)):
            self.fail("attractor", i, f"none for a motion of period {runs['period_ratio'][a]}")


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    campaign = SweepCampaign(os.environ["CLATTER"], followed_scenes(count, seed))
    print(f"{campaign.points} points\n{report(campaign.failures)}")
    sys.exit(bool(campaign.failures))


if __name__ == "__main__":
    main()
