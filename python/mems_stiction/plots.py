"""One picture per scan: heights, contact map, cross-section through the contact that carries most.

Arrays are rows x columns, heights in metres, NaN where nothing was measured; row 0 is the top.
"""

import pathlib
import sys
import textwrap

import matplotlib

if (
    "matplotlib.pyplot" not in sys.modules
):  # else somebody draws already, in a notebook or in windows
    matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402
from matplotlib.colors import ListedColormap  # noqa: E402
from matplotlib.font_manager import FontProperties  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402
from matplotlib.textpath import text_to_path  # noqa: E402
from mpl_toolkits.axes_grid1 import make_axes_locatable  # noqa: E402

from mems_stiction.prediction_text import STATUS_NAMES, bound_of, digits_of, flag_names, flag_words  # noqa: E402
from mems_stiction import quantities  # noqa: E402
from mems_stiction.provenance import sign  # noqa: E402
from mems_stiction.quantities import length_scale, literal, percent, typeset  # noqa: E402
from mems_stiction.whole_file import whole  # noqa: E402

# Elastic, elasto-plastic, fully plastic: told apart without red-green vision too.
REGIMES = ((1, "elastic", "#2f7fd1"), (2, "elasto-plastic", "#f2b705"), (3, "plastic", "#d1322f"))
SMALL_CONTACT_SHARE = 3e-4  # contacts that take less of the frame are ringed, or nobody sees them
MOST_RINGS = 300
CAPTION_WIDTH = 175  # letters
CAPTION_LINE = 0.033  # height of a line of the caption, as a share of the picture's
LEAST_SPAN = 0.05  # of an axis, as a share of the values on it


def with_unit(value, unit, digits=3):
    """As people write it: a picture can show what a terminal may not."""
    return quantities.with_unit(value, unit, digits).replace(" u", " µ")


def widen(axes, values, share=LEAST_SPAN):
    """Gives a linear axis of height a least span of that share of the largest of the values that it
    shows, about their middle: what differs by less is drawn as the level line that it is, not as
    noise over the whole axis."""
    finite = np.asarray(values, dtype=float)
    finite = finite[np.isfinite(finite)]
    if not finite.size:
        return
    least = share * np.abs(finite).max()
    low, high = axes.get_ylim()
    if high - low < least:
        middle = 0.5 * (finite.min() + finite.max())
        axes.set_ylim(middle - 0.5 * least, middle + 0.5 * least)


def lines_within(width, text, size):
    """The text in lines that are at most so wide [inches] in letters of this size [points]."""
    font = FontProperties(size=size)
    lines = []
    for word in text.split(" "):  # not at spaces that end no line
        longer = lines[-1] + " " + word if lines else word
        if lines and _width(longer, font) > width:
            lines.append(word)
        else:
            lines[-1:] = [longer]
    return lines


def statement_lines(statements, wrapped, most):
    """Statements as sentences, in no more lines than these. wrapped: the lines of one sentence."""
    lines = [
        line for text in statements for line in wrapped(typeset(text[0].upper() + text[1:] + "."))
    ]
    left = len(lines) - most
    return lines if left <= 0 else lines[: most - 1] + ["... and %d lines more" % (left + 1)]


def _width(text, font):
    """[inches]"""
    return text_to_path.get_text_width_height_descent(literal(text), font, False)[0] / 72.0


def name_ticks(axes, names, most_upright, **style):
    """Names below the places 0, 1, ... of the axis, shortened; aslant where there are more than so
    many."""
    is_slant = len(names) > most_upright
    axes.set_xticks(range(len(names)))
    axes.set_xticklabels(
        [literal(textwrap.shorten(name, 22, placeholder="…")) for name in names],
        rotation=30 if is_slant else 0,
        ha="right" if is_slant else "center",
        **style,
    )


class ScanPicture:
    """What one picture shows.

    heights, deformed: the scan before and after contact [m]; they may differ by a plane, since
    preprocessing levels.
    counter_deformed: the counter-surface after contact [m], or None for a flat one.
    contact_map: 0 apart, 1 elastic, 2 elasto-plastic, 3 plastic.
    asperities, prediction: the messages' records. pitch_x, pitch_y: [m].
    """

    def __init__(
        self,
        name,
        heights,
        deformed,
        counter_deformed,
        contact_map,
        asperities,
        prediction,
        pitch_x,
        pitch_y,
    ):
        self.name = name
        self.deformed = np.asarray(deformed, dtype=float)
        self.contact_map = np.asarray(contact_map)
        self.heights = in_frame_of(
            np.asarray(heights, dtype=float), self.deformed, self.contact_map
        )
        self.counter = (
            np.zeros_like(self.deformed)
            if counter_deformed is None
            else np.asarray(counter_deformed, float)
        )
        self.asperities = list(asperities)
        self.prediction = prediction
        self.pitch_x, self.pitch_y = pitch_x, pitch_y

    @property
    def extent(self):
        rows, columns = self.heights.shape
        return columns * self.pitch_x, rows * self.pitch_y

    def counter_at_contact(self):
        """The counter-surface where the search ended, in the scan's heights. The cell that came
        into contact last touches without interference: no other contact cell is further apart."""
        separation = (self.counter - self.heights)[self.contact_map > 0]
        return self.counter - (
            np.nanmax(separation) if separation.size else np.nanmin(self.counter - self.heights)
        )


def in_frame_of(heights, deformed, contact_map):
    """`heights` less the plane by which it differs from `deformed` outside the contacts."""
    difference = heights - deformed
    rows, columns = np.indices(heights.shape)
    use = np.isfinite(difference) & (contact_map == 0)
    if use.sum() < 3:
        return heights
    design = np.stack([np.ones(use.sum()), columns[use], rows[use]], axis=1)
    plane, *_ = np.linalg.lstsq(design, difference[use], rcond=None)
    return heights - (plane[0] + plane[1] * columns + plane[2] * rows)


def save_picture(picture, path, with_caption=True):
    """Writes the three panels as PNG; without a caption where the page around it says all that."""
    figure = plt.figure(figsize=(15, 5.4 if with_caption else 4.6), dpi=110)
    caption = _caption(picture) if with_caption else ""
    top = (
        min(0.80, 0.925 - CAPTION_LINE * (caption.count("\n") + 1) - 0.055)
        if with_caption
        else 0.93
    )  # above the panels there is a line of titles
    grid = figure.add_gridspec(
        1,
        3,
        width_ratios=(1.0, 1.0, 1.15),
        left=0.045,
        right=0.985,
        top=top,
        bottom=0.17,
        wspace=0.3,
    )
    if with_caption:
        figure.suptitle(
            literal(picture.name), x=0.045, y=0.965, ha="left", fontsize=14, fontweight="bold"
        )
        figure.text(0.045, 0.925, caption, fontsize=10.5, color="#333333", va="top")
    draw_heights(figure, figure.add_subplot(grid[0]), picture)
    contact_axes = figure.add_subplot(grid[1])
    section = _section(picture)
    draw_contacts(contact_axes, picture, section)
    _draw_section(figure.add_subplot(grid[2]), picture, section)
    sign(figure, picture.prediction)
    save(figure, path)


def save(figure, target):
    """Writes a figure to a file, which is whole or absent, or as PNG to a stream, and closes it."""
    try:
        if hasattr(target, "write"):
            figure.savefig(target)
        else:
            path = pathlib.Path(target)
            with whole(path if path.suffix else path.with_suffix(".png")) as part:
                figure.savefig(str(part))
    finally:
        plt.close(figure)


def _caption(picture):
    prediction = picture.prediction
    bound = bound_of(prediction, "at least ")
    parts = [
        STATUS_NAMES.get(prediction.status, "?"),
        "pull-off force %s%s"
        % (bound, with_unit(prediction.pull_off_force, "N", digits_of(prediction))),
        "contact %s of the area" % percent(prediction.contact_fraction),
        "rms height %s" % with_unit(prediction.rms_height, "m"),
        "normal load %s" % with_unit(prediction.normal_load, "N"),
        "voltage %s" % with_unit(prediction.voltage, "V"),
    ]
    text = "   |   ".join(parts)
    flags = flag_words(flag_names(prediction.regime_flags), prediction.model_doubt)
    return (
        text + "\n" + textwrap.fill("Outside the model's range: " + flags, CAPTION_WIDTH)
        if flags
        else text
    )


def map_axes(axes, picture, title):
    """Title and label of a map. Returns its extent and the factor from metres."""
    width, height = picture.extent
    scale, unit = length_scale(max(width, height))
    axes.set_anchor("N")
    axes.set_title(title, fontsize=11)
    axes.set_xlabel("x [%s]" % unit)
    return (0, width * scale, height * scale, 0), scale


def beside(axes):
    """Room for a colour bar."""
    return make_axes_locatable(axes).append_axes("right", size="4.5%", pad=0.1)


def draw_heights(figure, axes, picture):
    extent, _ = map_axes(axes, picture, "Height")
    axes.set_ylabel("y [%s]" % length_scale(max(picture.extent))[1])
    finite = picture.heights[np.isfinite(picture.heights)]
    scale, unit = length_scale(finite.max() - finite.min())
    low, high = np.percentile(finite, [0.2, 99.8]) if finite.size else (0, 1)
    middle = np.mean(finite)
    axes.set_facecolor("#e8d5e8")
    image = axes.imshow(
        (picture.heights - middle) * scale,
        extent=extent,
        cmap="viridis",
        vmin=(low - middle) * scale,
        vmax=(high - middle) * scale,
        interpolation="nearest",
    )
    bar = figure.colorbar(image, cax=beside(axes), extend="both")
    bar.set_label("height above mean [%s]" % unit)


def draw_relief(axes, picture, extent):
    """The heights in pale greys, so that colours stand out from valleys and from peaks."""
    finite = picture.heights[np.isfinite(picture.heights)]
    low, high = np.percentile(finite, [1, 99])
    span = high - low or 1.0  # a plane
    axes.imshow(
        picture.heights,
        extent=extent,
        cmap="gray",
        vmin=low - 0.9 * span,
        vmax=high + 0.15 * span,
        interpolation="nearest",
    )


def draw_contacts(axes, picture, section=None, title="Contact by regime", legend_at=0.47):
    """Contacts in the colours of their regimes over the heights; the line of the cross-section. The
    legend stands below, around this share of the figure's width."""
    extent, scale = map_axes(axes, picture, title)
    draw_relief(axes, picture, extent)
    colours = ListedColormap([colour for _, _, colour in REGIMES])
    shown = np.ma.masked_equal(picture.contact_map, 0)
    axes.imshow(shown, extent=extent, cmap=colours, vmin=0.5, vmax=3.5, interpolation="nearest")
    width, height = picture.extent
    small = [a for a in picture.asperities if a.area < SMALL_CONTACT_SHARE * width * height]
    small.sort(key=lambda a: -a.load)
    for value, _, colour in REGIMES:
        ringed = [a for a in small[:MOST_RINGS] if a.regime == value]
        if not ringed:
            continue
        axes.scatter(
            [(a.x + picture.pitch_x / 2) * scale for a in ringed],
            [(a.y + picture.pitch_y / 2) * scale for a in ringed],
            s=55 if len(small) < 80 else 20,
            facecolors="none",
            edgecolors=colour,
            linewidths=1.1,
            clip_on=False,
        )
    if section is not None:
        y = (section.row + 0.5) * picture.pitch_y * scale
        axes.plot(
            [section.first * picture.pitch_x * scale, (section.last + 1) * picture.pitch_x * scale],
            [y, y],
            color="black",
            linewidth=1.6,
        )
    axes.set_xlim(extent[0], extent[1])
    axes.set_ylim(extent[2], extent[3])
    beside(axes).set_axis_off()  # the two maps keep the same size
    counts = (
        picture.prediction.elastic_count,
        picture.prediction.elasto_plastic_count,
        picture.prediction.plastic_count,
    )
    # surfaces that have flowed place by place: cells are elastic or at the hardness
    is_by_cell = counts[1] > 0 and not (picture.contact_map == 2).any()
    handles = [
        Patch(
            color=colour,
            label="%s (%d%s)" % (label, count, ", red in part" * (is_by_cell and value == 2)),
        )
        for (value, label, colour), count in zip(REGIMES, counts)
    ]
    if section is not None:
        handles.append(plt.Line2D([], [], color="black", linewidth=1.6, label="cross-section"))
    axes.figure.legend(
        handles=handles,
        loc="lower center",
        bbox_to_anchor=(legend_at, 0.01),
        ncol=4,
        fontsize=9,
        frameon=False,
        handlelength=1.2,
        columnspacing=1.2,
    )


class _Section:
    def __init__(self, asperity, row, first, last):
        self.asperity, self.row, self.first, self.last = asperity, row, first, last


def _section(picture):
    """Along x through the contact that carries most, three cap radii to either side and at least 7
    pixels."""
    if not picture.asperities:
        return None
    asperity = max(picture.asperities, key=lambda a: a.load)
    rows, columns = picture.heights.shape
    row = min(max(int(round(asperity.y / picture.pitch_y)), 0), rows - 1)
    column = min(max(int(round(asperity.x / picture.pitch_x)), 0), columns - 1)
    reach = max(7, int(round(3 * asperity.cap_radius / picture.pitch_x)))
    return _Section(asperity, row, max(0, column - reach), min(columns - 1, column + reach))


def _draw_section(axes, picture, section):
    axes.set_title("Cross-section through the contact that carries most", fontsize=11)
    if section is None:
        axes.set_axis_off()
        axes.text(0.5, 0.5, "no contact", ha="center", va="center")
        return
    part = slice(section.first, section.last + 1)
    before, after = picture.heights[section.row, part], picture.deformed[section.row, part]
    counter = picture.counter_at_contact()[section.row, part]
    x = np.arange(section.first, section.last + 1) * picture.pitch_x - section.asperity.x
    zero = np.nanmax(before)
    x_scale, x_unit = length_scale(x[-1] - x[0])
    z_scale, z_unit = length_scale(np.nanmax(before) - np.nanmin(before))
    changed = np.nanmax(np.abs(after - before)) > 1e-3 * max(np.nanmax(before - counter), 1e-12)
    style = {"marker": "."} if len(x) < 60 else {}
    axes.fill_between(
        x * x_scale, (after - zero) * z_scale, np.nanmin(before - zero) * z_scale, color="#e9edf2"
    )
    axes.plot(
        x * x_scale,
        (counter - zero) * z_scale,
        color="#555555",
        linewidth=1.4,
        linestyle=(0, (5, 2)),
        zorder=3,
        label="counter-surface at rest",
    )
    axes.plot(
        x * x_scale,
        (before - zero) * z_scale,
        color="#e07b00",
        linewidth=2.6,
        label="before contact",
        **style,
    )
    axes.plot(
        x * x_scale,
        (after - zero) * z_scale,
        color="#0b4f9e",
        linewidth=1.4,
        label="after contact" if changed else "after contact: unchanged",
    )
    # Ten times the interference shows what the contact does, a third of the relief where it stands;
    # the rest may leave the picture.
    relief = zero - np.nanmin(before)
    deepest = -min(relief, max(10 * np.nanmax(before - counter), relief / 3))
    low, high = deepest * z_scale, max(0.0, np.nanmax(counter - zero) * z_scale)
    span = high - low or 1.0  # two planes
    axes.set_ylim(low - 0.03 * span, high + 0.42 * span)
    axes.set_xlim(x[0] * x_scale, x[-1] * x_scale)
    axes.set_xlabel("x from the contact's centre [%s]" % x_unit)
    axes.set_ylabel("height from the peak [%s]" % z_unit)
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.legend(loc="upper left", fontsize=8.5, frameon=False)
    asperity = section.asperity
    regime = dict((value, label) for value, label, _ in REGIMES).get(asperity.regime, "?")
    axes.text(
        0.985,
        0.975,
        "%s\nload %s\nradius of curvature %s\nplasticity index %.2f"
        % (
            regime,
            with_unit(asperity.load, "N"),
            with_unit(asperity.composite_radius, "m"),
            asperity.plasticity_index,
        ),
        transform=axes.transAxes,
        ha="right",
        va="top",
        fontsize=8.5,
        color="#333333",
        linespacing=1.35,
    )
