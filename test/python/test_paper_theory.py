"""The theory that doc/paper.md draws beside the model, against its own limits and values of
others."""

import math
import pathlib
import sys
import unittest

import numpy as np
from scipy import integrate

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "studies"))

from paper import theory  # noqa: E402


class SphereTest(unittest.TestCase):
    def test_states_of_jkr_in_maugis_units(self):
        """Closed forms; the printed digits of Maugis 1992."""
        self.assertAlmostEqual(theory.jkr_load(1.5 ** (1 / 3)), -1.5, 12)  # fixed load
        self.assertAlmostEqual(theory.jkr_load(theory.LAST_RADIUS), -5 / 6, 12)
        self.assertAlmostEqual(theory.jkr_approach(theory.LAST_RADIUS), -0.908560, 6)
        self.assertAlmostEqual(theory.jkr_load(theory.UNLOADED_RADIUS), 0.0, 12)
        self.assertAlmostEqual(theory.jkr_approach(theory.UNLOADED_RADIUS), 1.100642, 6)
        self.assertAlmostEqual(theory.jkr_approach(theory.FIRST_RADIUS), 0.0, 12)
        self.assertAlmostEqual(theory.jkr_load(5.0), 97.613872, 6)

    def test_the_load_is_the_derivative_of_the_energy(self):
        step = 1e-6
        for radius in (0.7, 1.0, 1.8, 4.0):
            energy = theory.jkr_energy(radius + step) - theory.jkr_energy(radius - step)
            approach = theory.jkr_approach(radius + step) - theory.jkr_approach(radius - step)
            # load pi w R times approach (pi^2 w^2 R/K^2)^(1/3) is the unit of energy, pi w (radius
            # of contact)^2
            self.assertAlmostEqual(
                -energy / approach, theory.jkr_load(radius), 6
            )  # central difference, round-off 1e-10/step
            slope = approach / (2 * step)
            self.assertAlmostEqual(slope, theory.jkr_approach_slope(radius), 7)

    def test_six_tenths_of_the_surface_energy_remain_without_load(self):
        radius = theory.UNLOADED_RADIUS
        self.assertAlmostEqual(theory.jkr_energy(radius) / radius**2, 0.6, 12)


class GreenwoodWilliamsonTest(unittest.TestCase):
    def test_exponential_heights_have_the_closed_form(self):
        for exponent in (0, 0.5, 1, 1.5, 2.5):
            for separation in (0.0, 1.0, 4.0):
                value = theory.greenwood_williamson(
                    exponent, separation, density=lambda s: math.exp(-s), highest=60.0
                )
                self.assertAlmostEqual(
                    value / (math.gamma(exponent + 1) * math.exp(-separation)), 1.0, 7
                )

    def test_gaussian_heights_at_zero_separation_have_the_closed_form(self):
        for exponent in (0, 1, 1.5, 2, 3):
            value = theory.greenwood_williamson(exponent, 0.0)
            self.assertAlmostEqual(
                value,
                2 ** (exponent / 2 - 1) * math.gamma((exponent + 1) / 2) / math.sqrt(math.pi),
                9,
            )

    def test_the_published_table(self):
        for separation, value in ((0, 0.430020), (1, 0.075668), (2, 0.006648), (3, 0.000264)):
            self.assertAlmostEqual(
                theory.greenwood_williamson(1.5, separation), value, delta=5.1e-7
            )  # its digits

    def test_jkr_summits_without_adhesion_carry_what_hertz_says(self):
        """Large theta: the unit of approach goes to 0 against the rms, and radius^3 is
        (approach/unit)^(3/2)."""
        unit = theory.unit_approach(1e9)
        load = theory.over_contacts(theory.jkr_load, 0.5, unit, theory.FIRST_RADIUS, 1.0)
        self.assertAlmostEqual(
            load * unit**1.5 / theory.greenwood_williamson(1.5, 0.5), 1.0, 3
        )  # adhesion: unit^(3/4)


class FullerTaborTest(unittest.TestCase):
    def test_smooth_surfaces_pull_off_with_all_summits_at_once(self):
        self.assertAlmostEqual(theory.fuller_tabor(1e-3), 1.0, 4)

    def test_rough_surfaces_do_not_adhere(self):
        values = [theory.fuller_tabor(parameter) for parameter in (1, 5, 15, 30, 60)]
        self.assertTrue(all(b < 0.5 * a for a, b in zip(values, values[1:])), values)
        self.assertLess(values[-1], 1e-6)

    def test_the_curve(self):
        for parameter, value in (
            (0.1, 0.98879),
            (0.5, 0.87997),
            (1, 0.73346),
            (2, 0.51190),
            (5, 0.18548),
            (10, 0.03642),
            (15, 7.083e-3),
        ):
            self.assertAlmostEqual(
                theory.fuller_tabor(parameter) / value, 1.0, 3
            )  # four digits are given


class RestTest(unittest.TestCase):
    def test_smooth_surfaces_rest_on_all_summits_as_if_each_were_alone(self):
        """theta to 0: the rms vanishes against the unit of approach."""
        unit = theory.unit_approach(1e-4)
        alone = (
            math.pi
            * theory.SUMMITS.density
            * theory.SUMMITS.radius
            * unit
            * theory.UNLOADED_RADIUS**2
        )
        for rest in (theory.rest_of_jkr_summits(1e-4), theory.rest_of_cap_summits(1e-4)):
            self.assertAlmostEqual(rest.share, 1.0, 9)
            self.assertAlmostEqual(
                rest.area / alone, 1.0, 3
            )  # second order in rms over unit: (2e-3)^2, times a slope
            self.assertAlmostEqual(rest.energy / (0.6 * alone), 1.0, 3)

    def test_the_separation_is_that_of_a_sphere_alone(self):
        unit = theory.unit_approach(1e-4)
        self.assertAlmostEqual(theory.rest_of_jkr_summits(1e-4).separation / unit, -1.100642, 3)
        self.assertAlmostEqual(
            theory.rest_of_cap_summits(1e-4).separation / unit, -(theory.UNLOADED_RADIUS**2) / 2, 3
        )

    def test_loads_balance_summit_by_summit(self):
        """A second way: trapezoids over heights, radii from a table."""
        parameter = 6.0
        rest = theory.rest_of_jkr_summits(parameter)
        unit = theory.unit_approach(parameter)
        heights = np.linspace(rest.separation, 8 * theory.SUMMITS.rms, 200001)
        radii = np.interp(
            (heights - rest.separation) / unit,
            [theory.jkr_approach(a) for a in np.linspace(theory.FIRST_RADIUS, 8, 20001)],
            np.linspace(theory.FIRST_RADIUS, 8, 20001),
        )
        density = (
            np.exp(-0.5 * (heights / theory.SUMMITS.rms) ** 2)
            / math.sqrt(2 * math.pi)
            / theory.SUMMITS.rms
        )
        loads = (radii**3 - np.sqrt(6 * radii**3)) * density
        balance = integrate.trapezoid(loads, heights) / integrate.trapezoid(np.abs(loads), heights)
        self.assertAlmostEqual(balance, 0.0, 6)  # trapezoids of 4e-5 rms
        self.assertAlmostEqual(integrate.trapezoid(density, heights) / rest.share, 1.0, 6)

    def test_everything_falls_with_the_adhesion_parameter(self):
        for rest_of in (theory.rest_of_jkr_summits, theory.rest_of_cap_summits):
            rests = [rest_of(parameter) for parameter in (0.1, 0.5, 1, 3, 10, 30, 100)]
            for figure in ("share", "area", "energy"):
                values = [getattr(rest, figure) for rest in rests]
                self.assertTrue(
                    all(b < a or a > 1 - 1e-9 for a, b in zip(values, values[1:])), (figure, values)
                )


if __name__ == "__main__":
    unittest.main()
