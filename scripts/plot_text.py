"""Texts of files and command lines as pictures show them."""

import re
from itertools import groupby

LONGEST = 12  # letters of a word that is written out


def plain(text):
    """A text in one line without mathematics, and with a mark for what no picture can show."""
    text = re.sub(r"[\t\n\r]", " ", text)
    return re.sub(r"[\x00-\x1f\x7f\ud800-\udfff]", "\N{REPLACEMENT CHARACTER}", text).replace("$", r"\$")


def short_word(word):
    """An impact word, a long one with powers of what repeats: LLLLLLLUUUUUUU becomes L⁷U⁷."""
    if len(word) <= LONGEST:
        return plain(word)
    shown, room = "", LONGEST
    for letter, run in groupby(re.findall(r"\w\*?", word)):
        times = len(list(run))
        room -= len(letter) + (len(str(times)) if times > 1 else 0)
        if room < 0:
            return shown + "…"
        shown += letter + (f"$^{{{times}}}$" if times > 1 else "")
    return shown
