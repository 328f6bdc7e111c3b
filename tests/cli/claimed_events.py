"""The events of certificates: see apps/verify/README.md for their format."""


def speed_in(event):
    """The name of the velocity that an event claims, if it does: of a loose mass that in its housing."""
    return next((name for name in ("v", "w") if name in event), None)


def contacts(certificate):
    return [i for i, event in enumerate(certificate["events"]) if speed_in(event)]


def rests(certificate):
    return [i for i, event in enumerate(certificate["events"]) if event["event"] in ("rest", "press")]


def place_name(event):
    """Of a wall beside stops that is "wall"."""
    return "wall" if "wall" in event else "stop"


def is_of_wall(certificate, event):
    return "wall" in event or ("loose" in certificate["scene"] and event.get("stop") not in certificate["scene"])


def holder_of_R(scene, event):
    """The object that has the restitution of a rigid stop, of a wall of a loose mass, or of both walls."""
    side, housing = event.get(place_name(event)), scene.get("loose", {})
    if "wall" not in event and side in scene:
        return scene[side]
    return housing if {"R", "restitution"} & housing.keys() else housing.get(side, {})


def restitution(certificate, event):
    """That of a rigid stop, or of a wall of a loose mass."""
    return holder_of_R(certificate["scene"], event)["R"]


def rest_name(certificate, event):
    return "press" if is_of_wall(certificate, event) else "rest"
