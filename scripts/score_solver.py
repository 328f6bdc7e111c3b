#!/usr/bin/python3
"""Scores a solver on scenes whose motion is known, as those of share/clatter/hard_scenes.jsonl. SciPy's solve_ivp,
stopped at each contact, treats neither chatter nor rest; yours takes the place of solve()."""

import json
import math
import sys
import time

try:
    from scipy.integrate import solve_ivp
except ImportError:
    sys.exit("score_solver.py: SciPy isn't installed; install python3-scipy, or put your solver in its place")

SECONDS, MILLIONTH = 5, 1e-6  # for each scene; errors allowed, of the run's length, its largest speed, its extent


def solve(scene, start, end):
    """The contacts from the start to a time as (stop, time, velocity before), and (x, v) then."""
    h, k, f, nu, load, phase = (scene[name] for name in ("h", "k", "f", "nu", "load", "phase"))
    stops = [(name, sign, scene[name]) for name, sign in (("lower", -1), ("upper", 1)) if name in scene]
    t, y, contacts, latest = start["time"], (start["x"], start["v"]), [], time.monotonic() + SECONDS

    def rates(t, y):
        if time.monotonic() > latest:
            raise TimeoutError(f"no end within {SECONDS} s, at time {t:.6g} after {len(contacts)} contacts")
        a = f * math.sin(nu * t + phase) + load - k * y[0] - 2 * h * y[1]
        for _, sign, stop in stops:
            if "stiffness" in stop and (depth := sign * (y[0] - stop["position"])) > 0:
                damping = 2 * stop["damping"] * math.sqrt(stop["stiffness"])
                a -= sign * max(0, stop["stiffness"] * depth + damping * sign * y[1])
        return y[1], a

    gaps = [lambda t, y, sign=sign, stop=stop: sign * (stop["position"] - y[0]) for _, sign, stop in stops]
    for gap, (_, _, stop) in zip(gaps, stops):
        gap.terminal, gap.direction = "R" in stop, -1
    while t < end:
        step = math.pi / 8 / max(nu, math.sqrt(abs(k)))
        run = solve_ivp(rates, (t, end), y, "DOP853", events=gaps, rtol=1e-10, atol=1e-12, max_step=step)
        if run.status < 0:
            raise ArithmeticError(run.message)
        t, y, found = run.t[-1], run.y[:, -1], []
        for (name, _, stop), times, states in zip(stops, run.t_events, run.y_events):
            found += [(name, at, state[1]) for at, state in zip(times, states)]
            if "R" in stop and len(times):
                y = stop["position"], -stop["R"] * y[1]
        contacts += sorted(found, key=lambda contact: contact[1])
    return contacts, y


def difference(certificate, contacts, state):
    """What is wrong with a motion, or nothing."""
    events, end, left = certificate["events"], certificate["end"], list(contacts)
    x, v = float(end["x"][0]), float(end["v"][0])
    late = MILLIONTH * end["time"]
    extent = max(abs(float(certificate.get(name, end["x"])[0])) for name in ("x_min", "x_max"))
    speeds = [abs(float(one["v"][0])) for one in (end, *events) if "v" in one]
    far, fast = MILLIONTH * extent, MILLIONTH * max(*speeds, extent * math.sqrt(abs(certificate["scene"]["k"])))
    held, until = None, 0
    for event in events:
        side, at = event["stop"], float(event["time"][0])
        if "until" in event:  # all contacts with that stop until then are a part of it
            held, until = side, float(event["until"][0]) + late
            while left and left[0][0] == held and left[0][1] <= until:
                del left[0]
        elif event["event"] in ("impact", "touch") and not (side == held and at <= until):
            if not left or left[0][0] != side or abs(left[0][1] - at) > late:
                found = "{} at {:.6g}".format(*left[0]) if left else "nothing"
                return f"{event['event']} on the {side} stop at {at:.6g}: found {found}"
            if abs(left.pop(0)[2] - float(event["v"][0])) > fast:
                return f"{event['event']} on the {side} stop at {at:.6g}: another speed"
    if left:
        return f"found {len(left)} more contacts at the end"
    off = abs(state[0] - x), abs(state[1] - v)
    return "" if off[0] <= far and off[1] <= fast else f"end: x is off by {off[0]:.1g}, v by {off[1]:.1g}"


def score(certificate, solver):
    """What is wrong with the solver's motion of a scene, or nothing."""
    try:
        found = solver(certificate["scene"], certificate["start"], certificate["end"]["time"])
    except (TimeoutError, ArithmeticError, ValueError) as error:
        return str(error)
    return difference(certificate, *found)


def main(path, only=""):
    with open(path, encoding="utf-8") as file:
        scenes = [one for one in map(json.loads, file) if one["name"].startswith(only)]
    right = 0
    for one in scenes:
        wrong = score(one, solve)
        right += not wrong
        print(f"{one['name']:55} {wrong or 'right'}", flush=True)
    print(f"right in {right} of {len(scenes)}")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[1].startswith("-"):
        usage = "usage: score_solver.py FILE.jsonl [BEGINNING OF SCENES' NAMES]"
        sys.exit(print(f"{usage}\n\n{__doc__}") if "--help" in sys.argv else usage)
    main(*sys.argv[1:])
