"""What the panels of a figure show, so that a page finds the curve, or the dot, under a click."""

import weakref

_results, _planes = weakref.WeakKeyDictionary(), weakref.WeakKeyDictionary()


def note_results(axes, parts):
    """That the ordinate of a panel is of these results: (name, component or None) of each."""
    _results[axes] = list(parts)


def results_in(axes):
    return _results.get(axes, [])


def note_plane(axes, names):
    """That a panel has a dot for each point at these two inputs of the sweep, or results."""
    _planes[axes] = tuple(names)


def plane_in(axes):
    return _planes.get(axes, ())
