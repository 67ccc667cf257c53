"""Will rough surfaces of a MEMS part stick? Heights in, prediction out; SI units throughout.

    import mems_stiction

    prediction = mems_stiction.predict(heights, pitch=20e-9, load={"mechanical_load": 1e-6})
    prediction.pull_off_force  # [N]
    prediction.contact_map     # rows x columns: 0 apart, 1 elastic, 2 elasto-plastic, 3 plastic

The figures come from the C++ core, and are those of the program predict_scan to the last bit;
doc/python.md is the guide.
The modules curve, plots, report, ... have text and pictures of predictions, of Python's and of
ROS's.
"""

from importlib import import_module
from pkgutil import extend_path
from typing import TYPE_CHECKING, Any, List

# In a build tree the compiled part lies in another folder of the same name.
__path__ = extend_path(__path__, __name__)

if TYPE_CHECKING:
    from mems_stiction._calibration import Calibration, calibrate
    from mems_stiction._correlation import Correlation, correlation
    from mems_stiction._design import DesignSweep, design_sweep
    from mems_stiction._device import DeviceForce, predict_device
    from mems_stiction._half_space import HalfSpace, half_space
    from mems_stiction._lots import LotComparison, compare_lots
    from mems_stiction._made_surface import MadeSurface
    from mems_stiction._prediction import (
        Prediction,
        Predictor,
        Verdict,
        predict,
        predict_many,
        predict_under,
    )
    from mems_stiction._profile import surface_of_profile
    from mems_stiction._scans import (
        Cleaned,
        Roughness,
        Scan,
        channels,
        clean,
        decimate,
        generate,
        read,
        roughness,
    )
    from mems_stiction._settings import Error, FileError, OptionsError, Settings, SurfaceError
    from mems_stiction._station import ContactCycles, LoadSweep, cycle_contact, sweep_loads
    from mems_stiction._warnings import ScanWarning, SettingsWarning

# Found when they are first used: what only draws, or only wants the messages of ROS, does not load
# the core.
_MODULES = {
    "_calibration": ("Calibration", "calibrate"),
    "_correlation": ("Correlation", "correlation"),
    "_design": ("DesignSweep", "design_sweep"),
    "_device": ("DeviceForce", "predict_device"),
    "_half_space": ("HalfSpace", "half_space"),
    "_lots": ("LotComparison", "compare_lots"),
    "_made_surface": ("MadeSurface",),
    "_prediction": (
        "Prediction",
        "Predictor",
        "Verdict",
        "predict",
        "predict_many",
        "predict_under",
    ),
    "_profile": ("surface_of_profile",),
    "_scans": (
        "Cleaned",
        "Roughness",
        "Scan",
        "channels",
        "clean",
        "decimate",
        "generate",
        "read",
        "roughness",
    ),
    "_settings": ("Error", "FileError", "OptionsError", "Settings", "SurfaceError"),
    "_station": ("ContactCycles", "LoadSweep", "cycle_contact", "sweep_loads"),
    "_warnings": ("ScanWarning", "SettingsWarning"),
}
_MODULE_OF = {name: module for module, names in _MODULES.items() for name in names}

__all__ = [
    "Calibration",
    "Cleaned",
    "ContactCycles",
    "Correlation",
    "DesignSweep",
    "DeviceForce",
    "Error",
    "FileError",
    "HalfSpace",
    "LoadSweep",
    "LotComparison",
    "MadeSurface",
    "OptionsError",
    "Prediction",
    "Predictor",
    "Roughness",
    "Scan",
    "ScanWarning",
    "Settings",
    "SettingsWarning",
    "SurfaceError",
    "Verdict",
    "calibrate",
    "channels",
    "clean",
    "compare_lots",
    "correlation",
    "cycle_contact",
    "decimate",
    "design_sweep",
    "generate",
    "half_space",
    "predict",
    "predict_device",
    "predict_many",
    "predict_under",
    "read",
    "roughness",
    "surface_of_profile",
    "sweep_loads",
]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return import_module("mems_stiction.version").version()
    if name not in _MODULE_OF:
        raise AttributeError("module 'mems_stiction' has no attribute '%s'" % name)
    return getattr(import_module("mems_stiction." + _MODULE_OF[name]), name)


def __dir__() -> List[str]:
    return sorted(
        set(__all__) | {"__version__"} | {name for name in globals() if name.startswith("__")}
    )
