#!/usr/bin/env python3
"""Thin bodies by the separation curve against the half-space solver's, on frames that are 3 to 50 thicknesses wide.

usage: plate_study.py RESULTS.jsonl --first N --count N      solves frames that are not there yet
       plate_study.py RESULTS.jsonl --page PAGE.md           predicts them anew and writes the table between the marks of a page
       plate_study.py --figure FIGURE.png                    force against thickness, from film to block

A frame is drawn by its number alone. Rules were set on those below 1000 and looked at on those from 1000; from 7000 they are judged.
"""

import argparse
import json
import math
import pathlib
import signal
import sys
import warnings

import numpy as np

import mems_stiction

PIXELS = 64
BEGIN, END = "<!-- plates: begin -->", "<!-- plates: end -->"
GROUPS = [("set", 0, 1000), ("looked at", 1000, 7000), ("judged", 7000, 10**9)]
STIFF = {"upper/youngs_modulus": 1e17, "upper/poisson_ratio": 0.0, "lower/poisson_ratio": 0.0, "lower/hardness": 1e14, "upper/hardness": 1e14, "limits/accept_implausible": True}


def self_affine(random, pixels, pitch, roll_off, hurst, shortest):
    """Periodic heights, rms 1."""
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(pixels, pitch)[:, None], np.fft.rfftfreq(pixels, pitch)[None])
    amplitude = np.where(q <= 2 * np.pi / shortest, np.maximum(q, 2 * np.pi / roll_off) ** (-1 - hurst), 0.0)
    amplitude[0, 0] = 0.0
    heights = np.fft.irfft2(np.fft.rfft2(random.normal(size=(pixels, pixels))) * amplitude, s=(pixels, pixels))
    return heights / heights.std()


def frame(number):
    """Heights, pitch and settings: resolved, and soft enough for bending to matter on many."""
    random = np.random.default_rng(number)

    def between(low, high):
        return math.exp(random.uniform(math.log(low), math.log(high)))

    modulus, work, hamaker = between(5e9, 150e9), between(0.01, 0.12), 65e-21
    z0 = math.sqrt(hamaker / (16 * math.pi * work))
    pitch = min(modulus * z0**2 / work, 50e-9) * between(0.15, 0.8)
    width = PIXELS * pitch
    ratio = between(3, 50)
    roll_off = width * between(0.12, 1)
    heights = self_affine(random, PIXELS, pitch, roll_off, random.uniform(0.5, 0.95), 6 * pitch)
    heights *= z0 * between(0.7, 12)
    settings = {"interface/work_of_adhesion": work, "interface/hamaker_constant": hamaker, "lower/youngs_modulus": modulus,
                "lower/thickness": width / ratio, **STIFF}
    return heights, pitch, settings, ratio


def stiffness(q, modulus, thickness):
    """K of a body whose back is free, modulus E/(1 - nu^2)."""
    s = np.minimum(q * thickness, 30.0)
    bent = np.where(s > 1e-2, (np.sinh(s) ** 2 - s**2) / (np.sinh(s) * np.cosh(s) + s), s**3 / 6)
    return 0.5 * modulus * q * np.where(s >= 30, 1.0, bent)


def is_resolved(number):
    """Whether the cohesive length of the plate, 1/q of the wave with 2 K z0^2/Gamma = 1, has two pixels or more."""
    _, pitch, settings, _ = frame(number)
    work = settings["interface/work_of_adhesion"]
    z0_square = settings["interface/hamaker_constant"] / (16 * math.pi * work)
    wave = 1 / (2 * pitch)
    return 2 * stiffness(wave, settings["lower/youngs_modulus"], settings["lower/thickness"]) * z0_square / work >= 1


class Impatience(Exception):
    pass


def give_up(_signal, _stack):
    raise Impatience


def solve(path, first, count, patience):
    signal.signal(signal.SIGALRM, give_up)
    done = {json.loads(line)["number"] for line in path.read_text().splitlines()} if path.exists() else set()
    for number in range(first, first + count):
        if number in done or not is_resolved(number):
            continue
        heights, pitch, settings, ratio = frame(number)
        signal.alarm(patience)
        try:
            thin = mems_stiction.half_space(heights, pitch, **settings, **{"half_space/flow": False, "half_space/tolerance": 1e-3})
        except Impatience:
            row = {"number": number, "ratio": ratio, "force": None, "is_converged": False}
        else:
            row = {"number": number, "ratio": ratio, "force": thin.pull_off_force, "is_converged": bool(thin.is_converged)}
        signal.alarm(0)
        with path.open("a") as out:
            out.write(json.dumps(row) + "\n")
        print("frame %d of %d" % (number - first + 1, count), file=sys.stderr, flush=True)


def share(logs, limit):
    return "%.0f %%" % (100 * np.mean(np.abs(logs) <= math.log(limit))) if len(logs) else "-"


def line(title, rows):
    thin = np.array([row["thin"] for row in rows])
    stiff = np.array([row["stiff"] for row in rows])
    return "| %s | %d | %s | %s | %s | %.2f to %.2f | %s |" % (
        title, len(rows), share(thin, 1.3), share(thin, 1.5), share(thin, 2), math.exp(thin.min()), math.exp(thin.max()), share(stiff, 1.3))


def table(path):
    rows, unsolved = [], 0
    for text in path.read_text().splitlines():
        row = json.loads(text)
        if not is_resolved(row["number"]):
            continue
        if not row["is_converged"]:
            unsolved += 1
            continue
        heights, pitch, settings, _ = frame(row["number"])
        found = mems_stiction.predict(heights, pitch, **settings)
        stiff = mems_stiction.predict(heights, pitch, **{**settings, "lower/thickness": 0.0})
        ratio = found.flattening_energy / settings["interface/work_of_adhesion"]
        rows.append({**row, "thin": math.log(found.pull_off_force / row["force"]), "stiff": math.log(stiff.pull_off_force / row["force"]),
                     "bends": found.flattening_energy < 0.85 * stiff.flattening_energy, "conforms": found.is_conforming,
                     "flattening": ratio})
    text = ["| frames | number | within 1.3 | 1.5 | 2 | lowest to highest | as if thick, within 1.3 |", "|---|---|---|---|---|---|---|"]
    for title, first, last in GROUPS:
        group = [row for row in rows if first <= row["number"] < last]
        if group:
            text.append(line(title, group))
    judged = [row for row in rows if row["number"] >= GROUPS[-1][1]]
    kinds = [("judged, hardly bent", [row for row in judged if not row["bends"]]),
             ("judged, bent, by contacts", [row for row in judged if row["bends"] and not row["conforms"]]),
             ("judged, bent, conforming", [row for row in judged if row["bends"] and row["conforms"]])]
    text += [line(title, group) for title, group in kinds if group]
    if unsolved:
        text += ["", "%d frames were left out: the half-space solver did not finish them in the time that each is given." % unsolved]
    return "\n".join(text)


def write_page(path, page):
    before, rest = page.read_text().split(BEGIN)
    page.write_text(before + BEGIN + "\n\n" + table(path) + "\n\n" + rest[rest.index(END):])


def figure(picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    pixels, pitch, work = 96, 12e-9, 0.05
    width = pixels * pitch
    heights = 0.75e-9 * self_affine(np.random.default_rng(4), pixels, pitch, 0.5 * width, 0.8, 6 * pitch)
    settings = {"interface/work_of_adhesion": work, **STIFF, "lower/poisson_ratio": 0.22}

    def predicted(thickness):
        return mems_stiction.predict(heights, pitch, **settings, **{"lower/thickness": float(thickness)})

    thick = predicted(0.0)
    thicknesses = np.geomspace(0.025e-6, 4e-6, 30)
    forces = [predicted(thickness).pull_off_force for thickness in thicknesses]
    plates = np.geomspace(0.03e-6, 3e-6, 10)
    solved = [mems_stiction.half_space(heights, pitch, **settings, **{"lower/thickness": float(thickness), "half_space/flow": False, "half_space/tolerance": 1e-3})
              for thickness in plates]
    # the wave whose stiffness is the contact's own: where it is as long as the frame
    bed = thick.contact_stiffness / width**2
    modulus = 169e9 / (1 - 0.22**2)

    def mosaic(thickness):
        return 2 * np.pi * (modulus * thickness**3 / 12 / bed) ** 0.25

    def thickness_of(length):
        return (12 * bed / modulus * (length / (2 * np.pi)) ** 4) ** (1 / 3)

    parts = [mems_stiction.predict(np.ascontiguousarray(heights[r:r + 24, c:c + 24]), pitch, **settings).pull_off_force
             for r in range(0, pixels, 24) for c in range(0, pixels, 24)]
    plt.figure(figsize=(7, 4.4))
    plt.loglog(thicknesses * 1e6, np.array(forces) * 1e6, label="separation curve")
    plt.loglog(plates * 1e6, [1e6 * found.pull_off_force for found in solved], "o", label="half-space solver, as a plate")
    plt.axhline(thick.pull_off_force * 1e6, color="0.6", linestyle=":", label="thick body")
    plt.axhline(sum(parts) * 1e6, color="C3", linestyle="--", label="linear rule: parts of a quarter of the side, by area")
    plt.axvline(thickness_of(width) * 1e6, color="C2", linestyle="-.", label="the mosaic's length is the frame's side")
    plt.xlabel("thickness [um]")
    top = plt.gca().secondary_xaxis("top", functions=(lambda um: 1e6 * mosaic(1e-6 * np.maximum(um, 1e-9)), lambda um: 1e6 * thickness_of(1e-6 * um)))
    top.set_xlabel("length from which force goes with area [um]")
    plt.ylabel("pull-off force [uN]")
    plt.title("One surface of %.1f um, from film to block" % (width * 1e6))
    plt.legend(fontsize=8)
    plt.tight_layout()
    plt.savefig(picture, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="?", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=7000)
    parser.add_argument("--count", type=int, default=0)
    parser.add_argument("--patience", type=int, default=120, metavar="S", help="for the half-space of a frame [s]")
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--figure", type=pathlib.Path)
    arguments = parser.parse_args()
    warnings.simplefilter("ignore", mems_stiction.SettingsWarning)
    if arguments.count:
        solve(arguments.results, arguments.first, arguments.count, arguments.patience)
    if arguments.page:
        write_page(arguments.results, arguments.page)
    if arguments.figure:
        figure(arguments.figure)


if __name__ == "__main__":
    main()
