"""Messages of a made station, and a page of its own for a test case: the real server, without a
graph."""

import math
import pathlib
import sys
import threading

import numpy as np
from mems_stiction.msg import (
    PartVerdict,
    SeparationPoint,
    StictionPrediction,
    SweepLoadResult,
    SweepPoint,
    SweepSummary,
)
from mems_stiction.page_server import PageServer
from mems_stiction.page_state import PageState
from sensor_msgs.msg import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "ros"))
import browser  # noqa: E402,F401  (the path comes first)

SECOND = 10**9
NAN = math.nan
BAD_SITES = {(1, 2), (5, 5)}  # columns and rows of a wafer
TABS = ("overview", "maps", "curve", "runs", "parts", "wafers", "node")


def serve(case):
    """A page of its own for a test case: its state, and its server until the class ends."""
    case.state = PageState()
    case.state.set_link("ok", "Connected to the node.")
    started = threading.Event()

    def run():
        case.server = PageServer(case.state, "127.0.0.1", 0, None)
        started.set()
        case.server.run()

    thread = threading.Thread(target=run)
    thread.start()
    case.addClassCleanup(thread.join, 120)
    assert started.wait(120)
    case.addClassCleanup(case.server.stop)


def prediction(number, **changes):
    points = [
        SeparationPoint(displacement=x * 1e-9, force=force * 1e-6, is_separation=out)
        for x, force, out in (
            (-4, 0.0, False),
            (-1, 0.1, False),
            (0, 2.0, False),
            (0, 2.0, True),
            (-1, 3.7, True),
            (-2, 1.1, True),
            (-4, 0.0, True),
        )
    ]
    message = StictionPrediction(
        pull_off_force=3.7e-6 * (1 + 0.05 * (number % 3)),
        sticks=StictionPrediction.STICKS_NO,
        reason="the whole interval lies above 1, " * 8,
        margin=3.0,
        margin_lower=2.0,
        margin_upper=4.0,
        restoring_force=1e-5,
        peel_number=NAN,
        peel_number_lower=NAN,
        peel_number_upper=NAN,
        device_pull_off_force=3.3e-6,
        contact_area_jkr=NAN,
        rms_height=1e-9,
        asperity_count=3,
        settings_hash="00ff",
        scan_name="place %d" % number,
        curve=points,
        formulation="separation_curve",
        regime_flags=16 + 32 + 128,
        version="1.2.3",
        warnings=["=HYPERLINK(1)"],
        site_x=NAN,
        site_y=NAN,
    )
    for name, value in changes.items():
        setattr(message, name, value)
    return message


def part(serial, margin, sticks, **changes):
    message = PartVerdict(
        part_id="lot 3",
        serial_id=serial,
        scan_count=3,
        counted_scans=3,
        sticks=sticks,
        reason="why",
        verdict_by="prediction",
        margin=margin,
        margin_lower=margin / 2,
        margin_upper=margin * 2,
        worst_margin=margin / 3,
        worst_margin_scan="place 2",
        peel_number=NAN,
        peel_number_lower=NAN,
        peel_number_upper=NAN,
        worst_peel_number=NAN,
    )
    for name, value in changes.items():
        setattr(message, name, value)
    return message


def sweep():
    """Safe up to 20 V; at 30 V new contacts snap in."""
    points = []
    for direction, voltages in (
        (SweepPoint.UP, (0, 10, 20, 30, 40)),
        (SweepPoint.DOWN, (30, 20, 10, 0)),
    ):
        for voltage in voltages:
            more = voltage >= 30
            points.append(
                SweepPoint(
                    direction=direction,
                    voltage=voltage,
                    mechanical_load=1e-6,
                    pull_off_force=3e-6 if more else 1e-6,
                    pull_off_force_lower=2e-6 if more else 5e-7,
                    pull_off_force_upper=4e-6 if more else 2e-6,
                    contact_area=(9e-13 if more else 1e-13) * (1 + 1e-3 * voltage),
                    contact_area_jkr=NAN,
                    asperity_count=90 if more else 1,
                    margin=0.8 if more else 3.0,
                    margin_lower=0.5 if more else 2.0,
                    margin_upper=1.1 if more else 4.0,
                    holding_margin=0.6 if more else 2.5,
                    sticks=1 if more else 0,
                )
            )
    summary = SweepSummary(
        mechanical_load=1e-6,
        highest_releasing_voltage=20.0,
        highest_safe_voltage=20.0,
        lowest_safe_voltage=0.0,
        lowest_sticking_voltage=30.0,
        opening_voltage=20.0,
    )
    return SweepLoadResult(points=points, summaries=[summary], pull_in_voltage=12.5)


def heights_message(rows, columns):
    y, x = np.mgrid[:rows, :columns]
    heights = (np.sin(x / 9) * np.cos(y / 7) * 1e-8 + x * 2e-10 + 5e-7).astype(np.float32)
    heights[:5, :5] = np.nan
    return Image(
        height=rows, width=columns, step=4 * columns, encoding="32FC1", data=heights.tobytes()
    )


def contacts_message(rows, columns):
    regimes = np.zeros((rows, columns), np.uint8)
    regimes[rows // 2, columns // 4], regimes[5:9, 30:60] = 3, 1
    return Image(height=rows, width=columns, step=columns, encoding="mono8", data=regimes.tobytes())


def add_wafers(state):
    """7 x 7 sites, a gradient along x, two bad places; of the second wafer five rows are there,
    and one site without a margin. They are no scans of the tests' own count."""
    for wafer, rows in (("7", 7), ("8", 5)):
        for place in range(7 * rows):
            x, y = place % 7, place // 7
            is_bad = wafer == "7" and (x, y) in BAD_SITES
            margin = (
                NAN
                if wafer == "8" and place == 3
                else 2 * math.exp(0.1 * x + 0.02 * math.sin(7 * place)) * (0.3 if is_bad else 1)
            )
            state._wafers.add(
                place,
                prediction(
                    place,
                    margin=margin,
                    sticks=2 if is_bad else 0,
                    device_pull_off_force=1e-6,
                    lot_id="A",
                    wafer_id=wafer,
                    part_id="row %d" % y,
                    site_x=0.01 * x,
                    site_y=0.01 * y,
                ),
            )
