"""Certificates that are read with an error, each with the place and how to fix it that are told."""

import json

RIGHT = {
    "format": "clatter-certificate-1",
    "point": 3,
    "scene": {"h": 0.1, "k": 1, "f": 1, "nu": 1.2, "load": 0, "phase": 0, "lower": {"position": -5, "R": 0.7}},
    "claim": "transient",
    "start": {"time": 0, "x": 0, "v": 0},
    "events": [],
    "end": {"time": "0.1", "x": [0.0002, 1e-3], "v": [0.006, 1e-3]},
}


SPECIAL = {**RIGHT, "claim": "special", "kind": "fold", "parameter": [1.2, 1e-9], "slopes": {"nu": 1}, "periods": 1}


def without(name):
    return {key: value for key, value in RIGHT.items() if key != name}


def in_scene(**values):
    return {**RIGHT, "scene": {**RIGHT["scene"], **values}}


LOOSE = {"mass": 0.1, "R": 0.6, "load": 0, "lower": {"position": -0.4}, "upper": {"position": 0.4}}


def with_loose_mass(loose, **changes):
    """The right one with a loose mass in place of its stop, and other changes."""
    scene = {key: value for key, value in RIGHT["scene"].items() if key != "lower"}
    return {**RIGHT, "scene": {**scene, "loose": loose}, **changes}


HOUSED = {
    "start": {"time": 0, "x": 0, "v": 0, "z": 0, "w": 0},
    "end": {**RIGHT["end"], "z": [0, 1], "w": [0, 1]},
}
IMPACT = {"event": "impact", "wall": "upper", "time": [0, 1]}


def beside_stops(event):
    """The right one with a loose mass beside its stop."""
    return {**RIGHT, "scene": {**RIGHT["scene"], "loose": LOOSE}, **HOUSED, "events": [event]}


PERIOD = {"claim": "periodic", "periods": 1}
PRESS = {"event": "press", "stop": "lower", "time": [0, 1], "until": [1, 1]}


def with_law(**law):
    return in_scene(lower={"position": -5, "restitution": law})


KNOTS = "scene.lower.restitution.table"
MALFORMED_LAWS = [
    (in_scene(lower={"position": -5, "restitution": 0.7}), "scene.lower.restitution: is no object; write {...}"),
    (
        in_scene(lower={"position": -5, "restitution": {"R": 0.7, "below": 1}, "R": 0.7}),
        "scene.lower: has R and restitution; give one",
    ),
    (
        in_scene(lower={"position": -5, "restitution": {"R": 0.7, "below": 1}, "stiffness": 3, "damping": 0}),
        "scene.lower: has restitution and stiffness; give one",
    ),
    (with_law(), "scene.lower.restitution: has neither R nor table; give one"),
    (with_law(R=0.7), "scene.lower.restitution: doesn't depend on the speed; give R alone"),
    (with_law(R=0.7, below=0), "scene.lower.restitution: doesn't depend on the speed; give R alone"),
    (with_law(R=1.1, below=1), "scene.lower.restitution.R: is 1.1; it must be at least 0 and at most 1"),
    (with_law(R=0.7, below=-1), "scene.lower.restitution.below: is -1; it must be at least 0"),
    (with_law(R=0.7, exponent=0.2), "scene.lower.restitution.reference_speed: is missing; add it"),
    (with_law(R=0.7, exponent=0, reference_speed=1), "scene.lower.restitution.exponent: is 0; it must be above 0"),
    (with_law(R=0.7, exponent=1, reference_speed=1), "scene.lower.restitution.exponent: is 1; it must be below 1"),
    (
        with_law(R=0.7, exponent=0.2, reference_speed=0),
        "scene.lower.restitution.reference_speed: is 0; it must be above 0",
    ),
    (with_law(R=0.7, below=1, reference_speed=1), "scene.lower.restitution: the member 'reference_speed' has no mean"),
    (with_law(R=0.7, below=1, unit=2), "scene.lower.restitution: the member 'unit' has no meaning here; leave"),
    (with_law(R=0.7, table=[[1, 0.5]]), "scene.lower.restitution: has R and table; give one"),
    (
        with_law(table=[[1, 0.5]], exponent=0.2, reference_speed=1),
        "scene.lower.restitution.exponent: is given beside a table; leave one",
    ),
    (with_law(table=[]), rf"{KNOTS}: is empty; write \[\[speed, R\], ...\]"),
    (with_law(table=[[1, 0.5, 2]]), rf"{KNOTS}\[0\]: has 3 items; write \[speed, R\]"),
    (with_law(table=[[-1, 0.5]]), rf"{KNOTS}\[0\]\[0\]: is -1; it must be at least 0"),
    (with_law(table=[[1, 1.5]]), rf"{KNOTS}\[0\]\[1\]: is 1.5; it must be at least 0 and at most 1"),
    (with_law(table=[[1, 0.5], ["1.0", 0.4]]), rf"{KNOTS}\[1\]\[0\]: is no faster than the knot before; give each"),
    (with_law(table=[[1, 0.5]], unit=0), "scene.lower.restitution.unit: is 0; it must be above 0"),
    (
        {**SPECIAL, "scene": with_law(R=0.7, below=1)["scene"]},
        "claim: is special with a restitution that depends on the speed; claim transient or periodic",
    ),
    (
        with_loose_mass({**LOOSE, "restitution": {"R": 0.6, "below": 1}}, **HOUSED),
        "scene.loose: has R and restitution; give one",
    ),
    (
        with_loose_mass({**LOOSE, "upper": {"position": 0.4, "restitution": {"R": 0.6, "below": 1}}}, **HOUSED),
        "scene.loose.upper.restitution: is given beside that of both walls; leave one",
    ),
]

MALFORMED_ORDERS = [
    (in_scene(orders={"order": 2, "sin": 1}), "scene.orders: is no array; write"),
    (in_scene(orders=[{"order": 0, "sin": 1}]), r"scene.orders\[0\].order: is out of range; write 1 to 100"),
    (in_scene(orders=[{"order": 2.5, "sin": 1}]), r"scene.orders\[0\].order: is no whole number; write 1 or more"),
    (in_scene(orders=[{"order": 1, "sin": 1}]), r"scene.orders\[0\].sin: of order 1 is f; give f, and leave it out"),
    (in_scene(orders=[{"order": 3}]), r"scene.orders\[0\]: has neither sin nor cos; give one of them, or both"),
    (
        in_scene(orders=[{"order": 3, "sin": 1}, {"order": 3, "cos": 1}]),
        r"scene.orders\[1\]: is of an order that was given",
    ),
    (
        in_scene(orders=[{"order": 3, "sin": 1, "size": 2}]),
        r"scene.orders\[0\]: the member 'size' has no meaning here; leave it out",
    ),
    (
        {**SPECIAL, "slopes": {"orders": [{"order": 2, "sin": 1}]}},
        "slopes.orders: has the order 2, which the scene hasn",
    ),
    (
        {**SPECIAL, "slopes": {"nu": 1, "orders": [{"order": 1, "sin": 5}]}},
        r"slopes.orders\[0\].sin: of order 1 is f; give f, and leave it out",
    ),
    (
        {**SPECIAL, "slopes": {"nu": 1, "orders": [{"order": 2, "sin": 5}, {"order": 2, "sin": 1}]}},
        r"slopes.orders\[1\]: is of an order that was given; give each order once",
    ),
]
MALFORMED = MALFORMED_LAWS + [  # a line, and the place and how to fix it that are told
    *MALFORMED_ORDERS,
    ("{", "is no JSON .*; write one object a line"),
    ('{"a":' * 100000, "nests more than"),
    (without("format"), "format: is missing; add it"),
    ({**RIGHT, "format": "other"}, 'format: .*; write "clatter-certificate-1"'),
    (without("scene"), "scene: is missing; add it"),
    ({**RIGHT, "claim": "periodic", "periods": 1, "word": "-L"}, "word: is '-L'; write L, U, .* or -"),
    (in_scene(h=-1), "scene.h: is -1; it must be at least 0"),
    (in_scene(nu=0), "scene.nu: is 0; it must be above 0"),
    (in_scene(k="1e"), "scene.k: .* is no decimal number; write e.g."),
    (in_scene(k="nan"), "scene.k: .* is no decimal number; write e.g."),
    (in_scene(k=None), "scene.k: is no number; write a number"),
    (in_scene(lower={"position": 1}), "scene.lower: has neither R, restitution nor stiffness; give one"),
    (in_scene(lower={"position": 1, "R": 2}), "scene.lower.R: is 2; it must be at least 0 and at most 1"),
    (in_scene(upper={"position": -6, "R": 1}), "scene: has its lower stop above the upper one; exchange"),
    (in_scene(friction=0.2, friction_static=0.1), "scene.friction_static: is below friction; give the same or more"),
    (in_scene(k="0." + "1" * 399), "scene.k: '0.1*' is no decimal number; write e.g."),
    (in_scene(k="1.1e300"), "scene.k: '1.1e300' is beyond 1e-300 to 1e300; change the units"),
    (in_scene(k="-9e-301"), "scene.k: '-9e-301' is beyond 1e-300 to 1e300; change the units"),
    ({**RIGHT, "claim": "periodic", "periods": 1000001}, "periods: is out of range; write 1 to 1000000"),
    # to the last digit
    (
        in_scene(lower={"position": -5, "R": "1." + "0" * 380 + "1"}),
        "scene.lower.R: is 1.0*1; it must be at least 0 and",
    ),
    (
        in_scene(lower={"position": -5, "R": "-1e-299"}),
        "scene.lower.R: is -1e-299; it must be at least 0 and at most 1",
    ),
    (
        in_scene(friction="0.2" + "0" * 90 + "1", friction_static="0.2"),
        "scene.friction_static: is below friction; give the same or more",
    ),
    (in_scene(friction=0.2, friction_static="0.2"), "scene.friction_static: is below friction; give"),  # 0.2 + 1.1e-17
    (
        in_scene(upper={"position": "-5.0", "R": 1}, lower={"position": "-5", "R": 1}),
        "scene: has its lower stop above the upper one",
    ),
    (
        {**RIGHT, "events": [{"event": "stick", "time": [1, 1], "until": [2, 1], "x": [0, 1]}]},
        r"events\[0\]: is an event of dry friction; the scene has none",
    ),
    ({**RIGHT, "claim": "proof"}, "claim: is 'proof'; write transient, periodic or special"),
    ({**RIGHT, "claim": "special"}, "kind: is missing; add it"),
    ({**RIGHT, "claim": "special", "kind": "cusp"}, "kind: is 'cusp'; write fold, flip, "),
    ({**SPECIAL, "slopes": {"upper": {"position": 1}}}, "slopes.upper: is of no stop; leave it out"),
    ({**SPECIAL, "symmetric": False}, "symmetric: is false; leave it out"),
    ({**SPECIAL, "x_max": [1, 1]}, "x_max: is no claim of a special point; leave it out"),
    (
        {**RIGHT, "events": [{"event": "graze", "stop": "lower", "time": [1, 1]}]},
        r"events\[0\]: is a graze; only special",
    ),
    ({**RIGHT, "claim": "periodic", "periods": 0}, "periods: is out of range; write 1 to"),
    ({**RIGHT, "events": [{"event": "hit"}]}, r"events\[0\].event: is 'hit'; write impact"),
    (
        {**RIGHT, "events": [{"event": "impact", "stop": "upper", "time": [1, 1], "v": [1, 1]}]},
        r"events\[0\]: .*rigid stop; the scene has none there",
    ),
    ({**RIGHT, "end": {"time": 0, "x": [0, 1], "v": [0, 1]}}, "end: is not after the start; give a later time"),
    ({**RIGHT, "x_max": [0, -1]}, r"x_max\[1\]: is -1; it must be at least 0"),
    ({**RIGHT, "x_max": 0}, r"x_max: is no array; write"),
    (beside_stops(IMPACT), r"events\[0\].w: is missing; add it"),
    (beside_stops({**IMPACT, "wall": "middle"}), r"events\[0\].wall: is .*; write"),
    (beside_stops(PRESS), r"events\[0\]: is a press; give its wall"),
    (
        beside_stops({**IMPACT, "event": "touch", "w": [0, 1]}),
        r"events\[0\]: is a touch beside a loose mass; write impact, chatter or press of a wall",
    ),
    (
        beside_stops({"event": "impact", "stop": "upper", "time": [0, 1], "v": [1, 1]}),
        r"events\[0\]: is an event of a rigid stop; the scene has none there",
    ),
    (
        beside_stops({**IMPACT, "stop": "lower", "w": [1, 1]}),
        r"events\[0\]: the member 'stop' has no meaning here; leave it out",
    ),
    (with_loose_mass(LOOSE, **HOUSED, events=[IMPACT]), r"events\[0\].stop: is missing; add it"),
    (with_loose_mass({**LOOSE, "mass": 0}), "scene.loose.mass: is 0; it must be above 0"),
    (with_loose_mass({**LOOSE, "R": -1}), "scene.loose.R: is -1; it must be at least 0 and at most 1"),
    (
        with_loose_mass({**LOOSE, "lower": {"position": -0.4, "R": 0.5}}),
        "scene.loose.lower.R: is given beside that of both walls; leave one of them out",
    ),
    (with_loose_mass({key: LOOSE[key] for key in LOOSE if key != "R"}), "scene.loose.lower.R: is missing; add it"),
    (with_loose_mass({"mass": 1, "R": 1, "load": 0}), "scene.loose: has no walls; give lower, upper or both"),
    (with_loose_mass({**LOOSE, "lower": {"position": 1}}), "scene.loose: has its lower wall above the upper one; exch"),
    (with_loose_mass(LOOSE), "start.z: is missing; add it"),
    (with_loose_mass(LOOSE, **{**HOUSED, "end": RIGHT["end"]}), "end.z: is missing; add it"),
    (
        {**with_loose_mass(LOOSE), "claim": "special"},
        "claim: is special beside a loose mass; claim transient or periodic motion",
    ),
    (
        with_loose_mass(LOOSE, **HOUSED, events=[{**PRESS, "event": "rest"}]),
        r"events\[0\]: is a rest beside a loose mass; write impact, chatter or press",
    ),
    (
        with_loose_mass({**LOOSE, "lower": None}, **HOUSED, events=[PRESS]),
        "scene.loose.lower: is no object; write",
    ),
    (
        with_loose_mass({key: LOOSE[key] for key in LOOSE if key != "lower"}, **HOUSED, events=[PRESS]),
        r"events\[0\]: is an event of a wall; the housing has none there",
    ),
    ({**RIGHT, "events": [PRESS]}, r"events\[0\]: is a press; the scene has no loose mass; give it"),
    (
        with_loose_mass(
            {key: LOOSE[key] for key in LOOSE if key != "upper"},
            **PERIOD,
            start={"time": 0, "x": [0, 1], "v": [0, 1], "pressed": "upper"},
        ),
        "start.pressed: is a wall that isn't there; give the housing that wall, or z and w",
    ),
    (
        with_loose_mass(LOOSE, **PERIOD, start={"time": 0, "released": "lower"}),
        "start.released: is given beside a loose mass; give x and v",
    ),
    (
        with_loose_mass(LOOSE, **PERIOD, multipliers=[[0, 0, 1], [0, 0, 1]]),
        "multipliers: has not four items; write",
    ),
    # what nobody would look at
    ({**RIGHT, "periods": 7, "word": "LLL"}, "the line: the member '(periods|word)' has no meaning here; leave it out"),
    ({**RIGHT, "simmetric": True}, "the line: the member 'simmetric' has no meaning here; leave it out"),
    (in_scene(frictoin=2), "scene: the member 'frictoin' has no meaning here; leave it out"),
    (in_scene(lower={"position": -5, "R": 0.7, "damping": 1}), "scene.lower: the member 'damping' has no meaning here"),
    ({**RIGHT, "end": {**RIGHT["end"], "z": [0, 1]}}, "end: the member 'z' has no meaning here; leave it out"),
    (
        {**RIGHT, "start": {"time": -2.8, "released": "lower", "x": 9, "v": -4}},
        "start: the member '[xv]' has no meaning here; leave it out",
    ),
    ({**RIGHT, "loose": LOOSE, "friction": 0.4}, "the line: the member '(loose|friction)' has no meaning here; leave"),
    (
        {**RIGHT, "events": [{"event": "impact", "stop": "lower", "time": [1, 1], "v": [1, 1], "until": [2, 1]}]},
        r"events\[0\]: the member 'until' has no meaning here; leave it out",
    ),
    (
        {
            **{key: SPECIAL[key] for key in SPECIAL if key != "end"},
            "slopes": {"lower": {"R": 1, "stiffness": 1}},
            "start": {"time": 0, "x": [0, 1], "v": [0, 1]},
        },
        "slopes.lower: the member 'stiffness' has no meaning here; leave it out",
    ),
    (json.dumps(RIGHT)[:-1] + ', "end": {}}', "the line has the member 'end' twice in an object; keep one"),
    (json.dumps(RIGHT).replace('"h":', '"k": 2, "h":'), "the line has the member 'k' twice in an object; keep one"),
    ({**RIGHT, "start": {"time": 0, "x": "--1", "v": 0}}, "start.x: '--1' is no decimal number; write e.g."),
    *(
        (in_scene(k=text), "scene.k: .* is no decimal number; write e.g.")
        for text in ("", ".", "+-1", "1.2.3", "1e5e5", "e5", "1e+", " 1", "1 ", "0x1", "1_0")
    ),
    *(
        ({**RIGHT, "claim": "periodic", "periods": 1, "word": text}, "word: is '.*'; write L, U, .* or -")
        for text in ("\u2026", "*L", "L**", "L\u2026U", "(U)\u2026", "l")
    ),
]
