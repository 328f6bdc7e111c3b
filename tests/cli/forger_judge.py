"""Judges whether a certificate is surely false, by a motion that was simulated, the format, and nothing else.

A truth is the motion of a true certificate, once it agrees with it. A forgery of that certificate speaks of the same
scene and, within narrow errors, of the same motion.
"""

import copy
import math

from forger_housing import HousedMotion
from forger_motion import OTHER, Motion, Unreliable, number

LAST = ("rest", "press", "stick", "hold", "chatter")  # events with an end of their own


def period_of(scene):
    return 2 * math.pi / number(scene["nu"])


class Truth:
    """The motion of a certificate that was simulated, with its events of all the time that it may be asked about."""

    def __init__(self, certificate):
        self.certificate, self.scene = certificate, certificate["scene"]
        start = copy.deepcopy(certificate["start"])
        self.periodic = certificate["claim"] != "transient"
        if self.periodic:
            self.length = certificate["periods"] * period_of(self.scene)
        else:
            self.length = number(certificate["end"]["time"]) - number(start["time"])
        kind = HousedMotion if "loose" in self.scene else Motion
        begin = number(start["time"])
        if "released" in start:
            begin = kind(self.scene, start, begin).t
        self.begin, self.motion = begin, kind(self.scene, start, begin + self.length)
        self.size = 1 + max(abs(place) for place in self.motion.extrema())
        self.tolerance = 1e-4 * self.size
        if self.periodic and not self.returns():
            raise Unreliable("the simulated motion doesn't return")

    def returns(self):
        first, last = self.motion.state(self.begin), self.motion.state(self.begin + self.length)
        return max(abs(x - y) for x, y in zip(first, last)) < 1e-5 * self.size

    def events(self, times):
        """The events of so many times the length, after a start within the motion as it was."""
        whole = []
        for turn in range(times):
            for event in copy.deepcopy(self.motion.events):
                for name in ("time", "until"):
                    if name in event:
                        event[name] += turn * self.length
                joins = event["event"] == "press" and whole and whole[-1]["event"] == "press"
                if joins:
                    whole[-1]["until"] = event["until"]
                else:
                    whole.append(event)
        return whole

    def is_mirrored(self):
        """Whether it is its own mirror image half its length later; None: unclear."""
        housing = self.scene.get("loose", self.scene)
        half, times = self.length / 2, [self.begin + self.length * i / 41 for i in range(20)]
        states = [(self.motion.state(t), self.motion.state(t + half)) for t in times]
        sums = [one[0] + other[0] for one, other in states]
        apart = max(sums) - min(sums)
        if "lower" in self.scene and "upper" in self.scene:  # the mirror is in their middle
            middle = number(self.scene["lower"]["position"]) + number(self.scene["upper"]["position"])
            apart = max(apart, *(abs(whole - middle) for whole in sums))
        if "loose" in self.scene and "lower" in housing and "upper" in housing:
            middle = number(housing["lower"]["position"]) + number(housing["upper"]["position"])
            apart = max(apart, *(abs(one[2] + other[2] - middle) for one, other in states))
        return False if apart > 100 * self.tolerance else None


def beyond(claimed, true, tolerance):
    value, error = claimed
    return abs(number(value) - true) > number(error) + tolerance


class Judge:
    """The facts of a truth that a forgery contradicts."""

    def __init__(self, truth, forgery):
        self.truth, self.forgery = truth, forgery

    def is_surely_false(self):
        return bool(self.reason())

    def reason(self):
        for test in (
            self.of_members,
            self.of_events,
            self.of_periods,
            self.of_symmetry,
            self.of_word,
            self.of_extrema,
            self.of_end,
        ):
            if reason := test():
                return reason
        return None

    def of_members(self):
        """A member that this claim doesn't have."""
        more = {"x_min", "x_max"} if self.forgery["claim"] != "special" else {"symmetric"}
        more |= {"word", "symmetric", "multipliers"} if self.forgery["claim"] == "periodic" else set()
        for name, added in (("scene", set()), ("start", {"x", "v"}), (None, more)):
            of, known = (
                (self.forgery[name], self.truth.certificate[name])
                if name
                else (
                    self.forgery,
                    self.truth.certificate,
                )
            )
            if of.keys() - known.keys() - added:
                return "a member that the claim doesn't have"
        return None

    def true_events(self):
        """Those up to the claimed end."""
        forgery, truth = self.forgery, self.truth
        if truth.periodic:
            end = truth.begin + forgery["periods"] * period_of(truth.scene)
            events = truth.events(max(1, math.ceil(forgery["periods"] / truth.certificate["periods"])))
        else:
            end, events = number(forgery["end"]["time"]), truth.events(1)
        if end > truth.begin + truth.length * (1 + 1e-9) and not truth.periodic:
            return None, end
        return [event for event in events if event["time"] < end - 1e-9], end

    def of_events(self):
        """Walks along both lists; of a chatter any number of true impacts may be listed before its sum."""
        true, end = self.true_events()
        if true is None:
            return None
        tolerance, at = self.truth.tolerance, 0
        for index, claim in enumerate(self.forgery["events"]):
            kind = claim["event"]
            if kind == "chatter":
                before = at
                while at < len(true) and (true[at]["event"] in ("reversal", "turn") or self.is_impact(true[at], claim)):
                    at += 1
                rests = at < len(true) and true[at]["event"] in ("rest", "press") and self.are_alike(true[at], claim)
                if not rests or (index and self.forgery["events"][index - 1]["event"] == "chatter"):
                    return f"event {index + 1}: no chatter begins"
                if beyond(claim["until"], true[at]["time"], tolerance):
                    return f"event {index + 1}: the chatter ends elsewhere"
                if before and beyond(claim["time"], true[before - 1]["time"], tolerance):
                    return f"event {index + 1}: the chatter begins elsewhere"
                continue
            if at == len(true):
                return f"event {index + 1}: nothing happens any more"
            fact = true[at]
            if kind != fact["event"] or not self.are_alike(claim, fact):
                return f"event {index + 1}: {fact['event']}"
            for name in {"time", "until", "v", "w", "x", "z"} & claim.keys():
                if name not in fact:
                    return f"event {index + 1}: no {name}"
                value = min(fact[name], end) if name == "until" else fact[name]
                if beyond(claim[name], value, tolerance * (10 if name == "until" else 1)):
                    return f"event {index + 1}: another {name}"
            at += 1
        return "events are left out" if at < len(true) else self.of_cut(true, end)

    def of_cut(self, true, end):
        """A chatter must have ended before the motion does."""
        last = self.forgery["events"][-1]["event"] if self.forgery["events"] else None
        return "it ends within a chatter" if last == "chatter" and true[-1]["time"] > end - 1e-9 else None

    @staticmethod
    def are_alike(one, other):
        return (one.get("stop"), one.get("wall")) == (other.get("stop"), other.get("wall"))

    def is_impact(self, event, claim):
        return event["event"] == "impact" and self.are_alike(event, claim)

    def of_periods(self):
        if not self.truth.periodic:
            return None
        claimed, true = self.forgery["periods"], self.truth.certificate["periods"]
        return f"{true} periods" if claimed > true and claimed % true == 0 else None

    def of_symmetry(self):
        if self.forgery.get("symmetric") is True and self.truth.is_mirrored() is False:
            return "it isn't symmetric"
        mirrored = self.truth.certificate.get("symmetric") is True and self.truth.is_mirrored() is None
        return "it is symmetric" if mirrored and self.forgery.get("symmetric") is False else None

    def letters(self):
        """The word of one period, in the rotation after a rest."""
        events = [event for event in self.truth.events(1) if event["event"] in ("impact", "touch", "rest", "press")]
        rests = [i for i, event in enumerate(events) if event["event"] in ("rest", "press")]
        if rests:
            events = events[rests[-1] + 1 :] + events[: rests[-1] + 1]
        word = []
        for event in events:
            letter = event["wall"][0] if "wall" in event else event["stop"][0].upper()
            if event["event"] in ("impact", "touch"):
                word.append(letter)
            elif word and word[-1] == letter:
                while word and word[-1] == letter:
                    word.pop()
                word.append(letter + "*")
        return word

    def of_word(self):
        word = self.forgery.get("word")
        if word is None or not self.truth.periodic:
            return None
        letters = self.letters()
        if not letters:
            return "a word without impacts" if set(word) & set("*") or word.upper() in ("L", "U", "LU", "UL") else None
        return None if word in {"".join(letters[i:] + letters[:i]) for i in range(len(letters))} else "another word"

    def of_extrema(self):
        low, high = self.truth.motion.extrema()
        for name, value in (("x_min", low), ("x_max", high)):
            if name in self.forgery and beyond(self.forgery[name], value, self.truth.tolerance * 10):
                return f"another {name}"
        return None

    def of_end(self):
        end = self.forgery.get("end")
        if end is None or number(end["time"]) > self.truth.begin + self.truth.length:
            return None
        state = self.truth.motion.state(number(end["time"]))
        for name, value in zip("xvzw", state):
            if name in end and beyond(end[name], value, self.truth.tolerance * 10):
                return f"another {name} at the end"
        return None


__all__ = ["Judge", "Truth", "OTHER", "Unreliable"]
