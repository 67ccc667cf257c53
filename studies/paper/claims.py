"""The paper's claims as rows: what it says, what was run, what came out. Texts are fixed; every
number and every verdict is computed from the results."""

import functools
import math

import numpy as np

from mems_stiction.plots import with_unit
from mems_stiction.quantities import percent
from paper import cases, theory
from paper.data import PressedFrames, band, crossing, maps_of, number
from paper.figures import counts_of, max_tilts, surface_slope

YES, PART, NO, OPEN = "comes out", "comes out in part", "does not come out", "not tested"


class Row:
    """name: for tests and references; part: where in the paper."""

    def __init__(self, name, part, claim, ran, came_out, verdict):
        self.name, self.part, self.claim, self.ran, self.came_out, self.verdict = (
            name,
            part,
            claim,
            ran,
            came_out,
            verdict,
        )


def verdict(all_of_it, some_of_it=False):
    if all_of_it:
        return YES
    return PART if some_of_it else NO


def number_text(value, digits=3):
    if not math.isfinite(value):
        return "none in the range"
    if value != 0 and abs(value) < 1e-3 or abs(value) >= 1e5:
        mantissa, exponent = ("%.*e" % (digits - 1, value)).split("e")
        return "%s × 10^%d" % (mantissa, int(exponent))
    return "%.*g" % (digits, value)


class Facts:
    """What the rows are computed from."""

    def __init__(self, study, results, sweep, dump):
        self.study, self.results, self.sweep, self.dump = study, results, sweep, dump

    def maps(self, name):
        return maps_of(self.dump, name)


def all_rows(facts):
    makers = [
        energy_extremum,
        three_regimes,
        tilt,
        interface,
        section_regimes,
        bonding_limits,
        theory_comparison,
        falls,
    ]
    for of_material in (stops_later, larger_area, higher_pull_off):
        makers += [
            functools.partial(of_material, material=material) for material in cases.MATERIALS
        ]
    for solver in SOLVERS:
        makers += [
            functools.partial(of_solver, solver=solver)
            for of_solver in (larger_area_by, higher_pull_off_by)
        ]
    makers += [
        arbitrary_surfaces,
        material_topography,
        neighbours_only,
        van_der_waals_close,
        van_der_waals_rough,
        plastic_without_load,
        energy_outside_bonding,
        friction,
    ]
    return [maker(facts) for maker in makers]


# ---------------------------------------------------------------- section 2 and the abstract
def energy_extremum(facts):
    names = ["interface/%g" % parameter for parameter in cases.FIGURE_4_PARAMETERS]
    maps = [(name, facts.maps(name)) for name in names]
    rested = [(name, one) for name, one in maps if one.result["status"] == "EQUILIBRIUM"]
    said, holds = [], []
    for name, one in rested:
        force = one.energies("generalized_force")
        energy = np.append(one.energies("total_energy"), number(one.result["total_energy"]))
        share = number(one.result["total_energy"]) / energy.max()
        holds.append(force[-1] <= 0 < force[-2] and share > 0.99)
        said.append(
            "λ = %s: dE_t/dD is %s one step before and %s there; E_t has %s of its largest value, "
            "and %d of %d steps have more"
            % (
                name.split("/")[1],
                with_unit(force[-2], "N"),
                with_unit(force[-1], "N"),
                percent(share),
                np.sum(energy > energy[-1]),
                len(force),
            )
        )
    came_out = (
        "; ".join(said) + ". The other %d bond before an extremum." % (len(maps) - len(rested))
        if said
        else "no pair found an extremum"
    )
    return Row(
        "energy_extremum",
        "abstract, 2",
        "Equilibrium is an extremum of the free total energy.",
        "The energies of every step of figure 4's runs.",
        came_out,
        verdict(bool(holds) and all(holds), any(holds)),
    )


def three_regimes(facts):
    counts = counts_of(facts.results["contact"])
    return Row(
        "three_regimes",
        "abstract",
        "Asperities deform in one of three regimes: elastic, elasto-plastic, plastic.",
        "Figure 2's pair under %s." % with_unit(facts.results["contact"]["mechanical_load"], "N"),
        "%d elastic, %d elasto-plastic, %d plastic contacts in one frame." % tuple(counts),
        verdict(min(counts) > 0, sum(count > 0 for count in counts) == 2),
    )


def tilt(facts):
    largest = max_tilts(facts.results, facts.study).mean(axis=1)
    slopes = np.array([surface_slope(slope) for slope in cases.TILT_SLOPES])
    low, high = cases.PAPERS_TILT
    at = [
        float(np.interp(value, largest, slopes)) if largest[0] < value <= largest[-1] else math.nan
        for value in (low, high)
    ]
    tilts = np.degrees(facts.maps("tilted").asperities("tilt"))
    came_out = (
        "Largest of %d contacts at rms slope %.2f: %.1f degrees, median %.1f. Over %d pairs the "
        "mean largest tilt is %.0f degrees at a slope of %s, %.0f at %s."
        % (
            len(tilts),
            surface_slope(cases.STEEP_SLOPE),
            tilts.max(),
            np.median(tilts),
            min(facts.study.seeds, 6),
            low,
            number_text(at[0], 2),
            high,
            number_text(at[1], 2),
        )
    )
    return Row(
        "tilt",
        "2.2, fig. 3",
        "The tilt of the contacts' base planes can be up to 10 to 11 degrees.",
        "Silicon pairs of six slopes under %s." % with_unit(cases.CONTACT_PRESSURE, "Pa"),
        came_out,
        verdict(all(map(math.isfinite, at)), largest.max() > low),
    )


# ---------------------------------------------------------------- section 3
def interface(facts):
    rows = [facts.results["interface/%g" % parameter] for parameter in cases.FIGURE_4_PARAMETERS]
    depth = [row["approach"] / row["composite_rms_height"] for row in rows]
    said = "; ".join(
        "λ = %g: %s at D = %.2f σ, contact %s"
        % (
            parameter,
            row["status"].lower().replace("_", " "),
            one,
            percent(row["contact_fraction"]),
        )
        for parameter, row, one in zip(cases.FIGURE_4_PARAMETERS, rows, depth)
    )
    papers = [row["status"] == "EQUILIBRIUM" for row in rows[:2]]
    differs = depth[0] > depth[-1]
    reason = (
        ""
        if all(papers)
        else (
            " At the paper's 1 and 2.8 both pairs bond before an extremum; the difference comes at "
            "larger parameters here."
        )
    )
    return Row(
        "interface",
        "3, fig. 4",
        "The interfacial energy decides where the plates come to rest; λ = 1 against 2.8.",
        "One silicon pair, work of adhesion %s."
        % ", ".join(
            "%.2g" % cases.figure_4_work_of_adhesion(parameter)
            for parameter in cases.FIGURE_4_PARAMETERS
        ),
        said + "." + reason,
        verdict(differs and all(papers) and depth[0] > depth[1], differs),
    )


def section_regimes(facts):
    maps = facts.maps("contact")
    moved = np.abs(maps.lower_after - maps.lower)
    shares = [
        float(np.mean(moved[maps.contact_map == value] > 0))
        if np.any(maps.contact_map == value)
        else math.nan
        for value in (1, 2, 3)
    ]
    return Row(
        "section_regimes",
        "3, fig. 5",
        "Not all asperities deform in the same regime; the deformation is each asperity's own.",
        "Figure 2's pair: share of contact cells whose height has changed after pull-off.",
        "elastic contacts %s, elasto-plastic %s, plastic %s of the cells."
        % tuple(map(percent, shares)),
        verdict(shares[0] == 0 and shares[1] > 0.99 and shares[2] > 0.99, shares[2] > 0),
    )


def bonding_limits(facts):
    sweep = facts.sweep
    ends, below, said = {}, [], []
    for material in cases.MATERIALS:
        for series in ("elastic", "regimes_vdw"):
            share = sweep.bonded_share(material, series)
            below.append(bool(np.all(share[sweep.parameters <= cases.BONDING_LIMIT] == 1)))
            ends[material.name, series] = crossing(sweep.parameters, share, 0.5, scale=float)
            said.append(
                "%s, %s: %s"
                % (
                    material.name,
                    "no van der Waals" if series == "elastic" else "full model",
                    number_text(ends[material.name, series]),
                )
            )
    energy, _, _ = band(sweep.values(cases.SILICON, "elastic", "normalized_bonding_energy"))
    weak = crossing(sweep.parameters, energy, 0.01 * energy[0])
    came_out = (
        "All pairs bond at θ ≤ 1: %s. Half of the pairs bond up to θ = %s. Without van der Waals "
        "the bonding energy is below 1 %% of that of smooth surfaces from %s."
        % ("yes" if all(below) else "no", "; ".join(said), number_text(weak))
    )
    end_is_near = 0.5 < weak / cases.NON_BONDING_LIMIT < 2
    gradual = all(end < 2 * cases.BONDING_LIMIT for end in ends.values())
    if not gradual:
        came_out += (
            " The gradual fall between 1 and 12 is missing: a pair rests on few contacts or bonds."
        )
    return Row(
        "bonding_limits",
        "3, with Gui et al.",
        "Bonding below an adhesion parameter of 1, adherence between, none above 12.",
        "Figures 6 and 7.",
        came_out,
        verdict(all(below) and end_is_near and gradual, all(below)),
    )


def theory_comparison(facts):
    sweep = facts.sweep
    area, _, _ = band(sweep.values(cases.SILICON, "elastic", "contact_fraction"))
    fine = np.logspace(-1, 2, 61)
    level = 0.01
    model = crossing(sweep.parameters, area, level)
    jkr = crossing(fine, [theory.rest_of_jkr_summits(value).area for value in fine], level)
    caps = crossing(fine, [theory.rest_of_cap_summits(value).area for value in fine], level)
    came_out = (
        "Contact falls below %s of the area at θ = %s in the model, %s in the theory: a factor of "
        "%s. With the paper's cut caps in place of JKR's approach the theory gives %s; contacts of "
        "a real surface merge."
        % (
            percent(level),
            number_text(model),
            number_text(jkr),
            number_text(model / jkr, 2),
            number_text(caps),
        )
    )
    return Row(
        "theory_comparison",
        "3, figs. 6 and 7",
        "Results compared with the multi-asperity theory.",
        "Silicon, all-elastic, no van der Waals, as the theory assumes.",
        came_out,
        verdict(0.8 < model / jkr < 1.25, 0.4 < model / jkr < 2.5),
    )


def falls(facts):
    worst, said = 0.0, []
    for material in cases.MATERIALS:
        for series in cases.SERIES:
            for field in ("contact_fraction", "normalized_bonding_energy"):
                rise = largest_rise(facts.sweep.values(material, series.name, field))
                worst = max(worst, rise)
                if rise > 1:
                    said.append(
                        "%s of %s, %s: a mean is %s times the upper end of the band of a smaller "
                        "parameter"
                        % (field.replace("_", " "), material.name, series.label, number_text(rise))
                    )
    came_out = (
        "; ".join(said) + "."
        if said
        else (
            "No mean of the 16 curves lies above the band of a smaller parameter (largest ratio to "
            "its upper end %s; bonded pairs all have half of the area)." % number_text(worst)
        )
    )
    return Row(
        "falls",
        "figs. 6 and 7",
        "Bonding energy and contact area fall with the adhesion parameter.",
        "Means and bands (%d pairs) of every curve." % facts.study.seeds,
        came_out,
        verdict(not said, len(said) < 8),
    )


def largest_rise(values):
    """The largest ratio of a mean to the upper end of the band of any smaller parameter."""
    mean, _, high = band(values)
    return max(mean[later] / high[:later].min() for later in range(1, len(mean)))


class Pairs:
    """Runs of one pair of surfaces with and without plasticity, in which some asperity is not
    elastic and the all-elastic one found its equilibrium: what the paper's comparison is about."""

    def __init__(self, facts, material, with_van_der_waals):
        regimes, elastic = cases.WITH_AND_WITHOUT_REGIMES[1 if with_van_der_waals else 0]
        get = lambda series, field: facts.sweep.values(material, series, field)  # noqa: E731
        is_bonded = facts.sweep.status(material, elastic) != "EQUILIBRIUM"
        self.use = ~is_bonded & (
            get(regimes, "elasto_plastic_count") + get(regimes, "plastic_count") > 0
        )
        self._get, self._regimes, self._elastic = get, regimes, elastic

    def ratio(self, field):
        return self._get(self._regimes, field)[self.use] / self._get(self._elastic, field)[self.use]

    def steps(self):
        """Further steps (of sigma/50) with the regimes."""
        depth = self._get(self._regimes, "approach") - self._get(self._elastic, "approach")
        return (depth / (self._get(self._elastic, "composite_rms_height") / 50))[self.use]


def compare(facts, material, field):
    """What came out, and the numbers of smaller, equal and larger values."""
    said, numbers = [], np.zeros(3, dtype=int)
    for with_van_der_waals in (False, True):
        ratio = Pairs(facts, material, with_van_der_waals).ratio(field)
        if len(ratio):
            counts = np.array([np.sum(ratio < 1), np.sum(ratio == 1), np.sum(ratio > 1)])
            numbers += counts
            said.append(
                "%s van der Waals: %d larger, %d equal, %d smaller, up to %s times"
                % (
                    "with" if with_van_der_waals else "no",
                    counts[2],
                    counts[1],
                    counts[0],
                    number_text(ratio.max()),
                )
            )
    return "; ".join(said) or "no such pair", numbers


def larger_area(facts, material):
    said, (smaller, _, larger) = compare(facts, material, "contact_area")
    return Row(
        "larger_area_" + material.name,
        "conclusions 4, fig. 7",
        "The real contact area is larger than if all asperities are elastic: %s." % material.name,
        "Pairs of figure 7 with a contact that is not elastic, against the same all-elastic.",
        said + ".",
        verdict(larger > 0 and smaller == 0, larger > smaller),
    )


def higher_pull_off(facts, material):
    said, (smaller, _, larger) = compare(facts, material, "pull_off_force")
    note = " Smaller where the sum of radii in (11) falls." if smaller else ""
    return Row(
        "higher_pull_off_" + material.name,
        "conclusions 4, fig. 6",
        "The pull-off force is higher, too: %s." % material.name,
        SAME_PAIRS,
        said + "." + note,
        verdict(larger > 0 and smaller == 0, larger > smaller),
    )


SAME_PAIRS = "The same pairs."
SOLVERS = {"separation curve": "", "half-space": "half_space_"}
SAME = 0.01  # of two figures: nearer than the half-space is solved


def compare_pressed(facts, solver, field):
    """By a solver that counts adhesion once: what came out, and the numbers of smaller, equal and
    larger values."""
    said, numbers = [], np.zeros(3, dtype=int)
    for material in cases.MATERIALS:
        flow, elastic = PressedFrames(facts.study, facts.results).with_and_without_flow(
            material, SOLVERS[solver] + field
        )
        ratio = (flow / elastic)[np.isfinite(flow / elastic)]
        if not ratio.size:
            continue
        counts = np.array(
            [np.sum(ratio < 1 - SAME), np.sum(np.abs(ratio - 1) <= SAME), np.sum(ratio > 1 + SAME)]
        )
        numbers += counts
        said.append(
            "%s: %d larger, %d equal within 1 %%, %d smaller, median %s times, most %s"
            % (
                material.name,
                counts[2],
                counts[1],
                counts[0],
                number_text(float(np.median(ratio))),
                number_text(float(ratio.max())),
            )
        )
    return "; ".join(said) or "no such pair", numbers


def pressed_ran(facts):
    return (
        "%d pair%s of each material at θ of %s, pressed by %s of the hardness over the frame; the "
        "same pairs as if nothing could flow."
        % (
            facts.study.half_space_seeds,
            "" if facts.study.half_space_seeds == 1 else "s",
            ", ".join("%g" % one for one in facts.study.pressed_parameters),
            " and ".join(percent(press) for press in facts.study.presses),
        )
    )


def larger_area_by(facts, solver):
    said, (smaller, _, larger) = compare_pressed(facts, solver, "contact_fraction")
    return Row(
        "larger_area_by_" + solver,
        "conclusions 4, fig. 7",
        "The real contact area is larger than if all asperities are elastic: by the %s." % solver,
        pressed_ran(facts) if solver == next(iter(SOLVERS)) else SAME_PAIRS,
        said + ".",
        verdict(larger > 0 and smaller == 0, larger > smaller),
    )


def higher_pull_off_by(facts, solver):
    said, (smaller, _, larger) = compare_pressed(facts, solver, "pull_off_force")
    return Row(
        "higher_pull_off_by_" + solver,
        "conclusions 4, fig. 6",
        "The pull-off force is higher, too: by the %s." % solver,
        SAME_PAIRS,
        said + ".",
        verdict(larger > 0 and smaller == 0, larger > smaller),
    )


def at_rough_ends(facts, material):
    """Medians over the pairs with van der Waals attraction, where roughness is large: with the
    regimes over all-elastic."""
    regimes, elastic = cases.WITH_AND_WITHOUT_REGIMES[1]
    said = []
    for wanted in cases.ROUGH_PARAMETERS:
        place = int(np.argmin(np.abs(np.log(facts.sweep.parameters / wanted))))
        get = lambda series, field: facts.sweep.values(material, series, field)[place]  # noqa: E731
        steps = (get(regimes, "approach") - get(elastic, "approach")) / (
            get(elastic, "composite_rms_height") / 50
        )
        area, force = (
            np.median(get(regimes, field) / get(elastic, field))
            for field in ("contact_area", "pull_off_force")
        )
        said.append(
            "%s steps later, %s times the contact and %s times the force at θ = %s"
            % (
                number_text(float(np.median(steps))),
                number_text(float(area)),
                number_text(float(force)),
                number_text(facts.sweep.parameters[place]),
            )
        )
    return "; ".join(said)


def stops_later(facts, material):
    steps = np.concatenate(
        [Pairs(facts, material, with_van_der_waals).steps() for with_van_der_waals in (False, True)]
    )
    later = steps[steps > 0]
    return Row(
        "stops_later_" + material.name,
        "3",
        "With plastic asperities the iteration stops a few steps later: %s." % material.name,
        "The pairs of figures 6 and 7 with contacts that are not elastic.",
        "Of %d pairs %d stop later%s, %d earlier. With van der Waals attraction, medians: %s."
        % (
            len(steps),
            len(later),
            " (median %s steps of σ/50, most %s)"
            % (number_text(float(np.median(later))), number_text(float(later.max())))
            if len(later)
            else "",
            np.sum(steps < 0),
            at_rough_ends(facts, material),
        ),
        verdict(len(later) > 0 and not np.any(steps < 0), len(later) > 0),
    )


# ---------------------------------------------------------------- conclusions
def arbitrary_surfaces(facts):
    rows = {
        name.split("/", 1)[1]: row
        for name, row in facts.results.items()
        if name.startswith("arbitrary/")
    }
    good = [row["status"] == "EQUILIBRIUM" and row["pull_off_force"] > 0 for row in rows.values()]
    kinds = sorted({name.split("/")[0] for name in rows})
    more = all(
        rows[kind + "/" + load]["normal_load"] > rows[kind + "/van der Waals"]["normal_load"]
        for kind in kinds
        for load in ("voltage", "load")
    )
    said = "; ".join(
        "%s: %s"
        % (
            kind.replace("_", "-"),
            ", ".join(
                "%s %s" % (load, with_unit(rows[kind + "/" + load]["pull_off_force"], "N"))
                for load in ("van der Waals", "voltage", "load")
            ),
        )
        for kind in kinds
    )
    return Row(
        "arbitrary_surfaces",
        "conclusions 1",
        "Adhesive forces between two arbitrary surfaces under van der Waals and normal forces, "
        "elastic and plastic.",
        "Gaussian, skewed (skewness -1, kurtosis 5) and self-affine pairs under van der Waals "
        "attraction alone, with 5 V, with %s."
        % with_unit(rows[kinds[0] + "/load"]["mechanical_load"], "N"),
        "%d of %d in equilibrium. Pull-off force, %s." % (sum(good), len(good), said),
        verdict(all(good) and more, any(good)),
    )


def lowered(maps):
    """Volume by which the plastic and elasto-plastic contacts were pushed back: lower and upper
    surface [m^3]."""
    area = maps.pitch**2
    return (maps.lower - maps.lower_after).sum() * area, (
        maps.upper_after - maps.upper
    ).sum() * area


def material_topography(facts):
    said, shares = [], []
    for ratio in cases.HARDNESS_RATIOS:
        lower, upper = lowered(facts.maps("hardness/%g" % ratio))
        shares.append(lower / (lower + upper) if lower + upper > 0 else math.nan)
        said.append("%g: %s" % (ratio, percent(shares[-1])))
    volumes = [sum(lowered(facts.maps("roughness/%g" % factor))) for factor in (0.25, 0.5, 1.0)]
    rising = all(a <= b for a, b in zip(shares, shares[1:])) and shares[0] < 0.5 < shares[-1]
    changes = volumes[0] < volumes[-1]
    return Row(
        "material_topography",
        "abstract, conclusions 2",
        "The modification of the topography is guided by the material and by the topography.",
        "A steep silicon pair under load with four hardnesses of the upper body; then with a "
        "quarter and half of the roughness.",
        "Share of the volume taken by the lower surface at an upper over lower hardness of %s. "
        "Volume moved at 0.25, 0.5 and 1 times the roughness: %s nm³."
        % (", ".join(said), ", ".join("%.3g" % (volume * 1e27) for volume in volumes)),
        verdict(rising and changes, rising or changes),
    )


def neighbours_only(facts):
    maps = facts.maps("contact")
    changed = (maps.lower_after != maps.lower) | (np.abs(maps.upper_after - maps.upper) > 0)
    outside = int(np.sum(changed & (maps.contact_map == 0)))
    inside = int(np.sum(changed & (maps.contact_map > 0)))
    return Row(
        "neighbours_only",
        "conclusions 2",
        "The modification is a consequence of the interaction between asperities.",
        "Figure 2's pair: cells that differ after pull-off.",
        "%d cells in contact changed, %d out of contact." % (inside, outside),
        verdict(inside > 0 and outside == 0, inside > outside),
    )


def van_der_waals_close(facts):
    sweep = facts.sweep
    share = sweep.values(cases.SILICON, "regimes_vdw", "van_der_waals_force") / sweep.values(
        cases.SILICON, "regimes_vdw", "pull_off_force"
    )
    mean = share.mean(axis=1)
    best = int(np.argmax(mean))
    pressure = cases.SILICON.hamaker_constant / (6 * math.pi * (1e-9) ** 3)
    return Row(
        "van_der_waals_close",
        "conclusions 3",
        "The van der Waals interaction can be strong where the surfaces are close but do not "
        "touch.",
        "Silicon pairs of figure 7: F_w of (2), which counts only cells out of contact, over the "
        "pull-off force.",
        "From %s (θ = %s) up to %s (θ = %s) of the pull-off force; two planes 1 nm apart attract "
        "each other with %s."
        % (
            percent(mean[0]),
            number_text(sweep.parameters[0]),
            percent(mean[best]),
            number_text(sweep.parameters[best]),
            with_unit(pressure, "Pa"),
        ),
        verdict(mean[best] > 0.5, mean[best] > 0.1),
    )


def van_der_waals_rough(facts):
    sweep = facts.sweep
    pressure = (
        sweep.values(cases.SILICON, "regimes_vdw", "van_der_waals_force")
        / sweep.values(cases.SILICON, "regimes_vdw", "nominal_area")
    ).mean(axis=1)
    gap = sweep.values(cases.SILICON, "regimes_vdw", "mean_gap").mean(axis=1)
    peak = int(np.argmax(pressure))
    factor = pressure[peak] / pressure[-1]
    return Row(
        "van_der_waals_rough",
        "3",
        "For very rough surfaces the van der Waals interaction is weak.",
        "The same pairs: F_w over the nominal area.",
        "%s at θ = %s (mean gap %s), %s at θ = %s (mean gap %s): %s times less."
        % (
            with_unit(pressure[peak], "Pa"),
            number_text(sweep.parameters[peak]),
            with_unit(gap[peak], "m"),
            with_unit(pressure[-1], "Pa"),
            number_text(sweep.parameters[-1]),
            with_unit(gap[-1], "m"),
            number_text(factor),
        ),
        verdict(factor > 10, factor > 2),
    )


def plastic_without_load(facts):
    sweep, said, found, flows = facts.sweep, [], [], []
    for material in cases.MATERIALS:
        plastic = sweep.values(material, "regimes_vdw", "plastic_count").mean(axis=1)
        seen = np.flatnonzero(plastic > 0)
        ratio = Pairs(facts, material, True).ratio("contact_area")
        found.append(len(seen) > 0)
        flows.append(bool(np.any(ratio > 1)))
        where = (
            "from θ = %s, %s of the contacts at 100"
            % (
                number_text(sweep.parameters[seen[0]]),
                percent(
                    plastic[-1]
                    / sweep.values(material, "regimes_vdw", "asperity_count").mean(axis=1)[-1]
                ),
            )
            if len(seen)
            else "none up to θ = %s" % number_text(sweep.parameters[-1])
        )
        said.append(
            "%s: plastic by (9) %s; expected around %s for a summit of the mean radius"
            % (material.name, where, number_text(material.adhesion_parameter_at_index(1.1)))
        )
    return Row(
        "plastic_without_load",
        "conclusions 3",
        "Some asperities deform plastically even without an external load.",
        "Figure 7's pairs with no mechanical load and no voltage.",
        "; ".join(said)
        + ". It enlarges the contact for %s."
        % (
            " and ".join(material.name for material, flow in zip(cases.MATERIALS, flows) if flow)
            or "neither"
        ),
        verdict(all(found), any(found)),
    )


def energy_outside_bonding(facts):
    sweep, critical, said, enough = facts.sweep, cases.critical_bonding_energy(), [], []
    outside = (sweep.parameters > cases.BONDING_LIMIT) & (
        sweep.parameters <= cases.NON_BONDING_LIMIT * (1 + 1e-9)
    )
    for series in ("elastic", "regimes_vdw"):
        energy, _, _ = band(sweep.values(cases.SILICON, series, "bonding_energy"))
        last = crossing(sweep.parameters, energy, critical)
        enough.append(bool(np.all(energy[outside] > critical)))
        said.append(
            "%s: lowest %s between 1 and 12, above the beam's up to θ = %s"
            % (
                "no van der Waals" if series == "elastic" else "full model",
                with_unit(float(energy[outside].min()), "J/m^2"),
                number_text(last) if math.isfinite(last) else "%g at least" % sweep.parameters[-1],
            )
        )
    fine = np.logspace(0, 2, 41)
    theory_end = crossing(
        fine,
        [
            theory.rest_of_jkr_summits(value).energy * cases.SILICON.work_of_adhesion
            for value in fine
        ],
        critical,
    )
    return Row(
        "energy_outside_bonding",
        "abstract, 3, conclusions 5",
        "Even outside the bonding regime the bonding energy is high enough to cause adhesive "
        "problems for microstructures.",
        "Silicon of figure 6 against what holds down a beam %s long, %s thick, %s above the "
        "substrate, over all its length: (3/2) E t³h²/s⁴ = %s."
        % (
            with_unit(cases.BEAM_LENGTH, "m"),
            with_unit(cases.BEAM_THICKNESS, "m"),
            with_unit(cases.BEAM_GAP, "m"),
            with_unit(critical, "J/m^2"),
        ),
        "; ".join(said) + "; theory: up to θ = %s." % number_text(theory_end),
        verdict(all(enough), any(enough)),
    )


def friction(facts):
    return Row(
        "friction",
        "conclusions 6",
        "The model can serve as a ground for static friction studies.",
        "Nothing: an outlook, without an equation in the paper.",
        "Contact area, load and radius of each contact are published; no shear strength is "
        "modelled.",
        OPEN,
    )
