"""Runs stiction_batch on one scan with the first cleaning steps alone, one more at a time."""

import json
import subprocess

import numpy as np
import yaml

from mems_stiction.cleaning_steps import Stage, first_steps, steps_of


def stages_of(batch, settings, arguments, number, last, folder):
    """The surfaces between the steps of a scan, as Stages from the one that was measured to `last`, which all steps have cleaned: (heights, row).

    batch: the program. settings: what it wrote beside its rows, read. arguments: further ones, the inputs last. number: of the scan among them, from 1.
    folder: for files that are in the way afterwards. Empty where no step is on, or one of the surfaces cannot be predicted.
    """
    names = steps_of(settings["configuration"])
    stages = []
    for count in range(len(names)):
        place = folder / ("first_%d" % count)
        found = _predicted(batch, first_steps(settings["configuration"], names[:count]), arguments, number, settings["total"], place)
        if found is None:
            return []
        stages.append(Stage(names[count - 1] if count else "", *found))
    return stages + [Stage(names[-1], *last)] if names else []


def _predicted(batch, configuration, arguments, number, total, place):
    """Heights and row of one scan; None if it cannot be predicted so."""
    place.mkdir()
    (place / "settings.yaml").write_text(yaml.safe_dump(configuration), encoding="utf-8")
    done = subprocess.run([batch, "-o", str(place / "rows.jsonl"), "--dump", str(place / "scans"), "--config", str(place / "settings.yaml"),
                           "--shard", "%d/%d" % (number, total)] + arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if done.returncode:
        return None
    row = json.loads((place / "rows.jsonl").read_text(encoding="utf-8"))
    if row["reason"]:
        return None
    return np.load(str(place / "scans" / ("%06d" % number) / "heights.npy")), row
