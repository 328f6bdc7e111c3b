"""Relations that hold of the periodic motions which random scenes settle on.

Each comes back to its state after its period and no sooner, by the impacts and with the derivative that are told of it.
"""

import math

import numpy as np
from free_flight import flown
from random_scenes import is_beyond_soft
from scene_runs import OBSERVED, STEADY, complex_of, fastest


class SteadyMotions:
    """Runs scenes until they settle, and runs the motions found again; tells differences by fail(relation, i, text)."""

    def __init__(self, program, scenes, fail, say):
        self.program, self.scenes, self.fail, self.say = program, scenes, fail, say
        self.compare()

    def compare(self):
        """Each periodic motion comes back to its state, by the impacts and with the derivative that are told of it."""
        settle = 'mode = "steady"\nmax_periods = 600\n'
        runs = self.program.run(self.scenes, settle, STEADY)
        periodic = [
            i
            for i in range(len(self.scenes))
            if runs["status"][i] in (0, 3)
            and not self.scenes[i].is_unforced()
            and not self.scenes[i].base_amplitude
            and not self.scenes[i].stop_amplitude
        ]
        self.say(f"{len(periodic)} periodic")
        starts, periods = [], []
        for i in periodic:
            starts.append(self.scenes[i].changed(x0=runs["x"][i, 0], v0=runs["v"][i, 0]))
            periods.append(runs["period"][i])
        for j, i in enumerate(periodic):
            s, log, period = self.scenes[i], runs.logs[i], periods[j]
            turns = period * s.nu / (2 * math.pi)
            if math.isnan(period) and runs["v_min"][i] == runs["v_max"][i] == 0:
                continue  # it stands still
            n = round(turns) if math.isfinite(turns) else 0
            if not (n >= 1 and abs(turns - n) < 1e-9 * n):
                self.fail("period", i, f"{turns} forcing periods, status {runs['status'][i]}")
                continue
            rests = runs["rest_fraction"][i].sum() > 0
            soft = math.isfinite(s.stop_stiffness_lower) or math.isfinite(s.stop_stiffness_upper)
            self.minimal(i, log, n, period)
            if not np.array_equal(runs["impact_speed"][i], fastest(log), equal_nan=True):
                self.fail("hardest", i, f"impact_speed {runs['impact_speed'][i]} for {fastest(log)}")
            if not rests and not soft and not s.friction:
                self.closes(i, s, log, period)
            if runs["status"][i] == 3:
                if not s.friction:  # then a reversal may nearly stick
                    self.grazes(i, s, log, runs)
                continue
            if not rests and not soft and not s.friction:
                of = {-1: "_lower", 1: "_upper"}
                areas = [s.area_factor(of[side], abs(before)) for side, before in log[:, 1:3]]
                expected = math.exp(-2 * s.h * period) * math.prod(areas)
                product = complex_of(runs, i, 0) * complex_of(runs, i, 1)
                if not abs(product - expected) <= 1e-9 * expected + 1e-14:
                    self.fail("multipliers", i, f"product {product} for {expected}")
            self.returns(i, starts[j], period, runs, n)

    def minimal(self, i, log, n, period):
        """No part of the period repeats the motion already."""
        for m in range(1, n):
            if n % m or len(log) == 0 or len(log) * m % n:
                continue
            shift = len(log) * m // n
            later = np.roll(log, -shift, axis=0)
            off = np.abs((later[:, 0] - log[:, 0] - m * period / n + period / 2) % period - period / 2)
            if shift and np.all(off < 1e-7 * period) and np.all(np.abs(later[:, 1:3] - log[:, 1:3]) < 1e-7):
                self.fail("period", i, f"{n} forcing periods, but the motion repeats after {m}")
                return

    def closes(self, i, s, log, period):
        for row, (time, side, _, after) in enumerate(log):
            then = log[(row + 1) % len(log)]
            time_then = then[0] + (period if row + 1 == len(log) else 0)
            stop, next_stop = ((s.stop_upper if b > 0 else s.stop_lower) for b in (side, then[1]))
            there = flown(s, time, stop, after, time_then - time)
            off = abs(there[0] - next_stop) + abs(there[1] - then[2])
            if not off <= 1e-8 * (1 + abs(next_stop) + abs(then[2])):
                self.fail("log", i, f"row {row + 1} of {len(log)}: {there} for {next_stop}, {then[2]}")
                return

    def grazes(self, i, s, log, runs):
        slowest = np.abs(log[:, 2]).min() if len(log) else math.inf
        sides = set(log[:, 1]) if len(log) else set()
        gaps = [
            abs(stop - runs["x" + end][i])
            for stop, end, side in ((s.stop_lower, "_min", -1), (s.stop_upper, "_max", 1))
            if math.isfinite(stop) and side not in sides
        ]
        if slowest > 1e-3 and not any(gap < 1e-6 for gap in gaps) and len(log) < 3:
            self.fail("grazing", i, f"the slowest impact has the speed {slowest}")

    def returns(self, i, start, period, runs, n):
        """The state comes back after a period, and its neighbours as the multipliers say."""
        step = 1e-8 if start.friction else 1e-6  # a mass may stick inside a stiff stop, at places in a narrow band
        nearby = [start]
        for part in (step, step / 4):  # differences of two widths, since contacts with stiff stops are curved
            for sign in (1, -1):
                nearby.append(start.changed(x0=start.x0 + sign * part))
                nearby.append(start.changed(v0=start.v0 + sign * part))
        inside = all(s.stop_lower < s.x0 < s.stop_upper or is_beyond_soft(s) for s in nearby)
        time = f'mode = "transient"\nduration = {float(period)!r}\n'
        # of the frequency: a rest erases a change of the start, but rounding grows in the stretch after it
        nudge = 1e-11
        nudged = start.changed(nu=start.nu * (1 + nudge))
        runs_of = self.program.run([*(nearby if inside else [start]), nudged], time, OBSERVED)
        ends = np.column_stack([runs_of["x"][:, -1], runs_of["v"][:, -1]])
        begin = np.array([start.x0, start.v0])
        multipliers = [complex_of(runs, i, 0), complex_of(runs, i, 1)]
        size = 1 + np.abs(begin).max()
        rests = runs["rest_fraction"][i].sum() > 0
        if inside:
            wide = (ends[1:3] - ends[3:5]).T / (2 * step)
            derivative = (ends[5:7] - ends[7:9]).T / (2 * step / 4)
        growth = 1 + (np.abs(derivative).max() if inside and not rests else 1e3)
        stretched = np.abs(ends[-1] - ends[0]).max() / nudge
        if rests and stretched * nudge > 1e-3:
            return  # a run in double loses the motion; releases_test.py has the digits
        # a repeat is found to 1e-12 of the state
        if not np.abs(ends[0] - begin).max() <= size * (1e-10 * growth + 1e-14 * stretched):
            self.fail("return", i, f"{begin} comes to {ends[0]}")
        if not inside or rests or not np.isfinite(multipliers).all():
            return
        same = all(len(log) == len(runs_of.logs[0]) for log in runs_of.logs[:-1])
        forward = np.column_stack([(ends[1] - ends[0]), (ends[2] - ends[0])]) / step
        curved = np.abs(forward - wide).max()
        if not same or curved > 1e-3 * (1 + np.abs(wide).max()):
            return
        trace, expected = np.trace(derivative), sum(multipliers)
        error = np.abs(wide - derivative).max() / 10  # of a central difference: a fifteenth
        if not abs(trace - expected) <= error + 1e-6 * growth + 4e-15 * stretched / step:
            self.fail("derivative", i, f"trace {trace}, multipliers {multipliers}")
