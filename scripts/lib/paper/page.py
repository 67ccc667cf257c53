"""doc/paper.md from the results."""

import pathlib

import jinja2
import numpy as np

from mems_stiction.plots import with_unit
from mems_stiction.quantities import percent
from paper import cases, claims, figures
from paper.data import HalfSpaceFrames, Sweep, crossing

TEMPLATE = pathlib.Path(__file__).resolve().parent / "paper.md.jinja"
WIDE_LENGTH = 100e-9  # a correlation length as of a polysilicon film, for comparison
TABLE_PARAMETERS = (0.1, 1.0, 3.0, 12.0, 17.0, 30.0, 55.0, 100.0)


def table_rows(sweep, material, series):
    """Means over the pairs at some of the parameters."""
    get = lambda field: sweep.values(material, series, field).mean(axis=1)  # noqa: E731
    columns = {field: get(field) for field in ("adhesion_parameter", "contact_fraction", "asperity_count", "normalized_bonding_energy",
                                               "pull_off_force_jkr", "van_der_waals_force", "nominal_area")}
    bonded = sweep.bonded_share(material, series)
    places = sorted({int(np.argmin(np.abs(np.log(sweep.parameters / wanted)))) for wanted in TABLE_PARAMETERS})
    for place in places:
        one = {field: values[place] for field, values in columns.items()}
        yield {"parameter": claims.number_text(sweep.parameters[place]), "rms_height": with_unit(material.rms_height(sweep.parameters[place]), "m"),
               "published": claims.number_text(one["adhesion_parameter"]), "bonded": percent(bonded[place]),
               "fraction": percent(one["contact_fraction"]), "contacts": "%.0f" % one["asperity_count"],
               "energy": claims.number_text(one["normalized_bonding_energy"]),
               "jkr": with_unit(one["pull_off_force_jkr"] / one["nominal_area"], "Pa"),
               "van_der_waals": with_unit(one["van_der_waals_force"] / one["nominal_area"], "Pa")}


def material_facts(material):
    return {"name": material.name, "config": material.config, "modulus": with_unit(material.contact_modulus, "Pa"),
            "hardness": with_unit(material.hardness, "Pa"), "gamma": with_unit(material.work_of_adhesion, "J/m^2"),
            "hamaker": "%.0f zJ" % (material.hamaker_constant * 1e21), "length": with_unit(material.correlation_length, "m"),
            "pitch": with_unit(material.pitch, "m"), "lowest": with_unit(material.rms_height(0.1), "m"),
            "highest": with_unit(material.rms_height(100.0), "m"),
            "first_flow": claims.number_text(material.adhesion_parameter_at_index(0.6)),
            "full_flow": claims.number_text(material.adhesion_parameter_at_index(1.1))}


def published_over_nominal(sweep):
    """Lowest and highest ratio of (14) to the summits' adhesion parameter where an all-elastic silicon pair found its
    equilibrium on some ten contacts or more; None where no pair did."""
    get = lambda field: sweep.values(cases.SILICON, "elastic_vdw", field)  # noqa: E731
    ratio = get("adhesion_parameter") / sweep.parameters[:, None]
    use = (sweep.status(cases.SILICON, "elastic_vdw") == "EQUILIBRIUM") & (get("asperity_count") >= 10)
    return ("%.2f" % ratio[use].min(), "%.2f" % ratio[use].max()) if use.any() else None


def beside_facts(sweep, frames, material):
    """The default formulation beside the paper's, and beside the half-space on small frames: texts of the page."""
    energy = {series: sweep.values(material, series, "normalized_bonding_energy").mean(axis=1) for series in ("regimes_vdw", cases.BESIDE.name)}
    area = {series: sweep.values(material, series, "contact_fraction").mean(axis=1) for series in ("regimes_vdw", cases.BESIDE.name)}
    ratios = [model / solved for model, solved in (
        (frames.model(material, "normalized_bonding_energy"), figures.half_space_energy(frames, material)),
        (frames.model(material, "contact_fraction"), frames.half_space(material, "contact_fraction")))]
    known = [ratio[np.isfinite(ratio) & (ratio > 0)] for ratio in ratios]
    text = claims.number_text
    return {"name": material.name, "solved": int(np.isfinite(ratios[0]).sum()), "asked": ratios[0].size,
            "paper_highest": text(energy["regimes_vdw"].max()), "highest": text(energy[cases.BESIDE.name].max()),
            "half": text(crossing(sweep.parameters, energy[cases.BESIDE.name], 0.5)),
            "last": text(energy[cases.BESIDE.name][-1], 2), "paper_last": text(energy["regimes_vdw"][-1], 2),
            "area_last": text(area[cases.BESIDE.name][-1], 2), "paper_area_last": text(area["regimes_vdw"][-1], 2),
            "energy_ratio": ratio_text(known[0]), "area_ratio": ratio_text(known[1])}


def ratio_text(ratios):
    return "%.2f (%.2f to %.2f)" % (np.median(ratios), ratios.min(), ratios.max()) if ratios.size else "none"


def write(study, record, dump, folder):
    results = record["results"]
    sweep = Sweep(study, results)
    frames = HalfSpaceFrames(study, results)
    figures.draw_all(study, results, sweep, frames, dump, folder / "figures")
    rows = claims.all_rows(claims.Facts(study, results, sweep, dump))
    contact, tilted = results["contact"], results["tilted"]
    environment = jinja2.Environment(trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined, keep_trailing_newline=True)
    text = environment.from_string(TEMPLATE.read_text()).render(
        record=record, study=study, minutes="%.0f min" % max(1.0, record["seconds"] / 60) if record["seconds"] > 90 else "%.0f s" % record["seconds"],
        beside=[beside_facts(sweep, frames, material) for material in cases.MATERIALS], materials=[material_facts(material) for material in cases.MATERIALS], rows=rows,
        counts={name: sum(row.verdict == name for row in rows) for name in (claims.YES, claims.PART, claims.NO, claims.OPEN)},
        tables=[{"title": "%s, %s" % (material.name, series.label), "rows": list(table_rows(sweep, material, series.name))}
                for material in cases.MATERIALS for series in cases.SERIES if series.name in ("elastic", "regimes_vdw")],
        parameters=sweep.parameters, contact=contact, tilted=tilted, pressure=with_unit(cases.CONTACT_PRESSURE, "Pa"),
        load=with_unit(contact["mechanical_load"], "N"), map_side=with_unit(study.map_size * cases.SILICON.pitch, "m"),
        mixed_slope="%.2f" % figures.surface_slope(cases.MIXED_SLOPE), steep_slope="%.2f" % figures.surface_slope(cases.STEEP_SLOPE),
        tilt_pairs=min(study.seeds, 6), figure_4=cases.FIGURE_4_PARAMETERS,
        figure_4_status=[results["interface/%g" % parameter]["status"] for parameter in cases.FIGURE_4_PARAMETERS],
        published=published_over_nominal(sweep), wide_length=with_unit(WIDE_LENGTH, "m"),
        wide_flow=claims.number_text(cases.SILICON.adhesion_parameter_at_index(0.6) * WIDE_LENGTH / cases.SILICON.correlation_length),
        figure_4_rms=with_unit(cases.SILICON.rms_height(cases.FIGURE_4_ROUGHNESS), "m"))
    (folder / "paper.md").write_text(text)
