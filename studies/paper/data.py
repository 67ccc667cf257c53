"""What the core returned, as arrays: the sweep of figures 6 and 7, and the maps of single cases."""

import json
import math

import numpy as np

from paper import cases


def number(value):
    """JSON's null stands for what is not finite."""
    return math.nan if value is None else float(value)


class Sweep:
    """Figures by material, series, adhesion parameter and seed."""

    def __init__(self, study, results):
        self.parameters = study.adhesion_parameters
        self._study, self._results = study, results

    def values(self, material, series, field):
        """adhesion parameters x seeds"""
        return np.array(
            [[number(one[field]) for one in row] for row in self._rows(material, series)]
        )

    def status(self, material, series):
        """adhesion parameters x seeds, words"""
        return np.array([[one["status"] for one in row] for row in self._rows(material, series)])

    def bonded_share(self, material, series):
        return np.mean(self.status(material, series) == "BONDED", axis=1)

    def _rows(self, material, series):
        return [
            [
                self._results["sweep/%s/%s/%d/%d" % (material.name, series, place, seed)]
                for seed in range(1, self._study.seeds + 1)
            ]
            for place in range(len(self.parameters))
        ]


class HalfSpaceFrames:
    """The small frames that the half-space was asked about: adhesion parameters x seeds."""

    def __init__(self, study, results):
        self.parameters = study.half_space_parameters
        self._study, self._results = study, results

    def model(self, material, field):
        return np.array([[number(one[field]) for one in row] for row in self._rows(material)])

    def half_space(self, material, field):
        """NaN where it was not solved."""
        return np.array(
            [
                [
                    number(one["half_space_" + field])
                    if one["half_space_status"] == "SOLVED"
                    else math.nan
                    for one in row
                ]
                for row in self._rows(material)
            ]
        )

    def _rows(self, material):
        return [
            [
                self._results["half_space/%s/%d/%d" % (material.name, place, seed)]
                for seed in range(1, self._study.half_space_seeds + 1)
            ]
            for place in range(len(self.parameters))
        ]


class PressedFrames:
    """The small frames under a load: arrays of flow and of the elastic case, parameters x presses x
    seeds."""

    def __init__(self, study, results):
        self._study, self._results = study, results

    def with_and_without_flow(self, material, field):
        """A pair of arrays. `field` of the default; "half_space_..." of the half-space, NaN where
        it was not solved."""
        return tuple(
            np.array(
                [
                    [
                        [
                            self._value(
                                cases.pressed_name(material, is_flowing, number, press, seed), field
                            )
                            for seed in range(1, self._study.half_space_seeds + 1)
                        ]
                        for press in self._study.presses
                    ]
                    for number in range(len(self._study.pressed_parameters))
                ]
            )
            for is_flowing in (True, False)
        )

    def _value(self, name, field):
        one = self._results[name]
        if field.startswith("half_space_") and one["half_space_status"] != "SOLVED":
            return math.nan
        return number(one[field])


BAND = (16, 84)  # percentiles of the seeds: one standard deviation to either side, were they normal


def band(values):
    """Mean over the seeds and the two ends of its band, for each adhesion parameter."""
    return (
        np.mean(values, axis=1),
        np.percentile(values, BAND[0], axis=1),
        np.percentile(values, BAND[1], axis=1),
    )


def crossing(parameters, values, level, scale=math.log):
    """The adhesion parameter at which values fall through the level for the last time, interpolated
    on a logarithmic axis of parameters and the given scale of values; nan if they do not."""
    found = math.nan
    for left, right, before, after in zip(parameters, parameters[1:], values, values[1:]):
        if before >= level > after:
            part = (scale(before) - scale(level)) / (scale(before) - scale(after))
            found = left * (right / left) ** part
    return found


class Maps:
    """One case in full. Arrays rows x columns [m]; the upper surface is where the search ended."""

    def __init__(self, folder, pitch):
        self.pitch = pitch
        self.result = json.loads((folder / "result.json").read_text())
        load = lambda name: np.load(folder / (name + ".npy"))  # noqa: E731
        self.lower, self.lower_after = load("heights"), load("deformed")
        self.contact_map = load("contact_map")
        upper, upper_after = load("counter_heights"), load("counter_deformed")
        shift = np.min(upper - self.lower) + number(self.result["approach"])
        self.upper, self.upper_after = upper - shift, upper_after - shift
        self.distance = self.upper - self.lower

    def asperities(self, name):
        return np.array([number(value) for value in self.result["asperities"][name]])

    def energies(self, name):
        return np.array([number(value) for value in self.result["energy_curve"][name]])


def maps_of(dump, name):
    return Maps(dump / name.replace("/", "_"), cases.SILICON.pitch)
