"""Honest scales: noise is no curve, ticks can be read, and a few extreme values don't flatten all others."""

from dataclasses import dataclass

import numpy as np
from matplotlib import rcParams, ticker

from .names import scale_in

SAME = 1e-9  # of its scale: what differs by less is one value
NEGLIGIBLE = 1e-12  # of the largest: the phase of such an amplitude is noise
MOST_LEVELS = 12  # integers that have a colour each
USUAL = 0.995  # share of the values below the number of levels that have a colour of their own
FAR = 3.0  # extents of the usual values by which a scale must exceed them to be clipped
DIGITS = 6  # of a number beside a tick, at most
PLAIN = (-4, 5)  # powers of ten below which, and from which on, the numbers beside ticks have a common factor
LETTER = 0.53  # width of a digit over the size of its font
MINUS = "\N{MINUS SIGN}"
COUNTS = ("impacts_per_period", "period_ratio", "impact_total", "impact_count", "symmetric")  # whole in regular motion
TIMES = ("settling_periods",)  # whole, but no counts


def shown_values(output, name):
    """The values of a result as floats, in its own shape; NaN for infinite ones, for the period of motion without one,
    and for phases of negligible amplitudes."""
    values = output.values(name).astype(float)
    values = np.where(np.isfinite(values), values + 0.0, np.nan)  # no negative zero
    if name == "period_ratio":
        values[values == 0] = np.nan
    amplitudes = name.replace("_phase", "_amplitude")
    if amplitudes != name and amplitudes in output:
        amplitude = np.abs(output.values(amplitudes))
        values[amplitude <= NEGLIGIBLE * largest(amplitude)] = np.nan
    return values


def largest(values):
    """The largest modulus; 0 if there is no number."""
    moduli = np.abs(values[np.isfinite(values)])
    return float(moduli.max()) if moduli.size else 0.0


def is_constant(values, scale=None):
    """Whether all numbers are one, to rounding of a quantity of this scale; by default its own largest modulus."""
    known = values[np.isfinite(values)]
    scale = largest(known) if scale is None else scale
    return known.size > 0 and float(np.ptp(known)) <= SAME * scale


def constant_value(values, scale):
    """The value of a constant; 0 if it is noise."""
    value = float(np.nanmean(values))
    return 0.0 if abs(value) <= SAME * scale else value


def is_integer(values):
    """Whether all numbers are whole."""
    known = values[np.isfinite(values)]
    return known.size > 0 and bool((known == np.round(known)).all())


@dataclass
class Levels:
    """Integers that have a colour each. Values between them have one for each gap; greater ones are clipped."""

    first: int
    last: int
    has_gaps: bool
    greatest: float  # value that is clipped; NaN if none is

    @property
    def integers(self):
        return np.arange(self.first, self.last + 1)

    @property
    def boundaries(self):
        """Limits of the colours: around each integer, close to it if there are values between."""
        half = 0.01 if self.has_gaps else 0.5
        around = self.integers[:, None] + np.array([-half, half])
        return around.ravel() if self.has_gaps else np.append(around[:, 0], around[-1, 1])

    @property
    def is_clipped(self):
        return np.isfinite(self.greatest)


def integer_levels(values, name=""):
    """The levels of a quantity that counts: one of whole numbers, or named so. None if it is neither or has many."""
    if name in TIMES or name not in COUNTS and not is_integer(values):
        return None
    known = values[np.isfinite(values)]
    if known.size == 0 or np.median(known) > known.min() + MOST_LEVELS:
        return None
    first, last = int(np.floor(known.min())), int(np.ceil(known.max()))
    near = known[known <= first + MOST_LEVELS - 1]
    usual = max(int(np.ceil(np.quantile(near, USUAL, method="higher"))), first + 1)
    if last >= first + MOST_LEVELS or last - usual > FAR * (usual - first):
        last = usual
    beyond = float(known.max()) if known.max() > last else np.nan
    shown = known[known <= last]
    return Levels(first, last, not is_integer(shown), beyond)


def tidy_ticks(axes, title=""):
    """Numbers beside ticks that have at most six digits and don't meet, in the unit that the label of the axis, or the
    title, names. What they have in common, a factor or most of their digits, is added to the label, unless that is
    empty. To be called when the limits are set; returns what they have in common on each axis that it changed, "x" or
    "y", as text."""
    words = {}
    for name, axis in (("x", axes.xaxis), ("y", axes.yaxis)):
        low, high = sorted(getattr(axes, f"get_{name}lim")())
        own = (ticker.ScalarFormatter, ticker.LogFormatter)  # of matplotlib: no names of classes, no numbers left out
        scale = scale_in(axis.get_label_text() or title)
        if not isinstance(axis.get_major_formatter(), own):
            continue
        if axis.get_scale() == "log" and high > 100 * low:
            axis.set_major_formatter(Decades(scale))
            continue
        common = common_part(low * scale, high * scale)
        common.scale = scale
        axis.set_major_formatter(common)
        axis.set_minor_formatter(ticker.NullFormatter())
        if axis.get_scale() == "log" and high > 5 * low and not common.words:
            axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
            axis.set_major_formatter(ticker.FuncFormatter(lambda value, _, scale=scale: f"{value * scale:g}"))
        elif isinstance(axis.get_major_locator(), (ticker.MaxNLocator, ticker.LogLocator)):
            axis.set_major_locator(RoomyLocator(common, name == "x", wants_integers(axis)))
        words[name] = common.words
        if common.words and axis.get_label_text():
            axis.set_label_text(axis.get_label_text() + ("\n" if name == "y" else " ") + common.words)
    return words


def wants_integers(axis):
    return getattr(axis.get_major_locator(), "_integer", False)


def common_part(low, high):
    """The part that the numbers between two limits have in common; nothing if six digits tell them apart without it."""
    span, offset = high - low, 0.0
    if not span > 0:
        return Common(0.0, 0, "")
    finest, coarsest = power_of(span / RoomyLocator.MOST), power_of(max(-low, high))
    if coarsest - finest >= DIGITS:
        text = round_start(low, high)
        offset = float(text)
        coarsest = power_of(max(offset - low, high - offset))
        text = in_tens(text)
    digits = max(coarsest, 0) - min(finest, 0) + 1
    power = 0 if PLAIN[0] <= coarsest < PLAIN[1] and digits <= DIGITS else coarsest
    start = ("+ " if offset < 0 else f"{MINUS} ") + text.lstrip("-") if offset else ""
    return Common(offset, power, ", ".join(part for part in (start, f"in $10^{{{power}}}$" * bool(power)) if part))


def round_start(low, high):
    """A round number between two limits if there is one, else the one below both, as text."""
    unit = power_of(high - low) + 1
    middle = round((low + high) / 2, -unit)
    start = middle if low <= middle <= high else np.floor(low / 10.0**unit) * 10.0**unit
    text = f"{start:.{max(-unit, 0)}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def in_tens(text):
    """A decimal number with a power of ten, if it is so small or large that it begins or ends with many zeros."""
    power = power_of(abs(float(text)))
    if PLAIN[0] <= power < PLAIN[1]:
        return text
    digits = text.lstrip("-0.").replace(".", "").rstrip("0")
    return ("-" if text[0] == "-" else "") + f"{digits[0]}.{digits[1:]}".rstrip(".") + rf"$\cdot 10^{{{power}}}$"


def power_of(value):
    return int(np.floor(np.log10(value) + SAME))


@dataclass(eq=False)
class Common(ticker.Formatter):
    """Writes numbers less an offset and over a power of ten, which the words tell; of data in another unit, times the
    scale."""

    offset: float
    power: int
    words: str
    scale: float = 1.0

    def __call__(self, value, place=None):
        return self.format_ticks([value])[0]

    def format_ticks(self, values):
        """As many decimals as all numbers together need."""
        rest = (np.asarray(values, float) * self.scale - self.offset) / 10.0**self.power
        error = 1e-3 * (np.diff(rest).min() if len(rest) > 1 else largest(rest))
        rounded = (np.round(rest, decimals) + 0.0 for decimals in range(DIGITS))  # no negative zero
        decimals = next((i for i, close in enumerate(rounded) if np.all(np.abs(close - rest) <= error)), DIGITS)
        return [f"{value + 0.0:.{decimals}f}".replace("-", MINUS) for value in np.round(rest, decimals)]


class Decades(ticker.LogFormatterSciNotation):
    """Writes the powers of ten of a long logarithmic axis, of data in another unit times the scale."""

    def __init__(self, scale):
        super().__init__()
        self.scale = scale

    def __call__(self, value, place=None):
        return super().__call__(value * self.scale, place)


class RoomyLocator(ticker.MaxNLocator):
    """Ticks at round numbers, as many as have room for their numbers."""

    MOST = 9

    def __init__(self, formatter, is_across, integer):
        super().__init__(nbins=self.MOST, steps=[1, 2, 5, 10], integer=integer)
        self.common, self.is_across = formatter, is_across
        self.font_size = rcParams[f"{'x' if is_across else 'y'}tick.labelsize"]  # a later draw may have another style
        self.known = {}  # ticks by all that decides them: to lay out and draw a picture asks for them dozens of times

    def tick_values(self, low, high):
        key = (low, high, *self.room())
        if key not in self.known:
            self.known[key] = self.roomy_ticks(low, high)
        return self.known[key]

    def room(self):
        """The length of the axis in points, its limits and its scale."""
        axes, limits = self.axis.axes, self.axis.get_view_interval()
        length = axes.bbox.width if self.is_across else axes.bbox.height
        return length * 72.0 / axes.figure.dpi, *limits, self.axis.get_scale()

    def roomy_ticks(self, low, high):
        for bins in range(self.MOST, 0, -1):
            self.set_params(nbins=bins)
            ticks = super().tick_values(low, high)
            if self.has_room(ticks[(ticks >= min(low, high)) & (ticks <= max(low, high))]):
                break
        return ticks

    def has_room(self, ticks):
        """Whether the numbers of these ticks stand apart."""
        if len(ticks) < 2:
            return True
        length, *limits, _ = self.room()
        scale = self.axis.get_transform().transform
        share = np.diff(scale(ticks)).min() / np.ptp(scale(np.array(limits)))
        longest = max(map(len, self.common.format_ticks(ticks)))
        return share * length >= self.font_size * ((LETTER * longest + 1.0) if self.is_across else 1.8)
