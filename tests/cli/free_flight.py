"""Free flights of random scenes by their Taylor series, which share nothing with the program."""

import itertools
import math


def flown(s, tau, x, v, time):
    """Displacement and velocity after a free flight, by its Taylor series in steps."""
    rate = max(1.0, math.sqrt(abs(s.stiffness)), 2 * s.h, s.nu * s.pace())
    turn, first = 2 * math.pi / s.nu, s.phase / (2 * math.pi)  # the period of the force, and its phase at tau = 0
    begin, end = tau / turn + first, (tau + time) / turn + first
    turns = range(math.floor(begin), math.ceil(end) + 1)
    ends = sorted({knot + whole for knot in s.knots() for whole in turns if begin < knot + whole < end} | {begin, end})
    pieces = [
        (there + (then - there) * n / count, (then - there) / count)
        for there, then in itertools.pairwise(ends)
        for count in [max(1, math.ceil(4 * rate * (then - there) * turn))]
        for n in range(count)
    ]
    for there, part in pieces:
        step = part * turn
        shape = s.derivatives(there, there + part / 2, 24)
        terms = [x, v]
        force = s.f
        for k in range(24):
            forced = force * shape[k]
            constant = s.load if k == 0 else 0.0
            # terms[k] is the k-th derivative
            terms.append(constant + forced - 2 * s.h * terms[k + 1] - s.stiffness * terms[k])
            force *= s.nu
        x = sum(term * step**k / math.factorial(k) for k, term in enumerate(terms))
        v = sum(term * step ** (k - 1) / math.factorial(k - 1) for k, term in enumerate(terms) if k)
    return x, v
