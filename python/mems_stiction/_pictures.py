"""Predictions and half-spaces as a notebook shows them: a few figures, and a picture inside the
page.

prediction is a Prediction, solution a HalfSpace; both import this file when they are shown."""

from __future__ import annotations

import base64
import html
import io
from types import SimpleNamespace
from typing import Any, List, Tuple

import matplotlib.pyplot  # noqa: F401  (before plots, which else chooses where pyplot draws)
import numpy as np
from matplotlib.figure import Figure

from mems_stiction import _core, plots
from mems_stiction.curve import DIRECTIONS, Curve
from mems_stiction.curve_figure import draw_curves
from mems_stiction.prediction_text import flag_words
from mems_stiction.quantities import area, counted, length_scale, literal, percent, ratio

STATUS_CODES = {"EQUILIBRIUM": 0, "BONDED": 1, "NO_EQUILIBRIUM": 2}
DPI = 72


def picture_of(prediction: Any) -> Any:
    """For plots.save_picture() and its parts, which know the records of messages: columns along x,
    statuses as numbers."""
    back: Any = np.transpose if prediction._is_transposed else np.asarray
    heights = back(prediction.heights)

    def map_of(array: Any, otherwise: Any) -> Any:
        return otherwise if array is None else back(array)

    record = SimpleNamespace(
        **{name: getattr(prediction, name) for name in _core.figures["PredictionFigures"]}
    )
    record.status = STATUS_CODES[prediction.status]
    record.model_doubt = prediction.model_doubt
    return plots.ScanPicture(
        prediction.name or "scan",
        heights,
        map_of(prediction.deformed_lower, heights),
        map_of(prediction.deformed_upper, None),
        map_of(prediction.contact_map, np.zeros(heights.shape, np.uint8)),
        prediction.asperities,
        record,
        *prediction.pitch,
    )


def curve_of(name: str, points: np.recarray, pull_off_force: float) -> Any:
    """For curve_figure.draw_curves()."""
    return Curve(
        name,
        [(point.height, point.force, DIRECTIONS[point.direction]) for point in points],
        pull_off_force,
    )


def _embedded(figure: Figure) -> str:
    stream = io.BytesIO()
    figure.savefig(stream, format="png")
    return '<img src="data:image/png;base64,%s"/>' % base64.b64encode(stream.getvalue()).decode(
        "ascii"
    )


def _table(rows: List[Tuple[str, str]]) -> str:
    cells = "".join(
        '<tr><td style="text-align:left">%s</td><td style="text-align:left"><b>%s</b></td></tr>'
        % (html.escape(label), html.escape(text))
        for label, text in rows
    )
    return "<table>%s</table>" % cells


def prediction_html(prediction: Any) -> str:
    rows = [
        ("status", prediction.status.lower().replace("_", " ")),
        ("pull-off force", plots.with_unit(prediction.pull_off_force, "N")),
        (
            "contact",
            "%s of %s" % (percent(prediction.contact_fraction), area(prediction.nominal_area)),
        ),
        (
            "contacts: elastic, elasto-plastic, plastic",
            "%d: %d, %d, %d"
            % (
                prediction.asperity_count,
                prediction.elastic_count,
                prediction.elasto_plastic_count,
                prediction.plastic_count,
            ),
        ),
        ("rms height", plots.with_unit(prediction.rms_height, "m")),
        ("flattening energy / gained by adhesion and water", ratio(prediction.flattening_ratio)),
    ]
    if prediction.verdict is not None:
        rows.append(("does the device stick?", prediction.verdict.summary))
    if prediction.flags:
        rows.append(
            ("outside the model's range", flag_words(prediction.flags, prediction.model_doubt))
        )
    rows += [("warning", text) for text in prediction.warnings]
    return _table(rows) + _embedded(_prediction_figure(prediction))


def _prediction_figure(prediction: Any) -> Figure:
    picture = picture_of(prediction)
    curve = prediction.curve_over_height
    figure = Figure(figsize=(15 if len(curve) else 10, 4.8), dpi=DPI)
    grid = figure.add_gridspec(
        1, 3 if len(curve) else 2, left=0.05, right=0.985, top=0.92, bottom=0.17, wspace=0.3
    )
    axes = figure.add_subplot(grid[0])
    plots.draw_heights(figure, axes, picture)
    axes.set_ylabel("y [%s]" % length_scale(max(picture.extent))[1])
    plots.draw_contacts(figure.add_subplot(grid[1]), picture)
    if len(curve):
        axes = figure.add_subplot(grid[2])
        axes.set_title("Force over height", fontsize=11)
        draw_curves(axes, [curve_of("prediction", curve, prediction.pull_off_force)])
    return figure


def half_space_html(solution: Any) -> str:
    rows = [
        ("half-space", solution.status.lower().replace("_", " ")),
        ("pull-off force", plots.with_unit(solution.pull_off_force, "N")),
        (
            "contact",
            "%s in %s"
            % (percent(solution.contact_fraction), counted(solution.contact_count, "group")),
        ),
        (
            "converged, resolved",
            "%s, %s"
            % (
                *(
                    "yes" if flag else "no"
                    for flag in (solution.is_converged, solution.is_resolved)
                ),
            ),
        ),
    ]
    if solution.verdict is not None:
        rows.append(("does the device stick?", solution.verdict.summary))
    if solution.status != "SOLVED":
        rows.append(("why", solution.message))
    return _table(rows) + _embedded(_half_space_figure(solution))


def save_half_space(solution: Any, path: str) -> None:
    """As the notebook shows it, on a page of its own."""
    figure = _half_space_figure(solution)
    figure.set_dpi(2 * DPI)
    figure.suptitle(
        "%s: %s, pull-off force %s"
        % (
            literal(solution.name) or "half-space",
            solution.status.lower().replace("_", " "),
            plots.with_unit(solution.pull_off_force, "N"),
        ),
        y=0.99,
        fontsize=12,
    )
    plots.save(figure, path)


def _half_space_figure(solution: Any) -> Figure:
    figure = Figure(figsize=(10, 4.8), dpi=DPI)
    grid = figure.add_gridspec(1, 2, left=0.07, right=0.985, top=0.88, bottom=0.14, wspace=0.3)
    left, right = figure.add_subplot(grid[0]), figure.add_subplot(grid[1])
    left.set_title("Pressure at rest [GPa], by column and row", fontsize=11)
    if solution.pressure is None:
        left.set_axis_off()
    else:
        image = left.imshow(
            np.where(solution.pressure > 0, solution.pressure, np.nan) * 1e-9,
            cmap="plasma",
            interpolation="nearest",
        )
        figure.colorbar(image, cax=plots.beside(left))
    right.set_title("Force over height", fontsize=11)
    if len(solution.curve):
        draw_curves(right, [curve_of("half-space", solution.curve, solution.pull_off_force)])
    return figure
