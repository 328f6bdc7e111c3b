"""The same as forger_motion of a main mass that carries a loose one."""

import math

import numpy as np

from forger_motion import SIGN, SLOW, Flow, Motion, Unreliable, first_fall, number
from laws_of_speed import law_of, share


class HousedMotion(Motion):
    """Events and pieces of both masses up to an end; places are those of the main mass."""

    def __init__(self, scene, start, end):
        loose = scene["loose"]
        self.mass, self.load = number(loose["mass"]), number(loose["load"])
        self.walls = {side: number(loose[side]["position"]) for side in SIGN if side in loose}
        of_both = {name: loose[name] for name in ("R", "restitution") if name in loose}
        self.laws = {side: law_of({**of_both, **loose[side]}) for side in self.walls}
        self.share, self.pressed, self.since = self.mass / (1 + self.mass), start.get("pressed"), number(start["time"])
        self.was_carried, self.struck_on = False, None
        self.rub = number(loose.get("friction", 0))
        self.hold = number(loose.get("friction_static", self.rub)) / self.mass
        self.gripped, self.slide = False, 0  # by friction alone; the sign of z'
        self.name = "wall" if {"lower", "upper", "friction"} & scene.keys() else "stop"
        if self.pressed:
            self.z, self.w = self.walls[self.pressed], 0.0
        else:
            self.z, self.w = (number(start[n][0] if isinstance(start[n], list) else start[n]) for n in "zw")
        self.slide = int(np.sign(self.w)) if self.hold else 0
        super().__init__(scene, start, end)

    def begin(self, start):
        super().begin(start)
        if self.hold and self.w == 0 and not self.pressed:
            if self.v == 0 and (self.mu_static or self.stops):
                raise Unreliable("whether friction holds a mass at the start")
            self.stop_in_housing(False)
        for side, place in self.walls.items():
            depth, into = SIGN[side] * (self.z - place), SIGN[side] * self.w
            if self.pressed or depth < -1e-9:
                continue
            if depth != 0 or self.events or self.mode == "rest" or 0 < into < 1e-3:
                raise Unreliable("a start on a wall")
            if into > 0:
                self.strike(side)
            elif into == 0 and not self.gripped and self.push_on(side) > 0:
                self.pressed = side

    def carries(self):
        return self.pressed or self.gripped

    def flow(self, heading=None):
        alone = super().flow(heading)
        if not self.carries():
            return self.drawn(alone, self.slide * self.rub)
        return self.as_one(alone)

    @staticmethod
    def drawn(flow, load):
        return Flow(flow.h, flow.k, flow.force, flow.load + load) if load else flow

    def as_one(self, alone):
        whole, load = 1 + self.mass, alone.load + self.mass * self.load
        return Flow(alone.h / whole, alone.k / whole, alone.force.over(whole), load / whole)

    def pressing(self, side, t):
        return super().pressing(side, t) + SIGN[side] * self.slide * self.rub

    def left(self, way):
        """The acceleration that is left until the loose mass leaves both masses as one, against that way."""
        return self.hold - way * (self.load - self.as_one(Motion.flow(self)).push(self.t, self.x, self.v))

    def stop_in_housing(self, moved):
        """A loose mass with z' = 0 away from walls: friction holds it, or it slides where it is pushed."""
        self.w, up, down = 0.0, self.left(1), self.left(-1)
        if min(abs(up), abs(down)) < 1e-6:
            raise Unreliable("whether friction holds the loose mass")
        self.gripped, self.since = min(up, down) > 0, self.t
        if not self.gripped and moved:
            self.tell("turn", time=self.t, z=self.z)
        self.slide = 0 if self.gripped else 1 if up < 0 else -1

    def beside(self, flow):
        """The states at some times of a flight from now on; None: something holds the main mass."""
        start, z0, w0, carried = (self.t, self.x, self.v), self.z, self.w, self.carries()
        load = self.load - self.slide * self.rub / self.mass

        def at(t):
            x, v = flow.at(start, t) if flow else (start[1] + 0 * t, 0 * t)
            if carried:
                return x, v, z0 + 0 * t, 0 * t
            s = t - start[0]
            y, rate = start[1] + z0 + (start[2] + w0) * s + load * s * s / 2, start[2] + w0 + load * s
            return x, v, y - x, rate - v

        return at

    def advance(self):
        held = self.mode in ("rest", "stick")
        if held and self.carries():
            raise Unreliable("both masses are held")
        flow = None if held else self.flow()
        at = self.beside(flow)
        names, margins = self.of_held() if held else self.margins(flow, (self.t, self.x, self.v))
        if self.carries():
            for way in (SIGN[self.pressed],) if self.pressed else (1, -1):
                names.append(("let go", way))
                margins.append(lambda t, way=way: way * (self.load - flow.push(t, *at(t)[:2])) + self.hold)
        else:
            if self.hold:
                names.append(("halt", None))
                margins.append(lambda t: self.slide * at(t)[3])
            for side, place in self.walls.items():
                names.append(("strike", side))
                # from where it leaves a wall on, rounding isn't taken for a strike
                rounding = (1e-15 if self.w else 1e-12) if abs(self.z - place) < 1e-15 else 0
                margins.append(lambda t, s=side, place=place, off=rounding: SIGN[s] * (place - at(t)[2]) + off)
        begun = self.t
        self.t, index = first_fall(margins, begun, self.end, Motion.flow(self, heading=0).step)
        self.pieces.append((begun, self.t, at))
        self.x, self.v, self.z, self.w = (float(x[0]) for x in at(np.array([self.t])))
        name, side = names[index] if index is not None else ("end", None)
        if self.pressed and name != "leave":
            self.tell("press", **{self.name: self.pressed}, time=self.since, until=self.t)
        if self.gripped and name != "leave":
            self.tell("hold", time=self.since, until=self.t, z=self.z)
        if held and name == "halt":
            raise Unreliable("the loose mass stops beside one that is held")
        if held:
            self.let_main_go(begun, name, side)
        if name == "strike":
            self.strike(side)
        elif name == "let go":
            self.pressed, self.gripped = None, False
            self.slide = -side if self.hold else 0
        elif name == "halt":
            self.stop_in_housing(True)
        elif not held and name != "end":
            self.cross(name, side)

    def of_held(self):
        """What lets a main mass go that a stop or friction holds."""
        if self.mode == "rest":
            return [("release", -SIGN[self.side])], [lambda t: self.pressing(self.side, t)]
        mode, self.mode = self.mode, self.held
        flow, x = self.flow(heading=0), self.x
        self.mode = mode
        ways = (1, -1)
        return [("release", way) for way in ways], [
            lambda t, way=way: self.mu_static - way * flow.push(t, x) for way in ways
        ]

    def let_main_go(self, begun, name, way):
        if self.mode == "rest":
            self.tell("rest", stop=self.side, time=begun, until=self.t)
        else:
            self.tell("stick", time=begun, until=self.t, x=self.x)
        if name == "end":
            return
        on_stop = self.side if self.mode == "rest" else None
        self.mode = "free" if on_stop else self.held
        if name == "release":
            self.heading = way if self.mu_static else 0
        self.struck_on = on_stop

    def push_on_still_mass(self):
        """Of both masses, if a wall has pressed the loose one up to now."""
        return super().push_on_still_mass() + (self.mass * self.load if self.was_carried else 0)

    def cross(self, name, side):
        before, pressed, gripped = self.v, self.pressed, self.gripped
        self.pressed, self.gripped, self.was_carried = None, False, self.carries()
        if self.hold and name == "hit" and "stiffness" not in self.stops[side]:
            self.slide = int(np.sign(self.w + (1 + share(law_of(self.stops[side]), abs(before))) * before))
        super().cross(name, side)
        self.w += before - self.v if name != "still" else 0
        if name == "leave":
            self.pressed, self.gripped = pressed, gripped
        elif gripped and self.mode in ("rest", "stick"):
            raise Unreliable("two events at once")
        elif gripped and self.w == 0:
            self.stop_in_housing(False)
        elif pressed and (SIGN[pressed] * self.w > 0 or self.mode in ("rest", "stick")):
            raise Unreliable("two events at once")
        elif pressed and self.w == 0 and self.push_on(pressed) > 0:
            self.pressed, self.since = pressed, self.t
        elif pressed and self.w == 0 and self.hold:
            self.slide = -SIGN[pressed]

    def push_on(self, side):
        """The acceleration with which a loose mass on a wall is held against leaving it."""
        push = self.left(-SIGN[side])
        if abs(push) < 1e-6:
            raise Unreliable("whether a wall presses")
        return push

    def strike(self, side):
        self.tell("impact", **{self.name: side}, time=self.t, w=self.w)
        self.z, R = self.walls[side], share(self.laws[side], abs(self.w))
        before, rests, self.slide = self.v, False, 0
        if abs(R * self.w) < SLOW:
            self.v += self.share * self.w
            rests = self.push_on(side) > 0
        if abs(R * self.w) < SLOW and not rests and R > 0:
            raise Unreliable("whether a wall presses")
        self.v = before + (1 + (0 if rests else R)) * self.share * self.w
        self.w = 0.0 if rests else -R * self.w
        self.pressed, self.since = (side, self.t) if rests else (None, self.t)
        self.slide = -SIGN[side] if self.hold and not rests else 0
        if self.struck_on and SIGN[self.struck_on] * self.v > 0:
            raise Unreliable("two events at once")
        self.struck_on = None
        self.heading = int(np.sign(self.v)) if self.mu_static else 0
        if self.mode in ("contact", "beyond"):
            stop, sign = self.stops[self.side], SIGN[self.side]
            q = 2 * stop["damping"] / math.sqrt(stop["stiffness"])
            if (sign * (self.x + q * self.v - stop["position"]) > 0) != (self.mode == "contact"):
                raise Unreliable("two events at once")
