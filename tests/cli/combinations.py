"""Relations between runs of random scenes that hold in mechanics.

Nothing is shared with the program but its files: integrals of our own decide whether one impact of a log follows from
the one before, and everything else is a relation between runs of one motion written in two ways: mirrored, scaled,
shifted, in other units of time, cut in two, alone instead of in a sweep, on another instruction set.

usage: combinations.py [SCENES [SEED]]     (environment: CLATTER, the program)
"""

import math
import os
import sys
import tempfile

import numpy as np
from free_flight import flown
from random_scenes import is_beyond_soft, rough_scenes
from scene_runs import OBSERVED, Program, fastest, machine_keys, sizes
from steady_relations import SteadyMotions

DURATION = 24.0


class Campaign:
    """Compares runs of one motion written in two ways."""

    def __init__(self, program, scenes, stream=None):
        self.scenes, self.stream, self.failures = scenes, stream, []
        with tempfile.TemporaryDirectory() as folder:
            self.program = Program(program, folder)
            self.transients()
            SteadyMotions(self.program, scenes, self.fail, self.say)

    def fail(self, relation, i, text):
        self.failures.append((relation, i, text, self.scenes[i]))

    def transients(self):
        scenes = self.scenes
        time = f'mode = "transient"\nduration = {DURATION}\n'

        def run(scenes, *words, time=time, **how):
            return self.program.run(scenes, time, OBSERVED, *words, **how)

        base = self.base = run(scenes)
        # How much a motion magnifies a change decides how far two runs of it may be apart.
        size = sizes(base, "x") + np.array([abs(s.x0) for s in scenes])
        nudge = 1e-11
        aside = run([s.changed(v0=s.v0 + nudge * (1 if s.v0 >= 0 else -1) * max(1, abs(s.v0))) for s in scenes])
        aside2 = run([s.changed(nu=s.nu * (1 + nudge)) for s in scenes])
        aside3 = run([s if s.x0 in (s.stop_lower, s.stop_upper) else s.changed(x0=s.x0 * (1 - nudge)) for s in scenes])
        self.steady_count = np.ones(len(scenes), bool)
        grown = np.zeros(len(scenes))
        sticks = of_friction(base, "stick_fraction")
        for other in (aside, aside2, aside3):
            self.steady_count &= self.counts(other) == self.counts(base)
            for name in ("x", "v"):
                grown = np.maximum(grown, np.abs(other[name] - base[name]).max(axis=1) / nudge)
                for end in ("_min", "_max"):
                    grown = np.maximum(grown, np.abs(other[name + end] - base[name + end]) / nudge)
            grown = np.maximum(grown, np.abs(of_friction(other, "stick_fraction") - sticks) / nudge)
        self.allowed = 1e-14 * (1e2 * grown + 30 * size + 30 * sizes(base, "v"))
        self.decided = (base["status"] == 2) & np.isfinite(grown) & (self.allowed < 1e-6 * (1 + size))
        self.say(f"{self.decided.sum()} of {len(scenes)} decided")

        def compare(relation, other, **how):
            self.compare(relation, base, other, **how)

        compare("scalar", run(scenes, "--arch", "scalar"))
        compare("effects", run(scenes, "--set", "integrator.effects=all"))
        compare("mirror", run([s.mirrored() for s in scenes]), mirror=True)
        shaken = [s.turned() if s.base_amplitude or s.stop_amplitude else s for s in scenes]
        compare("half a turn ahead", run(shaken))
        compare("scale 4", run([s.scaled(4.0) for s in scenes]), size=4.0)
        compare("scale 3", run([s.scaled(3.0) for s in scenes]), size=3.0)
        compare(
            "time",
            run([s.in_time(3.0) for s in scenes], time=time.replace(str(DURATION), str(3 * DURATION))),
            speed=3.0,
        )
        millimetres = [s.scaled(0.002).in_time(1 / 160) for s in scenes]
        in_si = {"section": "[machine]\nmass = 0.37\n", "keys_of": machine_keys(0.37)}
        theirs = run(millimetres, time=time.replace(str(DURATION), str(DURATION / 160)), **in_si)
        compare("machine", theirs, size=0.002, speed=1 / 160, mass=0.37)
        still = [s if s.base_amplitude or s.stop_amplitude else s.shifted(0.75) for s in scenes]
        places = np.array([0.0 if s.base_amplitude or s.stop_amplitude else 0.75 for s in scenes])
        compare("shift", run(still), shift=places)
        self.split(run, base, time)
        self.alone(run, base)
        self.logs(base)
        self.hardest(base)
        self.energy(base)

    def say(self, text):
        if self.stream:
            print(text, file=self.stream, flush=True)

    @staticmethod
    def counts(runs):
        return np.array([len(log) for log in runs.logs])

    def compare(self, relation, base, other, mirror=False, size=1.0, speed=1.0, shift=0.0, mass=1.0):
        sign = -1.0 if mirror else 1.0
        places = np.broadcast_to(np.asarray(shift), (len(self.scenes),))
        low, high = ("max", "min") if mirror else ("min", "max")

        def check(name, mine, its, scale=1.0):
            off, allowed = np.abs(mine - its), scale * self.allowed
            while off.ndim > 1:
                off = off.max(axis=-1)
            for i in np.flatnonzero(self.decided & ~(off <= allowed)):
                self.fail(relation, i, f"{name} {mine[i]} for {its[i]}, allowed {allowed[i]:.2g}")

        for i in np.flatnonzero(self.decided & (other["status"] != base["status"])):
            self.fail(relation, i, f"status {other['status'][i]} for {base['status'][i]}")
        check("x_min", sign * other["x_" + low] / size - places, base["x_min"])
        check("x_max", sign * other["x_" + high] / size - places, base["x_max"])
        check("v_min", sign * other["v_" + low] * speed / size, base["v_min"])
        check("v_max", sign * other["v_" + high] * speed / size, base["v_max"])
        # of its energy, as a touch of a mass that begins on its stop has the root of a rounding
        hardest = other["impact_speed"][:, ::-1] if mirror else other["impact_speed"]
        squared = (np.nan_to_num(hardest) * speed / size) ** 2
        check("impact_speed ^ 2", squared, np.nan_to_num(base["impact_speed"]) ** 2, 1 + 2 * sizes(base, "v"))
        check("x", sign * other["x"] / size - places[:, None], base["x"])
        check("v", sign * other["v"] * speed / size, base["v"])
        scale = 1 + sizes(base, "v") * (1 + self.counts(base))
        check("stick_fraction", of_friction(other, "stick_fraction"), of_friction(base, "stick_fraction"))
        for name in ("work_in", "loss_damping", "loss_impact", "loss_friction"):
            if relation == "shift" and name == "work_in":
                continue  # the spring's place counts as load
            mine = of_friction(base, name) if name == "loss_friction" else base[name]
            its = of_friction(other, name) if name == "loss_friction" else other[name]
            its = its * speed**2 / size**2 / mass
            if its.ndim == 2 and mirror:
                its = its[:, ::-1]
            check(name, its, mine, 10 * scale + 100 * np.abs(mine).reshape(len(self.scenes), -1).max(axis=1))
        for i in np.flatnonzero(self.decided & self.steady_count & (self.counts(other) != self.counts(base))):
            self.fail(relation, i, f"{self.counts(other)[i]} impacts for {self.counts(base)[i]}")

    def split(self, run, base, time):
        """A run cut in two has the states, impacts and extrema of the whole."""
        halves = time.replace(str(DURATION), str(DURATION / 2))
        first = run(self.scenes, time=halves)
        theirs = [
            s.changed(
                x0=first["x"][i, -1],
                v0=first["v"][i, -1],
                phase=math.remainder(s.phase + s.nu * DURATION / 2, 2 * math.pi),
            )
            for i, s in enumerate(self.scenes)
        ]
        usable = [
            i for i, s in enumerate(self.scenes) if self.decided[i] and not s.base_amplitude and not s.stop_amplitude
        ]
        if not usable:
            return
        second = run([theirs[i] for i in usable], time=halves)
        for j, i in enumerate(usable):
            allowed = 1e2 * self.allowed[i]
            for name in ("x", "v"):
                if not abs(second[name][j, -1] - base[name][i, -1]) <= allowed:
                    self.fail(
                        "split", i, f"{name} {second[name][j, -1]} for {base[name][i, -1]}, allowed {allowed:.2g}"
                    )
                for end, of in (("_min", min), ("_max", max)):
                    both = of(first[name + end][i], second[name + end][j])
                    if not abs(both - base[name + end][i]) <= allowed:
                        self.fail("split", i, f"{name + end} {both} for {base[name + end][i]}, allowed {allowed:.2g}")
            forced = not self.scenes[i].is_unforced()  # else the height at which a chatter is summed is of the start
            both = len(first.logs[i]) + len(second.logs[j])
            in_contact = is_beyond_soft(theirs[i]) or first["rest_fraction"][i].sum() > 0
            if forced and self.steady_count[i] and not in_contact and both != len(base.logs[i]):
                self.fail("split", i, f"{both} impacts for {len(base.logs[i])}")

    def alone(self, run, base):
        """A point alone has the bytes of the point in a sweep."""
        for i in range(0, len(self.scenes), max(1, len(self.scenes) // 20)):
            one = run([self.scenes[i]])
            for name in ("x_min", "x_max", "v_min", "v_max", "work_in", "x", "v"):
                if not np.array_equal(one[name][0], base[name][i], equal_nan=True):
                    self.fail("alone", i, f"{name} {one[name][0]} for {base[name][i]}")
            if not np.array_equal(one.logs[0], base.logs[i], equal_nan=True):
                self.fail("alone", i, "another log")

    def energy(self, base):
        """Finite motion has finite energies, and they balance."""
        for i in np.flatnonzero(base["status"] == 2):
            residual = base["energy_residual"][i]
            size = max(
                abs(base["work_in"][i]),
                base["loss_damping"][i],
                base["loss_impact"][i].max(),
                of_friction(base, "loss_friction")[i],
                sizes(base, "v")[i] ** 2,
                sizes(base, "x")[i] ** 2,
            )
            if not abs(residual) <= 1e-10 * size + 1e-12:
                self.fail("energy", i, f"residual {residual} of {size}")

    def hardest(self, base):
        """No impact of the log is faster than the fastest, and one is as fast."""
        for i in np.flatnonzero(base["status"] == 2):
            if not np.array_equal(base["impact_speed"][i], fastest(base.logs[i]), equal_nan=True):
                self.fail("hardest", i, f"impact_speed {base['impact_speed'][i]} for {fastest(base.logs[i])}")

    def logs(self, base):
        """Each impact of rigid stops at rest follows from the one before, by closed forms, if nothing rubs."""
        for i in np.flatnonzero(base["status"] == 2):
            s, log = self.scenes[i], base.logs[i]
            soft = math.isfinite(s.stop_stiffness_lower) or math.isfinite(s.stop_stiffness_upper)
            if s.friction or soft or s.stop_amplitude or s.base_amplitude or len(log) == 0:
                continue
            tau, x, v = 0.0, s.x0, s.v0
            if x == s.stop_lower:
                v = max(v, -s.R_at("_lower", abs(v)) * v)  # the impact at the beginning isn't logged
            if x == s.stop_upper:
                v = min(v, -s.R_at("_upper", abs(v)) * v)
            for time, side, before, after in log[:40]:
                stop, name = (s.stop_upper, "_upper") if side > 0 else (s.stop_lower, "_lower")
                R, ulps = s.R_at(name, abs(before)), 4 if getattr(s, "R_exponent" + name) else 1  # of the power
                held = v == 0 and x in (s.stop_lower, s.stop_upper)  # it may have rested in between
                there = flown(s, tau, x, v, time - tau)
                off = abs(there[0] - stop) + abs(there[1] - before)
                if not held and not off <= 1e-9 * (1 + abs(stop) + abs(before)):
                    self.fail("log", i, f"impact at {time}: {there} for {stop}, {before}")
                    break
                if not abs(after + R * before) <= ulps * 1e-15 * abs(before):
                    self.fail("log", i, f"impact at {time}: {after} after {before}")
                    break
                # a slow rebound may be the one after which a chatter is summed
                if abs(after) < 1e-5:
                    break
                tau, x, v = time, stop, after
            else:
                # after the last impact the mass flies to the end of the run, unless it rebounds too low to be told
                low = after**2 / 2 < 1e-10 * (abs(s.f) + abs(s.load) + abs(s.stiffness * stop)) if len(log) else True
                if not low and len(log) <= 40:
                    there = flown(s, tau, x, v, DURATION - tau)
                    off = abs(there[0] - base["x"][i, -1]) + abs(there[1] - base["v"][i, -1])
                    if not off <= 1e-8 * (1 + abs(there[0]) + abs(there[1])):
                        self.fail("log", i, f"{there} at the end for {base['x'][i, -1]}, {base['v'][i, -1]}")


def of_friction(runs, name):
    """Values of a result that only scenes with friction have, 0 of the others."""
    return np.nan_to_num(runs.values.get(name, np.zeros(len(runs.logs))))


def report(failures):
    kinds, lines = {}, []
    for relation, i, text, scene in failures:
        kinds.setdefault(relation, []).append((i, text, scene))
    for relation, found in kinds.items():
        lines.append(f"{relation}: {len({i for i, _, _ in found})} scenes")
        lines += [f"  {i}: {text}\n    {scene}" for i, text, scene in found[:4]]
    return "\n".join(lines)


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    failed = False
    for first in range(0, count, 250):
        scenes = rough_scenes(min(250, count - first), seed + first // 250)
        campaign = Campaign(os.environ["CLATTER"], scenes, sys.stdout)
        print(report(campaign.failures), flush=True)
        failed = failed or bool(campaign.failures)
    sys.exit(failed)


if __name__ == "__main__":
    main()
