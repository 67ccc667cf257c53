"""calibrate: constants come back from made measurements, their intervals hold, and what does not
belong is said."""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import mems_stiction
import numpy as np
import yaml

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from mems_stiction import calibration_places  # noqa: E402
from mems_stiction._settings import values_of  # noqa: E402
from mems_stiction.calibration_constants import WORK, Axis  # noqa: E402
from mems_stiction.calibration_data import measurements_of, pooled, shared_scans  # noqa: E402
from mems_stiction.calibration_fit import Likelihood  # noqa: E402
from mems_stiction.calibration_grid import between_nodes  # noqa: E402
from mems_stiction.calibration_search import Search  # noqa: E402
from module_cases import REPOSITORY, rough  # noqa: E402  (the path comes first)
from tiers import evidence, times  # noqa: E402

PITCH = 10e-9
TRUTH = 0.031  # work of adhesion [J/m^2]
SURFACES = [rough(96, 96, 3e-9, seed) for seed in range(3)]
OXIDE = {
    "lower": {"film_thickness": 2e-9, "hamaker_constant": 261e-21},
    "upper": {"film_thickness": 2e-9, "hamaker_constant": 261e-21},
    "interface": {"retardation_length": 20e-9},
}
LOWER, UPPER = "lower/film_thickness", "upper/film_thickness"
CALIBRATE = str(REPOSITORY / "scripts" / "calibrate")


def force_of(heights, **interface):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mems_stiction.ScanWarning)
        warnings.simplefilter("ignore", mems_stiction.SettingsWarning)
        return mems_stiction.predict(
            heights, PITCH, interface=dict({"work_of_adhesion": TRUTH}, **interface)
        ).pull_off_force


def predicted(heights, config, **settings):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mems_stiction.ScanWarning)
        warnings.simplefilter("ignore", mems_stiction.SettingsWarning)
        return mems_stiction.predict(
            heights,
            PITCH,
            mems_stiction.Settings(config, **{WORK: TRUTH}),
            half_space={"enabled": False},
            **settings,
        )


def measured(value, heights, error=0.2, **others):
    return dict(
        {
            "kind": "pull_off_force",
            "value": value,
            "uncertainty": error * value,
            "scans": heights,
            "pitch": PITCH,
        },
        **others,
    )


def exact():
    """Ten forces as the model has them."""
    return [
        measured(force_of(SURFACES[place % 3]), SURFACES[place % 3], name="tip %d" % place)
        for place in range(10)
    ]


def calibrated(data, config=None, **settings):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mems_stiction.ScanWarning)
        warnings.simplefilter("ignore", mems_stiction.SettingsWarning)
        return mems_stiction.calibrate(data, config, **settings)


class MadeDataTest(unittest.TestCase):
    def test_intervals_of_200_draws_hold_the_truth_and_there_is_no_bias(self):
        data = measurements_of(exact(), None, {})
        search = Search(data, [Axis(WORK, values_of(mems_stiction.Settings()))], lambda: None)
        search.run()
        truth = np.array([datum.value for datum in data])
        covered, logs = 0, []
        for draw in range(200):
            values = truth * (1.0 + 0.2 * np.random.RandomState(draw).standard_normal(len(truth)))
            likelihood = Likelihood(
                values,
                0.2 * values,
                np.zeros(len(truth)),
                ["force"] * len(truth),
                search.surrogate.expected,
                search.surrogate.bounds(),
            )
            fit = likelihood.fit()
            interval = likelihood.interval(fit, 0)
            covered += interval.lower < math.log(TRUTH) < interval.upper
            logs.append(fit.parameters[0] - math.log(TRUTH))
        self.assertGreaterEqual(covered, 180)
        self.assertLessEqual(covered, 196)
        self.assertAlmostEqual(math.exp(np.mean(logs)), 1.0, delta=0.02)

    @evidence
    def test_surfaces_that_scatter_widen_the_interval_as_far_as_the_measurements_show(self):
        model = lambda parameters: np.full(10, math.exp(parameters[0]))  # noqa: E731
        for scatter, lowest, highest in ((0.0, 0.1, 0.3), (0.3, 0.2, 0.6)):
            covered, widths = 0, []
            for draw in range(60):
                random = np.random.RandomState(draw)
                values = (1.0 + 0.1 * random.standard_normal(10)) * np.exp(
                    scatter * random.standard_normal(10)
                )
                likelihood = Likelihood(
                    values, 0.1 * values, np.full(10, 0.3), ["force"] * 10, model, [(-3.0, 3.0)]
                )
                interval = likelihood.interval(likelihood.fit(), 0)
                covered += interval.lower < 0.0 < interval.upper
                widths.append(interval.upper - interval.lower)
            self.assertGreaterEqual(covered, 51)
            self.assertGreater(np.median(widths), lowest)
            self.assertLess(np.median(widths), highest)

    def test_what_scans_leave_open_is_common_to_all_that_rest_on_them(self):
        """Three parts scatter by a tenth, and lie together wherever the surfaces are that the scans
        stand for."""
        model = lambda parameters: np.full(3, math.exp(parameters[0]))  # noqa: E731
        covered = {0.0: 0, 0.3: 0}
        for draw in range(40):
            random = np.random.RandomState(draw)
            values = np.exp(0.3 * random.standard_normal() + 0.1 * random.standard_normal(3))
            for common in covered:
                likelihood = Likelihood(
                    values,
                    1e-3 * values,
                    np.full(3, 0.1),
                    ["force"] * 3,
                    model,
                    [(-3.0, 3.0)],
                    np.full(3, common),
                    np.ones((3, 3)),
                )
                interval = likelihood.interval(likelihood.fit(), 0)
                covered[common] += interval.lower < 0.0 < interval.upper
        self.assertLess(covered[0.0], 20)
        self.assertGreaterEqual(covered[0.3], 35)

    def test_the_error_of_shared_scans_is_that_of_their_covariance(self):
        """Of three measurements the first two rest on one scan, the third on another."""
        values, common = np.array([0.9, 1.3, 0.7]), np.array([0.2, 0.3, 0.4])
        shared = np.array([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        likelihood = Likelihood(
            values,
            0.1 * values,
            np.zeros(3),
            ["force"] * 3,
            lambda parameters: np.full(3, math.exp(parameters[0])),
            [(-3.0, 3.0)],
            common,
            shared,
        )
        covariance = np.diag(np.full(3, 0.1**2)) + shared * np.outer(common, common)
        for parameter in (0.0, 0.4, -2.0):
            logs = np.log(values) - parameter + 0.1**2 / 2  # as measured with a normal error
            expected = logs @ np.linalg.solve(covariance, logs) + math.log(
                np.linalg.det(covariance)
            )
            self.assertAlmostEqual(likelihood.deviance(np.array([parameter])), expected, places=9)

    def test_scans_that_differ_leave_errors_of_their_own(self):
        """Ten parts, each by its own scan, which tells the force of its surface to 40 %: no misfit,
        and no interval without an end."""
        covered = 0
        for draw in range(60):
            random = np.random.RandomState(draw)
            values = (1.0 + 0.1 * random.standard_normal(10)) * np.exp(
                0.4 * random.standard_normal(10)
            )
            likelihood = Likelihood(
                values,
                0.1 * values,
                np.zeros(10),
                ["force"] * 10,
                lambda parameters: np.full(10, math.exp(parameters[0])),
                [(-5.0, 5.0)],
                np.full(10, 0.4),
                np.eye(10),
            )
            fit = likelihood.fit()
            interval = likelihood.interval(fit, 0)
            self.assertLess(fit.chi_square, 30.0)
            self.assertLess(interval.upper - interval.lower, 0.8)
            covered += interval.lower < 0.0 < interval.upper
        self.assertGreaterEqual(covered, 53)

    def test_distances_of_a_measurement_count_how_well_the_others_know_it(self):
        """A force among lengths that hardly go with the constant has only the other force to be
        told from; one on surfaces of its own has their error, too."""
        among_lengths = (
            np.repeat([1.0, 0.1], (2, 8)),
            np.repeat([0.04, 0.02], (2, 8)),
            0.0,
            0.0,
            np.zeros(10, int),
        )
        on_others = np.ones(4), np.full(4, 0.02), 0.03, 0.06, np.array([0, 1, 1, 1])
        for slopes, shares, place, common, surfaces in (among_lengths, on_others):
            count, distances = len(slopes), []
            for draw in range(150):
                random = np.random.RandomState(draw)
                values = (1.0 + shares * random.standard_normal(count)) * np.exp(
                    place * random.standard_normal(count)
                    + common * random.standard_normal(2)[surfaces]
                )
                likelihood = Likelihood(
                    values,
                    shares * values,
                    np.full(count, place),
                    ["%g" % slope for slope in slopes],
                    lambda parameters: np.exp(slopes * parameters[0]),
                    [(-2.0, 2.0)],
                    np.full(count, common),
                    surfaces[:, None] == surfaces,
                )
                distances.append(likelihood._distance(0, list(range(1, count))))
            self.assertAlmostEqual(
                float(np.sqrt(np.mean(np.square(distances)))),
                1.0,
                delta=0.15,
                msg="common error %g" % common,
            )

    def test_one_of_ten_that_does_not_belong_is_named_and_left_out(self):
        data = exact()
        data[4].update(value=2.5 * data[4]["value"], uncertainty=2.5 * data[4]["uncertainty"])
        found = calibrated(data)
        self.assertEqual(list(np.flatnonzero(found.measurements.is_outlier)), [4])
        self.assertRegex(found.statements[0], "^tip 4 does not belong")
        self.assertAlmostEqual(found.work_of_adhesion / TRUTH, 1.0, delta=0.02)

    def test_two_constants_where_surfaces_tell_them_apart(self):
        surfaces = [
            rough(96, 96, rms, seed) for seed, rms in enumerate((0.3e-9, 1e-9, 3e-9, 10e-9))
        ]
        found = calibrated(
            [
                measured(force_of(heights, hamaker_constant=3e-20), heights, 0.05)
                for heights in surfaces
            ]
        )
        self.assertAlmostEqual(found.hamaker_constant / 3e-20, 1.0, delta=0.05)
        self.assertLess(found.hamaker_constant_lower, 3e-20)
        self.assertGreater(found.hamaker_constant_upper, 3e-20)
        self.assertRegex(
            found.statements[-1],
            r"^the measurements tell the Hamaker constant, too: (29|30|31)[0-9.]* zJ \([0-9.]+ to "
            r"[0-9.]+\)$",
        )
        self.assertAlmostEqual(found.work_of_adhesion / TRUTH, 1.0, delta=0.05)

    def test_a_second_constant_that_costs_the_work_of_adhesion_stays_as_configured(self):
        """Both intervals were closed, and that of the work of adhesion was twice as wide for it."""
        surfaces = [rough(96, 96, 1.2e-9, seed) for seed in range(10)]
        found = calibrated(
            [
                measured(force_of(heights, work_of_adhesion=0.07), heights, 0.15)
                for heights in surfaces
            ]
        )
        self.assertTrue(math.isnan(found.hamaker_constant_lower))
        self.assertRegex(found.statements[-1], "do not tell the Hamaker constant apart")
        self.assertLess(math.log(found.work_of_adhesion_upper / found.work_of_adhesion_lower), 0.3)
        self.assertLess(found.work_of_adhesion_lower, 0.07)
        self.assertGreater(found.work_of_adhesion_upper, 0.07)

    def test_the_part_of_humidity_where_several_were_measured(self):
        data = [
            measured(
                force_of(heights, relative_humidity=humidity, contact_angle=0.7),
                heights,
                0.1,
                relative_humidity=humidity,
            )
            for humidity in (0.0, 0.3, 0.6)
            for heights in SURFACES[:2]
        ]
        found = calibrated(data)
        self.assertAlmostEqual(found.contact_angle, 0.7, delta=0.05)
        self.assertLess(found.contact_angle_lower, 0.7)
        self.assertGreater(found.contact_angle_upper, 0.7)
        self.assertRegex(
            found.statements[-1],
            r"^the liquid's angle of contact is 0\.[67][0-9]* rad \(0\.[0-9]+ to [0-9.]+\)$",
        )
        self.assertAlmostEqual(found.work_of_adhesion / TRUTH, 1.0, delta=0.1)

    def test_the_thickness_of_films_where_rough_surfaces_see_under_them(self):
        """Works of rough surfaces see the silicon, forces of smooth ones the oxide."""
        data = []
        for seed, rms in enumerate((0.5e-9, 1e-9, 3e-9, 6e-9, 10e-9)):
            heights = rough(64, 64, rms, seed, 12)
            for kind in ("pull_off_force", "apparent_work_of_adhesion"):
                value = getattr(predicted(heights, OXIDE, **{LOWER: 3e-9, UPPER: 3e-9}), kind)
                data.append(dict(measured(value, heights, 0.03), kind=kind))
        found = calibrated(data, OXIDE)
        self.assertAlmostEqual(found.film_thickness / 3e-9, 1.0, delta=0.1)
        self.assertLess(found.film_thickness_lower, 3e-9)
        self.assertGreater(found.film_thickness_upper, 3e-9)
        self.assertAlmostEqual(found.work_of_adhesion / TRUTH, 1.0, delta=0.05)
        self.assertRegex(
            found.statements[-2],
            r"^the measurements tell the thickness of the films, too: [0-9.]+ nm \([0-9.]+ to",
        )
        self.assertRegex(found.statements[-1], "^the Hamaker constant was not fitted beside it")
        configured = values_of(found.settings)
        self.assertEqual(configured[LOWER], found.film_thickness)
        self.assertEqual(configured[UPPER], found.film_thickness)

    def test_films_of_smooth_surfaces_stay_as_configured(self):
        data = [
            measured(predicted(heights, OXIDE).pull_off_force, heights, 0.1)
            for heights in (rough(64, 64, 0.3e-9, seed, 12) for seed in range(4))
        ]
        found = calibrated(data, OXIDE)
        self.assertEqual(found.film_thickness, 2e-9)
        self.assertTrue(math.isnan(found.film_thickness_lower))
        self.assertIn(
            "the measurements do not tell the thickness of the films apart from the work of "
            "adhesion; it stays at 2.00 nm as configured",
            found.statements,
        )
        self.assertEqual(values_of(found.settings)[LOWER], 2e-9)

    def test_a_contact_potential_where_several_voltages_were_on(self):
        """Whose voltages act while the surfaces are drawn apart: with the potential's sign they
        hold more, against it less."""
        insulated = {"interface": {"insulator_thickness": 4e-9}}
        data = [
            measured(
                predicted(
                    heights, insulated, **{"load/contact_potential": voltage - 0.3}
                ).apparent_work_of_adhesion,
                heights,
                0.05,
                kind="apparent_work_of_adhesion",
                voltage=voltage,
            )
            for heights in (rough(64, 64, 6e-9, seed, 12) for seed in range(3))
            for voltage in (-0.8, 0.0, 0.8)
        ]
        found = calibrated(data, insulated)
        self.assertAlmostEqual(found.contact_potential, -0.3, delta=0.05)
        self.assertLess(found.contact_potential_lower, -0.3)
        self.assertGreater(found.contact_potential_upper, -0.3)
        self.assertRegex(
            found.statements[-1],
            r"^the measurements tell the contact potential, too: -[0-9]+ mV \(-[0-9]+ to -[0-9]+\)",
        )
        configured = values_of(found.settings)
        self.assertEqual(configured["load/contact_potential"], found.contact_potential)
        self.assertLess(configured["uncertainty/contact_potential"], 0.3)
        self.assertEqual(configured["load/voltage"], 0.0)

    def test_a_contact_potential_of_one_voltage_stays_as_configured(self):
        settings = {"interface": {"insulator_thickness": 4e-9}, "load": {"contact_potential": 0.2}}
        found = calibrated(
            [
                measured(predicted(heights, settings).pull_off_force, heights)
                for heights in SURFACES
            ],
            settings,
        )
        self.assertEqual(found.contact_potential, 0.2)
        self.assertIn(
            "these measurements at one voltage do not tell the contact potential; it stays at "
            "200 mV as configured",
            found.statements,
        )
        self.assertAlmostEqual(found.work_of_adhesion / TRUTH, 1.0, delta=0.02)

    def test_the_hamaker_constant_alone(self):
        """Works of rough surfaces that hardly stick go by it: it is told, and the work of adhesion
        stays as configured."""
        surfaces = [rough(96, 96, 10e-9, seed) for seed in range(4)]
        data = []
        for heights in surfaces:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                work = mems_stiction.predict(
                    heights, PITCH, interface={"work_of_adhesion": 1e-3, "hamaker_constant": 3e-20}
                ).apparent_work_of_adhesion
            data.append(
                {
                    "kind": "apparent_work_of_adhesion",
                    "value": work,
                    "uncertainty": 0.1 * work,
                    "scans": heights,
                    "pitch": PITCH,
                }
            )
        found = calibrated(data)
        self.assertTrue(math.isnan(found.work_of_adhesion))
        self.assertAlmostEqual(found.hamaker_constant / 3e-20, 1.0, delta=0.1)
        self.assertIn("the work of adhesion stays at 50.0 mJ/m^2 as configured", found.statements)
        configured = values_of(found.settings)
        self.assertEqual(configured["interface/hamaker_constant"], found.hamaker_constant)
        self.assertLess(configured["uncertainty/hamaker_constant"], 0.5)
        self.assertEqual(configured["interface/work_of_adhesion"], 0.05)
        self.assertIn("work of adhesion not known", found.yaml())

    def test_forces_that_no_work_of_adhesion_explains_end_in_a_sentence(self):
        found = calibrated([measured(1e5 * force_of(SURFACES[0]), SURFACES[0])])
        self.assertTrue(math.isnan(found.work_of_adhesion))
        self.assertRegex(found.statements[0], "do not tell the work of adhesion: it is at least ")
        with self.assertRaisesRegex(mems_stiction.OptionsError, "nothing to configure"):
            found.yaml()

    def test_values_that_no_work_of_adhesion_gives_are_asked_for_their_unit(self):
        nanonewtons = 20.0
        found = calibrated([measured(nanonewtons, SURFACES[0], name="tip 1")])
        self.assertRegex(
            found.statements[1],
            "^tip 1: 20.0 N was measured, and the nearest that any work of adhesion gives is "
            "[0-9.]+ [un]N: is it in SI units, and of these surfaces and this area",
        )

    def test_a_probe_in_micrometres_and_a_work_that_no_solids_have_are_asked_for_their_units(self):
        def said(force, radius):
            datum = {"kind": "pull_off_force", "value": force, "uncertainty": 0.1 * force}
            return calibrated([dict(datum, radius=radius, name="tip 1")]).statements

        probe = "tip 1: a radius of 1.00 m is stated, which no probe has: is it in SI units?"
        work = "hardly any solids have a work of adhesion of "
        for force, radius, is_far, is_high in (
            (300.0, 1.0, True, True),  # nN and um
            (2.0, 1.0, True, False),
            (3e-5, 1e-6, False, True),
            (1e-7, 1e-6, False, False),
            (1e-3, 0.02, False, False),  # a surface force apparatus
        ):
            statements = said(force, radius)
            self.assertEqual(probe in statements, is_far, statements)
            self.assertEqual(any(text.startswith(work) for text in statements), is_high, statements)

    def test_uncertainties_that_leave_all_open_are_told_from_surfaces_that_do(self):
        found = calibrated([measured(2e-8, SURFACES[0], 20.0)])
        self.assertTrue(math.isnan(found.work_of_adhesion))
        self.assertEqual(
            found.statements[0],
            "these measurements do not tell the work of adhesion: their uncertainties leave it "
            "open from 100 uJ/m^2 to 2.00 J/m^2",
        )

    def test_works_of_large_surfaces_that_far_forces_hold_end_in_a_sentence(self):
        """A few of their summits touch: it is Hamaker's constant that gives most of the work."""
        few = {"device_force": {"realisations": 3, "max_cells": 1e4}}
        datum = {
            "kind": "apparent_work_of_adhesion",
            "value": 5e-6,
            "uncertainty": 1e-6,
            "scans": SURFACES[:1],
            "pitch": PITCH,
            "area": 1e-11,
        }
        found = calibrated([datum], **few)
        self.assertTrue(math.isnan(found.work_of_adhesion))
        self.assertRegex(found.statements[0], "tell the work of adhesion: ")


class GridTest(unittest.TestCase):
    """Between the nodes of two constants: what one monotone cubic after the other gives, without a
    jump."""

    X, Y = np.array([0.0, 0.4, 1.1, 1.5, 2.6, 4.0]), np.array([-1.0, -0.2, 0.1, 1.0, 2.2])

    def setUp(self):
        x, y = self.X[:, None, None], self.Y[None, :, None]
        self.values = np.exp(-x / 3.0) * np.tanh(y) * np.array([1.0, 2.0]) + 0.1 * x
        self.between = between_nodes(self.X, self.Y, self.values)

    def test_nodes_and_lines_through_them_are_those_of_one_cubic(self):
        from scipy.interpolate import PchipInterpolator

        for place, x in enumerate(self.X):
            np.testing.assert_allclose(
                self.between([[x, y] for y in self.Y]), self.values[place], atol=1e-14
            )
            np.testing.assert_allclose(
                self.between([[x, 0.7]])[0],
                PchipInterpolator(self.Y, self.values[place])(0.7),
                atol=1e-14,
            )
        for place, y in enumerate(self.Y):
            np.testing.assert_allclose(
                self.between([[0.9, y]])[0],
                PchipInterpolator(self.X, self.values[:, place])(0.9),
                atol=1e-14,
            )

    def test_neither_it_nor_its_slope_jumps(self):
        step = 1e-6
        for x in self.X[1:-1]:
            below, here, above = self.between([[x + shift, 0.7] for shift in (-step, 0.0, step)])
            np.testing.assert_allclose(above - here, here - below, atol=20.0 * step**2)


class KindsTest(unittest.TestCase):
    def test_lengths_of_beams_are_those_of_the_predicted_work(self):
        work = mems_stiction.predict(
            SURFACES[0], PITCH, interface={"work_of_adhesion": TRUTH}
        ).apparent_work_of_adhesion
        beam = {"thickness": 2e-6, "gap": 1e-6, "modulus": 169e9}
        lengths = {"detachment_length": (0.375, "cantilever"), "crack_length": (1.5, "cantilever")}
        for kind, (factor, beam_type) in lengths.items():
            # Mastrangelo and Hsu 1993; de Boer and Michalske 1999
            length = (factor * 169e9 * 2e-6**3 * 1e-6**2 / work) ** 0.25
            datum = dict(
                beam,
                kind=kind,
                value=length,
                uncertainty=0.01 * length,
                scans=SURFACES[0],
                pitch=PITCH,
                beam_type=beam_type,
            )
            self.assertAlmostEqual(
                calibrated([datum]).work_of_adhesion / TRUTH, 1.0, delta=0.02, msg=kind
            )

    def test_a_smooth_sphere_lies_between_jkr_and_dmt(self):
        radius = 1e-6
        force = 2 * math.pi * radius * TRUTH  # DMT
        found = calibrated(
            [
                {
                    "kind": "pull_off_force",
                    "value": force,
                    "uncertainty": 0.01 * force,
                    "radius": radius,
                }
            ]
        )
        self.assertGreater(found.work_of_adhesion, 0.98 * TRUTH)
        self.assertLess(found.work_of_adhesion, 1.02 * TRUTH * 4 / 3)  # JKR
        self.assertFalse(any("may be out" in line for line in found.statements))

    def test_a_sphere_that_is_so_soft_that_its_force_is_doubted_is_told(self):
        radius = 10e-6
        force = 1.5 * math.pi * radius * TRUTH  # JKR
        soft = {"youngs_modulus": 1e8}
        found = calibrated(
            [
                {
                    "kind": "pull_off_force",
                    "value": force,
                    "uncertainty": 0.01 * force,
                    "radius": radius,
                    "name": "bead",
                }
            ],
            lower=soft,
            upper=soft,
        )
        told = [line for line in found.statements if "may be out by more than 1.3" in line]
        self.assertEqual(len(told), 1, found.statements)
        self.assertIn("bead", told[0])

    def test_a_sphere_on_a_rough_surface_scatters_from_place_to_place(self):
        found = calibrated([measured(2e-8, SURFACES[0], 0.01, radius=0.5e-6)])
        self.assertGreater(found.work_of_adhesion_upper, 1.2 * found.work_of_adhesion)

    def test_a_probe_keeps_its_shape_and_its_places_whatever_cleans_the_scan(self):
        def spread(tilt, **preprocessing):
            scan = SURFACES[0] + tilt * np.arange(96)
            found = calibrated(
                [measured(2e-8, scan, 0.01, radius=0.5e-6)], preprocessing=preprocessing
            )
            return (
                found.work_of_adhesion,
                found.work_of_adhesion_upper / found.work_of_adhesion_lower,
            )

        plain = spread(0.0)
        self.assertGreater(plain[1], 1.5)
        for level in ("plane", "polynomial"):
            for found, expected in zip(spread(1e-10, level=level), plain):
                self.assertAlmostEqual(found / expected, 1.0, delta=0.25, msg=level)

    def test_an_area_is_judged_by_made_surfaces(self):
        """The mean logarithm of realisations; what the device's deviation has beyond their scatter
        is common to all such places."""
        (measurement,) = checked([measured(1e-7, SURFACES, 0.01, area=4e-12)], FEW)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            measurement.prepare([{WORK: TRUTH}])
            (device,) = mems_stiction._device.predict_device_under(
                measurement.place.scans,
                4e-12,
                None,
                [mems_stiction.Settings(measurement.place._base, **{WORK: TRUTH})],
            )
        logs = np.log(device.realisations.pull_off_force)
        self.assertEqual(len(logs), 8)  # 2.5 times 3, for one place
        shift = math.log(device.pull_off_force) - np.median(logs)
        self.assertAlmostEqual(
            math.log(measurement.expected({WORK: TRUTH})), np.mean(logs) + shift, places=9
        )
        self.assertAlmostEqual(measurement.scatter({WORK: TRUTH}), np.std(logs, ddof=1), places=12)
        common, scatter = measurement.common({WORK: TRUTH}), measurement.scatter({WORK: TRUTH})
        self.assertGreaterEqual(common, scatter / math.sqrt(len(logs)))  # of a mean of so many
        self.assertLess(math.hypot(common, scatter), device.force_deviation)

    def test_what_scans_leave_open_is_not_the_chance_in_two_estimates_of_one_scatter(self):
        """Beside the law's own error, and that of the mean of the realisations."""
        own, scatter, count = 0.12, 0.1, 20
        once_more = 1.0 + 1.0 / count
        for of_scans, more in ((0.0, 0.03), (0.3, 0.05)):
            random = np.random.RandomState(1)
            found = []
            for _ in range(2000):
                stated = scatter * random.standard_normal(count)
                others = math.hypot(scatter, of_scans) * random.standard_normal(count)
                largest = max(np.var(stated, ddof=1), np.var(others, ddof=1))
                deviation = math.sqrt(once_more * (largest + own**2))
                found.append(calibration_places._sampled(1.0, np.exp(stated), deviation)[2] ** 2)
            expected = once_more * (of_scans**2 + own**2) + scatter**2 / count
            self.assertAlmostEqual(np.mean(found) / expected, 1.0, delta=more)

    def test_the_larger_of_two_estimates_of_a_variance_exceeds_it(self):
        of_exponentials = calibration_places.excess_of_larger(2)
        self.assertAlmostEqual(of_exponentials, 0.5, places=12)
        random = np.random.RandomState(2)
        pairs = random.chisquare(7, (2, 100000)) / 7.0
        self.assertAlmostEqual(
            calibration_places.excess_of_larger(7), pairs.max(axis=0).mean() - 1.0, delta=0.005
        )

    def test_several_constants_have_the_forces_of_each_and_their_surfaces_are_made_once(self):
        data = checked([measured(1e-7, SURFACES, area=4e-12)], FEW)
        constants = [{WORK: 0.01}, {WORK: 0.08}]
        calls = []
        under = calibration_places.predict_device_under
        with (
            mock.patch.object(
                calibration_places,
                "predict_device_under",
                side_effect=lambda *given: calls.append(len(given[3])) or under(*given),
            ),
            warnings.catch_warnings(),
        ):
            warnings.simplefilter("ignore")
            data[0].prepare(constants)
            together = [data[0].expected(one) for one in constants]
            (other,) = checked([measured(1e-7, SURFACES, area=4e-12)], FEW)
            alone = [other.expected(one) for one in constants]
        self.assertEqual(calls, [2, 1, 1])
        self.assertEqual(together, alone)


FEW = {"device_force": {"realisations": 3, "max_cells": 1e4}}


def checked(data, settings=None):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mems_stiction.SettingsWarning)
        return measurements_of(data, None, settings or {})


class PlacesTest(unittest.TestCase):
    """Which measurements share what, and where the scan is what was measured."""

    SIDE = 96 * PITCH

    def test_a_scan_of_the_measured_area_is_the_place_that_was_measured(self):
        for area in (None, self.SIDE**2, 9.2e-13):  # as stated with two digits
            place = checked([measured(1e-7, SURFACES[0], area=area)])[0].place
            self.assertTrue(place.is_frame, msg=area)
            self.assertEqual(place.figures({WORK: TRUTH}).force, force_of(SURFACES[0]))
        cropped = {
            "preprocessing": {
                "region": {"left": 0.0, "top": 0.0, "width": self.SIDE / 2, "height": self.SIDE}
            }
        }
        self.assertTrue(
            checked([measured(1e-7, SURFACES[0], area=self.SIDE**2 / 2)], cropped)[0].place.is_frame
        )
        for others in (
            {"area": 4 * self.SIDE**2},
            {"area": self.SIDE**2, "contacts": 4},
            {"area": self.SIDE**2, "scans": SURFACES[:2]},
        ):
            self.assertTrue(
                checked([measured(1e-7, SURFACES[0], **others)])[0].place.is_made, msg=others
            )

    def test_the_same_scan_is_common_and_others_are_independent(self):
        """Known by its heights: another array or file of the same scan is the same one."""
        again = np.array(SURFACES[0])
        data = checked(
            [
                measured(1e-7, scans, area=4e-12)
                for scans in (SURFACES[0], again, SURFACES[1], SURFACES[:2])
            ]
        )
        np.testing.assert_allclose(
            shared_scans(data),
            [[1, 1, 0, 0.5**0.5], [1, 1, 0, 0.5**0.5], [0, 0, 1, 0.5**0.5], [0.5**0.5] * 3 + [1]],
        )
        self.assertIs(data[0].place, data[1].place)
        self.assertEqual(
            len({datum.place._seed() for datum in data}), 3
        )  # chance is no error of all of them

    def test_a_scan_that_several_measurements_rest_on_is_the_place_of_none(self):
        (own,) = checked([measured(1e-7, SURFACES[0], area=4e-12)])
        self.assertTrue(values_of(own.place._base)["device_force/own_long_waves"])
        for datum in checked([measured(1e-7, SURFACES[0], area=area) for area in (4e-12, 8e-12)]):
            self.assertFalse(values_of(datum.place._base)["device_force/own_long_waves"])

    def test_values_of_one_scan_that_differ_by_more_than_their_uncertainties_are_of_other_places(
        self,
    ):
        force = force_of(SURFACES[0])

        def is_made(factors):
            return checked(
                [
                    measured(factor * force, SURFACES[0], 0.1, area=self.SIDE**2)
                    for factor in factors
                ]
            )[0].place.is_made

        self.assertFalse(is_made((0.9, 1.0, 1.1, 0.95, 1.05)))
        self.assertFalse(is_made((0.9, 1.0, 1.1, 0.95, 2.5)))  # one does not belong
        self.assertTrue(is_made((0.5, 0.7, 1.0, 1.4, 2.0)))

    def test_many_places_have_fewer_realisations_than_one_and_tell_their_scatter_together(self):
        data = checked(
            [measured(1e-7, rough(32, 32, 3e-9, seed), area=1e-12) for seed in range(10)]
        )
        self.assertEqual({datum.place.realisations for datum in data}, {3})
        scatters = pooled([0.2] * 9 + [0.8], data)
        mean = (9 * 0.2**2 + 0.8**2) / 10
        self.assertAlmostEqual(scatters[9] ** 2, (2 * 0.8**2 + 8 * mean) / 10)
        self.assertEqual(
            checked([measured(1e-7, SURFACES[0], area=4e-12)])[0].place.realisations, 20
        )


class OwnScansTest(unittest.TestCase):
    """Ten forces, each of a frame with its own scan, whose area it is."""

    def test_they_tell_the_work_of_adhesion(self):
        covered, logs = 0, []
        for draw in range(times(2, 4)):
            random = np.random.RandomState(draw)
            truth, rms_height = 0.02 * 7.5 ** random.uniform(), 1e-9 * 4.0 ** random.uniform()
            data = []
            for place in range(10):
                heights = rough(128, 128, rms_height, 100 * draw + place)
                value = force_of(heights, work_of_adhesion=truth) * (
                    1.0 + 0.15 * random.standard_normal()
                )
                data.append(measured(value, heights, 0.15, area=(128 * PITCH) ** 2))
            found = calibrated(data)
            covered += found.work_of_adhesion_lower < truth < found.work_of_adhesion_upper
            logs.append(math.log(found.work_of_adhesion / truth))
        # a sound interval misses two of four in 1.4 % of cases, both of two in 0.3 %
        self.assertGreaterEqual(covered, times(1, 3))
        self.assertAlmostEqual(float(np.mean(logs)), 0.0, delta=0.1)


class DocumentTest(unittest.TestCase):
    def test_the_measurements_of_the_document_are_read(self):
        text = (REPOSITORY / "doc" / "process.md").read_text(encoding="utf-8")
        listed = yaml.safe_load(text.split("```yaml\n")[1].split("```")[0])
        for datum in listed:
            datum.update(scans=SURFACES[0], pitch=PITCH)
        data = measurements_of(listed, None, {})
        self.assertEqual(
            [datum.kind for datum in data],
            ["pull_off_force", "pull_off_force", "detachment_length", "crack_length"],
        )
        self.assertEqual([datum.value for datum in data], [2.1e-7, 6e-6, 3.5e-4, 2.4e-4])
        self.assertEqual([datum.place.humidity for datum in data], [0.0, 0.0, 0.0, 0.4])


class FacesTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def run_program(self, *arguments):
        return subprocess.run(
            [sys.executable, CALIBRATE, *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )

    def write_list(self):
        listed = []
        for place, heights in enumerate(SURFACES):
            np.save(str(self.path / ("scan%d.npy" % place)), heights)
            force = float(force_of(heights))
            listed.append(
                {
                    "kind": "pull_off_force",
                    "value": force,
                    "uncertainty": 0.1 * force,
                    "scans": "scan%d.npy" % place,
                    "pitch": PITCH,
                    "name": "dimple %d" % place,
                }
            )
        (self.path / "measured.yaml").write_text(yaml.safe_dump(listed))
        return self.path / "measured.yaml"

    def test_the_program_writes_a_configuration_that_the_verdict_takes(self):
        calibrated_yaml, picture = self.path / "process.yaml", self.path / "fit.png"
        run = self.run_program(
            "--json", "-o", calibrated_yaml, "--picture", picture, self.write_list()
        )
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        record = json.loads(run.stdout)
        self.assertAlmostEqual(record["work_of_adhesion"] / TRUTH, 1.0, delta=0.02)
        self.assertEqual(record["version"], mems_stiction.__version__)
        values = values_of(mems_stiction.Settings(calibrated_yaml))
        self.assertEqual(values["interface/work_of_adhesion"], record["work_of_adhesion"])
        # lognormal with this relative deviation: the interval comes back
        spread = math.sqrt(math.log1p(values["uncertainty/work_of_adhesion"] ** 2))
        self.assertAlmostEqual(
            math.exp(2 * 1.96 * spread)
            / (record["work_of_adhesion_upper"] / record["work_of_adhesion_lower"]),
            1.0,
            delta=0.01,
        )
        self.assertIn("dimple 2, pull_off_force", calibrated_yaml.read_text())
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")

    def test_measurements_that_tell_nothing_end_with_1_and_write_no_configuration(self):
        listed = yaml.safe_load(self.write_list().read_text())[:1]
        listed[0].update(value=1e-2, uncertainty=1e-3)
        (self.path / "measured.yaml").write_text(yaml.safe_dump(listed))
        run = self.run_program("-o", self.path / "process.yaml", self.path / "measured.yaml")
        self.assertEqual(run.returncode, 1)
        self.assertIn("do not tell the work of adhesion", run.stdout)
        self.assertFalse((self.path / "process.yaml").exists())

    def test_the_program_takes_what_is_implausible_if_told_to_and_counts_warnings_if_strict(self):
        (self.path / "odd.yaml").write_text("device: {beam_length: 1000.0}\n")
        call = ("--config", self.path / "odd.yaml", self.write_list())
        refused = self.run_program(*call)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--accept-implausible", refused.stderr)
        accepted = self.run_program("--accept-implausible", *call)
        self.assertEqual(accepted.returncode, 0, accepted.stderr)
        self.assertIn("calibrate: warning: device/beam_length 1000", accepted.stderr)
        strict = self.run_program("--accept-implausible", "--strict", *call)
        self.assertEqual(strict.returncode, 1)
        self.assertRegex(strict.stderr, "\ncalibrate: [0-9]+ warnings?, and --strict takes none\n$")

    def test_the_program_names_what_is_wrong(self):
        run = self.run_program(self.path / "none.yaml")
        self.assertEqual(run.returncode, 2)
        self.assertRegex(run.stderr, r"^calibrate: .*none\.yaml: [^\n]*\n$")
        bomb = "".join(
            "- &a%d [%s]\n" % (level, ", ".join(["*a%d" % (level - 1)] * 10 if level else ["1"]))
            for level in range(10)
        )
        for text, words in (
            (
                "scans: &s [*s]\n",
                "line 1: an alias stands inside what it names, so that the text contains itself",
            ),
            ("- scans: &s\n  - *s\n", "line 2: an alias stands inside what it names"),
            (bomb, "line 5: the text holds more than 10000 values"),
            ("[" * 3000, "line 1: more than 32 levels"),
            ("- value: 2026-99-99\n", "has a value that cannot be read: month must be"),
        ):
            (self.path / "loop.yaml").write_text(text)
            self.assertRegex(
                self.run_program(self.path / "loop.yaml").stderr,
                r"^calibrate: [^\n]*loop\.yaml: %s[^\n]*\n$" % words,
            )
        (self.path / "text.yaml").write_text("kind: pull_off_force\n")
        self.assertRegex(
            self.run_program(self.path / "text.yaml").stderr,
            r"^calibrate: .*text\.yaml: must be a list",
        )
        for text, lines in (
            ("- kind: pull_off_force\n  value: 2e-8\n  value: 9e-8\n", (3, 2)),
            ("- {value: 2e-8, value: 9e-8}\n", (1, 1)),
        ):
            (self.path / "twice.yaml").write_text(text)
            self.assertRegex(
                self.run_program(self.path / "twice.yaml").stderr,
                r"^calibrate: .*twice\.yaml: value: given in line %d and before in line %d, must "
                r"be given once\n$" % lines,
            )

    def test_each_wrong_measurement_is_named(self):
        good = measured(1e-7, SURFACES[0])
        for changed, words in (
            (
                {"kind": "force"},
                r"measurements\[0\]/kind: 'force' is not allowed, must be one of pull_off_force",
            ),
            ({"value": -1}, r"measurements\[0\]/value: -1 is not allowed, must be a number > 0"),
            ({"value": "1 nN"}, r"measurements\[0\]/value: '1 nN' is not allowed"),
            ({"uncertainty": 0}, r"measurements\[0\]/uncertainty: 0 is not allowed"),
            (
                {"thickness": 1e-6},
                r"measurements\[0\]/thickness: there is no such key for pull_off_force",
            ),
            ({"scans": None}, r"measurements\[0\]/scans: are missing"),
            (
                {"radius": 1e-6, "area": 1e-12},
                r"measurements\[0\]/radius: is not allowed with area",
            ),
            ({"relative_humidity": 1.5}, r"measurements\[0\]: interface/relative_humidity"),
            (
                {"name": 0o17},
                r"measurements\[0\]/name: 15 is not allowed, must be a text: quote it",
            ),
            (
                {"kind": ["force"]},
                r"measurements\[0\]/kind: \['force'\] is not allowed, must be one of "
                r"pull_off_force",
            ),
            ({"value": True}, r"measurements\[0\]/value: True is not allowed, must be a number"),
            ({"contacts": 4}, r"measurements\[0\]/contacts: is not allowed without area"),
            (
                {"area": 1e-12, "contacts": -2},
                r"measurements\[0\]/contacts: -2 is not allowed, must be an integer in \[1, ",
            ),
            (
                {"area": 1e-12, "contacts": "many"},
                r"measurements\[0\]/contacts: 'many' is not allowed, must be an integer",
            ),
        ):
            with self.assertRaisesRegex(mems_stiction.OptionsError, words):
                calibrated([dict(good, **changed)])
        for changed, words in (
            ({"pitch": "10 nm"}, r"^tip 3: pitch: '10 nm' is not allowed"),
            ({"scans": np.full((9, 9), np.nan)}, "^tip 3: .*no valid pixel"),
            ({"scans": "none.gwy"}, "^tip 3: none.gwy: there is no such file"),
        ):
            with self.assertRaisesRegex(mems_stiction.Error, words):
                calibrated([dict(good, name="tip 3", **changed)])
        with self.assertRaisesRegex(
            mems_stiction.OptionsError,
            r"measurements\[0\]/kind: is missing, must be one of pull_off_force",
        ):
            calibrated([{name: value for name, value in good.items() if name != "kind"}])
        with self.assertRaisesRegex(mems_stiction.OptionsError, "an empty list"):
            calibrated([])
        with self.assertRaisesRegex(mems_stiction.OptionsError, "must be a list of dictionaries"):
            calibrated(good)
        with self.assertRaisesRegex(
            mems_stiction.OptionsError, "beam_type: 'bridge' is not allowed"
        ):
            calibrated(
                [
                    dict(
                        good,
                        kind="crack_length",
                        thickness=1e-6,
                        gap=1e-6,
                        modulus=1e11,
                        beam_type="bridge",
                    )
                ]
            )

    def test_progress_ends_it_where_it_throws(self):
        shares = []

        def stop(share):
            shares.append(share)
            if len(shares) == 3:
                raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            calibrated([measured(1e-7, SURFACES[0])], on_progress=stop)
        self.assertEqual(shares, sorted(shares))


if __name__ == "__main__":
    unittest.main()
