"""doc/paper.md from the results."""

import pathlib

import jinja2
import numpy as np

from mems_stiction.plots import with_unit
from paper import cases, claims, figures
from paper.data import HalfSpaceFrames, Sweep, crossing

TEMPLATE = pathlib.Path(__file__).resolve().parent / "paper.md.jinja"
WIDE_LENGTH = 100e-9  # a correlation length as of a polysilicon film, for comparison


def material_facts(material):
    return {
        "name": material.name,
        "config": material.config,
        "length": with_unit(material.correlation_length, "m"),
        "pitch": with_unit(material.pitch, "m"),
        "lowest": with_unit(material.rms_height(0.1), "m"),
        "highest": with_unit(material.rms_height(100.0), "m"),
        "first_flow": claims.number_text(material.adhesion_parameter_at_index(0.6)),
        "full_flow": claims.number_text(material.adhesion_parameter_at_index(1.1)),
    }


def published_over_nominal(sweep):
    """Lowest and highest ratio of (14) to the summits' adhesion parameter where an all-elastic
    silicon pair found its equilibrium on some ten contacts or more; None where no pair did."""
    get = lambda field: sweep.values(cases.SILICON, "elastic_vdw", field)  # noqa: E731
    ratio = get("adhesion_parameter") / sweep.parameters[:, None]
    use = (sweep.status(cases.SILICON, "elastic_vdw") == "EQUILIBRIUM") & (
        get("asperity_count") >= 10
    )
    return ("%.2f" % ratio[use].min(), "%.2f" % ratio[use].max()) if use.any() else None


def beside_facts(sweep, frames, material):
    """The default formulation beside the paper's, and beside the half-space on small frames: texts
    of the page."""
    energy = {
        series: sweep.values(material, series, "normalized_bonding_energy").mean(axis=1)
        for series in ("regimes_vdw", cases.BESIDE.name)
    }
    area = {
        series: sweep.values(material, series, "contact_fraction").mean(axis=1)
        for series in ("regimes_vdw", cases.BESIDE.name)
    }
    ratios = [
        model / solved
        for model, solved in (
            (
                frames.model(material, "normalized_bonding_energy"),
                figures.half_space_energy(frames, material),
            ),
            (
                frames.model(material, "contact_fraction"),
                frames.half_space(material, "contact_fraction"),
            ),
        )
    ]
    known = [ratio[np.isfinite(ratio) & (ratio > 0)] for ratio in ratios]
    text = claims.number_text
    return {
        "name": material.name,
        "solved": int(np.isfinite(ratios[0]).sum()),
        "asked": ratios[0].size,
        "paper_highest": text(energy["regimes_vdw"].max()),
        "highest": text(energy[cases.BESIDE.name].max()),
        "half": text(crossing(sweep.parameters, energy[cases.BESIDE.name], 0.5)),
        "last": text(energy[cases.BESIDE.name][-1], 2),
        "paper_last": text(energy["regimes_vdw"][-1], 2),
        "area_last": text(area[cases.BESIDE.name][-1], 2),
        "paper_area_last": text(area["regimes_vdw"][-1], 2),
        "energy_ratio": ratio_text(known[0]),
        "area_ratio": ratio_text(known[1]),
    }


def ratio_text(ratios):
    return (
        "%.2f (%.2f to %.2f)" % (np.median(ratios), ratios.min(), ratios.max())
        if ratios.size
        else "none"
    )


def write(study, record, dump, folder):
    results = record["results"]
    sweep = Sweep(study, results)
    frames = HalfSpaceFrames(study, results)
    figures.draw_all(study, results, sweep, frames, dump, folder / "figures")
    rows = claims.all_rows(claims.Facts(study, results, sweep, dump))
    contact, tilted = results["contact"], results["tilted"]
    environment = jinja2.Environment(
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
        keep_trailing_newline=True,
    )
    text = environment.from_string(TEMPLATE.read_text()).render(
        record=record,
        study=study,
        minutes="%.0f min" % max(1.0, record["seconds"] / 60)
        if record["seconds"] > 90
        else "%.0f s" % record["seconds"],
        beside=[beside_facts(sweep, frames, material) for material in cases.MATERIALS],
        materials=[material_facts(material) for material in cases.MATERIALS],
        rows=rows,
        counts={
            name: sum(row.verdict == name for row in rows)
            for name in (claims.YES, claims.PART, claims.NO, claims.OPEN)
        },
        parameters=sweep.parameters,
        contact=contact,
        tilted=tilted,
        pressure=with_unit(cases.CONTACT_PRESSURE, "Pa"),
        load=with_unit(contact["mechanical_load"], "N"),
        map_side=with_unit(study.map_size * cases.SILICON.pitch, "m"),
        mixed_slope="%.2f" % figures.surface_slope(cases.MIXED_SLOPE),
        steep_slope="%.2f" % figures.surface_slope(cases.STEEP_SLOPE),
        tilt_pairs=min(study.seeds, 6),
        figure_4=cases.FIGURE_4_PARAMETERS,
        figure_4_status=[
            results["interface/%g" % parameter]["status"] for parameter in cases.FIGURE_4_PARAMETERS
        ],
        published=published_over_nominal(sweep),
        wide_length=with_unit(WIDE_LENGTH, "m"),
        wide_flow=claims.number_text(
            cases.SILICON.adhesion_parameter_at_index(0.6)
            * WIDE_LENGTH
            / cases.SILICON.correlation_length
        ),
        figure_4_rms=with_unit(cases.SILICON.rms_height(cases.FIGURE_4_ROUGHNESS), "m"),
    )
    (folder / "paper.md").write_text(text)
