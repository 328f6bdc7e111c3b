"""Certificates that are read with an error, each with the place and how to fix it that are told."""

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


MALFORMED = [  # a line, and the place and how to fix it that are told
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
    (in_scene(lower={"position": 1}), "scene.lower: has neither R nor stiffness; give one"),
    (in_scene(lower={"position": 1, "R": 2}), "scene.lower.R: is 2; it must be at least 0 and at most 1"),
    (in_scene(upper={"position": -6, "R": 1}), "scene: has its lower stop above the upper one; exchange"),
    (in_scene(friction=0.2, friction_static=0.1), "scene.friction_static: is below friction; give the same or more"),
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
]
