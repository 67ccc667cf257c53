"""Which pairs of surfaces are predicted, and with which settings. Every number of the study stands
here.

Surfaces are Gaussian with the autocorrelation sigma^2 exp(-r^2/l^2), two independent ones per pair,
each with half of the composite variance. The adhesion parameter of a pair, before anything touches,
is that of its summits,

    theta = (E/Gamma) sqrt(sigma^3/R) = sqrt(radius factor) E sigma^2/(Gamma l),   R = l^2/(radius
    factor x sigma),

so it is set by the roughness (figures 6 and 7) or by the work of adhesion (figure 4). SI units.
"""

import json
import math
import pathlib
import threading
import warnings
from concurrent.futures import ThreadPoolExecutor, as_completed

import mems_stiction
import numpy as np
import yaml

from paper.theory import SUMMITS

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
CORRELATION_PIXELS = 10
BASE_RMS_HEIGHT = 1e-9  # of each surface as drawn; cases scale it
PAPERS_MODEL = {"approach/formulation": "paper"}
NO_VAN_DER_WAALS = {"interface/hamaker_constant": 0.0}
ALL_ELASTIC = {"approach/deformation": "elastic"}
# Gui et al.: bonding below the first, non-bonding above the second.
BONDING_LIMIT, NON_BONDING_LIMIT = 1.0, 12.0


class Material:
    """One of the ready-made pairs of materials, and the lateral size of its roughness."""

    def __init__(self, name, config, correlation_length):
        self.name, self.config, self.correlation_length = name, config, correlation_length
        settings = yaml.safe_load((REPOSITORY / config).read_text())
        compliance = sum(
            (1 - body["poisson_ratio"] ** 2) / body["youngs_modulus"]
            for body in (settings["lower"], settings["upper"])
        )
        self.contact_modulus = 1 / compliance
        self.youngs_modulus = settings["lower"]["youngs_modulus"]
        self.hardness = min(settings[body]["hardness"] for body in ("lower", "upper"))
        self.work_of_adhesion = settings["interface"]["work_of_adhesion"]
        self.hamaker_constant = settings["interface"]["hamaker_constant"]

    @property
    def pitch(self):
        return self.correlation_length / CORRELATION_PIXELS

    def summit_radius(self, rms_height):
        return SUMMITS.radius * self.correlation_length**2 / rms_height

    def adhesion_parameter(self, rms_height):
        return (
            self.contact_modulus
            / self.work_of_adhesion
            * math.sqrt(rms_height**3 / self.summit_radius(rms_height))
        )

    def rms_height(self, adhesion_parameter):
        """Composite, for an adhesion parameter, which goes with its square."""
        return 1e-9 * math.sqrt(adhesion_parameter / self.adhesion_parameter(1e-9))

    def plasticity_index(self, rms_height):
        return (
            self.contact_modulus
            / self.hardness
            * math.sqrt(rms_height / self.summit_radius(rms_height))
        )

    def adhesion_parameter_at_index(self, plasticity_index):
        """Where a summit of the mean radius has this plasticity index: both go with powers of the
        rms height."""
        return self.adhesion_parameter(1e-9 * plasticity_index / self.plasticity_index(1e-9))


SILICON = Material("silicon", "config/polysilicon_oxide.yaml", 10e-9)
GOLD = Material("gold", "config/gold_gold.yaml", 50e-9)
MATERIALS = (SILICON, GOLD)


class Series:
    """One curve of figures 6 and 7."""

    def __init__(self, name, label, settings):
        self.name, self.label, self.settings = name, label, settings


SERIES = (
    Series("elastic", "all-elastic, no van der Waals", {**ALL_ELASTIC, **NO_VAN_DER_WAALS}),
    Series("regimes", "three regimes, no van der Waals", NO_VAN_DER_WAALS),
    Series("elastic_vdw", "all-elastic, with van der Waals", ALL_ELASTIC),
    Series("regimes_vdw", "three regimes, with van der Waals", {}),
)
# Drawn beside the paper's: the default formulation on the same pairs; no claim of the paper is held
# against it.
BESIDE = Series(
    "separation_curve",
    "separation curve, with van der Waals",
    {"approach/formulation": "separation_curve"},
)
WITH_AND_WITHOUT_REGIMES = (("regimes", "elastic"), ("regimes_vdw", "elastic_vdw"))


# Closest where the model goes from bonded to few contacts.
PARAMETERS = (
    0.1,
    0.3,
    1.0,
    2.0,
    3.0,
    5.0,
    7.0,
    9.0,
    12.0,
    14.0,
    17.0,
    20.0,
    25.0,
    30.0,
    40.0,
    55.0,
    75.0,
    100.0,
)
ROUGH_PARAMETERS = (55.0, 100.0)  # where the regimes' part is told one by one
QUICK_PARAMETERS = (0.1, 1.0, 5.0, 12.0, 25.0, 50.0, 100.0)
HALF_SPACE_FIGURES = ("status", "apparent_work_of_adhesion", "contact_fraction", "pull_off_force")
HALF_SPACE_PARAMETERS = (0.3, 1.0, 3.0, 7.0, 12.0, 20.0, 30.0, 55.0, 100.0)
QUICK_HALF_SPACE_PARAMETERS = (1.0, 12.0, 100.0)


# Conclusion 4 by the default and by the half-space: adhesion parameters of pairs pressed by these
# multiples of the hardness, with the materials' hardness and as if nothing could flow.
PRESSED_PARAMETERS = (30.0, 100.0, 300.0)
PRESSES = (0.02, 0.1)
NEVER_FLOWS = {"lower/hardness": 1e15, "upper/hardness": 1e15}


class Study:
    """Sizes and numbers, for a full run or a trial."""

    def __init__(self, seeds, size, is_quick):
        self.seeds, self.size = seeds, size
        self.map_size = min(size, 1024)  # figures 1 to 5
        self.small_size = min(size, 512)  # rows of the table that need no statistics
        self.adhesion_parameters = np.array(QUICK_PARAMETERS if is_quick else PARAMETERS)
        self.half_space_parameters = np.array(
            QUICK_HALF_SPACE_PARAMETERS if is_quick else HALF_SPACE_PARAMETERS
        )
        self.pressed_parameters = np.array(
            PRESSED_PARAMETERS[2:] if is_quick else PRESSED_PARAMETERS
        )
        self.presses = PRESSES[1:] if is_quick else PRESSES
        self.half_space_seeds, self.half_space_size = (
            (1, 48) if is_quick else (3, 128)
        )  # seconds each at the latter


# ---------------------------------------------------------------- figures 1 to 5
# Composite rms height over correlation length: of figures 1, 2 and 5, where asperities of all three
# regimes meet, and of figure 3, where tilts are as large as the paper's.
MIXED_SLOPE, STEEP_SLOPE = 0.06, 0.10
CONTACT_PRESSURE = 60e6  # [Pa] mechanical load over the nominal area
TILT_SLOPES = (0.02, 0.04, 0.06, 0.08, 0.10, 0.12)
PAPERS_TILT = (10.0, 11.0)  # [degrees]
FIGURE_4_PARAMETERS = (1.0, 2.8, 30.0, 60.0)
FIGURE_4_ROUGHNESS = (
    60.0  # the adhesion parameter that the pair has with the material's own work of adhesion
)

# ---------------------------------------------------------------- rows of the table
# Beam that the bonding energy is measured by: stuck in the S-shape, (3/2) E t^3 h^2/s^4, as long as
# one on a MEMS test chip.
BEAM_THICKNESS, BEAM_GAP, BEAM_LENGTH = 2e-6, 2e-6, 500e-6
HARDNESS_RATIOS = (
    0.5,
    0.97,
    1.0,
    2.0,
)  # upper over lower hardness; between a = 0.9 and 1/a both deform


def critical_bonding_energy():
    """Energy per area that holds the beam down over all its length [J/m^2]."""
    return 1.5 * SILICON.youngs_modulus * BEAM_THICKNESS**3 * BEAM_GAP**2 / BEAM_LENGTH**4


def figure_4_work_of_adhesion(parameter):
    return SILICON.work_of_adhesion * FIGURE_4_ROUGHNESS / parameter


def surface(material, seed, **changes):
    lengths = {"correlation_length_%s" % axis: material.correlation_length for axis in "xy"}
    return {
        "type": "gaussian",
        "seed": seed,
        "gaussian": {"rms_height": BASE_RMS_HEIGHT, **lengths, **changes},
    }


def scale_for(composite_rms_height):
    return composite_rms_height / math.sqrt(2) / BASE_RMS_HEIGHT


def case(name, material, composite_rms_height, settings, dump=None):
    wanted = {
        "name": name,
        "scale": scale_for(composite_rms_height),
        "config": str(REPOSITORY / material.config),
        "settings": {**PAPERS_MODEL, **settings},
    }
    if dump is not None:
        wanted["dump"] = str(dump / name.replace("/", "_"))
    return wanted


def pair(material, size, seed, cases, lower=None, upper=None):
    """Surfaces 2 seed - 1 and 2 seed, so that no two pairs share one."""
    return {
        "size": size,
        "pitch": material.pitch,
        "lower": lower or surface(material, 2 * seed - 1),
        "upper": upper or surface(material, 2 * seed),
        "cases": cases,
    }


def sweep_pairs(study):
    """Figures 6 and 7: every series over the adhesion parameter, by roughness."""
    for seed in range(1, study.seeds + 1):
        for material in MATERIALS:
            yield pair(
                material,
                study.size,
                seed,
                [
                    case(
                        "sweep/%s/%s/%d/%d" % (material.name, series.name, number, seed),
                        material,
                        material.rms_height(parameter),
                        series.settings,
                    )
                    for number, parameter in enumerate(study.adhesion_parameters)
                    for series in SERIES + (BESIDE,)
                ],
            )


def half_space_pairs(study):
    """Small frames for figures 6 and 7, by the default formulation and by the half-space."""
    for seed in range(1, study.half_space_seeds + 1):
        for material in MATERIALS:
            yield pair(
                material,
                study.half_space_size,
                seed,
                [
                    {
                        **case(
                            "half_space/%s/%d/%d" % (material.name, number, seed),
                            material,
                            material.rms_height(parameter),
                            BESIDE.settings,
                        ),
                        "half_space": True,
                    }
                    for number, parameter in enumerate(study.half_space_parameters)
                ],
            )


def pressed_name(material, is_flowing, number, press, seed):
    return "pressed/%s/%s/%d/%g/%d" % (
        material.name,
        "flow" if is_flowing else "elastic",
        number,
        press,
        seed,
    )


def pressed_pairs(study):
    """The same small frames under a load, with flow and without, by the default formulation and by
    the half-space."""
    for seed in range(1, study.half_space_seeds + 1):
        for material in MATERIALS:
            area = (study.half_space_size * material.pitch) ** 2
            yield pair(
                material,
                study.half_space_size,
                seed,
                [
                    {
                        **case(
                            pressed_name(material, is_flowing, number, press, seed),
                            material,
                            material.rms_height(parameter),
                            {
                                **BESIDE.settings,
                                "load/mechanical_load": press * material.hardness * area,
                                **({} if is_flowing else NEVER_FLOWS),
                            },
                        ),
                        "half_space": True,
                    }
                    for number, parameter in enumerate(study.pressed_parameters)
                    for press in study.presses
                    for is_flowing in (True, False)
                ],
            )


def load_on(size, material):
    return CONTACT_PRESSURE * (size * material.pitch) ** 2


def map_pairs(study, dump):
    """Figures 1, 2, 3 and 5: one pair under load; 3: more pairs over the slope; 4: one pair over
    the work of adhesion."""
    load = {"load/mechanical_load": load_on(study.map_size, SILICON)}
    for seed in range(1, min(study.seeds, 6) + 1):
        cases = [
            case("tilt/%g/%d" % (slope, seed), SILICON, slope * SILICON.correlation_length, load)
            for slope in TILT_SLOPES
        ]
        if seed == 1:
            cases += [
                case(name, SILICON, slope * SILICON.correlation_length, load, dump)
                for name, slope in (("contact", MIXED_SLOPE), ("tilted", STEEP_SLOPE))
            ]
            rms_height = SILICON.rms_height(FIGURE_4_ROUGHNESS)
            for parameter in FIGURE_4_PARAMETERS:
                settings = {"interface/work_of_adhesion": figure_4_work_of_adhesion(parameter)}
                cases.append(case("interface/%g" % parameter, SILICON, rms_height, settings, dump))
        yield pair(SILICON, study.map_size, seed, cases)


def table_pairs(study, dump):
    """Rows of the table that the figures do not answer."""
    size = study.small_size
    steep = STEEP_SLOPE * SILICON.correlation_length
    load = {"load/mechanical_load": load_on(size, SILICON)}
    yield pair(
        SILICON,
        size,
        1,
        [
            case(
                "hardness/%g" % ratio,
                SILICON,
                steep,
                {**load, "upper/hardness": ratio * SILICON.hardness},
                dump,
            )
            for ratio in HARDNESS_RATIOS
        ]
        + [
            case("roughness/%g" % factor, SILICON, factor * steep, load, dump)
            for factor in (0.25, 0.5, 1.0)
        ],
    )
    voltage = {"load/voltage": 5.0, "interface/insulator_thickness": 100e-9}
    kinds = {
        "gaussian": surface(SILICON, 1),
        "skewed": surface(SILICON, 1, skewness=-1.0, kurtosis=5.0),
        "self_affine": {
            "type": "self_affine",
            "seed": 1,
            "self_affine": {
                "rms_height": BASE_RMS_HEIGHT,
                "hurst_exponent": 0.8,
                "rolloff_wavelength": 20 * SILICON.correlation_length,
                "cutoff_wavelength": SILICON.correlation_length,
            },
        },
    }
    for kind, drawn in kinds.items():
        cases = [
            case("arbitrary/%s/%s" % (kind, name), SILICON, steep, settings)
            for name, settings in (("van der Waals", {}), ("voltage", voltage), ("load", load))
        ]
        yield pair(SILICON, size, 1, cases, lower=drawn, upper={**drawn, "seed": 2})


def all_pairs(study, dump):
    return (
        list(map_pairs(study, dump))
        + list(table_pairs(study, dump))
        + list(sweep_pairs(study))
        + list(half_space_pairs(study))
        + list(pressed_pairs(study))
    )


def surface_of(wanted, pair):
    """Heights as a probe would see them, asperities up [m]."""
    return mems_stiction.generate(
        (pair["size"], pair["size"]), pair["pitch"], counter_surface=wanted
    ).heights


def settings_of(wanted):
    """Of a case. Maps, contacts and energies only for one that names a folder for them."""
    output = dict.fromkeys(
        ("deformed_surfaces", "contact_map", "asperities", "roughness", "energy_curve"),
        "dump" in wanted,
    )
    return mems_stiction.Settings(
        mems_stiction.Settings(wanted["config"], **wanted["settings"]),
        output=output,
        counter_surface={"facing": "up"},
    )


def predict_cases(group, pitch, lower, upper):
    """The cases of two surfaces [m]: of each its name and figures, half_space_... beside them where
    it asks for these."""
    settings = [settings_of(wanted) for wanted in group]
    for wanted, own, prediction in zip(
        group, settings, mems_stiction.predict_under(lower, pitch, settings, upper)
    ):
        figures = prediction.to_dict()
        if wanted.get("half_space"):
            solved = mems_stiction.half_space(lower, pitch, own, upper=upper)
            figures.update(
                {"half_space_" + name: getattr(solved, name) for name in HALF_SPACE_FIGURES}
            )
        if "dump" in wanted:
            write_maps(pathlib.Path(wanted["dump"]), prediction, figures)
        yield wanted["name"], figures


def write_maps(folder, prediction, figures):
    """What data.Maps reads."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, array in (
        ("heights", prediction.heights),
        ("deformed", prediction.deformed_lower),
        ("counter_heights", prediction.upper_heights),
        ("counter_deformed", prediction.deformed_upper),
        ("contact_map", prediction.contact_map),
    ):
        np.save(str(folder / (name + ".npy")), array)
    for name, records in (
        ("asperities", prediction.asperities),
        ("energy_curve", prediction.energy_curve),
    ):
        figures = {
            **figures,
            name: {field: records[field].tolist() for field in records.dtype.names},
        }
    (folder / "result.json").write_text(json.dumps(figures))


class DrawnPair:
    """Both surfaces of a pair, drawn by whichever thread is first to ask, and let go of after its
    last group of cases. Cases of one pair differ in nothing but their scale and settings."""

    def __init__(self, pair):
        self.pair = pair
        alike = {}  # what predict_under() takes together
        for wanted in pair["cases"]:
            alike.setdefault((wanted["scale"], "dump" in wanted), []).append(wanted)
        self.groups = list(alike.values())
        self._lock, self._surfaces, self._left = threading.Lock(), None, len(self.groups)

    def predict_group(self, group, on_figures):
        with self._lock:
            if self._surfaces is None:
                self._surfaces = tuple(
                    surface_of(self.pair[body], self.pair) for body in ("lower", "upper")
                )
            lower, upper = (heights * group[0]["scale"] for heights in self._surfaces)
        for name, figures in predict_cases(group, self.pair["pitch"], lower, upper):
            on_figures(name, figures)
        with self._lock:
            self._left -= 1
            if not self._left:
                self._surfaces = None


def is_long(group):
    """A half-space takes longer than many predictions."""
    return any(wanted.get("half_space") for wanted in group)


def run(pairs, jobs, on_case):
    """Predicts every case by the core, so many surfaces at the same time, those that take long
    first, so that no thread is left alone with them. @return name of the case -> its figures, the
    same whatever the number of jobs. on_case() is called after each."""
    results = {}
    lock = threading.Lock()

    def keep(name, figures):
        with lock:
            results[name] = figures
            on_case()

    groups = [(drawn, group) for drawn in map(DrawnPair, pairs) for group in drawn.groups]
    groups.sort(key=lambda one: not is_long(one[1]))
    with warnings.catch_warnings(), ThreadPoolExecutor(jobs) as pool:
        warnings.simplefilter("ignore", mems_stiction.ScanWarning)
        futures = [pool.submit(drawn.predict_group, group, keep) for drawn, group in groups]
        try:
            for future in as_completed(futures):
                future.result()
        finally:
            for future in futures:
                future.cancel()
    return results
