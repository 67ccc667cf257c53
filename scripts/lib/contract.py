#!/usr/bin/env python3
"""Compares names, records of scans and figures of made frames with those of an earlier build.

usage: contract.py store FILE [--build FOLDER] [--frames N]
       contract.py compare FILE [--build FOLDER]

Imports, compared to the bit, and records are those of the scans in MEMS_STICTION_SCANS. Frames are
those of both error maps and pressed ones, by the separation curve alone. FILE contains what scans
say: do not commit it. `compare` ends with 1 if a name went, an import or an unflagged record
changed, or an unflagged figure of a frame changed by more than 0.1 %.
"""

import argparse
import ast
import hashlib
import inspect
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import warnings

import yaml

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = (
    "predict_scan",
    "predict_device",
    "stiction_batch",
    "import_scan",
    "make_scan_bag",
    "stiction_node",
)
LEVEL = {"level": "plane"}
SETTINGS = {  # under which each scan is predicted
    "default": {},
    "levelled": {"preprocessing": dict(LEVEL, spikes={"enabled": True}, fill={"enabled": True})},
    "pressed": {"preprocessing": LEVEL, "load": {"pressure": 1e7}},
    "paper": {"preprocessing": LEVEL, "approach": {"formulation": "paper"}},
}
WITHOUT_MEANING = {"processing_time", "version", "settings_hash", "file"}  # in a comparison
FIGURES = (
    "status",
    "pull_off_force",
    "apparent_work_of_adhesion",
    "contact_area",
    "approach",
    "flattening_ratio",
    "is_conforming",
    "asperity_count",
    "elastic_count",
    "plastic_count",
    "pull_off_contact_count",
    "regime_flag_names",
    "model_doubt",
)
COMPARED = ("pull_off_force", "apparent_work_of_adhesion", "contact_area")
FLAG = "near_bonding"
TOLERANCE = 1e-3  # of figures that no flag doubts
SHOWN = 12  # lines of each kind


# ---------------------------------------------------------------- names


def flat_keys(tree, prefix=""):
    for key, value in tree.items():
        if isinstance(value, dict) and value:
            yield from flat_keys(value, prefix + key + "/")
        else:
            yield prefix + key


def message_fields(path):
    """One name for each field and constant, with its type and its part of the file."""
    names, part = [], 0
    for line in path.read_text().splitlines():
        text = re.sub(r"\s+", " ", line.split("#")[0]).strip()
        if text == "---":
            part += 1
        elif text:
            names.append("%s[%d]: %s" % (path.stem, part, text))
    return names


def run(*command):
    command = [str(part) for part in command]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)


def options_of(program):
    """Options and exit codes that its help names."""
    found = run(program, "--help")
    text, name = found.stdout + found.stderr, program.name
    names = [name + " " + one for one in re.findall(r"(?<![\w-])--[a-z][a-z-]*[a-z]", text)]
    for status in re.findall(r"[Ee]xit status:?(.*?)(?:\n\s*\n|$)", text, re.DOTALL):
        names += ["%s exits with %s" % (name, code) for code in re.findall(r"\b[0-9]\b", status)]
    return names


def module_names():
    import mems_stiction

    names = []
    for name, value in sorted(vars(mems_stiction).items()):
        if name.startswith("_") or inspect.ismodule(value):
            continue
        names.append("mems_stiction." + name)
        try:
            of_call = inspect.signature(value).parameters
        except (TypeError, ValueError):
            continue
        names += ["mems_stiction.%s(%s)" % (name, one) for one in of_call]
    stub = ast.parse((REPOSITORY / "python/mems_stiction/_core.pyi").read_text())
    for kind in (node for node in stub.body if isinstance(node, ast.ClassDef)):
        members = (member for member in kind.body if isinstance(member, ast.AnnAssign))
        names += ["%s.%s" % (kind.name, member.target.id) for member in members]
    return names


def names_of(build):
    names = {"fields": [], "settings": [], "options": [], "graph": [], "python": module_names()}
    for folder in ("msg", "srv", "action"):
        for path in (REPOSITORY / folder).iterdir():
            names["fields"] += message_fields(path)
    for path in (REPOSITORY / "config").glob("*.yaml"):
        keys = flat_keys(yaml.safe_load(path.read_text()) or {})
        names["settings"] += ["%s: %s" % (path.name, key) for key in keys]
    dynamic = re.findall(r'\.add\("(\w+)"', (REPOSITORY / "cfg/Stiction.cfg").read_text())
    names["settings"] += ["dynamic: " + key for key in dynamic]
    text = (REPOSITORY / "src/ros/topic_names.hpp").read_text()
    of_graph = re.findall(r'k\w+?(Topic|Service|Action)\[\] = "(\w+)"', text)
    names["graph"] = ["%s %s" % (kind.lower(), name) for kind, name in of_graph]
    programs = [build / name for name in PROGRAMS] + sorted((REPOSITORY / "scripts").iterdir())
    for program in filter(pathlib.Path.is_file, programs):
        names["options"] += options_of(program)
    return {kind: sorted(set(found)) for kind, found in names.items()}


# ---------------------------------------------------------------- scans


def import_of(program, path, folder):
    found = run(program, "--output", folder, path)
    digests = {}
    for written in sorted(folder.iterdir()):
        digests[written.name] = hashlib.sha256(written.read_bytes()).hexdigest()
        written.unlink()
    error = "" if found.returncode == 0 else found.stderr.replace(str(path), path.name)
    return {"exit": found.returncode, "files": digests, "error": error}


def record_of(program, settings, path):
    found = run(program, "--json", "--config", settings, path)
    record = json.loads(found.stdout) if found.stdout.strip() else {}
    record = {key: value for key, value in record.items() if key not in WITHOUT_MEANING}
    return dict(record, exit=found.returncode)


def scans_of(build):
    folder = os.environ.get("MEMS_STICTION_SCANS")
    if not folder:
        sys.exit("MEMS_STICTION_SCANS names no folder: records of scans are half of the contract")
    imports, records = {}, {}
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        written = work / "written"
        written.mkdir()
        for label, settings in SETTINGS.items():
            (work / (label + ".yaml")).write_text(yaml.safe_dump(settings))
        for path in sorted(pathlib.Path(folder).rglob("*")):
            if not path.is_file() or path.suffix in (".md", ".yaml"):
                continue
            name = str(path.relative_to(folder))
            imports[name] = import_of(build / "import_scan", path, written)
            for label in SETTINGS:
                settings = work / (label + ".yaml")
                record = record_of(build / "predict_scan", settings, path)
                records["%s, %s" % (name, label)] = record
            print("scan %s" % name, file=sys.stderr, flush=True)
    return imports, records


# ---------------------------------------------------------------- frames


def maps():
    """For each map what draws a frame by its number: heights, pitch, settings."""
    sys.path.insert(0, str(REPOSITORY / "studies"))
    import trust_frames
    import trust_kinds
    import trust_run

    scans = trust_frames.Scans(None)

    def of(frame, heights):
        return heights, frame["pitch"], trust_run.settings_of(frame, "separation_curve")

    first_changing = trust_kinds.ALIKE_COUNT
    return {
        "map": lambda number: of(*trust_frames.draw(number, 128, scans)),
        "kinds": lambda number: of(*trust_kinds.draw(number, 160)),
        "changing kinds": lambda number: of(*trust_kinds.draw(first_changing + number, 160)),
        "pressed": lambda number: of(*trust_kinds.draw_pressed(number, 96, 61)),
    }


def frames_of(count):
    import mems_stiction

    warnings.simplefilter("ignore")  # heights and constants are as drawn
    found = {}
    for name, draw in maps().items():
        found[name] = []
        for number in range(count if name in ("map", "kinds") else count // 4):
            prediction = mems_stiction.predict(*draw(number)).to_dict()
            found[name].append({key: prediction.get(key) for key in FIGURES})
        print("frames of %s" % name, file=sys.stderr, flush=True)
    return found


# ---------------------------------------------------------------- comparison


def differs(one, other):
    if not isinstance(one, float) or not isinstance(other, float):
        return one != other
    if math.isnan(one) or math.isnan(other):
        return math.isnan(one) != math.isnan(other)
    return abs(one - other) > TOLERANCE * max(abs(one), abs(other))


def is_flagged(*figures):
    return any(FLAG in (one.get("regime_flag_names") or "") for one in figures)


def show(title, lines):
    if not lines:
        return
    print("%s (%d):" % (title, len(lines)))
    for line in lines[:SHOWN]:
        print("  " + line)
    if len(lines) > SHOWN:
        print("  ... and %d more" % (len(lines) - SHOWN))


def compare_names(before, now):
    all_gone = []
    for kind in before:
        gone = sorted(set(before[kind]) - set(now[kind]))
        show("gone from " + kind, gone)
        show("new in " + kind, sorted(set(now[kind]) - set(before[kind])))
        all_gone += gone
    return not all_gone


def compare_records(before, now):
    changed, flagged = [], []
    for name, one in before.items():
        other = now.get(name, {})
        keys = [key for key in one.keys() | other.keys() if differs(one.get(key), other.get(key))]
        words = [
            key if key not in COMPARED else "%s %s -> %s" % (key, one.get(key), other.get(key))
            for key in sorted(keys)
        ]
        if keys:
            (flagged if is_flagged(one, other) else changed).append(name + ": " + ", ".join(words))
    show("records that changed", changed)
    show("flagged records that changed", flagged)
    return not changed


def compare_frames(before, now):
    is_kept = True
    for name in now:
        pairs = list(zip(before.get(name, []), now[name]))
        changed = []
        for number, (one, other) in enumerate(pairs):
            words = [
                "%s %.5g -> %.5g" % (key, one[key], other[key])
                for key in COMPARED
                if differs(one[key], other[key]) and not is_flagged(one, other)
            ]
            if words:
                changed.append("frame %d: %s" % (number, ", ".join(words)))
        flagged = [sum(map(is_flagged, side)) for side in zip(*pairs)]
        print(
            "%s: %d frames, flagged %d before and %d now; %d lost the flag, %d never had it"
            % (
                name,
                len(pairs),
                flagged[0],
                flagged[1],
                sum(is_flagged(one) and not is_flagged(other) for one, other in pairs),
                sum(not is_flagged(one, other) for one, other in pairs),
            )
        )
        show("unflagged frames of %s that changed" % name, changed)
        is_kept = is_kept and not changed
    return is_kept


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("what", choices=("store", "compare"))
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument(
        "--build",
        type=pathlib.Path,
        help="folder of the programs",
        default=REPOSITORY / "build/devel/lib/mems_stiction",
    )
    parser.add_argument("--frames", type=int, default=300, help="of each error map")
    arguments = parser.parse_args()
    before = json.loads(arguments.file.read_text()) if arguments.what == "compare" else None
    count = before["count"] if before else arguments.frames
    imports, records = scans_of(arguments.build)
    now = {
        "count": count,
        "names": names_of(arguments.build),
        "imports": imports,
        "records": records,
        "frames": frames_of(count),
    }
    if before is None:
        arguments.file.write_text(json.dumps(now))
        return 0
    now = json.loads(json.dumps(now))
    changed = [name for name in before["imports"] if before["imports"][name] != imports.get(name)]
    show("imports that changed", changed)
    kept = [
        compare_names(before["names"], now["names"]),
        not changed,
        compare_records(before["records"], now["records"]),
        compare_frames(before["frames"], now["frames"]),
    ]
    print(
        "kept: names %s, imports %s, records %s, frames %s"
        % tuple("yes" if one else "NO" for one in kept)
    )
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
