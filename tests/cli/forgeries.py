"""Certificates with one wrong claim each, made from right ones; see apps/verify/README.md for their format."""

import copy

from claimed_events import contacts, holder_of_R, is_of_wall, place_name, rest_name, restitution, rests, speed_in

BEYOND = 2  # a wrong number is off by so many times its error


def off(claimed):
    value, error = claimed
    return [value + BEYOND * max(error, 1e-15 * abs(value)), error]


def number(certificate, index, name):
    """Another value of a claimed number of an event."""
    certificate["events"][index][name] = off(certificate["events"][index][name])
    return certificate


def wrong_speed(certificate):
    for index in contacts(certificate)[:1]:
        return number(certificate, index, speed_in(certificate["events"][index]))


def wrong_time(certificate):
    for index in contacts(certificate)[-1:]:
        return number(certificate, index, "time")


def contact_left_out(certificate):
    for index in contacts(certificate)[:1]:
        del certificate["events"][index]
        return certificate


def contact_put_in(certificate):
    for index in contacts(certificate)[:1]:
        again = copy.deepcopy(certificate["events"][index])
        again["time"][0] += 1e-3
        certificate["events"].insert(index + 1, again)
        return certificate


def wrong_stop(certificate):
    for event in (certificate["events"][index] for index in contacts(certificate)[:1]):
        scene = certificate["scene"]
        of = scene["loose"] if is_of_wall(certificate, event) else scene
        if not ("lower" in of and "upper" in of) or ("R" in of["lower"]) != ("R" in of["upper"]):
            return None
        name = place_name(event)
        event[name] = {"lower": "upper", "upper": "lower"}[event[name]]
        return certificate


def wall_for_stop(certificate):
    """An event of one mass is claimed as one of the other."""
    for event in certificate["events"]:
        name, speed = place_name(event), speed_in(event)
        scene = certificate["scene"]
        if event["event"] != "impact" or "loose" not in scene or not ({"lower", "upper"} & scene.keys()):
            continue
        of, other = (scene, ("stop", "v")) if name == "wall" else (scene["loose"], ("wall", "w"))
        if "stiffness" not in of.get(event[name], {"stiffness": 1}):
            event[other[0]], event[other[1]] = event.pop(name), event.pop(speed)
            return certificate


def events_exchanged(certificate):
    """One of each mass, without their times."""
    events = certificate["events"]
    for one, other in zip(events, events[1:]):
        if {place_name(one), place_name(other)} == {"stop", "wall"} and speed_in(one) and speed_in(other):
            one["time"], other["time"] = other["time"], one["time"]
            at = events.index(one)
            events[at], events[at + 1] = other, one
            return certificate


def twice_the_period(certificate):
    if certificate["claim"] == "transient" or "released" in certificate["start"] or rests(certificate):
        return None
    if certificate.get("kind") in ("fold", "flip"):  # the motion over two periods has many, or is born there
        return None
    period = certificate["periods"] * 2 * 3.141592653589793 / certificate["scene"]["nu"]
    certificate["periods"] *= 2
    later = copy.deepcopy(certificate["events"])
    for event in later:
        for name in ("time", "until"):
            if name in event:
                event[name] = [event[name][0] + period, 2 * event[name][1] + 1e-12]
    certificate["events"] += later
    for name in ("multipliers", "word", "symmetric"):
        certificate.pop(name, None)
    return certificate


def wrong_multiplier(certificate):
    """A stable motion is called unstable."""
    if certificate["claim"] != "periodic" or "multipliers" not in certificate:
        return None
    re, im, error = certificate["multipliers"][0]
    certificate["multipliers"][0] = [re + 1.5, im, error]
    return certificate if error < 0.5 else None


def rest_that_is_none(certificate):
    for index, event in enumerate(certificate["events"]):
        if event["event"] == "impact":
            until = [event["time"][0] + 1e-3, 1e-9]
            if restitution(certificate, event) == 0:  # it would rest at once
                continue
            name = place_name(event)
            chatter = {"event": "chatter", name: event[name], "time": event["time"], "until": until}
            rest = {**chatter, "event": rest_name(certificate, event), "time": until, "until": [until[0] + 0.5, 1e-9]}
            certificate["events"][index + 1 :] = [chatter, rest]
            return certificate


def rest_where_the_force_pulls(certificate):
    """After an impact that takes all speed."""
    events = certificate["events"]
    for index, event in enumerate(events):
        if event["event"] == "impact" and restitution(certificate, event) == 0:
            kind, name = rest_name(certificate, event), place_name(event)
            if index + 1 == len(events) or events[index + 1]["event"] != kind:
                until = [event["time"][0] + 0.5, 1e-9]
                rest = {"event": kind, name: event[name], "time": event["time"], "until": until}
                events.insert(index + 1, rest)
                return certificate


def rest_left_out(certificate):
    for index in rests(certificate)[:1]:
        del certificate["events"][index]
        return certificate


def rest_too_long(certificate):
    for index in rests(certificate)[:1]:
        return number(certificate, index, "until")


def sticks(certificate):
    return [i for i, event in enumerate(certificate["events"]) if event["event"] == "stick"]


def wrong_place(certificate):
    for index, event in enumerate(certificate["events"]):
        if "x" in event:
            return number(certificate, index, "x")


def stick_left_out(certificate):
    for index in sticks(certificate)[:1]:
        del certificate["events"][index]
        return certificate


def stick_that_is_none(certificate):
    for event in certificate["events"]:
        if event["event"] == "reversal":
            return event.update(event="stick", until=[event["time"][0] + 1e-3, 1e-9]) or certificate


def stick_too_long(certificate):
    for index in sticks(certificate)[:1]:
        return number(certificate, index, "until")


def more_friction(certificate):
    scene = certificate["scene"]
    for name in {"friction", "friction_static"} & scene.keys():
        scene[name] *= 1.001
    slips = certificate["events"] and certificate["claim"] != "special"
    return certificate if scene.get("friction") and slips else None


def wrong_maximum(certificate):
    if "x_max" in certificate:
        return certificate | {"x_max": off(certificate["x_max"])}


def wrong_minimum(certificate):
    if "x_min" in certificate:
        return certificate | {"x_min": off(certificate["x_min"])}


WITHOUT_IMPACTS = {"-": "(L)", "(L)": "-", "(U)": "(L)"}  # words of such motion, and other ones


def wrong_word(certificate):
    word = certificate.get("word")
    if word in WITHOUT_IMPACTS:
        return certificate | {"word": WITHOUT_IMPACTS[word]}
    if word:
        return certificate | {"word": word + "L"}


def wrong_symmetry(certificate):
    if certificate["claim"] == "special":  # of the motion of a half, which returns mirrored
        return None
    if certificate.get("symmetric") is True and "released" not in certificate["start"]:
        return certificate | {"symmetric": False}


def wrong_start(certificate):
    start = certificate["start"]
    if (
        certificate["claim"] != "transient"
        and "x" in start
        and not any(event["event"] == "rest" for event in certificate["events"])
    ):
        start["x"] = off(start["x"])
        return certificate


def wrong_end(certificate):
    if "end" in certificate:
        certificate["end"]["x"] = off(certificate["end"]["x"])
        return certificate


def wrong_restitution(certificate):
    if certificate["claim"] == "special":  # it may be that of a stop that is only grazed
        return None
    for event in certificate["events"]:
        if event["event"] == "impact":
            of = holder_of_R(certificate["scene"], event)
            of["R"] = of["R"] * 0.999 + 1e-4
            return certificate


def wrong_loose_mass(certificate):
    if "loose" in certificate["scene"] and contacts(certificate):
        certificate["scene"]["loose"]["mass"] *= 1.001
        return certificate


def wrong_place_in_housing(certificate):
    place = certificate.get("end", certificate["start"])
    if "z" in place and isinstance(place["z"], list):
        place["z"] = off(place["z"])
        return certificate


def pressed_by_the_other_wall(certificate):
    """From its place on the other wall the loose mass takes another course."""
    start, loose = certificate["start"], certificate["scene"].get("loose", {})
    if "pressed" in start and "lower" in loose and "upper" in loose:
        start["pressed"] = {"lower": "upper", "upper": "lower"}[start["pressed"]]
        return certificate


def two_multipliers_of_a_press(certificate):
    """After a press two multipliers are 0, not one."""
    if "pressed" in certificate["start"] and "multipliers" in certificate:
        certificate["multipliers"][-1] = [0.5, 0.0, 0.25]
        return certificate


def wrong_parameter(certificate):
    """A special point elsewhere on its branch."""
    if certificate["claim"] == "special":
        certificate["parameter"] = off(certificate["parameter"])
        for name, slope in certificate["slopes"].items():  # the scene is that of the claimed parameter
            at, by = certificate["scene"], BEYOND * certificate["parameter"][1]
            if isinstance(slope, dict):
                for part, of_stop in slope.items():
                    at[name][part] += of_stop * by
            else:
                at[name] += slope * by
        return certificate


def wrong_kind(certificate):
    others = {"fold": "flip", "flip": "fold", "symmetry breaking": "fold", "graze": "fold"}
    kind = certificate.get("kind")
    if kind is not None and not (kind == "fold" and certificate.get("symmetric")):
        certificate["kind"] = others.get(kind, "fold")
        return certificate


def graze_that_is_an_impact(certificate):
    for event in certificate["events"]:
        if event["event"] == "graze" and "R" in certificate["scene"][event["stop"]]:
            event.update(event="impact", v=[{"lower": -1e-3, "upper": 1e-3}[event["stop"]], 1e-9])
            return certificate


def graze_left_out(certificate):
    if certificate.get("kind") == "graze":
        certificate["events"] = [event for event in certificate["events"] if event["event"] != "graze"]
        return certificate


FORGERIES = [
    wrong_speed,
    wrong_time,
    contact_left_out,
    contact_put_in,
    wrong_stop,
    wall_for_stop,
    events_exchanged,
    twice_the_period,
    wrong_multiplier,
    rest_that_is_none,
    rest_where_the_force_pulls,
    rest_left_out,
    rest_too_long,
    wrong_place,
    stick_left_out,
    stick_that_is_none,
    stick_too_long,
    more_friction,
    wrong_maximum,
    wrong_minimum,
    wrong_word,
    wrong_symmetry,
    wrong_start,
    wrong_end,
    wrong_restitution,
    wrong_loose_mass,
    wrong_place_in_housing,
    pressed_by_the_other_wall,
    two_multipliers_of_a_press,
    wrong_parameter,
    wrong_kind,
    graze_that_is_an_impact,
    graze_left_out,
]


def forged(certificate):
    """Each forgery that a certificate admits, with its kind."""
    for forge in FORGERIES:
        if (forgery := forge(copy.deepcopy(certificate))) is not None:
            yield forge.__name__, forgery
