"""What the tests of the Python module share: frames, settings, and the program that they are held
against."""

import os
import pathlib

import numpy as np

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PITCH = 20e-9
FORMULATIONS = ("separation_curve", "paper", "printed")
DEVICE = {"spring_stiffness": 2.0, "travel": 1e-6, "contact_area": 1e-11}
FEW = {
    "realisations": 3,
    "max_cells": 1e4,
}  # surfaces of the device, for tests that ask for something else
CLEANING = {
    "level": "plane",
    "spikes": {"enabled": True},
    "fill": {"enabled": True, "max_fraction": 0.5},
}


def program():
    """predict_scan as built; by the environment where ROS cannot find it."""
    if "MEMS_STICTION_PREDICT_SCAN" in os.environ:
        return os.environ["MEMS_STICTION_PREDICT_SCAN"]
    from roslib.packages import find_node

    return find_node("mems_stiction", "predict_scan")[0]


def rough(rows, columns, rms_height=5e-9, seed=1, length=5):
    """Gaussian heights [m], correlated over `length` pixels."""
    q = np.hypot(np.fft.fftfreq(rows)[:, None], np.fft.rfftfreq(columns)[None, :])
    waves = np.fft.rfft2(np.random.RandomState(seed).standard_normal((rows, columns)))
    heights = np.fft.irfft2(waves * np.exp(-((q * np.pi * length) ** 2) / 2), s=(rows, columns))
    return heights / heights.std() * rms_height


def frames():
    """Smooth to rough, of either type, with holes, with a tilt and a spike."""
    holes = rough(40, 50, 3e-9, 3)
    holes[5:9, 30:40] = np.nan
    dirty = rough(48, 48, 4e-9, 4) + 1e-9 * np.arange(48)
    dirty[7, 9] += 200e-9
    return {
        "smooth": rough(64, 48, 0.4e-9),
        "rough": rough(64, 64, 12e-9, 2),
        "single": rough(33, 61).astype(np.float32),
        "holes": holes,
        "dirty": dirty,
    }


def without_times(record):
    """What two runs can share."""
    return {
        name: without_times(value) if isinstance(value, dict) else value
        for name, value in record.items()
        if name not in ("processing_time", "file", "scan_name", "checksum", "settings_hash")
    }


class Topography:
    """What is used of SurfaceTopography's class, for machines that do not have it: the first index
    is x."""

    def __init__(self, heights, physical_sizes, unit=None, periodic=False):
        self._heights, self.physical_sizes, self.is_periodic, self.unit = (
            heights,
            physical_sizes,
            periodic,
            unit,
        )

    def heights(self):
        return self._heights


def topographies():
    """Name and class of each kind of topography: the stand-in, and the real one where it is
    installed."""
    kinds = [("stand-in", Topography)]
    try:
        from SurfaceTopography import Topography as Real
    except ImportError:
        return kinds
    return kinds + [("SurfaceTopography", Real)]
