"""The same as forger_motion of a main mass that carries a loose one."""

import numpy as np

from forger_motion import SIGN, SLOW, Flow, Unreliable, first_fall, number


class HousedMotion:
    """Events and pieces of both masses up to an end; places are those of the main mass."""

    def __init__(self, scene, start, end):
        h, k, f, nu, phase, load = (number(scene[name]) for name in ("h", "k", "f", "nu", "phase", "load"))
        loose = scene["loose"]
        self.mass, self.load = number(loose["mass"]), number(loose["load"])
        self.walls = {side: number(loose[side]["position"]) for side in SIGN if side in loose}
        self.restitution = {side: number(loose[side].get("R", loose.get("R"))) for side in self.walls}
        whole, self.share = 1 + self.mass, self.mass / (1 + self.mass)
        self.alone = Flow(h, k, f, nu, phase, load)
        self.both = Flow(h / whole, k / whole, f / whole, nu, phase, (load + self.mass * self.load) / whole)
        self.end, self.events, self.pieces = end, [], []
        value = {name: number(x[0] if isinstance(x, list) else x) for name, x in start.items() if name in "xvzw"}
        self.t, self.x, self.v, self.pressed = number(start["time"]), value["x"], value["v"], start.get("pressed")
        self.z, self.w = (self.walls[self.pressed], 0.0) if self.pressed else (value["z"], value["w"])
        if not self.pressed and any(SIGN[s] * (self.z - place) > -1e-9 for s, place in self.walls.items()):
            raise Unreliable("a start on a wall")
        for _ in range(600):
            if self.t >= end:
                return
            self.press() if self.pressed else self.fly()
        raise Unreliable("hundreds of events")

    def place(self, start, t):
        t0, x0, v0, z0, w0 = start
        x, v = self.alone.at((t0, x0, v0), t)
        s = t - t0
        y, rate = x0 + z0 + (v0 + w0) * s + self.load * s * s / 2, v0 + w0 + self.load * s
        return x, v, y - x, rate - v

    def fly(self):
        start, sides = (self.t, self.x, self.v, self.z, self.w), list(self.walls)
        margins = [lambda t, s=side: -SIGN[s] * (self.place(start, t)[2] - self.walls[s]) for side in sides]
        self.t, index = first_fall(margins, self.t, self.end, self.alone.step)
        self.pieces.append((start[0], self.t, lambda t: self.place(start, t)))
        self.x, self.v, self.z, self.w = (float(x[0]) for x in self.place(start, np.array([self.t])))
        if index is not None:
            self.strike(sides[index])

    def strike(self, side):
        self.events.append({"event": "impact", "stop": side, "time": self.t, "w": self.w})
        push = SIGN[side] * (self.load - self.alone.push(self.t, self.x, self.v))
        self.z, R = self.walls[side], self.restitution[side]
        rests = abs(R * self.w) < SLOW and push > 1e-6
        if abs(R * self.w) < SLOW and not rests and R > 0:
            raise Unreliable("whether a wall presses")
        self.v += (1 + (0 if rests else R)) * self.share * self.w
        self.w = 0.0 if rests else -R * self.w
        self.pressed = side if rests else None

    def press(self):
        side, begun, start = self.pressed, self.t, (self.t, self.x, self.v)

        def force(t):
            x, v = self.both.at(start, t)
            return SIGN[side] * (self.load - self.both.push(t, x, v))

        self.t, index = first_fall([force], begun, self.end, self.both.step)
        wall = self.walls[side]
        self.events.append({"event": "press", "stop": side, "time": begun, "until": self.t})
        self.pieces.append((begun, self.t, lambda t: (*self.both.at(start, t), wall + 0 * t, 0 * t)))
        self.x, self.v = (float(x[0]) for x in self.both.at(start, np.array([self.t])))
        self.z, self.w = wall, 0.0
        self.pressed = side if index is None else None

    def state(self, t):
        for begin, end, at in self.pieces:
            if begin <= t <= end:
                return tuple(float(x[0]) for x in at(np.array([t])))
        raise Unreliable("a time outside the motion")

    def extrema(self):
        places = [at(np.linspace(begin, end, 300))[0] for begin, end, at in self.pieces if end > begin]
        return float(min(p.min() for p in places)), float(max(p.max() for p in places))
