"""Figures like the paper's 1 to 7, in the style of mems_stiction/plots.py."""

import math

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from mems_stiction.plots import REGIMES, plt
from paper import cases, theory
from paper.data import band, maps_of

NM = 1e9
GREY, DARK = "#888888", "#333333"
# By series: with van der Waals in warm colours; three regimes as full lines, all-elastic dashed.
SERIES_STYLE = {
    "elastic": ("#2f7fd1", (0, (5, 2))),
    "regimes": ("#0b4f9e", "-"),
    "elastic_vdw": ("#f2a33c", (0, (5, 2))),
    "regimes_vdw": ("#b0413e", "-"),
    "separation_curve": ("#1d8348", "-"),
}


def save(figure, path):
    figure.savefig(path, dpi=100)
    plt.close(figure)


def map_image(axes, values, extent, **style):
    image = axes.imshow(values, extent=(0, extent, extent, 0), interpolation="nearest", **style)
    axes.set_xlabel("x [nm]")
    return image


def regime_handles(counts=None):
    return [
        Patch(
            color=color, label=label if counts is None else "%s (%d)" % (label, counts[value - 1])
        )
        for value, label, color in REGIMES
    ]


def regime_colors():
    return ListedColormap(["white"] + [color for _, _, color in REGIMES])


def counts_of(result):
    return [result[name] for name in ("elastic_count", "elasto_plastic_count", "plastic_count")]


# ---------------------------------------------------------------- 1: two surfaces in contact
def window_around(maps, size):
    """First row and column of the window of this size with the largest contact area, by sums over
    the map."""
    touching = (maps.contact_map > 0).astype(float)
    sums = np.pad(touching.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    inside = sums[size:, size:] - sums[:-size, size:] - sums[size:, :-size] + sums[:-size, :-size]
    return np.unravel_index(np.argmax(inside), inside.shape)


def draw_surfaces(maps, path):
    size = min(72, maps.lower.shape[0])
    row, column = window_around(maps, size)
    part = (slice(row, row + size), slice(column, column + size))
    lower, upper, contact = maps.lower[part] * NM, maps.upper[part] * NM, maps.contact_map[part]
    middle = lower.mean()
    x, y = np.meshgrid(np.arange(size) * maps.pitch * NM, np.arange(size) * maps.pitch * NM)
    figure = plt.figure(figsize=(10, 5.4))
    axes = figure.add_axes((0.02, -0.08, 0.96, 1.14), projection="3d", computed_zorder=False)
    shades = plt.cm.Blues_r(0.15 + 0.6 * (lower - lower.min()) / np.ptp(lower))
    for value, _, color in REGIMES:
        shades[contact == value] = plt.matplotlib.colors.to_rgba(color)
    axes.plot_surface(
        x,
        y,
        lower - middle,
        facecolors=shades,
        rstride=1,
        cstride=1,
        linewidth=0,
        antialiased=False,
        shade=False,
    )
    axes.plot_wireframe(
        x,
        y,
        np.maximum(upper, lower) - middle,
        rstride=2,
        cstride=2,
        color="#444444",
        linewidth=0.5,
        alpha=0.65,
    )
    axes.set_box_aspect((1, 1, 0.42), zoom=1.12)
    axes.view_init(elev=17, azim=-58)
    axes.set_xlabel("x [nm]")
    axes.set_ylabel("y [nm]")
    axes.set_zlabel("z [nm]")
    handles = [
        Patch(color="#5f9bd0", label="lower surface"),
        plt.Line2D([], [], color="#444444", linewidth=0.8, label="upper surface"),
    ]
    figure.legend(
        handles=handles
        + [
            Patch(color=h.get_facecolor(), label="contact, " + h.get_label())
            for h in regime_handles()
        ],
        loc="upper center",
        ncol=5,
        frameon=False,
        fontsize=10,
    )
    save(figure, path)


# ---------------------------------------------------------------- 2: contact and non-contact areas
def draw_areas(maps, path):
    extent = maps.lower.shape[1] * maps.pitch * NM
    size = maps.lower.shape[0] // 4
    row, column = window_around(maps, size)
    scale = maps.pitch * NM
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5.6))
    sign = np.where(maps.contact_map > 0, -1, 1)
    two = ListedColormap(["#d1322f", "#eef2f7"])
    map_image(left, sign, extent, cmap=two, vmin=-1, vmax=1)
    left.set_title(
        "S of (4) over the frame: %d contacts" % maps.result["asperity_count"], fontsize=11
    )
    left.set_ylabel("y [nm]")
    left.add_patch(
        plt.Rectangle(
            (column * scale, row * scale),
            size * scale,
            size * scale,
            fill=False,
            color="black",
            linewidth=1.2,
        )
    )
    part = (slice(row, row + size), slice(column, column + size))
    box = (column * scale, (column + size) * scale, (row + size) * scale, row * scale)
    image = right.imshow(
        np.ma.masked_where(sign[part] < 0, maps.distance[part] * NM),
        extent=box,
        cmap="Blues",
        interpolation="nearest",
        vmin=0,
    )
    right.set_facecolor("#d1322f")
    right.set_title("the framed part: distance where S = +1", fontsize=11)
    right.set_xlabel("x [nm]")
    figure.colorbar(image, ax=right, fraction=0.046, pad=0.03).set_label(
        "distance of the surfaces [nm]"
    )
    figure.legend(
        handles=[
            Patch(color="#d1322f", label="S = -1: contact"),
            Patch(facecolor="#eef2f7", edgecolor=GREY, label="S = +1: no contact"),
        ],
        loc="lower center",
        ncol=2,
        frameon=False,
    )
    figure.subplots_adjust(left=0.07, right=0.94, top=0.93, bottom=0.17, wspace=0.15)
    save(figure, path)


# ---------------------------------------------------------------- 3: tilt
def max_tilts(results, study):
    """Degrees, slopes x seeds."""
    seeds = range(1, min(study.seeds, 6) + 1)
    return np.degrees(
        [
            [results["tilt/%g/%d" % (slope, seed)]["max_tilt"] for seed in seeds]
            for slope in cases.TILT_SLOPES
        ]
    )


def surface_slope(slope_factor):
    """rms slope [-] of each surface of a pair: sqrt(<|grad z|^2>) = 2 sigma/l with its own
    sigma."""
    return 2 * slope_factor / math.sqrt(2)


def draw_tilts(maps, results, study, path):
    tilts = np.degrees(maps.asperities("tilt"))
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4))
    left.hist(
        tilts,
        bins=np.arange(0, max(12.0, tilts.max()) + 0.5, 0.5),
        color="#2f7fd1",
        edgecolor="white",
        linewidth=0.5,
    )
    left.axvspan(
        *cases.PAPERS_TILT,
        color="#f2b705",
        alpha=0.35,
        label="the paper's largest: 10 to 11 degrees",
    )
    left.set_xlabel("tilt of a contact's base plane [degrees]")
    left.set_ylabel("number of contacts")
    left.set_title(
        "%d contacts, rms slope of each surface %.2f"
        % (len(tilts), surface_slope(cases.STEEP_SLOPE)),
        fontsize=11,
    )
    left.set_ylim(0, 1.2 * left.get_ylim()[1])
    left.legend(frameon=False, fontsize=9, loc="upper left")
    largest = max_tilts(results, study)
    slopes = [surface_slope(slope) for slope in cases.TILT_SLOPES]
    mean = largest.mean(axis=1)
    right.fill_between(
        slopes,
        largest.min(axis=1),
        largest.max(axis=1),
        color="#2f7fd1",
        alpha=0.25,
        linewidth=0,
        label="lowest to highest of %d pairs" % largest.shape[1],
    )
    right.plot(slopes, mean, "o-", color="#0b4f9e", label="largest tilt, mean of the pairs")
    right.axhspan(*cases.PAPERS_TILT, color="#f2b705", alpha=0.35)
    right.set_xlabel("rms slope of each surface [-]")
    right.set_ylabel("largest tilt [degrees]")
    right.set_ylim(0, 1.3 * max(largest.max(), cases.PAPERS_TILT[1]))
    right.set_title("largest tilt against the slope", fontsize=11)
    right.legend(frameon=False, fontsize=9, loc="upper left")
    finish(figure, (left, right))
    save(figure, path)


def finish(figure, all_axes):
    for axes in all_axes:
        axes.grid(color="#dddddd", linewidth=0.6)
        axes.set_axisbelow(True)
    figure.tight_layout()


# ---------------------------------------------------------------- 4: interfaces
def draw_interfaces(dump, path):
    figure, all_axes = plt.subplots(
        1, len(cases.FIGURE_4_PARAMETERS), figsize=(13, 4.3), sharey=True
    )
    for letter, axes, parameter in zip("abcd", all_axes, cases.FIGURE_4_PARAMETERS):
        maps = maps_of(dump, "interface/%g" % parameter)
        size = maps.lower.shape[0] // 2
        map_image(
            axes,
            maps.contact_map[:size, :size],
            size * maps.pitch * NM,
            cmap=regime_colors(),
            vmin=0,
            vmax=3,
        )
        result = maps.result
        axes.set_title(
            "(%s)  λ = %g, Γ = %.2g J/m²\n%s, %.3g %% contact"
            % (
                letter,
                parameter,
                cases.figure_4_work_of_adhesion(parameter),
                result["status"].lower().replace("_", " "),
                100 * result["contact_fraction"],
            ),
            fontsize=10.5,
        )
    all_axes[0].set_ylabel("y [nm]")
    figure.legend(
        handles=regime_handles() + [Patch(facecolor="white", edgecolor=GREY, label="no contact")],
        loc="lower center",
        ncol=4,
        frameon=False,
    )
    figure.subplots_adjust(left=0.05, right=0.99, top=0.87, bottom=0.19, wspace=0.06)
    save(figure, path)


# ---------------------------------------------------------------- 5: cross-section
def best_section(maps, width, margin=10):
    """Row and first column of the window whose contacts, away from its ends, are of the most
    regimes, then the deepest."""
    inner = width - 2 * margin

    def over_windows(values):
        sums = np.pad(values.cumsum(1), ((0, 0), (1, 0)))
        return (sums[:, inner:] - sums[:, :-inner])[:, margin:-margin]

    kinds = sum(
        over_windows((maps.contact_map == value).astype(int)) >= 3 for value, _, _ in REGIMES
    )
    depth = over_windows(np.where(maps.contact_map > 0, -maps.distance, 0.0))
    row, column = np.unravel_index(np.argmax(kinds + depth / depth.max()), depth.shape)
    return row, column


def draw_section(maps, path):
    width = min(160, maps.lower.shape[1] - 1)
    row, first = best_section(maps, width)
    part = slice(first, first + width)
    x = np.arange(width) * maps.pitch * NM
    lower, upper = maps.lower[row, part] * NM, maps.upper[row, part] * NM
    lower_after, upper_after = maps.lower_after[row, part] * NM, maps.upper_after[row, part] * NM
    regimes = maps.contact_map[row, part]
    middle = lower.mean()
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(11, 6.4), sharex=True)
    for axes, low, high, title in (
        (top, lower, upper, "before: the surfaces at equilibrium, undeformed"),
        (
            bottom,
            lower_after,
            upper_after,
            "after pull-off, in the same place: elastic contacts come back unchanged",
        ),
    ):
        axes.fill_between(x, low - middle, min(low.min(), lower.min()) - middle, color="#e9edf2")
        axes.plot(x, low - middle, color="#0b4f9e", linewidth=1.4, label="lower surface")
        axes.plot(
            x,
            high - middle,
            color="#555555",
            linewidth=1.4,
            linestyle=(0, (5, 2)),
            label="upper surface",
        )
        axes.set_title(title, fontsize=11, loc="left")
        axes.set_ylabel("height [nm]")
        axes.set_ylim(
            (lower - middle).min(), max((lower - middle).max(), np.percentile(upper - middle, 80))
        )
    for value, _, color in REGIMES:
        for axes in (top, bottom):
            edges = np.flatnonzero(
                np.diff(np.concatenate(([0], (regimes == value).astype(int), [0])))
            )
            for start, end in edges.reshape(-1, 2):
                axes.axvspan(
                    x[start] - 0.5 * maps.pitch * NM,
                    x[end - 1] + 0.5 * maps.pitch * NM,
                    color=color,
                    alpha=0.35,
                    linewidth=0,
                )
    bottom.plot(x, lower - middle, color="#e07b00", linewidth=0.9, label="lower surface before")
    bottom.set_xlabel("x [nm]")
    finish(figure, (top, bottom))
    figure.subplots_adjust(bottom=0.17)
    handles = bottom.get_legend_handles_labels()[0] + regime_handles()
    figure.legend(handles=handles, loc="lower center", ncol=6, frameon=False, fontsize=9.5)
    save(figure, path)


# ---------------------------------------------------------------- 6, 7: against the adhesion
# parameter
def theory_curves():
    """Adhesion parameters; rests of JKR summits and of cut summits."""
    parameters = np.logspace(-1, 2, 61)
    return (
        parameters,
        [theory.rest_of_jkr_summits(value) for value in parameters],
        [theory.rest_of_cap_summits(value) for value in parameters],
    )


def half_space_energy(frames, material):
    """Work of separation over the work of adhesion."""
    return frames.half_space(material, "apparent_work_of_adhesion") / material.work_of_adhesion


def draw_frames(axes, parameters, half_space, model):
    """Half-space and default formulation on the same small frames, each frame a mark."""
    color = SERIES_STYLE[cases.BESIDE.name][0]
    for values, marker, face, name in (
        (half_space, "s", "none", "half-space, small frames"),
        (model, "x", color, "separation curve, the same frames"),
    ):
        axes.plot(
            np.repeat(parameters, values.shape[1]),
            values.ravel(),
            linestyle="none",
            marker=marker,
            markersize=5,
            color=color,
            markerfacecolor=face,
            label=name,
            zorder=5,
        )


def draw_sweep(sweep, frames, field, of_half_space, of_theory, label, limits, contact_of_one, path):
    """One panel per material. of_half_space: the figure's values by the half-space on the frames,
    for a material.
    of_theory: the figure's value of a theory.Rest; beyond 1 its contacts would overlap."""
    figure, all_axes = plt.subplots(1, 2, figsize=(12.5, 5.6), sharey=True)
    parameters, jkr, caps = theory_curves()
    for axes, material in zip(all_axes, cases.MATERIALS):
        for rests, style, name in (
            (jkr, "-", "theory: Gaussian summits, JKR"),
            (caps, ":", "theory: Gaussian summits, cut caps"),
        ):
            values = np.array([of_theory(rest) for rest in rests])
            shown = np.where(np.array([rest.area for rest in rests]) <= 1.0, values, np.nan)
            axes.plot(parameters, shown, style, color="black", linewidth=1.6, label=name)
        for series in cases.SERIES + (cases.BESIDE,):
            color, style = SERIES_STYLE[series.name]
            mean, low, high = band(sweep.values(material, series.name, field))
            axes.fill_between(sweep.parameters, low, high, color=color, alpha=0.18, linewidth=0)
            axes.plot(
                sweep.parameters,
                mean,
                linestyle=style,
                color=color,
                linewidth=1.8,
                label=series.label,
            )
            if series is not cases.BESIDE:  # whose figures of bonded pairs are no bounds
                bonded = sweep.bonded_share(material, series.name) > 0.5
                axes.plot(sweep.parameters[bonded], mean[bonded], "^", color=color, markersize=4.5)
        draw_frames(axes, frames.parameters, of_half_space(material), frames.model(material, field))
        axes.axvline(cases.BONDING_LIMIT, color=GREY, linewidth=0.9, linestyle="--")
        axes.axvline(cases.NON_BONDING_LIMIT, color=GREY, linewidth=0.9, linestyle="--")
        for place, text in ((0.33, "bonding"), (3.5, "adherence"), (35, "non-bonding")):
            axes.text(
                place,
                0.985,
                text,
                transform=axes.get_xaxis_transform(),
                ha="center",
                va="top",
                color="#555555",
                fontsize=9.5,
            )
        if contact_of_one is not None:
            axes.axhline(contact_of_one, color=GREY, linewidth=0.8, linestyle=":")
            axes.text(0.105, contact_of_one * 1.25, "one cell per frame", color=GREY, fontsize=8.5)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlim(0.1, 100)
        axes.set_ylim(*limits)
        axes.set_xlabel("adhesion parameter θ [-]")
        axes.set_title(
            "%s on %s, correlation length %.0f nm"
            % (material.name, material.name, material.correlation_length * NM),
            fontsize=11,
        )
    all_axes[0].set_ylabel(label)
    finish(figure, all_axes)
    figure.subplots_adjust(bottom=0.27)
    handles = all_axes[0].get_legend_handles_labels()[0]
    handles.append(
        plt.Line2D(
            [], [], color=DARK, marker="^", linestyle="none", markersize=5, label="bonded: at least"
        )
    )
    figure.legend(handles=handles, loc="lower center", ncol=4, frameon=False, fontsize=9.5)
    save(figure, path)


def draw_all(study, results, sweep, frames, dump, folder):
    contact = maps_of(dump, "contact")
    draw_surfaces(contact, folder / "figure_1.png")
    draw_areas(contact, folder / "figure_2.png")
    draw_tilts(maps_of(dump, "tilted"), results, study, folder / "figure_3.png")
    draw_interfaces(dump, folder / "figure_4.png")
    draw_section(contact, folder / "figure_5.png")
    draw_sweep(
        sweep,
        frames,
        "normalized_bonding_energy",
        lambda material: half_space_energy(frames, material),
        lambda rest: rest.energy,
        "bonding energy over Γ × nominal area [-]",
        (1e-6, 1e4),
        None,
        folder / "figure_6.png",
    )
    draw_sweep(
        sweep,
        frames,
        "contact_fraction",
        lambda material: frames.half_space(material, "contact_fraction"),
        lambda rest: rest.area,
        "contact area over nominal area [-]",
        (1e-7, 10.0),
        1.0 / study.size**2,
        folder / "figure_7.png",
    )
