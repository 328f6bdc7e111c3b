"""Edits of certificates, drawn at random: of lists of events, members, periods, symmetry, starts, ends, special points.

An edit may leave a certificate true; a judge tells which are surely false.
"""

import copy
import math

from claimed_events import holder_of_R, place_name
from forger_judge import LAST, OTHER, Unreliable, number, period_of
from laws_of_speed import ends_in_chatter, law_of


def widened(certificate, error):
    """Errors so large that only the list of events, not its numbers, tells what is false."""
    for event in certificate["events"]:
        for name in ("time", "until", "v", "w", "x", "z"):
            if name in event:
                event[name][1] = max(number(event[name][1]), error)
    return certificate


def shifted(event, by):
    event = copy.deepcopy(event)
    for name in {"time", "until"} & event.keys():
        event[name] = [number(event[name][0]) + by, number(event[name][1]) + 1e-9]
    return event


def leave_out(events, draw):
    del events[draw.randrange(len(events))]


def leave_out_a_chatter(events, draw):
    chatters = [i for i, event in enumerate(events) if event["event"] == "chatter"]
    if chatters:
        del events[draw.choice(chatters)]


def double(events, draw):
    at = draw.randrange(len(events))
    events.insert(at, copy.deepcopy(events[at]))


def double_a_last(events, draw):
    """Of a chatter, a rest, a stick or a press."""
    found = [i for i, event in enumerate(events) if event["event"] in LAST]
    if found:
        at = draw.choice(found)
        events.insert(at, copy.deepcopy(events[at]))


def begin_at_the_end(events, draw):
    """What holds the mass to the end begins once more there."""
    if events[-1]["event"] in LAST:
        again = copy.deepcopy(events[-1])
        again["time"] = list(again["until"])
        for place in {"x", "z"} & again.keys():
            again[place] = [0, again[place][1]]
        events.append(again)


def exchange(events, draw):
    at = draw.randrange(len(events))
    events[at - 1], events[at] = events[at], events[at - 1]


def shift(events, draw):
    at = draw.randrange(len(events))
    events[at] = shifted(events[at], draw.choice((-1, 1)) * 10 ** draw.uniform(-3, 0))


def split(events, draw):
    """One rest, stick or press becomes two."""
    found = [i for i, event in enumerate(events) if event["event"] in ("rest", "stick", "press", "hold")]
    if found:
        at = draw.choice(found)
        begin, end = (number(events[at][name][0]) for name in ("time", "until"))
        middle, second = begin + (end - begin) * draw.random(), copy.deepcopy(events[at])
        events[at]["until"][0] = second["time"][0] = middle
        events.insert(at + 1, second)


def join(events, draw):
    """One event lasts until the end of the next one that does."""
    at = draw.randrange(len(events))
    later = [i for i in range(at + 1, len(events)) if events[i]["event"] == events[at]["event"]]
    if "until" in events[at] and later:
        events[at]["until"] = events[later[0]]["until"]
        del events[at + 1 : later[0] + 1]


def other_stop(events, draw):
    at = draw.randrange(len(events))
    name = place_name(events[at])
    if name in events[at]:
        events[at][name] = OTHER[events[at][name]]


MASSES = {"reversal": "turn", "turn": "reversal", "stick": "hold", "hold": "stick"}
MATES = {"x": "z", "z": "x"}


def other_mass(events, draw):
    """An event of one mass becomes one of the other."""
    at = draw.randrange(len(events))
    if events[at]["event"] in MASSES:
        events[at] = {MATES.get(name, name): value for name, value in events[at].items()}
        events[at]["event"] = MASSES[events[at]["event"]]
    for name, other, speed, other_speed in (("stop", "wall", "v", "w"), ("wall", "stop", "w", "v")):
        if name in events[at]:
            renamed = {name: other, speed: other_speed}
            events[at] = {renamed.get(key, key): value for key, value in events[at].items()}
            return


def held_or_not(events, draw):
    """A loose mass that friction turns is said to be held, or the other way round."""
    at = draw.randrange(len(events))
    if events[at]["event"] == "turn":
        events[at] = {**events[at], "event": "hold", "until": copy.deepcopy(draw.choice(events)["time"])}
    elif events[at]["event"] == "hold":
        events[at] = {name: value for name, value in events[at].items() if name != "until"} | {"event": "turn"}


def end_of_another(events, draw):
    found = [event for event in events if "until" in event]
    if found:
        draw.choice(found)["until"] = copy.deepcopy(draw.choice(events)["time"])


LISTS = [leave_out, leave_out_a_chatter, double, double_a_last, begin_at_the_end, exchange, shift, split, join]
LISTS += [other_stop, other_mass, held_or_not, end_of_another]


def more_periods(certificate, draw):
    """Some times the period, with the list of each turn edited or not."""
    times = draw.choice((2, 3, 5))
    period, events = certificate["periods"] * period_of(certificate["scene"]), certificate["events"]
    if events and "pressed" in certificate["start"]:
        first, last = events[0], events[-1]
        whole = {**copy.deepcopy(last), "until": shifted(first, period)["until"]}
        turns = [shifted(event, turn * period) for turn in range(times) for event in [*events[1:-1], whole]]
        turns[-1] = shifted(last, (times - 1) * period)
        certificate["events"] = [first, *turns]
    else:
        certificate["events"] = [shifted(event, turn * period) for turn in range(times) for event in events]
    certificate["periods"] *= times
    for name in ("word", "symmetric", "multipliers"):
        certificate.pop(name, None)
    if certificate["claim"] == "special" and draw.random() < 0.5:
        certificate["symmetric"] = True
    return certificate


def other_symmetry(certificate, draw):
    if certificate["claim"] == "special":
        certificate["symmetric"] = True
    else:
        certificate["symmetric"] = draw.random() < 0.5
        certificate.pop("word", None)
    return certificate


def other_word(certificate, draw):
    word = certificate.get("word") or "L"
    certificate["word"] = draw.choice((word[::-1], word + word, word[:-1], word + "U", word.replace("*", ""), "\u2026"))
    return certificate


def other_extrema(certificate, draw):
    name = draw.choice(("x_min", "x_max"))
    value, error = certificate.get(name, [0, 1e-9])
    certificate[name] = [number(value) + draw.choice((-1, 1)) * 10 ** draw.uniform(-3, 0), error]
    return certificate


def other_end(certificate, draw):
    name = draw.choice([name for name in "xvzw" if name in certificate["end"]])
    value, error = certificate["end"][name]
    certificate["end"][name] = [number(value) + draw.choice((-1, 1)) * 10 ** draw.uniform(-2, 0), error]
    return certificate


def end_within_a_chatter(certificate, draw):
    """The motion is said to be at rest by an end that comes before that of its chatter."""
    found = [i for i, event in enumerate(certificate["events"]) if event["event"] == "chatter"]
    if not found or "loose" in certificate["scene"]:
        return certificate
    at = draw.choice(found)
    events, end = certificate["events"][: at + 2], certificate["end"]
    begin, until = (number(events[at][name][0]) for name in ("time", "until"))
    end["time"] = begin + (until - begin) * draw.uniform(0.05, 0.95)
    place = certificate["scene"][events[at]["stop"]]["position"]
    end["x"], end["v"] = [place, 1e-9], [0, 1e-9]
    events[-1]["until"] = [end["time"], draw.choice((1e-9, 10))]
    certificate["events"] = events
    certificate.pop("x_min", None), certificate.pop("x_max", None)
    return certificate


def at_rest_for_a_while(certificate, draw):
    """The motion is said to rest until its release, and then to have no event."""
    start = certificate["start"]
    if "released" in start:
        side, time, before = start["released"], number(start["time"]), 10 ** draw.uniform(-3, -1)
        place = certificate["scene"][side]["position"]
        certificate["start"] = {"time": time - before, "x": [place, 0], "v": [0, 0]}
        rest = {"event": "rest", "stop": side, "time": [time - before, 1e-9], "until": [time, 1e-6]}
        certificate["events"] = [rest]
        certificate.update(word=f"({side[0].upper()})", symmetric=False)
        certificate.pop("x_min", None), certificate.pop("x_max", None)
    return certificate


def member(certificate, draw):
    """A claim of another kind, a misspelt one, or one in another place."""
    name, value = draw.choice(
        (("periods", 7), ("word", "LLL"), ("simmetric", True), ("frictoin", 1), ("stability", "no"))
    )
    target = draw.choice((certificate, certificate["scene"], certificate["start"]))
    if name not in target:
        target[name] = value
    return certificate


def other_parameter(certificate, draw):
    certificate["parameter"][0] = number(certificate["parameter"][0]) + draw.choice((-1, 1)) * 10 ** draw.uniform(-3, 0)
    return certificate


MEMBERS = [more_periods, other_symmetry, other_word, other_extrema, other_end, end_within_a_chatter]
MEMBERS += [at_rest_for_a_while, member, other_parameter]


def members_of(certificate):
    if certificate["claim"] == "transient":
        return [other_extrema, other_end, end_within_a_chatter, member]
    if certificate["claim"] == "special":
        return [more_periods, other_symmetry, other_parameter, member]
    return [more_periods, more_periods, other_symmetry, other_word, other_extrema, at_rest_for_a_while, member]


def forged(certificate, draw):
    """A forgery, and the names of its edits."""
    forgery, names = copy.deepcopy(certificate), []
    if draw.random() < 0.6:
        edit = draw.choice(members_of(certificate))
        forgery, names = edit(forgery, draw), [edit.__name__]
    for _ in range(draw.choice((0, 1, 1, 2) if names else (1, 1, 2))):
        edit = draw.choice(LISTS)
        if forgery["events"]:
            edit(forgery["events"], draw)
            names.append(edit.__name__)
    if draw.random() < 0.4:
        widened(forgery, draw.choice((1e-4, 1e-2, 0.3)))
    return forgery, names


def claimed_from(events, scene, draw, error):
    """Claims of the events of a simulated motion, of whose chatters some impacts are listed."""
    claims = []
    for event in events:
        rigid = holder_of_R(scene, event)
        if event["event"] in ("rest", "press") and claims and ends_in_chatter(law_of(rigid)):
            series = len(claims)
            while series > 0 and claims[series - 1]["event"] in ("impact", "reversal"):
                if claims[series - 1].get("stop", event["stop"]) != event["stop"]:
                    break
                series -= 1
            impacts = [i for i in range(series, len(claims)) if claims[i]["event"] == "impact"]
            del claims[draw.choice(impacts) + 1 :]
            until = [event["time"], error]
            claims.append({"event": "chatter", "stop": event["stop"], "time": claims[-1]["time"], "until": until})
        claims.append(
            {name: [value, error] if name not in ("event", "stop") else value for name, value in event.items()}
        )
    return claims


def moved(certificate, truth, draw):
    """A true certificate of the same motion that starts elsewhere."""
    if "loose" in certificate["scene"] or certificate["claim"] == "special":
        raise Unreliable("no such start")
    return (moved_transient if certificate["claim"] == "transient" else moved_period)(certificate, truth, draw)


def moved_transient(certificate, truth, draw):
    """One that starts with an impact of a chatter, so that none of its flights need be followed."""
    events = truth.motion.events
    rests = [i for i, event in enumerate(events) if i and event["event"] == "rest"]
    rests = [i for i in rests if events[i - 1]["event"] == "impact" and events[i - 1]["stop"] == events[i]["stop"]]
    if not rests:
        raise Unreliable("no such start")
    at = draw.choice(rests) - 1
    while at and events[at - 1].get("stop") == events[at]["stop"] and abs(events[at]["v"]) < 1e-2:
        at -= 1
    if abs(events[at].get("v", 0)) < 1e-2:
        raise Unreliable("no such start")
    place = certificate["scene"][events[at]["stop"]]["position"]
    start = {"time": events[at]["time"], "x": place, "v": events[at]["v"]}
    claims = claimed_from([copy.deepcopy(event) for event in events[at:]], certificate["scene"], draw, 1e-4)
    kept = {name: value for name, value in certificate.items() if name not in ("start", "events", "x_min", "x_max")}
    end = {name: value if name == "time" else [value[0], 1e-3] for name, value in certificate["end"].items()}
    return {**kept, "start": start, "events": claims, "end": end}


def moved_period(certificate, truth, draw):
    """One that starts in flight, mostly shortly before a rest."""
    rests = [event["time"] for event in truth.motion.events if event["event"] in ("rest", "press")]
    time = truth.begin + truth.length * draw.random()
    if rests and draw.random() < 0.7:
        time = draw.choice(rests) - 10 ** draw.uniform(-2, 0)
    if time <= truth.begin:
        raise Unreliable("no such start")
    x, v = truth.motion.state(time)
    events = [event for event in truth.events(2) if time < event["time"] <= time + truth.length]
    if any(abs(event.get(name, 0) - time) < 1e-3 for event in truth.motion.events for name in ("time", "until")):
        raise Unreliable("a start on an event")
    if any(event["time"] <= time <= event.get("until", -math.inf) for event in truth.motion.events):
        raise Unreliable("a start at rest")
    start = {"time": time, "x": [x, 1e-7], "v": [v, 1e-7]}
    kept = {name: value for name, value in certificate.items() if name not in ("start", "events")}
    return {**kept, "start": start, "events": claimed_from(events, certificate["scene"], draw, 1e-5)}
