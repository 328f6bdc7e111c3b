"""Motion from one release to the next in 60 decimal digits, by Taylor series and events of our own.

A stop that has held a mass lets it go at one phase of the force, without speed. So motion that rests twice on one stop
repeats, and what happens in between tells its period. Rigid stops at rest, R < 0.99, a force.
"""

import math
from dataclasses import dataclass, field
from decimal import Decimal, getcontext

getcontext().prec = 60
TERMS = 40
LOW = Decimal(10) ** -34  # rebounds below it are summed
LOWER, UPPER = -1, 1


def arctangent_of_inverse(n):
    """atan(1/n) by its series."""
    total, power, k = Decimal(0), Decimal(1) / n, 0
    while abs(power) > Decimal(10) ** -62:
        total += power / (2 * k + 1) * (-1) ** k
        power, k = power / (n * n), k + 1
    return total


PI = 4 * (4 * arctangent_of_inverse(5) - arctangent_of_inverse(239))


def sine_and_cosine(angle):
    angle = (angle + PI) % (2 * PI)  # of the sign of its dividend
    angle -= PI if angle >= 0 else -PI
    term, sine, cosine, k = Decimal(1), Decimal(0), Decimal(0), 0
    while abs(term) > Decimal(10) ** -62 or k < 8:
        if k % 2:
            sine += term if k % 4 == 1 else -term
        else:
            cosine += term if k % 4 == 0 else -term
        k += 1
        term *= angle / k
    return sine, cosine


@dataclass
class Stretch:
    """Motion between two releases: impacts (phase in forcing periods since the first release's period began, side,
    velocity before), the stop of the next release, and the forcing periods until then."""

    impacts: list = field(default_factory=list)
    side: int = 0
    periods: int = 0


class Motion:
    def __init__(self, scene):
        numbers = ("h", "f", "nu", "phase", "load", "stiffness")
        self.h, self.f, self.nu, self.phase, self.load, self.k = (Decimal(getattr(scene, name)) for name in numbers)
        self.stops = {LOWER: scene.stop_lower, UPPER: scene.stop_upper}
        self.stops = {side: Decimal(stop) for side, stop in self.stops.items() if math.isfinite(stop)}
        self.R = {LOWER: Decimal(scene.R_lower), UPPER: Decimal(scene.R_upper)}
        self.period = 2 * PI / self.nu
        rate = max(1.0, math.sqrt(abs(scene.stiffness)), 2 * scene.h, scene.nu)
        self.step = Decimal(0.25 / rate)

    def series(self, tau, x, v):
        """Coefficients of the displacement, by powers of the time since tau."""
        sine, cosine = sine_and_cosine(self.nu * tau + self.phase)
        terms, force = [x, v], self.f
        for n in range(TERMS):
            forced = force * (sine, cosine, -sine, -cosine)[n % 4] + (self.load if n == 0 else 0)
            terms.append((forced - 2 * self.h * (n + 1) * terms[n + 1] - self.k * terms[n]) / ((n + 1) * (n + 2)))
            force *= self.nu / (n + 1)
        return terms

    def pressing(self, tau, side):
        """The force that presses a mass on a stop."""
        sine, _ = sine_and_cosine(self.nu * tau + self.phase)
        return side * (self.load + self.f * sine - self.k * self.stops[side])

    def release_after(self, tau, side):
        """The time at which a stop that holds the mass at tau releases it; nothing if it never does."""
        step = self.period / 256
        for n in range(300):
            low, high = tau + n * step, tau + (n + 1) * step
            if self.pressing(high, side) <= 0:
                for _ in range(12):
                    middle = (low + high) / 2
                    low, high = (middle, high) if self.pressing(middle, side) > 0 else (low, middle)
                slope = side * self.f * self.nu
                for _ in range(6):
                    rate = slope * sine_and_cosine(self.nu * low + self.phase)[1]
                    low -= self.pressing(low, side) / rate
                return low
        return None

    def stretch_from(self, side, most):
        """The motion from a stop's release to the next one, whichever stop; nothing if that takes too long."""
        at = next(n for n in range(256) if self.pressing(n * self.period / 256, side) > 0)
        release = self.release_after(at * self.period / 256, side)
        begin = int(release // self.period)
        tau, x, v, on = release, self.stops[side], Decimal(0), side
        found = Stretch()
        while tau < release + (most + 1) * self.period:
            terms = self.series(tau, x, v)
            contact = self.contact(terms, on)
            if contact is None:
                x, v = value(terms, self.step), slope_of(terms, self.step)
                tau, on = tau + self.step, 0
                continue
            elapsed, on = contact
            before = slope_of(terms, elapsed)
            tau, x, v = tau + elapsed, self.stops[on], -self.R[on] * before
            found.impacts.append((float(tau / self.period) - begin, on, float(before)))
            press = self.pressing(tau, on)
            if press > 0 and v * v / (2 * press) < LOW:
                tau += 2 * abs(v) / (press * (1 - self.R[on]))
                released = self.release_after(tau, on)
                if released is None:
                    return None
                found.side, found.periods = on, int(released // self.period) - begin
                return found
        return None

    def contact(self, terms, on):
        """The first contact within a step, as (time, stop); nothing without one. `on`: the stop that it begins on."""
        first = None
        for side, stop in self.stops.items():
            gap = [side * (terms[0] - stop), *(side * term for term in terms[1:])]
            if side == on:  # divided by the time, so that its beginning is no root
                gap = gap[1:]
                bend = 2 * gap[1]
                if gap[0] < 0 < bend and -4 * gap[0] / bend < self.step / 16:
                    found = self.root(gap, -2 * gap[0] / bend)
                    if first is None or found < first[0]:
                        first = (found, side)
                    continue
            for n in range(1, 17):
                s = n * self.step / 16
                if first is not None and s - self.step / 16 > first[0]:
                    break
                if value(gap, s) > 0:
                    low, high = s - self.step / 16, s
                    for _ in range(8):
                        middle = (low + high) / 2
                        low, high = (middle, high) if value(gap, middle) <= 0 else (low, middle)
                    found = self.root(gap, high)
                    if first is None or found < first[0]:
                        first = (found, side)
                    break
        return first

    @staticmethod
    def root(terms, s):
        for _ in range(60):
            change = value(terms, s) / slope_of(terms, s)
            s -= change
            if abs(change) <= abs(s) * Decimal(10) ** -52:
                break
        return s


def value(terms, s):
    total = Decimal(0)
    for term in reversed(terms):
        total = total * s + term
    return total


def slope_of(terms, s):
    total = Decimal(0)
    for n in range(len(terms) - 1, 0, -1):
        total = total * s + n * terms[n]
    return total


def cycle_through(scene, side, most=64):
    """The forcing periods and impacts of the motion that a stop's release leads to, by its stretches; nothing if it
    takes longer than `most` periods, or never rests again."""
    motion, stretches, order = Motion(scene), {}, []
    while side not in stretches:
        stretch = motion.stretch_from(side, most)
        if stretch is None:
            return None
        stretches[side] = stretch
        order.append(side)
        side = stretch.side
    periods, impacts = 0, []
    for stop in order[order.index(side) :]:
        impacts += [(phase + periods, *rest) for phase, *rest in stretches[stop].impacts]
        periods += stretches[stop].periods
    return periods, impacts
