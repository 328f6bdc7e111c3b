"""Curves of special points of random scenes, and the branches that they cross.

usage: followed_curves.py [SCENES [SEED]]     (environment: CLATTER, the program)
"""

import os
import sys
import tempfile

import numpy as np
from combinations import report
from followed_branches import BranchCampaign
from random_scenes import slipping_scenes
from scene_runs import Program

KINDS = ("fold", "flip", "symmetry breaking", "graze")


class CurveCampaign:
    """Follows curves of random scenes in the plane of nu and a level of friction. A branch along nu at the level of one
    of their points has the special point there. It begins with the motion that the scene settles on, or near the
    point of the curve, whose state at another nu is no solution of anything that the curve solved."""

    def __init__(self, program, scenes):
        self.scenes, self.failures, self.curves, self.crossings = scenes, [], 0, 0
        self.unmet = 0  # crossings with no branch to compare: none that begins there comes to the special point
        with tempfile.TemporaryDirectory() as folder:
            self.program = Program(program, folder)
            for i, scene in enumerate(scenes):
                for kind in KINDS:
                    self.follow(i, scene, kind)

    def follow(self, i, scene, kind):
        highest = scene.friction_static or 1.5 * scene.friction
        across = f'across = "friction"\nacross_range = [{0.6 * scene.friction!r}, {highest!r}]\ncurve = "{kind}"\n'
        limits = [0.8 * scene.nu, 1.25 * scene.nu]
        found = self.program.branch(scene, limits, across)
        if found is None or not len(found["nu"]):
            return
        for number in range(int(found["branch"].max()) + 1):
            on = np.flatnonzero(found["branch"] == number)
            self.curves += 1
            self.keeps_multiplier(i, kind, found, on)
            middle = on[len(on) // 2]
            if len(on) >= 8 and limits[0] < found["nu"][middle] < limits[1]:
                self.cross(i, scene, kind, found, middle, limits)

    def keeps_multiplier(self, i, kind, found, on):
        """Both ends aside, and short curves: an impact without speed takes the digits of multipliers."""
        if kind not in ("fold", "flip") or len(on) < 8:
            return
        of = {"fold": 1, "flip": -1}[kind]
        off = np.hypot(found["multiplier_re"][on] - of, found["multiplier_im"][on]).min(axis=1)[1:-1]
        if len(off) and not off.max() < 1e-6:
            self.failures.append(("multiplier", i, f"{kind}: off by {off.max()}", self.scenes[i]))

    def cross(self, i, scene, kind, found, point, limits):
        nu, there = found["nu"][point], scene.changed(friction=found["friction"][point])
        state = {"x0": float(found["x"][point]), "v0": float(found["v"][point]), "phase": 0.0}
        period = f"period = {int(np.ceil(found['period_ratio'][point]))}\n"
        starts = [(there, "")] + [(there.changed(nu=float(nu * part), **state), period) for part in (1.002, 0.998)]
        least, nearest = 1.0, None
        for start, keys in starts:
            if not BranchCampaign.is_inside(start) or not limits[0] <= start.nu <= limits[1]:
                continue
            along = self.program.branch(start, limits, keys)
            if along is None:
                continue
            names = [text.decode() for text in along["special_kind"]]
            off = [abs(at - nu) for name, at in zip(names, along["special_nu"]) if name == kind]
            if off and min(off) < least:
                least, nearest = min(off), start
        if least > 1e-3 * nu:
            self.unmet += 1  # another one, if any
            return
        self.crossings += 1
        if least > 1e-8 * nu:
            self.failures.append(
                ("crossing", i, f"{kind} at nu = {nu}, friction = {there.friction}: off by {least}", nearest)
            )


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    campaign = CurveCampaign(os.environ["CLATTER"], slipping_scenes(count, seed))
    print(f"{campaign.curves} curves, {campaign.crossings} special points met by branches, {campaign.unmet} not met")
    print(report(campaign.failures))
    sys.exit(bool(campaign.failures))


if __name__ == "__main__":
    main()
