"""How a typed program uses the module: mypy reads this, nobody runs it."""

from pathlib import Path
from typing import List

import mems_stiction
import numpy as np


def forces(frames: List[np.ndarray]) -> List[float]:
    settings = mems_stiction.Settings("part.yaml", load={"mechanical_load": 1e-6})
    return [
        prediction.pull_off_force
        for prediction in mems_stiction.predict_many(frames, 20e-9, settings)
    ]


def device(paths: List[Path], plane: np.ndarray) -> float:
    together = mems_stiction.predict_device(paths, config="part.yaml", area=1e-8)
    by_pitch = mems_stiction.predict_device({"a.npy": 10e-9, "b.npy": 2e-8}, area=1e-8)
    alone = mems_stiction.predict_device(plane, 1e-8, area=1e-8, upper=plane)
    swept = mems_stiction.sweep_loads(plane, 1e-8, voltages=[0.0, 5.0])
    assert len(swept.points)
    return together.pull_off_force + by_pitch.pull_off_force + alone.pull_off_force


def report(path: Path) -> str:
    scan = mems_stiction.read(path, pitch=(20e-9, 25e-9))
    prediction = mems_stiction.predict(mems_stiction.clean(scan, preprocessing={"level": "plane"}))
    verdict = prediction.verdict
    sticks = verdict.sticks if verdict is not None else "no device"
    solved: mems_stiction.HalfSpace = mems_stiction.half_space(scan)
    return "%s %s %g %g %s" % (
        prediction.status,
        sticks,
        prediction.roughness.sq,
        solved.pull_off_force,
        prediction.flags,
    )
