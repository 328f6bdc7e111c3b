"""A steady motion is one motion, whether it is started between its contacts or on one of them.

Scenes settle from the starts that were drawn; then each is begun anew on a contact of its log (phase from
impact_phase, displacement of the stop, velocity v_after, or v_before of a soft stop), within 1e-12 of it, as a
machine, and on every instruction set. The phase of the start is where the program cuts the motion into periods, so
all contacts of these runs fall together with a section. Periodic motion that contracts has the same word, impacts,
losses, status and multipliers from all of them.
"""

import math
import random
import tempfile

import numpy as np
from coincidences import ALL, IN_LANES, SETTLE, Failures, Way, contracts, differences, log_differences
from coincidences import machine, run
from command_line import runs_here
from free_flight import flown
from random_scenes import compliant_scenes, drawn, logarithmic, rubbed
from random_scenes import Scene, slipping_scenes
from scene_runs import Program, keys_of, numbers, sizes

ARCHES = [name for name in ("scalar", "sse2", "avx2", "avx512") if runs_here(name)]
BESIDE = 1e-12
IN_ENERGY = ("work_in", "loss_damping", "loss_friction", "loss_impact", "energy_residual")
OF_MASS = (*IN_ENERGY, "impulse", "impact_power", "contact_force_max")


def driven(draw):
    """A scene of any effects that a force or a shaking drives, and that loses energy."""
    while True:
        scene = drawn(draw)
        loses = scene.h > 1e-3 or scene.R_lower < 0.97 and scene.R_upper < 0.97
        if not scene.is_unforced() and abs(scene.f) + scene.stop_amplitude + scene.base_amplitude > 0.02 and loses:
            return scene


def bouncing(draw):
    """A ball on a table, with a spring or without one, of either sign."""
    scene = Scene(h=draw.choice([0.0, 0.0, logarithmic(draw, 1e-3, 0.3)]), stop_lower=0.0, load=-draw.uniform(0.5, 2))
    scene.stiffness = draw.choice([0.0, 0.0, logarithmic(draw, 1e-3, 0.5), -logarithmic(draw, 1e-3, 0.05)])
    scene.f, scene.nu = draw.choice([-1, 1]) * logarithmic(draw, 0.3, 3), logarithmic(draw, 0.5, 3)
    scene.R_lower, scene.x0, scene.v0 = draw.uniform(0.2, 0.85), draw.uniform(0, 1), draw.uniform(-1, 1)
    return scene


def alike(draw):
    """Two stops as far from the middle, and as hard."""
    gap = logarithmic(draw, 0.1, 2)
    scene = Scene(h=logarithmic(draw, 5e-3, 0.3), f=draw.choice([-1, 1]), nu=logarithmic(draw, 0.5, 3))
    scene.stop_lower, scene.stop_upper = -gap, gap
    scene.R_lower = scene.R_upper = draw.uniform(0.2, 0.9)
    scene.x0, scene.v0 = draw.uniform(-gap, gap), draw.uniform(-1, 1)
    return scene


def mixed_scenes(count, seed):
    """Scenes of every kind in turn, so that each takes a share of any count."""
    draw = random.Random(f"coincidences {seed}")
    slips, soft = iter(slipping_scenes(count, seed)), iter(compliant_scenes(count, seed))
    kinds = [driven, lambda d: next(slips), bouncing, lambda d: rubbed(d, driven(d)), alike, lambda d: next(soft)]
    return [kinds[i % len(kinds)](draw) for i in range(count)]


def on_soft_stop(scene, side):
    return math.isfinite(scene.stop_stiffness_upper if side > 0 else scene.stop_stiffness_lower)


def at_impact(scene, x, v, log, row):
    """The main mass at an impact of a loose one, by Taylor series from the beginning of a log without rests."""
    share, tau = scene.loose_mass / (1 + scene.loose_mass), 0.0
    for time, _, before, after in log[: row + 1]:
        x, v = flown(scene, tau, x, v, time - tau)
        v, tau = v + share * (before - after), time
    return x, v


class Contacts:
    """Runs scenes, begins them anew on contacts, and keeps the differences."""

    def __init__(self, program, scenes, seed=0):
        self.scenes, self.failures, self.draw = scenes, Failures(), random.Random(f"contacts {seed}")
        with tempfile.TemporaryDirectory() as folder:
            self.program = Program(program, folder)
            self.reference = run(self.program, scenes, ALL)
            self.chosen = [i for i in range(len(scenes)) if self.is_usable(i)]
            self.begin_anew()

    def is_usable(self, i):
        runs, log = self.reference, self.reference.logs[i]
        if not contracts(runs, i) or len(log) == 0 or self.is_chance(i):
            return False
        if np.nansum(runs["rest_fraction"][i]) > 0 and self.scenes[i].loose_mass:
            return False  # the place of the main mass isn't in the log
        first, last = log[0][0], log[-1][0]
        period = runs["period"][i]
        return 1e-6 < first and last < period - 1e-6  # no contact is near a section already

    def is_chance(self, i):
        """Whether a motion rests now and then, and may be chaotic between the rests: another start may not have come to
        rest by the end, and the last digits of a scene, in which that of a machine differs, decide the period."""
        return np.nansum(self.reference["rest_fraction"][i]) > 0 and self.reference["period_ratio"][i] >= 4

    def start(self, i, row):
        """The scene begun on an impact of its log; where the next velocity isn't known, just before it."""
        scene, log = self.scenes[i], self.reference.logs[i]
        time, side, before, after = log[row]
        phase = math.remainder(scene.phase + scene.nu * time, 2 * math.pi)
        if not scene.loose_mass:
            stop = scene.stop_upper if side > 0 else scene.stop_lower
            return scene.changed(phase=phase, x0=stop, v0=before if on_soft_stop(scene, side) else after)
        runs = self.reference
        x, v = at_impact(scene, runs["x"][i, 0], runs["v"][i, 0], log, row)
        wall = scene.loose_upper if side > 0 else scene.loose_lower
        return scene.changed(phase=phase, x0=x, v0=v, loose_x0=wall, loose_v0=after)

    def rows(self, i):
        """An impact on each stop that is hit."""
        log = self.reference.logs[i]
        return [self.draw.choice(np.flatnonzero(log[:, 1] == side)) for side in sorted(set(log[:, 1]))]

    def begin_anew(self):
        begun = [(i, self.start(i, row)) for i in self.chosen for row in self.rows(i)]
        before = [(i, s.changed(v0=self.before(s))) for i, s in begun if not s.loose_mass]
        beside = [(i, s.changed(phase=s.phase + sign * BESIDE)) for i, s in begun for sign in (-1, 1)]
        self.compare("on a contact", begun, ALL)
        self.compare("with the velocity before it", before, ALL)
        self.compare("1e-12 beside a contact", beside, IN_LANES)
        self.compare("as a machine", begun, ALL, way=machine())
        for arch in ARCHES:
            self.compare(f"by {arch}", begun, IN_LANES, "--arch", arch)

        self.number([pair for pair in begun if not pair[1].loose_mass][::4])

    def number(self, begun):
        """A start on a contact and one beside it end in one motion, with the word that it has elsewhere."""
        observe = IN_LANES + "attractor = true\n"
        for i, scene in begun:
            gap = min(scene.stop_upper - scene.stop_lower, 1.0)
            aside = scene.x0 + 1e-4 * gap * (-1 if scene.x0 == scene.stop_upper else 1)
            sweep = f"[sweep]\nx0 = {numbers([scene.x0, aside])}\nv0 = {numbers([scene.v0, scene.v0])}\n"
            values = "".join(f"{key} = {value!r}\n" for key, value in keys_of(scene).items() if key not in ("x0", "v0"))
            sweep = f'[scene]\n{values}{sweep}linked = "x0, v0"\n'
            runs = self.program.points(sweep, 2, SETTLE, observe)
            if differences(runs, 1, self.reference, i):
                continue  # that start has another basin, or is told amiss itself
            self.failures.compared += 1
            if not runs["attractor"][0] == runs["attractor"][1] >= 0:
                text = f"attractors {runs['attractor']}, status {runs['status']}, words {runs['impact_word']}"
                self.failures.add("as a numbered start", i, text, f"{sweep}[time]\n{SETTLE}{observe}")

    @staticmethod
    def before(start):
        """The velocity with which a start on a contact came there."""
        upper = start.x0 == start.stop_upper
        if on_soft_stop(start, 1 if upper else -1):
            return start.v0
        R = start.R_upper if upper else start.R_lower
        return -start.v0 / R if R > 0 else (1.0 if upper else -1.0)

    def compare(self, relation, begun, observe, *words, way=Way()):
        runs = run(self.program, [scene for _, scene in begun], observe, *words, way=way)
        for k, (i, scene) in enumerate(begun):
            self.failures.compared += 1
            told = differences(runs, k, self.reference, i, lambda name: way.mass if name in OF_MASS else 1.0)
            if observe == ALL:
                size = 1 + sizes(self.reference, "v")[i]
                rests = np.nansum(self.reference["rest_fraction"][i]) > 0
                told += log_differences(runs.logs[k], self.reference.logs[i], rests, size)
            for text in told:
                self.failures.add(relation, i, text, way.configuration(scene, observe, words))
