"""What others measured on rough surfaces, and the frames and settings it is predicted with;
doc/measured.md is written from it.

READ: the figure stands in the text that was opened (for most an abstract; more was not to be had).
RECALLED: it was not checked against the source. Whatever a source does not say is assumed, and
varied by VARIATIONS. SI units.
"""

import collections
import pathlib

import numpy as np
import trust_frames
import yaml

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
READ, RECALLED = "read", "recalled"
PIXELS_PER_LENGTH = 8

Source = collections.namedtuple("Source", "name where says")
DELRIO_2005 = Source(
    "DelRio, de Boer, Knapp, Reedy, Clews, Dunn, Nature Materials 4 (2005) 629",
    "abstract",
    "Adhesion of micromachined polysilicon beams. Small roughness: van der Waals forces across "
    "areas that do not touch, going with 1/D_ave^2, D_ave the average separation. Large roughness: "
    "contacting asperities dominate",
)
PLATES_1999 = Source(
    "electrostatically actuated polysilicon parallel plates, ASME IMECE 1999, 275",
    "abstract",
    "13.3 uN (standard deviation 1.2 uN) on 1.256e-9 m^2, polysilicon on polysilicon; a surface "
    "energy of 8.9 mJ/m^2 from it. Neither roughness nor humidity",
)
LAITINEN_2013 = Source(
    "Laitinen, Bauer, Niinimaki, Peuker, Powder Technology 246 (2013) 545",
    "abstract",
    "Alumina spheres on alumina by colloidal probe: the adhesion force falls approximately "
    "five-fold between 1.5 and 12.0 nm rms",
)
JACOBS_2013 = Source(
    "Jacobs, Ryan, Keating, Grierson, Lefever, Turner, Harrison, Carpick, Tribology Letters 50 "
    "(2013) 81",
    "abstract, beginning",
    "Diamond-like carbon and nanocrystalline diamond tips on diamond: rms 0.18 to 1.58 nm lowers "
    "the effective work of adhesion by more than a factor of ten",
)

FLAT_TIPS_2012 = Source(
    "adhesion measured with a flat AFM tip, Applied Surface Science 258 (2012) 6938",
    "abstract",
    "Flat tips of 2 um diameter on smooth and on chemically etched Si(100), over humidity: the "
    "roughness of the etched one reduces the force by more than an order of magnitude, by how much "
    "depends on the humidity",
)
CLAMPED_BEAMS = Source(
    "adhesion of polysilicon by a double-clamped beam that electrodes pull down",
    "abstract",
    "The adhesion force scales weakly with the apparent contact area, which dimples define",
)


class Case:
    """A measured quantity and surfaces to predict it from.

    quantity: "work" [J/m^2], "pressure" (pull-off force over nominal area [Pa]), "ratio" (work at
    the first over that at the second rms height) or "force ratio" (the same of the pull-off force).
    measured: one value for each rms height, or the ratio.
    """

    def __init__(
        self, key, source, known, quantity, measured, rms_heights, length, pixels, settings, assumed
    ):
        self.key, self.source, self.known, self.quantity, self.measured = (
            key,
            source,
            known,
            quantity,
            measured,
        )
        self.rms_heights, self.length, self.pixels, self.settings, self.assumed = (
            rms_heights,
            length,
            pixels,
            settings,
            assumed,
        )


def polysilicon():
    """The ready-made configuration: nothing is chosen for the occasion."""
    tree = yaml.safe_load(
        (REPOSITORY / "config" / "polysilicon_oxide.yaml").read_text(encoding="utf-8")
    )
    body = tree["lower"]
    return {
        "modulus": body["youngs_modulus"] / (2 * (1 - body["poisson_ratio"] ** 2)),
        "hardness": body["hardness"],
        "work": tree["interface"]["work_of_adhesion"],
        "hamaker": tree["interface"]["hamaker_constant"],
    }


POLYSILICON_ASSUMED = (
    "config/polysilicon_oxide.yaml as it is, dry; correlation length 100 nm; "
    "frames of 12.8 um; composite rms as listed"
)
ALUMINA = {"modulus": 200e9, "hardness": 20e9, "work": 0.08, "hamaker": 150e-21}
DIAMOND = {"modulus": 300e9, "hardness": 80e9, "work": 0.0463, "hamaker": 150e-21}

CASES = (
    Case(
        "beams",
        DELRIO_2005,
        RECALLED,
        "work",
        (50e-6, 5e-6),
        (2.6e-9, 10e-9),
        100e-9,
        1024,
        polysilicon(),
        POLYSILICON_ASSUMED + ". The measured values are recalled, as orders of magnitude",
    ),
    Case(
        "plates",
        PLATES_1999,
        READ,
        "pressure",
        (13.3e-6 / 1.256e-9,) * 3,
        (2e-9, 5e-9, 10e-9),
        100e-9,
        1024,
        polysilicon(),
        POLYSILICON_ASSUMED + ": the source gives none, three usual ones of polysilicon",
    ),
    Case(
        "alumina",
        LAITINEN_2013,
        READ,
        "ratio",
        (5.0,),
        (1.5e-9, 12e-9),
        50e-9,
        64,
        ALUMINA,
        "constants of alumina (recalled), dry; correlation length 50 nm; smooth spheres; frames of "
        "400 nm, about what a sphere of some um brings near",
    ),
    Case(
        "tips",
        JACOBS_2013,
        READ,
        "ratio",
        (10.0,),
        (0.18e-9, 1.58e-9),
        2e-9,
        64,
        DIAMOND,
        "constants of hard carbon (recalled; work of adhesion as diamond on ruby has, Thimons et "
        "al. 2021, abstract); correlation length 2 nm; frames of 16 nm. The measured value is a "
        "lower bound",
    ),
    Case(
        "flat tips",
        FLAT_TIPS_2012,
        READ,
        "force ratio",
        (10.0,),
        (0.3e-9, 3e-9),
        50e-9,
        288,
        polysilicon(),
        "config/polysilicon_oxide.yaml as it is, dry; both rms heights, correlation length 50 nm; "
        "frames of 1.8 um, which are the whole tip's area; no tilt of the tip. The measured value "
        "is a lower bound",
    ),
)

# The plates as they were: the whole area, of which a frame is one part in eight.
PLATE_AREA = 1.256e-9
PLATE_FORCE = 13.3e-6
PLATE_SCANS = 3
AREA_SHARES = (1 / 16, 1 / 4, 1.0)

# A cantilever as such beams are, and the part of it that rests: assumed, since no source was to be
# had that gives them.
BEAM = {
    "beam_type": "cantilever",
    "beam_length": 1e-3,
    "beam_thickness": 2.5e-6,
    "beam_gap": 2e-6,
    "beam_modulus": 160e9,
}
BEAM_AREA = 20e-6 * 100e-6

# rms, length, pixels and settings are factors on the case's own; stated are further settings.
Variation = collections.namedtuple(
    "Variation", "name rms length pixels settings is_self_affine stated", defaults=({},)
)
AS_ASSUMED = Variation("as assumed", 1.0, 1.0, 1, {}, False)
VARIATIONS = (
    Variation("correlation length x 2", 1.0, 2.0, 1, {}, False),
    Variation("correlation length / 2", 1.0, 0.5, 1, {}, False),
    Variation("rms height x sqrt(2): both surfaces as rough", 2**0.5, 1.0, 1, {}, False),
    Variation("work of adhesion x 2", 1.0, 1.0, 1, {"work": 2.0}, False),
    Variation("work of adhesion / 2", 1.0, 1.0, 1, {"work": 0.5}, False),
    Variation("Hamaker constant x 2", 1.0, 1.0, 1, {"hamaker": 2.0}, False),
    Variation("Hamaker constant / 2", 1.0, 1.0, 1, {"hamaker": 0.5}, False),
    Variation("side of the frame x 2", 1.0, 1.0, 2, {}, False),
    Variation("self-affine, H = 0.8, down to 4 pixels", 1.0, 1.0, 1, {}, True),
)

# What measured parts have and a dry, thick, uncharged oxide has not. Films, constants and lambda as
# in config/polysilicon_native_oxide.yaml. Water: some three ice-like layers on oxide by 30 %
# (Asay and Kim, J. Phys. Chem. B 109 (2005) 16760, abstract), one layer more at 50 % is assumed.
# Surfaces that fit each other share the correlation rho of all waves: equally rough ones have
# sqrt(1 - rho) of the composite roughness. The potential lies across both native oxides.
NATIVE = {
    "lower": {"film_thickness": 2e-9, "hamaker_constant": 261e-21},
    "upper": {"film_thickness": 2e-9, "hamaker_constant": 261e-21},
    "interface": {"retardation_length": 20e-9},
}


def humid(relative_humidity, water_film):
    return {"interface": {"relative_humidity": relative_humidity, "water_film": water_film}}


CHARGED = {"interface": {"insulator_thickness": 4e-9}, "load": {"contact_potential": 0.1}}
CORRELATION = 0.8
FITTING = (1.0 - CORRELATION) ** 0.5
EFFECTS = (
    Variation("native oxide, retarded", 1.0, 1.0, 1, {}, False, NATIVE),
    Variation("30 % humidity", 1.0, 1.0, 1, {}, False, humid(0.3, 0.8e-9)),
    Variation("50 % humidity", 1.0, 1.0, 1, {}, False, humid(0.5, 1.1e-9)),
    Variation("correlation 0.8", FITTING, 1.0, 1, {}, False),
    Variation("0.1 V", 1.0, 1.0, 1, {}, False, CHARGED),
    Variation("native oxide, correlation 0.8", FITTING, 1.0, 1, {}, False, NATIVE),
    Variation(
        "native oxide, 0.1 V",
        1.0,
        1.0,
        1,
        {},
        False,
        {**CHARGED, **NATIVE, "interface": {**CHARGED["interface"], **NATIVE["interface"]}},
    ),
)
OF_EFFECTS = ("beams", "plates", "flat tips")  # of polysilicon or silicon under its oxide

# Measurements whose available text lacks the roughness, or the force.
FOUND = (
    "Thimons, Gujrati, Sanner, Pastewka, Jacobs, doi 10.1007/s11340-021-00733-6 (2021)",
    "DelRio, Dunn, Phinney, Bourdon, de Boer, Appl. Phys. Lett. 90 (2007) 163104",
    "de Boer et al., Acta Materialia 48 (2000) 4531",
    "textured beams, River Publishers, e-book 9788770048422, p. 183",
    "Liu, Martin, Burnham, Optimal roughness for minimal adhesion (2007); ASME IJTC 2008, 593",
    "Chai, Liu, Lu, He, ACS Appl. Mater. Interfaces 2014, doi 10.1021/am4053333",
    "van Zwol, Palasantzas, De Hosson, Appl. Phys. Lett. 91 (2007), doi 10.1063/1.2768919",
    "Soldatenkov, Svetovoy, Physics 6 (2024) 1204",
    "Experimental evaluation and numerical modeling of adhesion phenomena in polysilicon MEMS "
    "(2013)",
)


def surface(case, variation, rms_height, seed, pixels):
    """(frame for trust_frames.configuration, heights [m])"""
    length = case.length * variation.length
    pitch = length / PIXELS_PER_LENGTH
    side = pixels * variation.pixels
    random = np.random.default_rng([14, seed])
    psd = (
        trust_frames.self_affine(2 * np.pi * length, pitch, 0.8)
        if variation.is_self_affine
        else lambda q: np.exp(-((q * length) ** 2) / 4)
    )
    heights = trust_frames.spectrum_surface(side, pitch, psd, random) * rms_height * variation.rms
    frame = {"number": seed, "pixels": side, "pitch": pitch, "pressure": 0.0}
    frame.update(
        {name: value * variation.settings.get(name, 1.0) for name, value in case.settings.items()}
    )
    return frame, heights.astype(np.float32)
