"""The force of a device as a picture: what the scans say of its waves, and what that makes of the
force over the area.

Takes the record that predict_device --json prints, as a dictionary.
"""

import math
import textwrap

from mems_stiction.input_file import UnfitFile, is_open_pipe, require_file
from mems_stiction.json_text import read_json
from mems_stiction.plots import plt, save, with_unit
from mems_stiction.provenance import sign
from mems_stiction.quantities import length_scale, literal, ratio, typeset

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator

MOST_BYTES = 100000000  # of a record
SCANS = "#0b4f9e"
CONTINUED = "#d17a00"
DEVICE = "#b3261e"
LINEAR = "#5a5f66"
ROUGHNESS = (
    ("rms_height", "rms height", "m"),
    ("rms_slope", "rms slope", ""),
    ("rms_curvature", "rms curvature", "1/m"),
)
LEAST_DENSITY = 1e-12  # of the largest one: less is what an interpolation left
LEAST_SHOWN = 1e-6  # of the largest force, rms height, slope or curvature
LINE = 0.19  # height of a line of text below the panels [inches]
LETTERS = 185  # of such a line


class RecordError(Exception):
    """What is wrong with a record, in one line with its file."""


def read_device(path):
    """The record in a file. Raises RecordError with the file and the cause."""
    try:
        if not is_open_pipe(path):
            require_file(path, "a record of predict_device", MOST_BYTES)
        with open(str(path), encoding="utf-8") as stream:
            record = read_json(stream.read())
    except OSError as error:
        raise RecordError("%s: cannot be read: %s" % (path, error.strerror))
    except UnfitFile as error:
        raise RecordError("%s: %s" % (path, error))
    except ValueError:
        raise RecordError("%s: is no JSON object; must be what predict_device --json prints" % path)
    missing = [
        name
        for name in ("pull_off_force", "area", "spectrum", "parts_of_scans", "realisations")
        if not isinstance(record, dict) or name not in record
    ]
    if missing:
        raise RecordError(
            "%s: has no '%s'; must be what predict_device --json prints" % (path, missing[0])
        )
    return record


def read_heights(path, pitch):
    """What save_device() takes as heights; None without a path. Raises RecordError with the file
    and the cause."""
    if path is None:
        return None
    if pitch is None or not 0 < pitch < math.inf:
        raise RecordError(
            "--pitch: %s is not allowed with --heights, must be a number > 0 m" % pitch
        )
    try:
        require_file(path, "an array of heights", MOST_BYTES)
        heights = np.load(str(path))
    except OSError as error:
        raise RecordError("%s: cannot be read: %s" % (path, error.strerror))
    except (UnfitFile, ValueError) as error:
        raise RecordError("%s: %s" % (path, error))
    if not isinstance(heights, np.ndarray) or heights.ndim != 2 or heights.dtype.kind != "f":
        raise RecordError("%s: holds no rows x columns of heights [m]" % path)
    return heights, pitch


def save_device(record, path, heights=None):
    """heights: those of a made surface, or of a part of it, with its pitch [m]: (rows x columns,
    pitch)."""
    save(device_picture(record, heights), path)


def device_picture(record, heights=None):
    """Power spectral density, roughness against scale, a made surface if there is one, force
    against area."""
    lines = [line for text in record.get("warnings") or () for line in _wrapped(typeset(text))]
    below = 0.62 + LINE * (len(lines) + 0.6 * bool(lines))  # inches
    width, height = (16.0 if heights is None else 20.0), 4.9 + below
    figure = plt.figure(figsize=(width, height), dpi=100)
    shares = (1.15, 0.85, 1.25) if heights is None else (1.15, 0.85, 0.95, 1.25)
    grid = figure.add_gridspec(
        3,
        len(shares),
        width_ratios=shares,
        left=0.85 / width,
        right=1 - 0.5 / width,  # half of the label of an area at the end of its axis
        top=1 - 0.75 / height,
        bottom=(below + 0.25) / height,
        wspace=0.3,
        hspace=0.12,
    )
    figure.suptitle(
        _title(record),
        x=0.85 / width,
        y=1 - 0.12 / height,
        ha="left",
        va="top",
        fontsize=12,
        fontweight="bold",
    )
    bands = _bands(record)
    _draw_spectrum(figure.add_subplot(grid[:, 0]), bands)
    _draw_roughness([figure.add_subplot(grid[place, 1]) for place in range(3)], bands)
    if heights is not None:
        _draw_surface(figure.add_subplot(grid[:, 2]), *heights)
    _draw_force(figure.add_subplot(grid[:, -1]), record)
    figure.text(
        0.3 / width,
        0.25 / height,
        literal("\n".join(lines)),
        fontsize=9,
        va="bottom",
        ha="left",
        color="#7a1f1a",
        linespacing=1.25,
    )
    sign(figure, record)
    return figure


def _title(record):
    scans = record.get("scans") or ()
    by = (
        "%d scan%s" % (len(scans), "" if len(scans) == 1 else "s")
        if len(scans) != 1
        else literal(scans[0].rpartition("/")[2])
    )
    return "Device of %s, by %s" % (_area_text(record["area"]), by)


def _area_text(value):
    """ "100 µm²"."""
    for unit, factor in (("mm²", 1e-6), ("µm²", 1e-12)):
        if value >= 0.01 * factor:
            return "%s %s" % (ratio(value / factor), unit)
    return "%s nm²" % ratio(value / 1e-18)


def _wrapped(text):
    wrapped = textwrap.wrap(text, LETTERS) or [""]
    return ["• " + wrapped[0]] + ["   " + line for line in wrapped[1:]]


def _number(value):
    return math.nan if value is None else float(value)


def _bands(record):
    """Columns by name, by ascending wavelength."""
    bands = sorted(record["spectrum"], key=lambda band: band["wavelength"])
    names = (
        "wavelength",
        "density",
        "density_lower",
        "density_upper",
        "rms_height",
        "rms_slope",
        "rms_curvature",
    )
    columns = {name: np.array([_number(band.get(name)) for band in bands]) for name in names}
    columns["is_measured"] = np.array(
        [bool(band.get("is_measured", True)) for band in bands], dtype=bool
    )
    for name in names[1:]:
        columns[name][~(columns[name] > 0)] = math.nan  # what a logarithmic axis cannot show
    return columns


def _runs(is_measured):
    """(first, behind the last, is measured) of each run of bands; a run of continued ones reaches
    to its measured neighbours."""
    edges = (
        [0]
        + [
            place
            for place in range(1, len(is_measured))
            if is_measured[place] != is_measured[place - 1]
        ]
        + [len(is_measured)]
    )
    for first, end in zip(edges, edges[1:]):
        if first == end:
            continue
        measured = bool(is_measured[first])
        yield (
            (first if measured else max(0, first - 1)),
            (end if measured else min(len(is_measured), end + 1)),
            measured,
        )


def _length_axis(axes, lengths):
    axes.set_xscale("log")
    axes.grid(color="#e3e3e3", linewidth=0.6)
    axes.set_axisbelow(True)
    if len(lengths):
        axes.set_xlim(lengths.min() / 1.15, lengths.max() * 1.15)
    _label(axes.xaxis, lambda value: with_unit(value, "m", 1))


def _label(axis, text_of, steps=(1.0,)):
    """Labels for a logarithmic axis, at these multiples of the powers of ten."""
    axis.set_major_locator(LogLocator(subs=steps))
    axis.set_major_formatter(FuncFormatter(lambda value, _: text_of(value)))
    axis.set_minor_formatter(FuncFormatter(lambda value, _: ""))


def _draw_spectrum(axes, bands):
    axes.set_title("What the scans say of the waves", fontsize=11)
    waves = bands["wavelength"]
    labelled = set()
    for first, end, measured in _runs(bands["is_measured"]):
        part = slice(first, end)
        colour = SCANS if measured else CONTINUED
        name = "measured" if measured else "continued beyond the scans"
        label = None if name in labelled else name
        labelled.add(name)
        axes.fill_between(
            waves[part],
            bands["density_lower"][part],
            bands["density_upper"][part],
            color=colour,
            alpha=0.2,
            linewidth=0,
        )
        axes.plot(
            waves[part],
            bands["density"][part],
            color=colour,
            linewidth=1.8,
            linestyle="-" if measured else (0, (4, 2)),
            label=label,
            marker="." if measured else None,
            markersize=4,
        )
    axes.set_yscale("log")
    _length_axis(axes, waves)
    highest = np.nanmax(bands["density"]) if np.isfinite(bands["density"]).any() else 1.0
    axes.set_ylim(bottom=max(axes.get_ylim()[0], LEAST_DENSITY * highest))
    axes.set_xlabel("wavelength")
    axes.set_ylabel("power spectral density [m⁴]")
    if labelled:
        if np.isfinite(bands["density_lower"]).any():
            axes.fill_between(
                [], [], [], color="#888888", alpha=0.25, linewidth=0, label="95 % range"
            )
        axes.legend(fontsize=9, framealpha=0.85, edgecolor="none", loc="upper left")


def _draw_roughness(panels, bands):
    panels[0].set_title("Roughness against scale", fontsize=11)
    waves = bands["wavelength"]
    for axes, (name, label, unit) in zip(panels, ROUGHNESS):
        values = bands[name]
        for first, end, measured in _runs(bands["is_measured"]):
            axes.plot(
                waves[first:end],
                values[first:end],
                color=SCANS if measured else CONTINUED,
                linewidth=1.8,
                linestyle="-" if measured else (0, (4, 2)),
            )
        _length_axis(axes, waves)
        if np.isfinite(values).any():
            axes.set_yscale("log")
            axes.set_ylim(bottom=max(axes.get_ylim()[0], LEAST_SHOWN * np.nanmax(values)))
            few = np.nanmax(values) < 30 * np.nanmin(values)
            _label(
                axes.yaxis,
                lambda value, unit=unit: _tick(value, unit),
                (1.0, 2.0, 5.0) if few else (1.0,),
            )
        else:
            axes.set_yticks([])
            axes.text(
                0.5,
                0.5,
                "not known",
                transform=axes.transAxes,
                ha="center",
                va="center",
                color="#777777",
                fontsize=9,
            )
        axes.set_ylabel(label, fontsize=9)
        axes.tick_params(labelsize=8.5)
        if axes is not panels[-1]:
            axes.tick_params(labelbottom=False)
    panels[-1].set_xlabel(
        "wavelength; height of all shorter waves,\nslope and curvature of all longer ones",
        fontsize=9,
    )


def _tick(value, unit):
    if unit == "1/m":
        return "%.3g/µm" % (value * 1e-6)
    return with_unit(value, unit, 1) if unit else "%.3g" % value


def _draw_surface(axes, heights, pitch):
    axes.set_title("A made surface", fontsize=11)
    rows, columns = heights.shape
    scale, unit = length_scale(max(rows, columns) * pitch)
    image = axes.imshow(
        1e9 * (heights - np.nanmean(heights)),
        cmap="viridis",
        interpolation="nearest",
        extent=(0, columns * pitch * scale, rows * pitch * scale, 0),
    )
    axes.set_xlabel("x [%s]" % unit)
    axes.figure.colorbar(image, ax=axes, orientation="horizontal", pad=0.14, label="height [nm]")


def _draw_force(axes, record):
    axes.set_title("Force against area", fontsize=11)
    area, force = _number(record["area"]), _number(record["pull_off_force"])
    low, high = (
        _number(record.get("pull_off_force_lower")),
        _number(record.get("pull_off_force_upper")),
    )
    linear = _number(record.get("linear_pull_off_force"))
    parts = [(part["area"], _number(part["pull_off_force"])) for part in record["parts_of_scans"]]
    parts = [(size, value) for size, value in parts if value > 0]
    made = [_number(one["pull_off_force"]) for one in record["realisations"]]
    made = [value for value in made if value > 0]
    if parts:
        axes.plot(
            *zip(*parts),
            "o",
            color=SCANS,
            markersize=5,
            alpha=0.55,
            markeredgewidth=0,
            label="scans and parts of them",
        )
    areas = [size for size, _ in parts] + [area]
    reach = np.array([min(areas), max(areas)])
    if linear > 0:
        axes.plot(
            reach,
            linear * reach / area,
            color=LINEAR,
            linewidth=1.4,
            linestyle="--",
            label="by area: %s" % with_unit(linear, "N", 2),
        )
    if made:
        axes.plot(
            [area] * len(made),
            made,
            "_",
            color=DEVICE,
            markersize=13,
            markeredgewidth=1.2,
            alpha=0.7,
            label="made surfaces",
        )
    if force > 0:
        reaches = (
            [[max(0.0, force - low)], [max(0.0, high - force)]]
            if low > 0 and math.isfinite(high)
            else None
        )
        axes.errorbar(
            [area],
            [force],
            yerr=reaches,
            fmt="D",
            color=DEVICE,
            markersize=8,
            capsize=5,
            linewidth=1.8,
            markeredgecolor="white",
            zorder=5,
            label="the device: %s%s"
            % (
                with_unit(force, "N", 2),
                ""
                if reaches is None
                else ", 95 %% %s to %s" % (with_unit(low, "N", 2), with_unit(high, "N", 2)),
            ),
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(reach[0] / 2.5, reach[1] * 2.5)
    axes.grid(color="#e3e3e3", linewidth=0.6)
    axes.set_axisbelow(True)
    _label(axes.xaxis, _area_text)
    _label(axes.yaxis, lambda value: with_unit(value, "N", 1))
    axes.set_xlabel("nominal area")
    axes.set_ylabel("pull-off force")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(fontsize=9, framealpha=0.85, edgecolor="none", loc="upper left")
    bottom, top = axes.get_ylim()
    bottom = max(bottom, LEAST_SHOWN * top)
    axes.set_ylim(bottom, top * (top / bottom) ** 0.3)  # room for the legend
