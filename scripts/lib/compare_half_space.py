"""The half-space of predict_scan against tamaas, ContactMechanics and Adhesion on the same frames;
run by scripts/compare_half_space. Prints a row for each case, writes a line for each quantity; exit
status 1 when a row is out."""

import argparse
import csv
import json
import pathlib
import resource
import subprocess
import time
import typing

import numpy as np
import tamaas
import tifffile
from Adhesion.Interactions import VDW82
from Adhesion.System import SmoothContactSystem
from Adhesion.System import make_system as make_adhesive_system
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics import make_system as make_hard_system
from SurfaceTopography import Topography

SIZE = 128
PITCH = 5e-9
MODULUS = 88.8e9  # contact modulus [Pa]
WORK = 0.05  # Gamma [J/m^2]
RANGE = 1.608e-10  # z0 [m]
TOLERANCE = 1e-4  # largest residual, of 8 Gamma/(3 z0): half_space/tolerance
STEP = 0.2  # between two heights, of z0
WALL = 1e-11  # z0 where nothing attracts [m]

# The surface of the contact-mechanics challenge (Mueser, Dapp et al., Tribol. Lett. 65 (2017) 118):
# Hurst exponent, longest and shortest wave [m], rms slope of all of them, contact modulus [Pa],
# work of adhesion [J/m^2] and range [m]. ContactEngineering's example takes 30 times that range on
# a coarse map.
CHALLENGE_HURST, CHALLENGE_SIDE, CHALLENGE_ROLL_OFF, CHALLENGE_SHORTEST, CHALLENGE_SLOPE = (
    0.8,
    100e-6,
    20e-6,
    0.1e-6,
    1.0,
)
CHALLENGE_RANGE_FACTOR = 30


class Pair(typing.NamedTuple):
    """What a frame of SIZE x SIZE pixels consists of."""

    pitch: float = PITCH
    modulus: float = MODULUS
    work: float = WORK
    range: float = RANGE

    @property
    def stress(self):
        return 8 * self.work / (3 * self.range)


CHALLENGE = Pair(CHALLENGE_SIDE / SIZE, 25e6, 0.05, CHALLENGE_RANGE_FACTOR * 2.071e-9)

SETTINGS = """
lower: {{youngs_modulus: {modulus}, poisson_ratio: {poisson}, thickness: {thickness}, backing: bonded, hardness: {hardness}}}
upper: {{youngs_modulus: 1.0e+30, poisson_ratio: 0.0, hardness: 1.0e+14}}
limits: {{accept_implausible: true}}
interface: {{work_of_adhesion: {work}}}
half_space: {{range: {range}, flow: {flow}, attraction: {attraction}, step: {step}, tolerance: {tolerance}}}
"""  # noqa: E501

TITLE = "## The half-space against other programs"
HEADING = (
    TITLE
    + """

`scripts/compare_half_space` prints every case and writes this summary. The frames are periodic and Gaussian, of
128 x 128 pixels of 5 nm; the other programs are tamaas 2.9.0 (Polonsky and Keer), ContactMechanics 1.8.3 (constrained
conjugate gradients; films are its `thickness`) and Adhesion 0.93 (L-BFGS-B, the same law as its VDW82). Pressures with
flow are checked by the displacement of tamaas under them, since the saturated solver of tamaas (KatoSaturated) does not
converge on these frames. Without attraction the wall here is as soft as z0 = 0.01 nm, theirs is hard. The height is the
mean displacement of Adhesion, whose retraction is sampled at every 0.2 z0; a parabola gives its largest force.

| quantity | other program | cases | largest error | allowed |
|---|---|---|---|---|
"""  # noqa: E501
)


class Row(typing.NamedTuple):
    """One case of a quantity, here and by the other program."""

    quantity: str
    program: str
    case: str
    unit: str
    here: float
    other: float
    tolerance: typing.Optional[float]  # None: here is at least other
    why: str

    @property
    def error(self):
        return abs(self.here / self.other - 1) if self.other else abs(self.here)

    @property
    def holds(self):
        return self.here >= self.other if self.tolerance is None else self.error <= self.tolerance

    @property
    def text(self):
        figures = (
            f"{self.here:.0f} | at least {self.other:g} | |"
            if self.tolerance is None
            else (f"{self.here:.4g} | {self.other:.4g} | {self.error:.1e} | {self.tolerance:.1e}")
        )
        return (
            f"| {self.quantity}, {self.case}, {self.program} | {self.unit} | {figures} | "
            f"{self.why} | "
            f"{'ok' if self.holds else '**out**'} |"
        )


def summary(rows):
    """A line for each quantity and program."""
    groups = {}
    for row in rows:
        groups.setdefault((row.quantity, row.program), []).append(row)
    for (quantity, program), group in groups.items():
        if group[0].tolerance is None:
            found, allowed = (
                f"{min(row.here for row in group):.0f} to {max(row.here for row in group):.0f}",
                f"at least {group[0].other:g}: {group[0].why}",
            )
        else:
            found, allowed = f"{max(row.error for row in group):.1e}", group[0].why
        out = sum(not row.holds for row in group)
        yield f"| {quantity} | {program} | {len(group)}{f', **{out} out**' if out else ''} | {found} | {allowed} |"  # noqa: E501


def rough_frame(rms_height, correlation_length, seed):
    """Gaussian heights [m] with a Gaussian autocorrelation, periodic; the highest point is at 0."""
    q = 2 * np.pi * np.fft.fftfreq(SIZE, PITCH)
    white = np.fft.fft2(np.random.default_rng(seed).standard_normal((SIZE, SIZE)))
    heights = np.fft.ifft2(
        white * np.exp(-(q[:, None] ** 2 + q[None, :] ** 2) * correlation_length**2 / 8)
    ).real
    heights = (heights - heights.mean()) / heights.std() * rms_height
    return (heights - heights.max()).astype(np.float32).astype(float)  # what a float32 TIFF keeps


def challenge_frame(seed):
    """Heights [m] with the spectrum of the contact-mechanics challenge, as far as the pixels of a
    coarse map show it."""
    lowest, highest = 2 * np.pi / CHALLENGE_ROLL_OFF, 2 * np.pi / CHALLENGE_SHORTEST
    q = 2 * np.pi * np.fft.fftfreq(SIZE, CHALLENGE.pitch)
    q = np.hypot(q[:, None], q[None, :])
    # C(q) = C0 max(q, q_r)^(-2 - 2 H): mean square slope = integral of q^3 C/(2 pi) dq, the flat
    # part and the rest
    flat = (
        lowest ** (-2 - 2 * CHALLENGE_HURST) * (lowest**4 - (2 * np.pi / CHALLENGE_SIDE) ** 4) / 4
    )
    falling = (highest ** (2 - 2 * CHALLENGE_HURST) - lowest ** (2 - 2 * CHALLENGE_HURST)) / (
        2 - 2 * CHALLENGE_HURST
    )
    density = (
        2
        * np.pi
        * CHALLENGE_SLOPE**2
        / (flat + falling)
        * np.maximum(q, lowest) ** (-2 - 2 * CHALLENGE_HURST)
    )
    density[(q == 0) | (q > highest)] = 0
    white = np.fft.fft2(np.random.default_rng(seed).standard_normal((SIZE, SIZE)))
    heights = np.fft.ifft2(white * np.sqrt(density) / CHALLENGE.pitch).real
    return (heights - heights.max()).astype(np.float32).astype(float)


class Ours:
    """predict_scan --half-space."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def solve(
        self,
        heights,
        load=0.0,
        attraction=True,
        thickness=0.0,
        poisson=0.0,
        pair=Pair(),
        hardness=None,
    ):
        """Its record. With a hardness [Pa] the lower body flows."""
        scan = self.folder / "frame.tiff"
        settings = self.folder / "frame_settings.yaml"
        curve = self.folder / "curve.csv"
        tifffile.imwrite(scan, heights.astype(np.float32))
        settings.write_text(
            SETTINGS.format(
                modulus=pair.modulus,
                work=pair.work,
                range=pair.range if attraction else WALL,
                step=STEP if attraction else 2.0,
                attraction=str(attraction).lower(),
                tolerance=TOLERANCE,
                thickness=thickness,
                poisson=poisson,
                hardness=1e13 if hardness is None else hardness,
                flow=str(hardness is not None).lower(),
            )
        )
        self.command = [
            self.program,
            "--json",
            "--config",
            settings,
            "--pitch",
            repr(pair.pitch),
            "--load",
            str(load),
            scan,
        ]
        command = [*self.command, "--half-space", "--curve", curve]
        record = json.loads(
            subprocess.run(command, check=True, capture_output=True, text=True).stdout
        )["half_space"]
        with open(curve, newline="", encoding="utf-8") as file:
            record["curve"] = [
                (float(row["height"]), float(row["force"]), row["direction"])
                for row in csv.DictReader(file)
            ]
        return record

    def pressed(self, heights, load, hardness):
        """Pressure [Pa] and what the surface has lost [m], where nothing attracts and the lower
        body flows."""
        self.solve(heights, load, attraction=False, hardness=hardness)
        maps = [self.folder / name for name in ("frame_pressure.tiff", "frame_deformed.tiff")]
        subprocess.run(
            [
                *self.command,
                "--half-space",
                "--half-space-pressure",
                maps[0],
                "--half-space-deformed",
                maps[1],
            ],
            check=True,
            capture_output=True,
        )
        pressure, deformed = (tifffile.imread(path).astype(float) for path in maps)
        return np.maximum(pressure, 0.0), heights - deformed

    def seconds(self):
        """CPU time that the half-space adds to the last prediction, the least of three."""

        def of(command):
            begin = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run(command, check=True, capture_output=True)
            end = resource.getrusage(resource.RUSAGE_CHILDREN)
            return end.ru_utime + end.ru_stime - begin.ru_utime - begin.ru_stime

        return min(of([*self.command, "--half-space"]) - of(self.command) for _ in range(3))


def tamaas_area(heights, load):
    """Contact area [m^2] by Polonsky and Keer's conjugate gradients."""
    length = SIZE * PITCH
    # lengths in pixels and pressures in E, as its tolerances are absolute
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [SIZE, SIZE], [SIZE, SIZE])
    model.E, model.nu = 1.0, 0.0
    solver = tamaas.PolonskyKeerRey(model, heights / PITCH, 1e-12)
    solver.max_iter = 10000
    solver.solve(load / length**2 / MODULUS)
    return tamaas.Statistics2D.contact(model.traction) * length**2


def contact_mechanics_area(heights, load, **film):
    """Contact area [m^2] by its constrained conjugate gradients.

    @param film  thickness [pixels] and Poisson's ratio of a film on something rigid
    """
    substrate = PeriodicFFTElasticHalfSpace((SIZE, SIZE), 1.0, (SIZE, SIZE), **film)
    system = make_hard_system(
        interaction="hardwall",
        substrate=substrate,
        surface=Topography(heights / PITCH, (SIZE, SIZE)),
    )
    system.minimize_proxy(external_force=load / MODULUS / PITCH**2, pentol=1e-8, maxiter=10000)
    return np.count_nonzero(system.contact_zone) * PITCH**2


def adhesion_curve(heights, lowest, highest, pair):
    """Adhesion with the same law and L-BFGS-B, lengths in z0 and pressures in 8 Gamma/(3 z0).

    @return (Z [m], F [N]) of the way down from `highest` to `lowest` [m] and of that back, and
    seconds. Its mean displacement has a stiffness of its own, so that Z = -offset + mean
    displacement is the height of predict_scan.
    """
    unit = pair.pitch / pair.range
    substrate = PeriodicFFTElasticHalfSpace(
        (SIZE, SIZE), pair.modulus / pair.stress, (SIZE * unit, SIZE * unit)
    )
    interaction = VDW82(c_sr=1 / 8, hamaker=6 * np.pi)  # -1/(2 r^2) + 1/(8 r^8): t = r^-3 - r^-9
    system = make_adhesive_system(
        surface=Topography(heights / pair.range, (SIZE * unit, SIZE * unit)),
        interaction=interaction,
        substrate=substrate,
        system_class=SmoothContactSystem,
    )
    offsets = np.arange(-highest / pair.range, -lowest / pair.range, STEP)
    displacement = np.zeros((SIZE, SIZE))
    branches = []
    begin = time.process_time()
    for way in (offsets, offsets[::-1]):
        points = []
        for offset in way:
            # its first guess must not lie beyond the surface
            gap = displacement - heights / pair.range - offset
            displacement = displacement + np.maximum(0.0, 0.6 - gap)
            result = system.minimize_proxy(
                offset=offset,
                initial_displacements=displacement,
                method="L-BFGS-B",
                tol=None,
                lbounds=heights / pair.range + offset + 0.5,
                options={
                    "gtol": TOLERANCE * unit**2,
                    "ftol": 0,
                    "maxcor": 10,
                    "maxiter": 20000,
                    "maxfun": 40000,
                },
            )
            displacement = np.asarray(result.x).reshape(SIZE, SIZE)
            force = -float(system.compute_normal_force()) * pair.stress * pair.range**2
            points.append(
                (
                    (-offset + displacement.mean()) * pair.range,
                    force,
                    np.abs(result.jac).max() / unit**2,
                )
            )
        branches.append(points)
    return branches, time.process_time() - begin


def largest(points, unit):
    """Largest force [N] over heights of this unit, on the parabola through the largest of the
    points and its neighbours."""
    heights, forces = np.array([p[0] for p in points]), np.array([p[1] for p in points])
    i = int(np.clip(forces.argmax(), 1, len(forces) - 2))
    a, b, c = np.polyfit(heights[i - 1 : i + 2] / unit, forces[i - 1 : i + 2], 2)
    return max(forces.max(), c - b * b / (4 * a) if a < 0 else 0.0)


def area_rows(ours):
    heights = rough_frame(1e-9, 60e-9, 1)
    slope = np.sqrt(np.mean((np.diff(heights, axis=1, append=heights[:, :1]) / PITCH) ** 2) * 2)
    for share in (0.005, 0.02, 0.05, 0.1):
        load = share * MODULUS * slope * (SIZE * PITCH) ** 2
        found = ours.solve(heights, load, attraction=False)["contact_area"]
        for name, area in (
            ("tamaas", tamaas_area(heights, load)),
            ("ContactMechanics", contact_mechanics_area(heights, load)),
        ):
            yield Row(
                "contact area without attraction",
                name,
                f"p/(E rms slope) = {share:g}",
                "m^2",
                found,
                area,
                max(0.02, PITCH**2 / area),
                "2 % or a cell",
            )


def tamaas_displacement(pressure):
    """Of the half-space under this pressure [m], but for its mean."""
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [SIZE, SIZE], [SIZE, SIZE])
    model.E, model.nu = 1.0, 0.0
    model.traction[:] = np.ascontiguousarray(pressure / MODULUS)
    model.solveNeumann()
    return np.asarray(model.displacement).reshape(SIZE, SIZE) * PITCH


def flow_rows(ours):
    """Pressures between 0 and the hardness that leave the gap of a contact even, and wider
    elsewhere, are the only ones that do: the energy is convex."""
    heights = rough_frame(1e-9, 60e-9, 1)
    slope = np.sqrt(np.mean((np.diff(heights, axis=1, append=heights[:, :1]) / PITCH) ** 2) * 2)
    for share, cap in ((0.005, 0.3), (0.02, 0.3), (0.02, 0.6), (0.1, 0.3), (0.1, 0.6)):
        load, hardness = (factor * MODULUS * slope for factor in (share * (SIZE * PITCH) ** 2, cap))
        pressure, lost = ours.pressed(heights, load, hardness)
        is_full = pressure > 0.999 * hardness
        between = (pressure > 0) & ~is_full
        gap = tamaas_displacement(pressure) - heights
        contact = gap[between].mean()
        expected = np.where(is_full, contact - gap, 0.0)
        nearer = np.count_nonzero((pressure <= 0) & (gap < contact - 0.02 * heights.std()))
        wider = np.count_nonzero(is_full & (expected < -0.02 * heights.std()))
        lost_error = np.sqrt(np.mean((lost - expected) ** 2) / np.mean(expected**2))
        case = f"p/(E rms slope) = {share:g}, hardness {cap:g} E rms slope"
        for quantity, unit, here, other, why in (
            ("load", "N", pressure.sum() * PITCH**2, load, "2 %"),
            (
                "rms of the gap in contact below the hardness, of the rms height",
                "",
                gap[between].std() / heights.std(),
                0.0,
                "0.02",
            ),
            (
                "cells apart that are nearer, and full ones that are wider",
                "cells",
                float(nearer + wider),
                0.0,
                "none",
            ),
            ("lost volume", "m^3", lost.sum() * PITCH**2, expected.sum() * PITCH**2, "2 %"),
            ("rms error of the lost heights, of their rms", "", lost_error, 0.0, "0.02"),
        ):
            yield Row(
                f"with flow: {quantity}",
                "displacement of tamaas",
                case,
                unit,
                here,
                other,
                0.02,
                why,
            )


def film_rows(ours):
    heights = rough_frame(1e-9, 60e-9, 1)
    for thickness, poisson, share in (
        (20e-9, 0.3, 0.02),
        (20e-9, 0.3, 0.1),
        (60e-9, 0.45, 0.05),
        (200e-9, 0.0, 0.05),
    ):
        load = share * MODULUS * 0.05 * (SIZE * PITCH) ** 2
        found = ours.solve(heights, load, attraction=False, thickness=thickness, poisson=poisson)[
            "contact_area"
        ]
        area = contact_mechanics_area(heights, load, thickness=thickness / PITCH, poisson=poisson)
        yield Row(
            "contact area without attraction, film on something rigid",
            "ContactMechanics",
            f"{1e9 * thickness:.0f} nm, nu {poisson:g}, p/E = {share * 0.05:g}",
            "m^2",
            found,
            area,
            max(0.01, PITCH**2 / area),
            "1 % or a cell",
        )


def adhesion_rows(ours):
    for name, heights, pair in (
        ("l 60 nm, sigma 1 nm", rough_frame(1e-9, 60e-9, 1), Pair()),
        ("l 100 nm, sigma 3 nm", rough_frame(3e-9, 100e-9, 1), Pair()),
        ("the challenge's statistics, range 30 rho", challenge_frame(1), CHALLENGE),
    ):
        found = ours.solve(heights, pair=pair)
        curve = found["curve"]
        lowest = min(height for height, _, _ in curve)
        highest = max(height for height, _, _ in curve)
        branches, seconds = adhesion_curve(heights, lowest, highest, pair)
        pull_off = largest(branches[1], pair.range)
        yield Row(
            "pull-off force",
            "Adhesion",
            name,
            "N",
            found["pull_off_force"],
            pull_off,
            0.02,
            "2 %: steps of 0.2 z0",
        )
        worst = 0.0
        for direction, points in zip(("APPROACH", "RETRACTION"), branches):
            way = sorted(
                (height, force) for height, force, towards in curve if towards == direction
            )
            at, forces = np.array(way).T
            for height, force, _ in points:
                if at[0] <= height <= at[-1]:
                    worst = max(worst, abs(np.interp(height, at, forces) - force) / pull_off)
        yield Row(
            "largest difference along the curve, of the pull-off force",
            "Adhesion",
            name,
            "",
            worst,
            0.0,
            0.02,
            "2 %: steps of 0.2 z0",
        )
        residual = max(point[2] for points in branches for point in points)
        own = ours.seconds()
        print(
            f"  {name}: Adhesion {seconds:.1f} s for {sum(map(len, branches))} heights, residual "
            f"{residual:.1e}; "
            f"predict_scan {own:.3f} s, {found['iterations']} Newton steps"
        )
        yield Row(
            "its time over ours",
            "Adhesion",
            name,
            "",
            seconds / own,
            40.0,
            None,
            "CPU time of both ways in steps of 0.2 z0, residual 1e-4, one thread",
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--predict-scan", required=True)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path)
    arguments = parser.parse_args()
    tamaas.set_log_level(tamaas.LogLevel.error)
    ours = Ours(arguments.predict_scan, arguments.folder)
    print(
        "| quantity | unit | here | the other | error | tolerance | why | "
        "|\n|---|---|---|---|---|---|---|---|"
    )
    rows = []
    for kind in (area_rows, flow_rows, film_rows, adhesion_rows):
        for row in kind(ours):
            rows.append(row)
            print(row.text, flush=True)
    if arguments.output:
        before = (
            arguments.output.read_text(encoding="utf-8").partition(TITLE)[0]
            if arguments.output.exists()
            else ""
        )
        arguments.output.write_text(
            before + HEADING + "\n".join(summary(rows)) + "\n", encoding="utf-8"
        )
    return 0 if all(row.holds for row in rows) else 1


if __name__ == "__main__":
    raise SystemExit(main())
