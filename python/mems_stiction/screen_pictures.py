"""What a station's screen shows of the newest scan beside the trend: the prediction's curve, both
contact maps, the half-space's curve over the prediction's. Figures of 1000 x 600 pixels."""

import math
import textwrap

import numpy as np
from matplotlib.colors import to_rgb

from mems_stiction.curve import DIRECTIONS, Curve
from mems_stiction.curve_figure import draw_curves
from mems_stiction.page_maps import severest
from mems_stiction.page_words import HALF_SPACE_STATES, finite
from mems_stiction.plots import REGIMES, Patch, plt, with_unit
from mems_stiction.prediction_text import flag_names, flag_words
from mems_stiction.provenance import sign
from mems_stiction.quantities import literal

SIZE = (10.0, 6.0)  # [inches of 100 pixels]
WARNING = "#c02020"
APART = "#bebebe"
MOST_CELLS = 470  # of a map along a side: of more, a cell shows the severest of its regimes
SOLVED = HALF_SPACE_STATES.index("solved")
OVER = "height over first touch less z0"  # predictions state no z0


def force_curve_picture(prediction):
    """Of a StictionPrediction: force over height, both ways, with figures and flags."""
    figure = _figure()
    points = _points_of(prediction)
    if not points:
        _say(
            figure,
            "formulation %s does not follow the force over the height" % prediction.formulation,
        )
    else:
        _headline(figure, _figures_of(prediction, prediction.asperity_count))
        detail = "%s, %s" % (prediction.formulation, _loads_of(prediction))
        _headline(figure, detail, 1, "#555555")
        flags = flag_words(flag_names(prediction.regime_flags), prediction.model_doubt)
        _headline(figure, textwrap.shorten(flags, 105, placeholder=" ..."), 2, WARNING)
        draw_curves(
            _axes(figure), [Curve("", points, finite(prediction.pull_off_force))], over=OVER
        )
    sign(figure, prediction)
    return figure


def half_space_curve_picture(solution, prediction=None):
    """Of a HalfSpaceSolution; with the curve of the prediction of the same scan, if it is known."""
    figure = _figure()
    points = [
        (point.height - solution.range, point.force, DIRECTIONS[point.direction])
        for point in solution.curve
    ]
    if not points:
        _say(figure, solution.message)
    else:
        is_solved = solution.status == SOLVED
        _headline(
            figure,
            _figures_of(solution, solution.contact_count) if is_solved else solution.message,
            0,
            "#202020" if is_solved else WARNING,
        )
        _headline(figure, _loads_of(solution), 1, "#555555")
        if is_solved and not solution.is_resolved:
            _headline(figure, "pixels are too coarse for the edges of contacts", 2, WARNING)
        curves = [Curve("half-space", points, finite(solution.pull_off_force))]
        of_prediction = _points_of(prediction) if prediction is not None else []
        if of_prediction:
            force = finite(prediction.pull_off_force)
            curves.append(Curve(prediction.formulation, of_prediction, force))
        draw_curves(_axes(figure), curves, over=OVER)
    sign(figure, solution)
    return figure


def contact_maps_picture(solution, model_map=None, half_space_map=None):
    """Both contact maps of the scan of a HalfSpaceSolution side by side: rows x columns, 0 apart, 1
    elastic, 2 elasto-plastic, 3 plastic."""
    figure = _figure()
    panels = (
        ("prediction", model_map, "comes with the next scan"),
        ("half-space", half_space_map, "no state at rest"),
    )
    for place, (title, cells, without) in enumerate(panels):
        axes = figure.add_axes((0.01 + 0.495 * place, 0.12, 0.485, 0.79))
        axes.set_axis_off()
        if cells is None:
            axes.text(0.5, 0.5, without, ha="center", va="center", transform=axes.transAxes)
        else:
            count = np.count_nonzero(cells)
            title = "%s: %d pixel%s in contact" % (title, count, "" if count == 1 else "s")
            axes.imshow(map_colours(cells), interpolation="nearest")
        axes.set_title(title, fontsize=12)
    figure.legend(
        handles=[Patch(color=APART, label="apart")]
        + [Patch(color=colour, label=label) for _, label, colour in REGIMES],
        loc="lower center",
        bbox_to_anchor=(0.5, 0.04),
        ncol=4,
        fontsize=10,
        frameon=False,
    )
    sign(figure, solution)
    return figure


def nothing_yet(text):
    """Dark, as an empty panel of rviz is not."""
    figure = plt.figure(figsize=SIZE, dpi=100, facecolor="#202024")
    figure.text(0.5, 0.5, text, ha="center", va="center", color="#a8adb8", fontsize=16)
    return figure


def pixels_of(figure):
    """Rows x columns x RGB; the figure is closed."""
    figure.canvas.draw()
    pixels = np.array(figure.canvas.buffer_rgba())[:, :, :3]
    plt.close(figure)
    return pixels


def map_colours(cells):
    """Rows x columns x RGB, no more than MOST_CELLS along a side, so that a contact of one pixel is
    seen."""
    colours = np.array([to_rgb(APART)] + [to_rgb(colour) for _, _, colour in REGIMES])
    return colours[severest(cells, MOST_CELLS)]


def _points_of(prediction):
    """(height less z0, force, direction) of its curve; the way out is that in where it says
    nothing else."""
    way_in, way_out = (
        [
            (-point.displacement, point.force)
            for point in prediction.curve
            if point.is_separation == is_out
        ]
        for is_out in (False, True)
    )
    way_out = way_out or way_in[::-1]
    return [point + (DIRECTIONS[0],) for point in way_in] + [
        point + (DIRECTIONS[1],) for point in way_out
    ]


def _figures_of(source, contacts):
    if not math.isfinite(source.pull_off_force):
        return "no pull-off force"
    return "pull-off %s, apparent work %s, %.3g %% in %d contact%s" % (
        with_unit(source.pull_off_force, "N"),
        with_unit(source.apparent_work_of_adhesion, "J/m^2"),
        100 * source.contact_fraction,
        contacts,
        "" if contacts == 1 else "s",
    )


def _loads_of(source):
    return "load %s, %s" % (with_unit(source.mechanical_load, "N"), with_unit(source.voltage, "V"))


def _figure():
    return plt.figure(figsize=SIZE, dpi=100)


def _axes(figure):
    return figure.add_axes((0.09, 0.125, 0.885, 0.7))


def _headline(figure, text, line=0, colour="#202020"):
    figure.text(0.02, 0.975 - 0.043 * line, literal(text), va="top", fontsize=12, color=colour)


def _say(figure, text):
    figure.text(0.02, 0.95, textwrap.fill(literal(text), 110), va="top", fontsize=12, color=WARNING)
