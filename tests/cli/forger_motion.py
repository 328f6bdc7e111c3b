"""The motion of a certificate's scene in doubles, for those who judge forgeries: it shares nothing with clatter or
clatter-verify. Flights in closed form, events by signs on a grid and halving.

Chatters end where rebounds are slower than SLOW; where this isn't certain, as in resonance, motion is Unreliable.
"""

import cmath
import copy
import math

import numpy as np

from laws_of_speed import law_of, share

SLOW = 1e-7  # a rebound that is slower ends a chatter
GRID = np.concatenate([np.geomspace(1e-10, 1, 60)[:-1], np.arange(1, 400)])  # in steps; flights may be short


class Unreliable(Exception):
    """A motion that doubles, or this simple way of following it, may get wrong."""


class Force:
    """f sin(theta) and further orders, sin and cos of j theta, with theta = nu t + phase."""

    def __init__(self, scene):
        self.nu, self.phase, self.sizes = number(scene["nu"]), number(scene["phase"]), {1: complex(number(scene["f"]))}
        for order in scene.get("orders", ()):
            size = complex(number(order.get("sin", 0)), number(order.get("cos", 0)))
            self.sizes[order["order"]] = self.sizes.get(order["order"], 0) + size

    def over(self, mass):
        """That on a mass which is so much larger."""
        same = copy.copy(self)
        same.sizes = {j: size / mass for j, size in self.sizes.items()}
        return same

    def waves(self, t):
        """Those of unit size, by order."""
        return {j: np.exp(1j * j * (self.nu * t + self.phase)) for j in self.sizes}

    def at(self, t):
        waves = self.waves(t)
        return sum((size * waves[j]).imag for j, size in self.sizes.items())


class Flow:
    """x'' + 2h x' + k x = force + load, in closed form."""

    def __init__(self, h, k, force, load):
        self.h, self.k, self.force, self.load = h, k, force, load
        self.responses = {}
        for j, size in force.sizes.items():
            nu = j * force.nu
            stiff = k - nu * nu + 2j * h * nu
            if abs(stiff) < 1e-6 * (abs(k) + nu * nu) or (k == 0 and load != 0) or 0 < abs(k) < 1e-6:
                raise Unreliable("resonance, or next to no spring")
            self.responses[j] = size / stiff
        self.centre = load / k if k else 0.0
        self.root = cmath.sqrt(h * h - k)
        self.step = 0.02 / max(math.sqrt(abs(k)), max(force.sizes) * force.nu, 2 * h, 1e-3)

    def steady(self, t):
        waves = self.force.waves(t)
        x = sum((response * waves[j]).imag for j, response in self.responses.items())
        v = sum((1j * j * self.force.nu * response * waves[j]).imag for j, response in self.responses.items())
        return x + self.centre, v

    def at(self, start, t):
        """x and x' at some times after a start (t, x, v)."""
        t0, x0, v0 = start
        x, v = self.steady(t)
        centre, rate = self.steady(t0)
        u, w, s = x0 - centre, v0 - rate, t - t0
        if abs(self.root) * np.max(s, initial=0) > 300:
            raise Unreliable("a motion that grows beyond doubles")
        decay, turn = np.exp(-self.h * s), np.cosh(self.root * s)
        way = np.sinh(self.root * s) / self.root if abs(self.root) > 1e-7 else s + 0j
        part = (decay * way).real
        turn = (decay * turn).real
        return x + (turn + self.h * part) * u + part * w, v - self.k * part * u + (turn - self.h * part) * w

    def push(self, t, x, v=0.0):
        """x''."""
        return self.force.at(t) + self.load - self.k * x - 2 * self.h * v


def first_fall(margins, start, end, step):
    """The first time at which one of some functions of time falls to 0, and which; (end, None) if none does."""
    begun = [False] * len(margins)
    while start < end:
        times = start + step * GRID
        times = np.append(times[times < end], min(end, times[-1]))
        found = None
        for index, margin in enumerate(margins):
            values = margin(times)
            positive = np.flatnonzero(values > 0)
            if not begun[index] and positive.size == 0:
                continue
            first = 0 if begun[index] else positive[0]
            fallen = np.flatnonzero(values[first:] <= 0)
            begun[index] = True
            if fallen.size and (found is None or times[first + fallen[0]] < found[1]):
                at = first + fallen[0]
                found = (times[at - 1] if at else start, times[at], index)
        if found:
            low, high, index = found
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (middle, high) if margins[index](np.array([middle]))[0] > 0 else (low, middle)
            rivals = [i for i, margin in enumerate(margins) if i != index and begun[i]]
            if any(margins[i](np.array([high]))[0] <= 1e-12 for i in rivals):
                raise Unreliable("two events at once")
            return high, index
        start = times[-1]
    return end, None


SIGN = {"lower": -1, "upper": 1}
OTHER = {"lower": "upper", "upper": "lower"}


def number(value):
    return float(value)


def numbers(values):
    """Those of an object; a law of restitution stays as it is."""
    return {name: value if isinstance(value, dict) else number(value) for name, value in values.items()}


class Motion:
    """Events and pieces of a motion of a mass between stops, up to an end."""

    def __init__(self, scene, start, end):
        self.scene = {name: number(value) for name, value in scene.items() if not isinstance(value, (dict, list))}
        self.force = Force(scene)
        self.mu = self.scene.get("friction", 0.0)
        self.mu_static = self.scene.get("friction_static", self.mu)
        self.stops = {side: numbers(scene[side]) for side in SIGN if side in scene}
        self.end, self.events, self.pieces = end, [], []
        self.mode, self.side, self.heading = "free", None, 0
        self.begin(start)
        for _ in range(600):
            if self.t >= end:
                return
            self.advance()
        raise Unreliable("hundreds of events")

    def flow(self, heading=None):
        scene = self.scene
        h, k, load = scene["h"], scene["k"], scene["load"]
        if self.mode == "contact":
            stop = self.stops[self.side]
            h += stop["damping"] * math.sqrt(stop["stiffness"])
            k += stop["stiffness"]
            load += stop["stiffness"] * stop["position"]
        load -= (self.heading if heading is None else heading) * self.mu
        return Flow(h, k, self.force, load)

    def pressing(self, side, t):
        scene = self.scene
        force = self.force.at(t) + scene["load"]
        return SIGN[side] * (force - scene["k"] * self.stops[side]["position"]) + self.mu_static

    def begin(self, start):
        self.t, period = number(start["time"]), 2 * math.pi / self.scene["nu"]
        if "released" in start:
            side = start["released"]
            times = self.t + np.linspace(-0.5, 0.5, 4001) * period
            press = self.pressing(side, times)
            falls = np.flatnonzero((press[:-1] > 0) & (press[1:] <= 0))
            near = falls[np.abs(times[falls] - self.t) < 0.01 * period]
            if near.size != 1:
                raise Unreliable("when the stop lets the mass go")
            self.t, _ = first_fall([lambda t: self.pressing(side, t)], times[near[0]], times[-1], period / 1e4)
            self.x, self.v, self.heading = self.stops[side]["position"], 0.0, -SIGN[side] if self.mu_static else 0
            return
        self.x, self.v = (number(start[name][0] if isinstance(start[name], list) else start[name]) for name in "xv")
        self.heading = int(np.sign(self.v)) if self.mu_static else 0
        for side, stop in self.stops.items():
            depth = SIGN[side] * (self.x - stop["position"])
            if depth > 0 and "stiffness" in stop:
                q = 2 * stop["damping"] / math.sqrt(stop["stiffness"])
                self.mode, self.side = "contact" if depth + q * SIGN[side] * self.v > 0 else "beyond", side
            elif abs(depth) < 1e-9 and "stiffness" not in stop and self.v == 0 and self.pressing(side, self.t) > 0:
                self.rest(side)
            elif abs(depth) < 1e-9 and "stiffness" not in stop and SIGN[side] * self.v > 1e-3:
                self.cross("hit", side)
                return
            elif depth > -1e-9:
                raise Unreliable("a start on a stop")
        if self.mu_static and self.v == 0 and self.mode != "rest":
            self.stop_moving(False)

    def rest(self, side):
        self.mode, self.side, self.x, self.v = "rest", side, self.stops[side]["position"], 0.0

    def tell(self, event, **more):
        self.events.append({"event": event, **more})

    def advance(self):
        if self.mode == "rest":
            return self.stay_on_stop()
        if self.mode == "stick":
            return self.stick()
        flow, start = self.flow(), (self.t, self.x, self.v)
        names, margins = self.margins(flow, start)
        time, index = first_fall(margins, self.t, self.end, flow.step)
        self.pieces.append((self.t, time, lambda t: flow.at(start, t)))
        (self.x,), (self.v,) = flow.at(start, np.array([time]))
        self.t = time
        if index is not None:
            self.cross(*names[index])

    def margins(self, flow, start):
        names, margins = [], []

        def add(name, side, sign, place, q=0.0):
            names.append((name, side))

            def margin(t):
                x, v = flow.at(start, t)
                return sign * (x + q * v - place)

            margins.append(margin)

        for side, stop in self.stops.items() if self.mode == "free" else ():
            add("hit", side, -SIGN[side], stop["position"])
        if self.mode != "free":
            stop, sign = self.stops[self.side], SIGN[self.side]
            q = 2 * stop["damping"] / math.sqrt(stop["stiffness"])
            if self.mode == "contact":
                add("separation", self.side, sign, stop["position"], q)
            else:
                add("leave", self.side, sign, stop["position"])
                add("renewal", self.side, -sign, stop["position"], q)
        if self.mu_static:
            names.append(("still", None))
            margins.append(lambda t: self.heading * flow.at(start, t)[1])
        return names, margins

    def cross(self, name, side):
        if name == "still":
            return self.stop_moving(True)
        stop, speed = self.stops[side], {"stop": side, "time": self.t, "v": self.v}
        if name == "leave":
            self.mode = "free"
        elif name != "hit":
            self.tell(name, **speed)
            undamped = stop["damping"] == 0
            self.mode = "contact" if name == "renewal" else "free" if undamped else "beyond"
        elif "stiffness" in stop:
            self.tell("touch", **speed)
            self.mode, self.side = "contact", side
        else:
            self.tell("impact", **speed)
            R = share(law_of(stop), abs(self.v))
            self.x, self.v = stop["position"], -R * self.v
            self.heading = -SIGN[side] if self.mu_static else 0
            if abs(self.v) < SLOW and self.pressing(side, self.t) > self.mu_static:
                self.rest(side)
            elif abs(self.v) < SLOW and R > 0:
                raise Unreliable("whether it rests")

    def stay_on_stop(self):
        begun, side, period = self.t, self.side, 2 * math.pi / self.scene["nu"]
        until, index = first_fall(
            [lambda t: self.pressing(side, t)], begun, min(self.end, begun + 1.01 * period), period / 500
        )
        self.t = until if index is not None else self.end
        self.tell("rest", stop=side, time=begun, until=self.t)
        self.pieces.append((begun, self.t, lambda t, x=self.x: (x + 0 * t, 0 * t)))
        self.mode, self.heading = "free", -SIGN[side] if self.mu_static else 0

    def stop_moving(self, moved):
        self.v = 0.0
        push = self.push_on_still_mass()
        if abs(abs(push) - self.mu_static) < 1e-9:
            raise Unreliable("whether friction holds the mass")
        if abs(push) < self.mu_static:
            self.held, self.mode = self.mode, "stick"
            return
        heading = int(np.sign(push))
        if moved:
            self.tell("reversal", time=self.t, x=self.x)
        self.heading = heading

    def push_on_still_mass(self):
        return self.flow(heading=0).push(self.t, self.x)

    def stick(self):
        self.mode, begun = self.held, self.t
        flow, x = self.flow(heading=0), self.x
        level = self.mu_static
        until, index = first_fall(
            [lambda t: level - flow.push(t, x), lambda t: level + flow.push(t, x)], begun, self.end, flow.step
        )
        self.t = until
        self.tell("stick", time=begun, until=until, x=x)
        self.pieces.append((begun, until, lambda t: (x + 0 * t, 0 * t)))
        if index is not None:
            self.heading = 1 if index == 0 else -1

    def state(self, t):
        for begin, end, at in self.pieces:
            if begin <= t <= end:
                return tuple(float(number[0]) for number in at(np.array([t])))
        raise Unreliable("a time outside the motion")

    def extrema(self):
        places = [at(np.linspace(begin, end, 300))[0] for begin, end, at in self.pieces if end > begin]
        return float(min(p.min() for p in places)), float(max(p.max() for p in places))
