"""What each cleaning step did to a scan: the settings with the first steps alone, and a picture of
the surfaces between them.

The surfaces, and what is predicted on each, come from the core: a scan is run with no step, with
the first, with the first two, and so on.
"""

import copy

import numpy as np

from mems_stiction.plots import beside, plt, with_unit
from mems_stiction.quantities import counted, length_scale
from mems_stiction.report_figures import png_of

# In the order in which they run, with the setting and the value that switches each off.
STEPS = (
    ("offset", "offset/enabled", False),
    ("lines", "lines/method", "none"),
    ("spikes", "spikes/enabled", False),
    ("fill", "fill/enabled", False),
    ("tip", "tip/radius", 0.0),
    ("level", "level", "none"),
    ("low_pass", "low_pass/cutoff_wavelength", 0.0),
    ("refine", "refine/factor", 1),
)
MOST_COLUMNS = 6
WORDS = {
    "offset": "mean taken off",
    "lines": "lines aligned",
    "spikes": "spikes taken out",
    "fill": "holes filled",
    "tip": "tip taken off",
    "level": "levelled",
    "low_pass": "low-pass",
    "refine": "refined",
}


def _lookup(preprocessing, key):
    """Of {"lines/method": ...}, {"lines": {"method": ...}} alike."""
    first, _, second = key.partition("/")
    if key in preprocessing:
        return preprocessing[key]
    nested = preprocessing.get(first)
    return nested.get(second) if isinstance(nested, dict) else None


def steps_of(configuration):
    """The names of the steps that are on in a configuration as stiction_batch writes it beside its
    rows."""
    preprocessing = configuration.get("preprocessing") or {}
    return [name for name, key, off in STEPS if _lookup(preprocessing, key) not in (None, off)]


def first_steps(configuration, names):
    """The configuration with these steps alone."""
    chosen = copy.deepcopy(configuration)
    preprocessing = chosen.setdefault("preprocessing", {})
    for name, key, off in STEPS:
        if name in names:
            continue
        first, _, second = key.partition("/")
        if isinstance(preprocessing.get(first), dict):
            preprocessing[first][second] = off
        else:
            preprocessing[key] = off
    return chosen


class Stage:
    """A surface between two steps: name of the last step ("" before the first), heights [m] rows x
    columns in the scan's own pixels, and the row that was predicted on it."""

    def __init__(self, name, heights, row):
        self.name, self.heights, self.row = name, np.asarray(heights, dtype=float), row


def rows_of(stages):
    """The table: for each stage its words, rms height, rms of the change [m] or None, pixels
    changed, missing pixels, and pull-off force [N]."""
    table = []
    for before, stage in zip([None] + stages[:-1], stages):
        difference = None if before is None else stage.heights - before.heights
        table.append(
            {
                "words": WORDS.get(stage.name, stage.name) if stage.name else "as measured",
                "rms": float(np.nanstd(stage.heights)),
                "missing": int(np.isnan(stage.heights).sum()),
                "change": None if difference is None else _rms(difference),
                "changed": None if difference is None else _changed(before.heights, stage.heights),
                "pull_off": stage.row.get("pull_off_force"),
            }
        )
    return table


def _rms(difference):
    finite = difference[np.isfinite(difference)]
    return float(np.sqrt(np.mean(finite**2))) if finite.size and finite.any() else None


def _changed(before, after):
    return int((~np.isclose(before, after, rtol=0.0, atol=0.0, equal_nan=True)).sum())


def cleaning_figure(stages, pitch_x, pitch_y):
    """A PNG as bytes: above the surface after each step, below what the step changed. pitch_x,
    pitch_y: of the first stage [m]."""
    blocks = [stages[first : first + MOST_COLUMNS] for first in range(0, len(stages), MOST_COLUMNS)]
    columns = min(MOST_COLUMNS, len(stages))
    height, width = stages[0].heights.shape
    extent = (0, width * pitch_x, height * pitch_y, 0)
    tall = min(
        max(height * pitch_y / (width * pitch_x), 0.4), 1.6
    )  # of a map, for one that is 1 wide
    tops = len(blocks) * 2 * (1.62 * tall + 0.42)  # inches
    figure = plt.figure(figsize=(2.5 * columns, tops), dpi=110)
    grid = figure.add_gridspec(
        2 * len(blocks),
        columns,
        left=0.01,
        right=1 - 0.27 / columns,
        top=1 - 0.3 / tops,
        bottom=0.08 / tops,
        wspace=0.42,
        hspace=0.42 / (1.62 * tall),
    )
    previous = None
    for number, stage in enumerate(stages):
        block, column = divmod(number, MOST_COLUMNS)
        title = (
            "as measured"
            if previous is None
            else "%d %s" % (number, WORDS.get(stage.name, stage.name))
        )
        _draw_map(
            figure,
            figure.add_subplot(grid[2 * block, column]),
            stage.heights,
            extent,
            title,
            "viridis",
        )
        axes = figure.add_subplot(grid[2 * block + 1, column])
        if previous is not None:
            if stage.name == "refine":
                _say(axes, "more pixels between\nthese, which stay")
            else:
                _draw_change(figure, axes, previous.heights, stage.heights, extent)
        else:
            scale, unit = length_scale(max(extent[1], extent[2]))
            _say(
                axes,
                "%.3g x %.3g %s\n\nbelow each surface:\nwhat its step changed;\nwhite: not measured"
                % (extent[1] * scale, extent[2] * scale, unit),
            )
        previous = stage
    return png_of(figure)


def _draw_map(figure, axes, heights, extent, title, colours, about_zero=False):
    axes.set_title(title, fontsize=10)
    axes.set_xticks([])
    axes.set_yticks([])
    finite = heights[np.isfinite(heights)]
    middle = 0.0 if about_zero else finite.mean()
    low, high = np.quantile(finite - middle, [0.002, 0.998])
    if about_zero:
        high = max(abs(low), abs(high)) or float(np.abs(finite).max())
        low = -high
    if high - low <= 0:
        low, high = -1e-12, 1e-12
    scale, unit = length_scale(high - low)
    image = axes.imshow(
        (heights - middle) * scale,
        extent=extent,
        cmap=colours,
        vmin=low * scale,
        vmax=high * scale,
        interpolation="nearest",
    )
    bar = figure.colorbar(image, cax=beside(axes))
    bar.set_label(unit, fontsize=8, labelpad=2)
    bar.ax.tick_params(labelsize=8)
    bar.locator = plt.MaxNLocator(5)
    bar.update_ticks()


def _draw_change(figure, axes, before, after, extent):
    difference = after - before
    finite = difference[np.isfinite(difference)]
    largest = float(np.abs(finite).max()) if finite.size else 0.0
    if not _changed(before, after):
        return _say(axes, "no pixel changed")
    if largest == 0.0:  # pixels that were lost, or that were missing
        return _draw_places(axes, before, after, extent)
    if np.ptp(finite) < 1e-9 * largest:
        return _say(
            axes,
            "%s%s\neverywhere"
            % ("+" if finite[0] > 0 else "", with_unit(float(finite.mean()), "m")),
        )
    mean = float(finite.mean())
    if abs(mean) > finite.std():  # a whole surface that was shifted hides what else was done to it
        title = "%s%s everywhere,\nbeside it rms %s" % (
            "+" if mean > 0 else "",
            with_unit(mean, "m"),
            with_unit(float(finite.std()), "m"),
        )
        return _draw_map(figure, axes, difference - mean, extent, title, "RdBu_r", about_zero=True)
    return _draw_map(
        figure,
        axes,
        difference,
        extent,
        "rms %s" % with_unit(_rms(difference), "m"),
        "RdBu_r",
        about_zero=True,
    )


def _draw_places(axes, before, after, extent):
    """Red where pixels were taken out, green where missing ones got heights."""
    height, width = before.shape
    axes.set_xlim(extent[:2])
    axes.set_ylim(extent[2:])
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    beside(axes).set_axis_off()
    words = []
    for places, colour, text in (
        (np.isfinite(before) & np.isnan(after), "#d1322f", "%s taken out"),
        (np.isnan(before) & np.isfinite(after), "#1b7a3d", "%s filled"),
    ):
        rows, columns = np.nonzero(places)
        if rows.size:
            axes.scatter(
                (columns + 0.5) / width * extent[1],
                (rows + 0.5) / height * extent[2],
                s=5,
                color=colour,
                linewidths=0,
            )
            words.append(text % counted(rows.size, "pixel"))
    axes.set_title(", ".join(words), fontsize=10)


def _say(axes, text):
    axes.set_axis_off()
    axes.text(
        0.5,
        0.5,
        text,
        ha="center",
        va="center",
        fontsize=10,
        color="#555555",
        transform=axes.transAxes,
    )
