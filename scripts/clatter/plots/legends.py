"""Legends that have room: above their panels, or once below all of them, in columns."""

from . import style

SIDES, BAR = 0.75, 1.0  # inches, of a panel's column: what the numbers and names beside it take, and a colour bar
HIGHEST, OWN = 0.25, 0.4  # of the height of a panel's row, for a legend above it; for one that no other panel shares
LARGEST = 0.3  # of the height of a picture of a given size, for the legend below; its letters become smaller
SIZES = (9.5, 8.0, 7.0)  # points
WIDEST = 0.98  # of the width of a picture
LETTERS = 11  # of a name, in an inch
PAD = 0.08  # inches, below and above the legend below


def lay_out(figure, is_fixed):
    """Finds the place of legends and panels; a figure whose size isn't fixed grows by the legend below the panels."""
    below = legend_below(figure, move_down(figure), is_fixed)
    if below:
        height = below.get_window_extent().height / figure.dpi + 2 * PAD
        if not is_fixed:
            figure.set_figheight(figure.get_figheight() + height)
        share = height / figure.get_figheight()
        figure.get_layout_engine().set(rect=(0.0, share, 1.0, 1.0 - share))
    style.lay_out(figure)
    if below:
        caption = figure._supxlabel
        top = caption.get_window_extent().y1 if caption and caption.get_text() else 0.0
        below.set_bbox_to_anchor((0.5, (top + PAD * figure.dpi) / figure.bbox.height), figure.transFigure)


def move_down(figure):
    """Removes the legends without room above their panels, and those that name nothing else, and returns their
    entries: (name, line or marker) of each."""
    panels = [axes for axes in figure.axes if axes.get_legend() and entries(axes)]  # else it names what another shows
    most = HIGHEST if all(max(map(entries, panels), key=len).keys() >= entries(axes).keys() for axes in panels) else OWN
    crowded = [axes for axes in panels if not fit_above(axes, most)]
    names = {name for axes in crowded for name in entries(axes)}
    moved, found = [axes for axes in panels if names.issuperset(entries(axes))], {}
    for axes in moved if crowded else []:
        axes.get_legend().remove()
        for name, handle in entries(axes).items():
            found.setdefault((name, look(handle)), (name, handle))
    return list(found.values())


def entries(axes):
    """The entries of a panel's legend, each name once."""
    return dict(zip(*reversed(axes.get_legend_handles_labels())))


def look(handle):
    """The look that tells an entry from another of its name."""
    return tuple(str(getattr(handle, f"get_{part}", str)()) for part in ("color", "linestyle", "marker", "facecolor"))


def fit_above(axes, share):
    """Gives a legend as many columns as its panel has room for, and returns whether it isn't higher than this share of
    the panel's row then."""
    figure, grid = axes.figure, axes.get_subplotspec().get_gridspec()
    bars = any(other.get_label() == "<colorbar>" for other in figure.axes)
    room = figure.get_figwidth() / grid.ncols - SIDES - (BAR if bars else 0.0)
    most = share * figure.get_figheight() / grid.nrows
    for columns in range(min(axes.get_legend()._ncols, len(entries(axes))), 0, -1):
        style.legend_above(axes, columns=columns, markerscale=axes.get_legend().markerscale)
        width, height = (side / figure.dpi for side in axes.get_legend().get_window_extent().size)
        if height > most or width <= room:
            return height <= most
    return False


def legend_below(figure, named, is_fixed):
    """A legend of the whole figure in as many columns as have room, in smaller letters if it would take too much of a
    given height; None if it names nothing."""
    legend, room = None, int(LETTERS * figure.get_figwidth())
    named = [(in_room(name, room), handle) for name, handle in named]
    for size in SIZES if named else ():
        for columns in range(min(len(named), 8), 0, -1):
            if legend:
                legend.remove()
            legend = column_legend(figure, named, columns, size)
            width, height = (side / figure.dpi for side in legend.get_window_extent().size)
            if width <= WIDEST * figure.get_figwidth():
                break
        if not is_fixed or height <= LARGEST * figure.get_figheight():
            break
    return legend


def in_room(name, room):
    """A name in lines of so many letters at most; a longer word without mathematics is cut."""
    lines = style.lines_of(name, room)
    return "\n".join(line if "$" in line or len(line) <= room else line[: room - 1] + "…" for line in lines)


def column_legend(figure, named, columns, size):
    names, handles = zip(*named)
    legend = figure.legend(
        handles,
        names,
        loc="lower center",
        ncol=columns,
        fontsize=size,
        borderaxespad=0.0,
        borderpad=0.0,
        columnspacing=1.2,
        handletextpad=0.5,
    )
    legend.set_in_layout(False)
    return legend
