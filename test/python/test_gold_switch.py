"""The gold switch of doc/process.md: the force that opens it rises with the load that closed it, as
by the half-space."""

import pathlib
import unittest
import warnings

import mems_stiction

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
GOLD = str(REPOSITORY / "config" / "gold_gold.yaml")
ROUGHNESS = {
    "type": "self_affine",
    "seed": 1,
    "self_affine": {"rms_height": 3e-9, "rolloff_wavelength": 200e-9, "cutoff_wavelength": 16e-9},
}


class GoldSwitchTest(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore")
        self.pad = mems_stiction.generate((128, 128), 4e-9, counter_surface=ROUGHNESS)

    def force(self, pressure, **settings):
        return mems_stiction.predict(
            self.pad, config=GOLD, load={"pressure": pressure}, **settings
        ).pull_off_force

    def test_the_force_rises_with_the_load_that_closed_it(self):
        forces = [self.force(pressure) for pressure in (0.0, 10e6, 30e6, 100e6)]
        self.assertEqual(forces, sorted(forces))
        self.assertGreater(forces[2], 5 * forces[0])
        elastic = [
            self.force(pressure, approach={"deformation": "elastic"}) for pressure in (0.0, 100e6)
        ]
        self.assertAlmostEqual(elastic[1] / elastic[0], 1.0, delta=0.02)  # steps of the way out

    def test_the_half_space_says_the_same(self):
        solved = mems_stiction.half_space(self.pad, config=GOLD, load={"pressure": 30e6})
        self.assertEqual(solved.status, "SOLVED")
        self.assertLess(abs(self.force(30e6) / solved.pull_off_force - 1), 0.25)


if __name__ == "__main__":
    unittest.main()
