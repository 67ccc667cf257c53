#!/usr/bin/env python3
"""Prints what scripts/bench measured as tables.

usage: bench_table.py FOLDER   with predict.json, in_flight.json, half_space.json, device.json,
transform_pair.json and, where they were made, callgrind.txt
                               and latency.json
"""

import json
import pathlib
import re
import sys

# What is predicted: name of the benchmarks, what stands above the table, and what cases must reach
# against labelling each step alone; the others are shown for information.
GROUPS = [
    (
        "predict",
        "The separation curve, surfaces that come to rest by themselves",
        {"gaussian/1024/200": 80, "gaussian/1024/1000": 300},
    ),
    (
        "predict_loaded",
        "The separation curve, pressed until 30 % overlap",
        {"gaussian/1024/200": 30},
    ),
    (
        "predict_paper",
        "The paper's formulation, pressed until 30 % touch",
        {"gaussian/1024/200": 30},
    ),
]
# White noise against the Gaussian frame, at rest and under the pressures [Pa] that parts meet;
# beyond them for information.
REQUIRED_NOISE = 4.0
PRESSURES_OF_PARTS = ("1e6", "1e7", "1e8")
REQUIRED_OUTPUT_COST = 1.6
REQUIRED_GROWTH = 5.0
# Cleaning and prediction of a scan against its prediction alone, and roughness by itself.
REQUIRED_CLEANING = {"offset": 1.5, "lines": 1.5, "fill": 1.5, "level": 1.5, "afm_recipe": 3.0}
REQUIRED_ROUGHNESS = 3.0
REQUIRED_SPEED_UP = 1.6
# A pixel of a made surface against one of a real Fourier transform of 1024 x 1024 pixels.
REQUIRED_TILES = {"self_affine": 4.0, "translated": 4.0}
# From scans to the force of a surface of 10^8 pixels: CPU time [s] and memory [GB] of one process.
REQUIRED_SECONDS = 20.0
REQUIRED_GIGABYTES = 1.5
# The whole answer for a device, in pairs of transforms of 4096 x 4096 by numpy.
REQUIRED_ANSWERS = {
    "own area, 192 x 192": 0.3,
    "1e-10 m^2, 4 scans of 512 x 512": 0.6,
    "1e-9 m^2, 4 scans of 512 x 512": 3.0,
    "1e-8 m^2, 4 scans of 512 x 512": 6.0,
}


def times_of(path, counter=None):
    """CPU time in ms by case, without the decorations of Google Benchmark's names; wall time for
    threaded cases. The least of the repetitions: what other programs on the machine add is never
    negative. In the order in which the cases are defined, also where their repetitions ran mixed.
    With a counter: divided by it, for the cases that have it."""
    times = {}
    for run in sorted(
        json.loads(path.read_text())["benchmarks"], key=lambda run: run.get("family_index", 0)
    ):
        if run.get("run_type") == "aggregate" or (counter and counter not in run):
            continue
        name = re.sub(r"/(min_time|iterations|repeats|real_time).*", "", run["name"])
        time = run["real_time"] if "real_time" in run["name"] else run["cpu_time"]
        time /= run[counter] if counter else 1.0
        times[name] = min(time, times.get(name, time))
    return times


def verdict(value, limit, at_least):
    good = value >= limit if at_least else value <= limit
    return "%s %g: %s" % ("at least" if at_least else "at most", limit, "yes" if good else "NO")


def print_group(times, group, title, required_ratio):
    print()
    print(title)
    print(
        "%-24s %10s %8s %12s %8s %10s  %s"
        % (
            "frame/size/steps",
            "predict",
            "passes",
            "all outputs",
            "cost",
            "label/predict",
            "required",
        )
    )
    for name, labelling in times.items():
        if not name.startswith("label/"):
            continue
        case = name[len("label/") :]
        predict = times[group + "/" + case]
        everything = times[group + "_all_outputs/" + case]
        one_pass = times["pass/" + case.split("/")[1]]
        required = required_ratio.get(case)
        print(
            "%-24s %10.2f %8.0f %12.2f %8.2f %13.1f  %s"
            % (
                case,
                predict,
                predict / one_pass,
                everything,
                everything / predict,
                labelling / predict,
                verdict(labelling / predict, required, True) if required else "",
            )
        )
    case = "gaussian/1024/200"
    growth = times[group + "/gaussian/2048/200"] / times[group + "/" + case]
    print(
        "2048 x 2048 against 1024 x 1024: %.2f (%s)"
        % (growth, verdict(growth, REQUIRED_GROWTH, False))
    )


def print_core(times):
    print(
        "Core, one thread. ms of CPU time, the least of the repetitions; 'passes' are reads of the "
        "whole frame."
    )
    for group, title, required_ratio in GROUPS:
        print_group(times, group, title, required_ratio)
    cost = (
        times["predict_loaded_all_outputs/gaussian/1024/200"]
        / times["predict_loaded/gaussian/1024/200"]
    )
    print(
        "all outputs against none, pressed gaussian/1024/200: %.2f (%s)"
        % (cost, verdict(cost, REQUIRED_OUTPUT_COST, False))
    )


def print_noise(times):
    print()
    print("White noise against the Gaussian frame, 1024 x 1024")
    print("%-24s %10s %12s %8s  %s" % ("under", "gaussian", "white noise", "ratio", "required"))
    groups = [
        name[: -len("/gaussian/1024/200")]
        for name in times
        if re.match("predict.*/gaussian/1024/200$", name)
    ]
    for group in groups:
        if "all_outputs" in group:
            continue
        kind, _, pressure = group.partition("/")
        gaussian, noise = (
            times["%s/%s/1024/200" % (group, frame)] for frame in ("gaussian", "white_noise")
        )
        is_required = group == "predict" or pressure in PRESSURES_OF_PARTS
        name = {
            "predict": "adhesion alone",
            "predict_under": "%s Pa" % pressure,
            "predict_loaded": "30 % overlap",
            "predict_paper": "paper, 30 % contact",
        }[kind]
        print(
            "%-24s %10.2f %12.2f %8.2f  %s"
            % (
                name,
                gaussian,
                noise,
                noise / gaussian,
                verdict(noise / gaussian, REQUIRED_NOISE, False) if is_required else "",
            )
        )


def print_cleaning(times):
    alone = times["predict_paper/gaussian/1024/200"]
    print()
    print("Before the prediction, gaussian/1024: with the paper's prediction against that alone")
    print("%-24s %10s %8s  %s" % ("step", "ms", "ratio", "required"))
    for name, time in times.items():
        if name.startswith("clean/"):
            step = name[len("clean/") :]
            required = REQUIRED_CLEANING.get(step)
            print(
                "%-24s %10.2f %8.2f  %s"
                % (
                    step,
                    time,
                    time / alone,
                    verdict(time / alone, required, False) if required else "",
                )
            )
    roughness = times["spatial_roughness"]
    print(
        "%-24s %10.2f %8.2f  %s (by itself)"
        % (
            "spatial_roughness",
            roughness,
            roughness / alone,
            verdict(roughness / alone, REQUIRED_ROUGHNESS, False),
        )
    )


def print_in_flight(times):
    # Each model does the same number of frames: twice the frames in the time of one.
    speed_up = 2.0 * times["in_flight/1"] / times["in_flight/2"]
    print(
        "two frames in flight against one: %.2f times the frames per second (%s)"
        % (speed_up, verdict(speed_up, REQUIRED_SPEED_UP, True))
    )


def print_half_space(rows):
    print()
    print(
        "The half-space; a pair is one forward and one inverse real transform of the frame in the "
        "same run"
    )
    for row in rows:
        held = "" if row["limit"] is None else verdict(row["figure"], row["limit"], row["at_least"])
        print("%-68s %10.2f %-6s %s" % (row["work"], row["figure"], row["unit"], held))


def print_device(path):
    pixels = times_of(path, "pixels")
    transform = pixels["transform"]
    print()
    print(
        "Surfaces of a device, made tile by tile; a transform is a real one of 1024 x 1024 pixels "
        "by OpenCV, %.1f ns a pixel" % (1e6 * transform)
    )
    print("%-24s %10s %8s  %s" % ("surface", "ns/pixel", "ratio", "required"))
    for name, time in pixels.items():
        if name.startswith("tiles/"):
            surface = name[len("tiles/") :]
            required = REQUIRED_TILES.get(surface)
            print(
                "%-24s %10.1f %8.2f  %s"
                % (
                    surface,
                    1e6 * time,
                    time / transform,
                    verdict(time / transform, required, False) if required else "",
                )
            )
    for name, time in times_of(path).items():
        if name.startswith("kernels/"):
            print("%-24s %10.0f ms, once for a spectrum and a pitch" % (name, time))
    runs = {
        run["name"].split("/")[1]: run
        for run in json.loads(path.read_text())["benchmarks"]
        if run["name"].startswith("whole/")
    }
    print(
        "From four scans to the force of a surface of 10^8 pixels; a transform is a real one of as "
        "many pixels, %.1f s" % runs["transform"]["seconds"]
    )
    print("%-24s %10s %8s %8s  %s" % ("surface", "s", "ratio", "GB", "required"))
    for name, run in runs.items():
        if name != "transform":
            print(
                "%-24s %10.1f %8.2f %8.2f  %s, %s"
                % (
                    name,
                    run["seconds"],
                    run["seconds"] / runs["transform"]["seconds"],
                    run["gigabytes"],
                    verdict(run["seconds"], REQUIRED_SECONDS, False),
                    verdict(run["gigabytes"], REQUIRED_GIGABYTES, False),
                )
            )


def print_answers(path, pair):
    least = {}
    for run in json.loads(path.read_text())["benchmarks"]:
        if run["name"].startswith("answer/") and run.get("run_type") != "aggregate":
            name = next(name for name in REQUIRED_ANSWERS if name in run["name"])
            if name not in least or run["seconds"] < least[name]["seconds"]:
                least[name] = run
    print(
        "The force of a device with its interval; a pair is a transform of 4096 x 4096 and its "
        "inverse by numpy, %.2f s" % pair
    )
    print("%-34s %8s %8s %8s  %s" % ("device", "s", "pairs", "GB", "required"))
    for name, required in REQUIRED_ANSWERS.items():
        if name in least:
            seconds = least[name]["seconds"]
            print(
                "%-34s %8.2f %8.2f %8.2f  %s"
                % (
                    name,
                    seconds,
                    seconds / pair,
                    least[name]["gigabytes"],
                    verdict(seconds / pair, required, False),
                )
            )


def print_latency(rows):
    print()
    print(
        "Replay of 1024 x 1024 scans, from the arrival of a scan to that of its prediction at one "
        "listener [ms]"
    )
    print(
        "%-8s %6s %6s %8s %8s %8s %12s %16s"
        % ("shell", "Hz", "scans", "p50", "p99", "dropped", "core p50", "callback/core")
    )
    for row in rows:
        print(
            "%-8s %6g %6d %8.1f %8.1f %8d %12.1f %16.2f"
            % (
                row["shell"],
                row["rate"],
                row["scans"],
                row["p50_ms"],
                row["p99_ms"],
                row["dropped"],
                row["core_p50_ms"],
                row["callback_to_publish_over_core"],
            )
        )


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    core = times_of(folder / "predict.json")
    print_core(core)
    print_noise(core)
    print_in_flight(times_of(folder / "in_flight.json"))
    callgrind = folder / "callgrind.txt"
    if callgrind.exists():
        counted = re.search(r"Collected : (\d+)", callgrind.read_text())
        if counted:
            count = int(counted.group(1))
            (folder / "instructions.json").write_text(
                json.dumps({"gaussian/512/200": count}) + "\n"
            )
            print("instructions, gaussian/512/200: %.1f million" % (count / 1e6))
    print_cleaning(core)
    print_half_space(json.loads((folder / "half_space.json").read_text()))
    print_device(folder / "device.json")
    print_answers(
        folder / "device.json", json.loads((folder / "transform_pair.json").read_text())["seconds"]
    )
    latency = folder / "latency.json"
    if latency.exists():
        print_latency(json.loads(latency.read_text()))
    print()
    print("JSON: %s" % folder)


if __name__ == "__main__":
    main()
