"""The report's picture of the half-space: its contacts beside those of the asperity model, and its
curve.

`result` is the dictionary of a result.json that stiction_batch --half-space --dump writes; SI
units.
"""

import numpy as np

from mems_stiction.curve_figure import draw_curves
from mems_stiction.plots import beside, draw_contacts, draw_relief, map_axes, plt
from mems_stiction.quantities import length_scale
from mems_stiction.report_figures import curves_of, number, png_of, scaled

MOST_RINGED_CELLS = 4000  # more contact is seen without rings
SMALL_GROUP_SHARE = 3e-4  # of the frame


def half_space_figure(picture, pressure, result):
    """A PNG as bytes. picture: a ScanPicture; pressure: at rest [Pa], positive in contact, or None
    where there is no rest."""
    figure = plt.figure(figsize=(15, 4.9), dpi=110)
    grid = figure.add_gridspec(1, 2, left=0.045, right=0.595, top=0.92, bottom=0.17, wspace=0.16)
    of_model = figure.add_subplot(grid[0])
    draw_contacts(of_model, picture, title="Contact: prediction, by regime", legend_at=0.165)
    of_model.set_ylabel("y [%s]" % length_scale(max(picture.extent))[1])
    _draw_pressure(figure, figure.add_subplot(grid[1]), picture, pressure)
    axes = figure.add_subplot(
        figure.add_gridspec(1, 1, left=0.7, right=0.985, top=0.92, bottom=0.17)[0]
    )
    axes.set_title("Force over height", fontsize=11)
    curves = curves_of(result)
    if curves:
        draw_curves(axes, curves)
    else:
        axes.set_axis_off()
    return png_of(figure)


def _draw_pressure(figure, axes, picture, pressure):
    extent, scale = map_axes(axes, picture, "Contact: half-space, by pressure at rest")
    draw_relief(axes, picture, extent)
    axes.set_xlim(extent[0], extent[1])
    axes.set_ylim(extent[2], extent[3])
    bar_axes = beside(axes)
    if pressure is None or not (pressure > 0).any():
        bar_axes.set_axis_off()
        text = "no contact" if pressure is not None else "did not come to rest"
        axes.text(0.5, 0.5, text, ha="center", va="center", transform=axes.transAxes)
        return
    is_contact = pressure > 0
    shown, unit = scaled(pressure[is_contact], "Pa")
    values = np.full(pressure.shape, np.nan)
    values[is_contact] = shown
    image = axes.imshow(
        values,
        extent=extent,
        cmap="plasma",
        vmin=0.0,
        vmax=float(shown.max()),
        interpolation="nearest",
    )
    figure.colorbar(image, cax=bar_axes).set_label("pressure [%s]" % unit)
    small = [
        group
        for group in contact_groups(is_contact)
        if len(group) < SMALL_GROUP_SHARE * is_contact.size
    ]
    if small:
        rows, columns = (np.array([np.mean(group, axis=0) + 0.5 for group in small])).T
        axes.scatter(
            columns * picture.pitch_x * scale,
            rows * picture.pitch_y * scale,
            s=55 if len(small) < 80 else 20,
            facecolors="none",
            edgecolors="#6a00a8",
            linewidths=1.1,
            clip_on=False,
        )


def contact_groups(is_contact):
    """Cells (row, column) that hang together by their sides, group by group; none where there are
    too many to ring."""
    cells = {tuple(cell) for cell in np.argwhere(is_contact)}
    if len(cells) > MOST_RINGED_CELLS:
        return []
    groups = []
    while cells:
        waiting = [cells.pop()]
        group = []
        while waiting:
            row, column = waiting.pop()
            group.append((row, column))
            beside_it = {
                (row - 1, column),
                (row + 1, column),
                (row, column - 1),
                (row, column + 1),
            } & cells
            cells -= beside_it
            waiting += beside_it
        groups.append(group)
    return groups


def half_space_words(result):
    """What the page says of the solution, in sentences."""
    sentences = []
    if result["half_space_message"]:
        sentences.append("Not solved: %s." % result["half_space_message"].rstrip("."))
    if "half_space_status" in result:
        sentences.append(
            "Converged: every state is an equilibrium."
            if result["half_space_is_converged"]
            else "Not converged: there is no answer to rely on."
        )
        sentences.append(
            "Resolved: pixels are small enough for the length over which contacts part."
            if result["half_space_is_resolved"]
            else "Not resolved: pixels are too large for the length over which contacts part, so "
            "the grid holds the edges of contacts, and the pull-off force is too large as a rule."
        )
    return " ".join(sentences)


def pull_off_ratio(row):
    """The prediction's pull-off force over that of the half-space; NaN where one is missing."""
    of_half_space = number(row.get("half_space_pull_off_force"))
    return number(row["pull_off_force"]) / of_half_space if of_half_space > 0 else float("nan")
