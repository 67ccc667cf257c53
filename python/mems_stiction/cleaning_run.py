"""Runs stiction_batch on one scan with the first cleaning steps alone, one more at a time."""

import json
import subprocess

import numpy as np
import yaml

from mems_stiction.cleaning_steps import Stage, first_steps, steps_of


class CannotShow(Exception):
    """Why the surfaces between the steps are not there, in one sentence."""


def stages_of(batch, settings, arguments, number, last, folder):
    """The surfaces between the steps of a scan, as Stages from the one that was measured to `last`,
    which all steps have cleaned: (heights, row).

    batch: the program. settings: what it wrote beside its rows, read. arguments: further ones, the
    inputs last. number: of the scan among them, from 1.
    folder: for files that are in the way afterwards. Empty where no step is on. Raises CannotShow
    if one of the surfaces cannot be predicted.
    """
    names = steps_of(settings["configuration"])
    stages = []
    for count in range(len(names)):
        place = folder / ("first_%d" % count)
        found = _predicted(
            batch,
            first_steps(settings["configuration"], names[:count]),
            arguments,
            number,
            settings["total"],
            place,
        )
        stages.append(Stage(names[count - 1] if count else "", *found))
    return stages + [Stage(names[-1], *last)] if names else []


def _predicted(batch, configuration, arguments, number, total, place):
    """Heights and row of one scan."""
    place.mkdir()
    configuration = dict(
        configuration, half_space=dict(configuration.get("half_space") or {}, enabled=False)
    )
    (place / "settings.yaml").write_text(yaml.safe_dump(configuration), encoding="utf-8")
    done = subprocess.run(
        [
            batch,
            "-o",
            str(place / "rows.jsonl"),
            "--dump",
            str(place / "scans"),
            "--config",
            str(place / "settings.yaml"),
            "--no-device-force",  # heights and force of the scan alone
            "--shard",
            "%d/%d" % (number, total),
        ]
        + arguments,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        universal_newlines=True,
    )
    has_rows = done.returncode in (0, 1)  # 1: no scan of them could be predicted
    row = (
        {"message": done.stderr}
        if not has_rows
        else json.loads((place / "rows.jsonl").read_text(encoding="utf-8"))
    )
    if row["message"]:
        raise CannotShow(
            "with the first steps alone the scan is not predicted: %s"
            % " ".join(row["message"].split())
        )
    return np.load(str(place / "scans" / ("%06d" % number) / "heights.npy")), row
