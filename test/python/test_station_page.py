"""The station's page without a graph: what it keeps, what it says, what it serves, and whom it
refuses."""

import asyncio
import contextlib
import copy
import io
import json
import math
import os
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.error
import urllib.request
import warnings
from types import SimpleNamespace

import numpy as np
import tornado.websocket
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from mems_stiction.msg import (
    CycleContactResult,
    CyclePoint,
    DeviceAdhesion,
    DeviceVerdict,
    HalfSpacePoint,
    HalfSpaceSolution,
    PartVerdict,
    SeparationPoint,
    StictionPrediction,
    SweepLoadResult,
    SweepPoint,
    SweepSummary,
)
from mems_stiction.control_chart import control_limits
from mems_stiction.page_maps import (
    contact_png,
    height_png,
    height_range,
    measured_at,
    rings,
    severest,
)
from mems_stiction.page_places import MOST_PLACES, MOST_WAFERS
from mems_stiction.page_server import FOLDER, CannotServe, PageServer
from mems_stiction.page_state import MOST_PARTS, MOST_SCANS, PageState, stamp_of_reason
from mems_stiction.page_words import (
    ON_ITS_WAY,
    all_finite,
    curve_of,
    half_space_of,
    part_of,
    ratio_of,
    trace_of,
    verdict_of,
)
from mems_stiction.quantities import typeset
from mems_stiction.station_text import sweep_sentences
from PIL import Image as Picture
from sensor_msgs.msg import Image

STATION_PAGE = pathlib.Path(__file__).resolve().parents[2] / "scripts/station_page"
SECOND = 10**9
NAN = math.nan


def has_core():
    try:
        from mems_stiction import _core  # noqa: F401
    except ImportError:
        return False
    return True


def prediction(margin=NAN, sticks=StictionPrediction.STICKS_UNKNOWN, **changes):
    message = StictionPrediction(
        part_id="lot 3",
        pull_off_force=1e-7,
        sticks=sticks,
        reason="because",
        margin=margin,
        margin_lower=0.5 * margin,
        margin_upper=2 * margin,
        restoring_force=NAN if math.isnan(margin) else 1e-6,
        peel_number=NAN,
        peel_number_lower=NAN,
        peel_number_upper=NAN,
        device_pull_off_force=NAN,
        contact_area_jkr=NAN,
    )
    for name, value in changes.items():
        setattr(message, name, value)
    return message


def part_message(**changes):
    message = PartVerdict(
        part_id="lot 3",
        serial_id="0012",
        scan_count=4,
        counted_scans=3,
        sticks=0,
        reason="above 1",
        verdict_by="prediction",
        margin=3.0,
        margin_lower=1.5,
        margin_upper=6.0,
        worst_margin=2.0,
        worst_margin_scan="place 2",
        peel_number=NAN,
        peel_number_lower=NAN,
        peel_number_upper=NAN,
        worst_peel_number=NAN,
        regime_flags=32,
        warnings=["one is odd"],
    )
    for name, value in changes.items():
        setattr(message, name, value)
    return message


def device_message(**changes):
    message = DeviceAdhesion(
        scan_count=3,
        part_id="lot 3",
        sticks=StictionPrediction.STICKS_NO,
        reason="above 1",
        verdict_by="prediction",
        pull_off_force=2e-7,
        pull_off_force_lower=1e-7,
        pull_off_force_upper=4e-7,
        linear_pull_off_force=3e-6,
        contacts=4.0,
        apparent_work_of_adhesion=1e-6,
        apparent_work_of_adhesion_lower=5e-7,
        apparent_work_of_adhesion_upper=2e-6,
        restoring_force=1e-6,
        margin=5.0,
        margin_lower=2.5,
        margin_upper=10.0,
        peel_number=NAN,
        peel_number_lower=NAN,
        peel_number_upper=NAN,
        settings_hash="00ff",
        warnings=["measure a field of 40 um"],
    )
    for name, value in changes.items():
        setattr(message, name, value)
    return message


def counts(rejected, reason="", dropped=0):
    values = {"rejected": rejected, "dropped": dropped, "last_reason": reason}
    return DiagnosticStatus(
        name="stiction_node: scans",
        level=b"\1",
        message="told",
        values=[KeyValue(key, str(value)) for key, value in values.items()],
    )


def jumping_sweep():
    """Up to 50 V, with a leap to ten times area and force, closed throughout."""
    points = [
        SweepPoint(
            direction=SweepPoint.UP,
            voltage=voltage,
            mechanical_load=1e-6,
            pull_off_force=force * 1e-8,
            contact_area=area * 1e-16,
            contact_area_jkr=NAN,
            asperity_count=count,
            margin=3.0,
            holding_margin=1.0,
        )
        for voltage, force, area, count in (
            (0, 1, 1, 1),
            (10, 1.01, 1.01, 1),
            (20, 10, 10, 90),
            (30, 10.1, 10.1, 90),
            (40, 10.2, 10.2, 90),
        )
    ]
    summary = SweepSummary(
        mechanical_load=1e-6,
        highest_releasing_voltage=NAN,
        highest_safe_voltage=NAN,
        lowest_sticking_voltage=NAN,
        opening_voltage=NAN,
    )
    return SweepLoadResult(points=points, summaries=[summary], pull_in_voltage=12.5)


def emptied(message, value):
    """The message with each of its floating-point numbers replaced, also in the messages that it
    holds."""
    for name, kind in zip(message.__slots__, message._slot_types):
        field = getattr(message, name)
        if kind in ("float32", "float64"):
            setattr(message, name, value)
        for part in field if isinstance(field, list) else [field]:
            if hasattr(part, "_slot_types"):
                emptied(part, value)
    return message


def map_message(array):
    array = np.asarray(array, np.uint8)
    return Image(
        height=array.shape[0],
        width=array.shape[1],
        step=array.shape[1],
        encoding="mono8",
        data=array.tobytes(),
    )


def on_wafer(x, y, margin=3.0, wafer="7", **changes):
    """A prediction of the site in column x and row y."""
    changes = dict(
        dict(
            lot_id="A",
            part_id="row %d" % y,
            pull_off_force=3e-7 / margin,
            rms_height=1e-9,
            settings_hash="00ff",
        ),
        **changes,
    )
    return prediction(
        margin,
        StictionPrediction.STICKS_YES if margin < 1 else StictionPrediction.STICKS_NO,
        wafer_id=wafer,
        site_x=1e-2 * x,
        site_y=1e-2 * y,
        **changes,
    )


BAD_SITES = {(1, 2), (5, 5)}


def wafer_of_49(add, wafer="7"):
    """7 x 7 sites whose margins grow along x by a tenth from one to the next, but at two, with some
    scatter."""
    scatter = np.random.RandomState(1).normal(0.0, 0.02, 49)
    for number, noise in enumerate(scatter):
        x, y = number % 7, number // 7
        add(
            (number + 1) * SECOND,
            on_wafer(
                x, y, 2.0 * math.exp(0.1 * x + noise) * (0.3 if (x, y) in BAD_SITES else 1.0), wafer
            ),
        )


class StateTest(unittest.TestCase):
    def test_losses_stand_in_the_trend_with_their_reason_and_a_restart_counts_from_zero(self):
        state = PageState()
        state.add_diagnostics(counts(7, "before our time"))
        state.add_prediction(1 * SECOND, prediction())
        state.add_diagnostics(counts(9, "rejected the scan of stamp 3.000000000: no pitch"))
        shown = state.snapshot()
        self.assertEqual((shown["count"], shown["lost"], shown["loss_is_newest"]), (3, 2, True))
        self.assertEqual(
            [row.get("lost") for row in shown["trend"]][1:],
            ["rejected the scan of stamp 3.000000000: no pitch"] * 2,
        )
        self.assertEqual(
            shown["losses"],
            [
                {
                    "number": 3,
                    "count": 2,
                    "reason": "Rejected the scan of stamp 3.000000000: no pitch.",
                }
            ],
        )
        state.add_diagnostics(counts(1, "of the new node"))
        self.assertEqual(state.snapshot()["lost"], 3)

    def test_a_loss_before_the_newest_prediction_does_not_hide_it(self):
        state = PageState()
        state.add_diagnostics(counts(0))
        state.add_prediction(5 * SECOND, prediction())
        state.add_diagnostics(counts(1, "rejected the scan of stamp 4.500000000: late news"))
        self.assertFalse(state.snapshot()["loss_is_newest"])
        self.assertEqual(stamp_of_reason("dropped the scan of stamp 4.500000000: x"), 4500000000)
        self.assertIsNone(stamp_of_reason("no partner"))

    def test_a_long_day_is_bounded_and_its_numbers_go_on(self):
        state = PageState()
        for number in range(3 * MOST_SCANS):
            state.add_prediction(number * SECOND, prediction(2.0, StictionPrediction.STICKS_NO))
        trend = state.snapshot()["trend"]
        self.assertEqual((len(trend), trend[-1]["number"]), (MOST_SCANS, 3 * MOST_SCANS))

    def test_control_limits_are_those_of_the_scans_with_the_newest_settings(self):
        state = PageState()
        forces = [1e-7 * factor for factor in (1.0, 1.1, 0.9, 1.0, 1.1, 1.0, 0.9, 5.0, 1.0)]
        state.add_prediction(1, prediction(pull_off_force=1e-3, settings_hash="before"))
        for number, force in enumerate(forces[:7]):
            state.add_prediction(number + 2, prediction(pull_off_force=force, settings_hash="now"))
        self.assertIsNone(state.snapshot()["control"])  # seven are too few
        for number, force in enumerate(forces[7:]):
            state.add_prediction(number + 9, prediction(pull_off_force=force, settings_hash="now"))
        state.add_prediction(
            20,
            prediction(
                pull_off_force=NAN, status=StictionPrediction.NO_EQUILIBRIUM, settings_hash="now"
            ),
        )
        expected = control_limits(forces)
        control = json.loads(json.dumps(state.snapshot()["control"], allow_nan=False))
        self.assertEqual((control["of"], control["first"], control["last"]), ("force", 2, 10))
        self.assertEqual(
            (control["lower"], control["centre"], control["upper"]),
            (expected.lower, expected.centre, expected.upper),
        )
        self.assertEqual(
            control["outside"],
            [number + 2 for number, force in enumerate(forces) if expected.is_outside(force)],
        )
        self.assertEqual(control["outside"], [9])

    def test_the_line_at_the_end_says_where_the_newest_scan_comes_from(self):
        state = PageState()
        state.add_prediction(
            1, prediction(scan_name="wafer", settings_hash="00ff", version="1.2.3")
        )
        self.assertEqual(
            state.snapshot()["scan"]["origin"],
            "scan wafer, part lot 3, settings 00ff, mems_stiction 1.2.3",
        )

    def test_a_sentence_of_a_sweep_is_one_line_for_the_browser_to_fold(self):
        state = PageState()
        result = jumping_sweep()
        self.assertTrue(
            any(text.startswith("    ") for text in sweep_sentences(result))
        )  # folded for a terminal
        state.add_sweep("goal", result)
        sentences = state.snapshot()["runs"]["sweep"]["sentences"]
        self.assertFalse([text for text in sentences if text.startswith("    ")])
        self.assertTrue(any(text.startswith("  jump") and len(text) > 130 for text in sentences))

    def test_a_run_without_a_margin_says_why_if_it_is_of_the_newest_scan(self):
        state = PageState()
        state.add_prediction(SECOND, prediction(reason="the scan does not show what holds"))
        cycles = CycleContactResult(cycles=[CyclePoint(cycle=1, margin=NAN, peel_number=NAN)])
        for stamp, why in ((1, "the scan does not show what holds"), (2, "it needs device/")):
            cycles.header.stamp.secs = stamp
            state.add_cycles("goal", cycles)
            sentences = state.snapshot()["runs"]["cycles"]["sentences"]
            self.assertTrue(
                any(text.startswith("There is no margin: " + why) for text in sentences), sentences
            )

    def test_the_whole_device_judges_once_its_force_is_there(self):
        state = PageState()
        awaiting = prediction(
            reason="the device's own force has not been found (it follows on device_force)",
            settings_hash="00ff",
            restoring_force=1e-6,
        )
        state.add_prediction(SECOND, awaiting)
        shown = state.snapshot()
        self.assertEqual(
            (shown["scan"]["verdict"]["word"], shown["scan"]["ratio"], shown["device"]),
            ("COMPUTING", None, None),
        )
        self.assertEqual(
            (shown["scan"]["verdict"]["reason"], shown["scan"]["verdict"]["provisional"]),
            (
                "The pull-off force of this scan is 100 nN, the restoring force of the spring "
                "1.00 µN.",
                ON_ITS_WAY,
            ),
        )
        state.add_device(SECOND, device_message())
        shown = json.loads(json.dumps(state.snapshot(), allow_nan=False))
        self.assertEqual(
            shown["scan"]["verdict"],
            {"level": "releases", "word": "RELEASES", "reason": "Above 1."},
        )
        self.assertEqual(shown["scan"]["ratio"], ratio_of(device_message()))
        self.assertEqual(shown["scan"]["warnings"], ["measure a field of 40 µm"])
        self.assertEqual(
            [
                shown["trend"][0][name]
                for name in ("device_force", "restoring_force", "ratio", "lower", "upper", "level")
            ],
            [2e-7, 1e-6, 5.0, 2.5, 10.0, "releases"],
        )
        self.assertEqual(
            (shown["device"]["number"], shown["device"]["scans"], shown["device"]["part"]),
            (1, "3 scans", "part lot 3"),
        )
        texts = {figure["name"]: figure["text"] for figure in shown["device"]["figures"]}
        self.assertEqual(texts["device_pull_off_force"], "200 nN (100 to 400)")
        self.assertEqual(texts["linear_pull_off_force"], "3.00 µN")
        # The next scan is not judged by the force that was found before it.
        state.add_prediction(2 * SECOND, awaiting)
        shown = state.snapshot()
        self.assertEqual(
            (shown["scan"]["verdict"]["word"], shown["device"]["number"]), ("COMPUTING", 1)
        )
        self.assertTrue(
            shown["scan"]["verdict"]["reason"].endswith(
                "The verdict before, on scan 1: RELEASES, margin 5."
            )
        )
        # Another load afterwards: the same scan, judged under other settings.
        state.add_device(
            2 * SECOND, device_message(sticks=StictionPrediction.STICKS_YES, settings_hash="11ff")
        )
        verdict = state.snapshot()["scan"]["verdict"]
        self.assertEqual(
            (verdict["word"], verdict["reason"]),
            ("STICKS", "Above 1. Judged again, under the settings of now."),
        )

    def test_a_device_whose_force_was_not_found_says_why_and_judges_nothing(self):
        state = PageState()
        state.add_prediction(SECOND, prediction(2.0, StictionPrediction.STICKS_NO))
        state.add_device(
            SECOND,
            device_message(
                status=DeviceAdhesion.REFUSED,
                message="no scan is large enough",
                pull_off_force=NAN,
                margin=NAN,
                contacts=NAN,
            ),
        )
        shown = json.loads(json.dumps(state.snapshot(), allow_nan=False))
        self.assertEqual(
            (shown["scan"]["verdict"]["word"], shown["trend"][0]["ratio"]), ("RELEASES", 2.0)
        )
        self.assertEqual(
            (shown["device"]["is_found"], shown["device"]["message"]),
            (False, "No scan is large enough."),
        )
        self.assertNotIn(
            "device_contacts", [figure["name"] for figure in shown["device"]["figures"]]
        )

    def test_what_is_not_finite_is_no_trouble_for_json(self):
        state = PageState()
        message = prediction(
            math.inf, StictionPrediction.STICKS_NO, flattening_ratio=math.inf, rms_height=NAN
        )
        state.add_prediction(SECOND, message)
        shown = json.loads(json.dumps(state.snapshot(), allow_nan=False))
        self.assertEqual(
            (shown["scan"]["ratio"]["text"], shown["scan"]["ratio"]["value"]), ("infinite", None)
        )
        self.assertNotIn("rms_height", [figure["name"] for figure in shown["scan"]["figures"]])

    def test_messages_without_one_finite_number_leave_the_page_alive(self):
        for value in (NAN, math.inf, -math.inf, 1e308, -sys.float_info.max):
            state = PageState()
            state.add_prediction(
                SECOND,
                emptied(
                    prediction(curve=[SeparationPoint(), SeparationPoint(is_separation=True)]),
                    value,
                ),
            )
            state.add_half_space(
                SECOND,
                emptied(
                    HalfSpaceSolution(
                        curve=[HalfSpacePoint(), HalfSpacePoint(direction=1)],
                        verdict_by="half_space",
                    ),
                    value,
                ),
            )
            state.add_device(SECOND, emptied(device_message(), value))
            state.add_part(SECOND, emptied(part_message(), value))
            state.add_sweep("goal", emptied(jumping_sweep(), value))
            state.add_cycles(
                "goal",
                emptied(
                    CycleContactResult(cycles=[CyclePoint(cycle=1), CyclePoint(cycle=2)]), value
                ),
            )
            shown = json.loads(json.dumps(state.snapshot(), allow_nan=False))
            self.assertEqual(
                (shown["runs"]["sweep"]["points"], len(shown["runs"]["cycles"]["points"])), ([], 2)
            )
            self.assertIsNone(shown["scan"]["curve"])
            self.assertEqual(shown["broken"], [])
            self.assertLess(max(len(figure["text"]) for figure in shown["scan"]["figures"]), 60)

    def test_messages_without_any_content_leave_the_page_alive(self):
        state = PageState()
        for _ in range(10):  # control limits need some
            state.add_prediction(SECOND, StictionPrediction())
        state.add_part(SECOND, PartVerdict())
        state.add_device(SECOND, DeviceAdhesion())
        state.add_half_space(SECOND, HalfSpaceSolution(status=200))
        state.add_sweep("goal", SweepLoadResult())
        state.add_cycles("goal", CycleContactResult())
        state.add_diagnostics(DiagnosticStatus())
        state.add_diagnostics(
            DiagnosticStatus(
                name="node", values=[KeyValue("rejected", "many"), KeyValue("dropped", "9" * 5000)]
            )
        )
        shown = json.loads(json.dumps(state.snapshot(), allow_nan=False))
        self.assertEqual(
            (shown["broken"], shown["part"]["name"], shown["lost"]), ([], "part without a name", 0)
        )

    def test_forces_of_every_size_have_control_limits(self):
        state = PageState()
        for number in range(20):
            state.add_prediction(
                number * SECOND, prediction(pull_off_force=1e308 if number % 2 else 5e-324)
            )
        shown = json.loads(json.dumps(state.snapshot(), allow_nan=False))
        self.assertEqual((shown["broken"], shown["count"]), ([], 20))

    def test_long_messages_are_cut_for_browsers(self):
        state = PageState()
        points = [
            SeparationPoint(displacement=1e-12 * number, force=1e-9) for number in range(100000)
        ]
        long = "x" * 1000000
        state.add_prediction(
            SECOND,
            prediction(
                curve=points,
                warnings=["w"] * 100000,
                scan_name=long,
                reason=long,
                preprocessing=[long] * 10,
            ),
        )
        state.add_part(SECOND, part_message(part_id=long, warnings=[long]))
        state.add_cycles(
            "goal",
            CycleContactResult(cycles=[CyclePoint(cycle=number) for number in range(100000)]),
        )
        result = jumping_sweep()
        result.points = [
            SweepPoint(voltage=0.001 * number, mechanical_load=1e-6) for number in range(100000)
        ]
        state.add_sweep("goal", result)
        for number in range(1000):
            state.add_diagnostics(DiagnosticStatus(name="node: %d" % number))
        text = json.dumps(state.snapshot(), allow_nan=False)
        self.assertLess(len(text), 2000000)
        shown = json.loads(text)
        self.assertEqual(
            (shown["scan"]["curve"]["in"][0][0], shown["scan"]["curve"]["in"][-1][0]),
            (0.0, points[-1].displacement),
        )
        self.assertEqual(shown["broken"], [])

    def test_the_node_and_the_source_of_its_scans_are_heard_and_nobody_else(self):
        from mems_stiction.page_listener import (
            PageListener,
        )  # as station_page does: messages are slow to import

        state = PageState()
        names = [
            "left/stiction_node: scans",
            "left/camera: scan_source",
            "left/camera: frames",
            "right/stiction_node: scans",
            "right/camera: scan_source",
        ]
        PageListener(state, "/left/stiction_node")._on_diagnostics(
            SimpleNamespace(status=[DiagnosticStatus(name=name) for name in names])
        )
        self.assertEqual(
            {status["name"] for status in state.snapshot()["diagnostics"]}, set(names[:2])
        )

    def test_what_brings_the_scans_is_told_in_a_line_and_silence_shows(self):
        now = [0.0]
        state = PageState(clock=lambda: now[0])

        def tell(level=0, **values):
            state.add_diagnostics(
                DiagnosticStatus(
                    name="scan_source: scan_source",
                    level=level,
                    values=[KeyValue(key=key, value=value) for key, value in values.items()],
                )
            )
            return state.snapshot()["sources"]

        (source,) = tell(found="0", published="0", refused="0", waiting="0")
        self.assertEqual(source["text"], "Source: 0 of 0 scans published.")
        (source,) = tell(found="1", published="0", refused="0", waiting="0")
        self.assertEqual(source["text"], "Source: 0 of 1 scan published.")
        now[0] = 1.0
        (source,) = tell(
            1,
            found="6",
            published="3",
            refused="1",
            waiting="2",
            last_published="beam 3 um.di",
            last_refused="notes.docx: no scan",
            hindered_by="nobody listens",
        )
        self.assertEqual(source["level"], "warn")
        self.assertEqual(
            source["text"],
            "Source: 3 of 6 scans published, the last: beam 3 um.di. Waiting: 2. "
            "Hindered: nobody listens. Refused: 1, the last: notes.docx: no scan.",
        )
        self.assertEqual(source["silent_after"], 10.0)
        now[0] = 31.0
        self.assertGreater(
            state.snapshot()["sources"][0]["age"], state.snapshot()["sources"][0]["silent_after"]
        )
        (source,) = tell(found="6")
        self.assertEqual(source["silent_after"], 90.0)  # it tells every half minute

    def test_a_map_that_is_none_keeps_the_one_before_and_is_named(self):
        state = PageState()
        good = map_message([[0, 1], [2, 3]])
        floats = Image(
            height=2, width=2, step=8, encoding="32FC1", data=np.zeros(4, np.float32).tobytes()
        )
        for name, first in (("contacts", good), ("height", floats)):
            state.set_map(name, SECOND, first)
            for changes, reason in (
                (dict(data=b"\0"), "data has 1 bytes, must have step"),
                (dict(encoding="rgb8"), "encoding 'rgb8' is not allowed"),
                (dict(height=0, width=0, step=0, data=b""), "size 0 x 0"),
                (dict(step=1), "step 1"),
                (dict(height=2**31), "data has"),
            ):
                damaged = copy.copy(first)
                for field, value in changes.items():
                    setattr(damaged, field, value)
                state.set_map(name, 2 * SECOND, damaged)
                self.assertIs(state.map_of(name)[1], first, reason)
                self.assertIn(reason, state.snapshot()["map_notes"][-1])
            state.set_map(name, 3 * SECOND, first)
            self.assertEqual(state.snapshot()["map_notes"], [])
        state.set_map("contacts", SECOND, floats)
        self.assertIn("must be mono8", state.snapshot()["map_notes"][0])

    def test_one_point_that_is_not_finite_takes_no_other_with_it(self):
        state = PageState()
        result = jumping_sweep()
        result.points[1].mechanical_load = result.points[2].voltage = NAN
        state.add_sweep("goal", result)
        self.assertEqual(
            [
                (point["voltage"], point["load"])
                for point in state.snapshot()["runs"]["sweep"]["points"]
            ],
            [(0, 1e-6), (10, None), (30, 1e-6), (40, 1e-6)],
        )
        points = [
            SeparationPoint(displacement=x, force=force)
            for x, force in ((-1e-9, 1e-9), (NAN, 2e-9), (0.0, NAN), (1e-9, 3e-9))
        ]
        self.assertEqual(curve_of(prediction(curve=points))["in"], [(-1e-9, 1e-9), (1e-9, 3e-9)])

    def test_ages_are_told_in_seconds_of_the_clock(self):
        now = [100.0]
        state = PageState(clock=lambda: now[0])
        self.assertIsNone(state.snapshot()["age"])
        state.add_prediction(SECOND, prediction())
        now[0] = 135.0
        self.assertEqual(state.snapshot()["age"], 35.0)

    def test_what_is_old_follows_the_rate_of_the_scans(self):
        now = [0.0]
        state = PageState(clock=lambda: now[0])
        self.assertEqual(state.snapshot()["stale_after"], 30.0)
        for period, expected in ((600.0, 1800.0), (0.05, 5.0)):
            for _ in range(20):
                now[0] += period
                state.add_prediction(1, prediction())
            self.assertAlmostEqual(state.snapshot()["stale_after"], expected)
        now[0] += 1e5  # a night is no period of theirs
        state.add_prediction(1, prediction())
        self.assertAlmostEqual(state.snapshot()["stale_after"], 5.0)

    def test_a_scan_that_is_judged_again_does_not_hide_a_later_one(self):
        state = PageState()
        for stamp in (5, 6):
            state.add_prediction(stamp * SECOND, prediction(serial_id=str(stamp)))
            state.add_device(stamp * SECOND, device_message(serial_id=str(stamp)))
            state.add_part(stamp * SECOND, part_message(serial_id=str(stamp)))
        state.add_device(5 * SECOND, device_message(serial_id="5", margin=7.0))
        state.add_part(5 * SECOND, part_message(serial_id="5", margin=7.0))
        shown = state.snapshot()
        self.assertEqual((shown["device"]["number"], shown["part"]["serial"]), (2, "6"))
        self.assertEqual(shown["trend"][0]["ratio"], 7.0)
        self.assertEqual(
            [(part["serial"], part["ratio"]["value"]) for part in shown["parts"]],
            [("6", 3.0), ("5", 7.0)],
        )
        state.add_prediction(1 * SECOND, prediction())  # a bag of an earlier day
        state.add_device(1 * SECOND, device_message())
        self.assertEqual(state.snapshot()["device"]["number"], 3)

    def test_parts_whose_scans_have_one_stamp_do_not_mix(self):
        state = PageState()
        for serial, force in (("1", 2e-7), ("2", 3e-7)):
            part = dict(part_id="lot 3", serial_id=serial)
            message = prediction(2.0, 0, **part, site_x=NAN, site_y=NAN)
            state.add_prediction(SECOND, message)
            state.add_device(SECOND, device_message(**part, pull_off_force=force))
            state.add_answer(SECOND, DeviceVerdict(**part))
        shown = state.snapshot()
        self.assertEqual([row["device_force"] for row in shown["trend"]], [2e-7, 3e-7])
        self.assertEqual([row["device_pull_off_force"] for row in state.wafers()[0]], [2e-7, 3e-7])
        self.assertEqual(shown["device"]["number"], 2)
        state.add_device(
            SECOND, device_message(part_id="lot 3", serial_id="1", pull_off_force=9e-7)
        )
        shown = state.snapshot()
        self.assertEqual([row["device_force"] for row in shown["trend"]], [9e-7, 3e-7])
        self.assertEqual(shown["device"]["number"], 2)  # of the newest scan

    def test_parts_are_bounded(self):
        state = PageState()
        for number in range(2 * MOST_PARTS):
            state.add_part(number, part_message(serial_id=str(number)))
        self.assertEqual(
            [part["serial"] for part in state.snapshot()["parts"]],
            [str(number) for number in range(MOST_PARTS, 2 * MOST_PARTS)],
        )
        self.assertEqual(len(state.part_rows()), MOST_PARTS)

    def test_a_stamp_has_the_digits_of_its_message(self):
        state = PageState()
        for stamp, digits, shown in (
            (1000000003 * SECOND, "1000000003.000000000", "1000000003.000"),
            (1000000003 * SECOND + 7, "1000000003.000000007", "1000000003.000"),
            (1000000003 * SECOND + 999999999, "1000000003.999999999", "1000000004.000"),
        ):
            state.add_prediction(stamp, prediction())
            self.assertEqual(state.scan_row()["stamp"], digits)
            self.assertEqual(state.snapshot()["scan"]["stamp"], shown)

    def test_progress_that_comes_after_the_result_is_not_shown(self):
        state = PageState()
        state.add_progress("cycles", "goal 1", 1, 2)
        self.assertEqual(state.snapshot()["runs"]["cycles"]["progress"], [1, 2])
        state.add_cycles(
            "goal 1", SimpleNamespace(cycles=[], message="cancelled", first_sticking_cycle=0)
        )
        state.add_progress("cycles", "goal 1", 2, 2)
        shown = state.snapshot()["runs"]["cycles"]
        self.assertNotIn("progress", shown)
        self.assertEqual(shown["message"], "cancelled")


@unittest.skipUnless(has_core(), "the compiled part of the Python module is not built")
class WafersTest(unittest.TestCase):
    def setUp(self):
        self.state = PageState()

    def told(self):
        from mems_stiction.page_wafers import told

        return json.loads(json.dumps(told(self.state.wafers()), allow_nan=False))

    def bad_sites(self, shown, figure):
        return {
            (round(100 * place["x"]), round(100 * place["y"]))
            for place in shown["places"]
            if figure in place["bad"]
        }

    def test_two_bad_places_of_a_wafer_with_a_trend_are_marked_and_no_other(self):
        wafer_of_49(self.state.add_prediction)
        shown = self.told()
        self.assertEqual(
            [figure["name"] for figure in shown["figures"]],
            ["margin", "pull_off_force", "rms_height"],
        )
        self.assertEqual(
            (len(shown["wafers"]), len(shown["places"]), shown["wafers"][0]["name"]),
            (1, 49, "Wafer 7 of lot A"),
        )
        for figure, bad in (
            ("margin", BAD_SITES),
            ("pull_off_force", BAD_SITES),
            ("rms_height", set()),
        ):
            self.assertEqual(self.bad_sites(shown, figure), bad)
            self.assertEqual(len(shown["wafers"][0]["bad"][figure]), len(bad))
        self.assertRegex(
            " ".join(shown["wafers"][0]["bad"]["margin"]),
            r"\(10, 20\) mm row 2: 0\.\d+, expected 2\.\d+",
        )
        self.assertEqual(shown["notes"], [])

    def test_the_newest_prediction_of_a_site_counts(self):
        wafer_of_49(self.state.add_prediction)
        before = self.state.wafers()
        self.assertIs(self.state.wafers(), before)  # drawn once for all browsers
        for number, (x, y) in enumerate(BAD_SITES):
            self.state.add_prediction(
                (100 + number) * SECOND, on_wafer(x, y, 2.0 * math.exp(0.1 * x))
            )
        shown = self.told()
        self.assertEqual((self.bad_sites(shown, "margin"), len(shown["places"])), (set(), 49))

    def test_what_has_no_value_is_missing_and_so_is_a_site_that_another_wafer_has(self):
        wafer_of_49(self.state.add_prediction)
        self.state.add_prediction(60 * SECOND, on_wafer(0, 0, 3.0, "8"))
        self.state.add_prediction(
            61 * SECOND, on_wafer(1, 0, 3.0, "8", status=StictionPrediction.NO_EQUILIBRIUM)
        )
        self.state.add_prediction(62 * SECOND, on_wafer(2, 0, math.inf, "8", pull_off_force=1e-9))
        shown = self.told()
        self.assertEqual(
            [wafer["name"] for wafer in shown["wafers"]], ["Wafer 8 of lot A", "Wafer 7 of lot A"]
        )  # heard of last first
        self.assertEqual([len(wafer["missing"]) for wafer in shown["wafers"]], [46, 0])
        self.assertEqual(
            [
                (place["texts"]["margin"], place["texts"]["rms_height"], place["values"]["margin"])
                for place in shown["places"]
                if place["wafer"] == 0
            ],
            [("3", "1.00 nm", 3.0), (None, "1.00 nm", None), ("infinite", "1.00 nm", None)],
        )

    def test_parts_stand_side_by_side_with_median_middle_half_and_verdicts(self):
        wafer_of_49(self.state.add_prediction)
        shown = self.told()
        parts = {part["part"]: part for part in shown["parts"]}
        self.assertEqual(sorted(parts), ["row %d" % row for row in range(7)])
        for number, part in enumerate(shown["parts"]):
            margins = [
                place["values"]["margin"] for place in shown["places"] if place["part"] == number
            ]
            self.assertEqual((part["places"], len(margins)), (7, 7))
            self.assertEqual(
                [part["figures"]["margin"][name] for name in ("median", "low", "high")],
                [np.percentile(margins, share) for share in (50, 25, 75)],
            )
        self.assertEqual(parts["row 2"]["levels"], {"sticks": 1, "releases": 6})
        self.assertEqual(parts["row 1"]["levels"], {"releases": 7})

    def test_wafers_and_places_are_bounded_and_it_is_said_what_went(self):
        for wafer in range(MOST_WAFERS + 2):
            self.state.add_prediction(wafer + 1, on_wafer(0, 0, wafer=str(wafer)))
        for number in range(MOST_PLACES + 3):
            self.state.add_prediction(1000 + number, on_wafer(number, 1, wafer="large"))
        shown = self.told()
        self.assertEqual(
            (len(shown["wafers"]), shown["wafers"][0]["name"]),
            (MOST_WAFERS, "Wafer large of lot A"),
        )
        self.assertEqual(
            len([place for place in shown["places"] if place["wafer"] == 0]), MOST_PLACES
        )
        self.assertIn(
            "Dropped: 3 wafers; the %d wafers heard of last are kept." % MOST_WAFERS, shown["notes"]
        )
        self.assertIn(
            "Dropped: 3 places; the %d newest places of each wafer are kept." % MOST_PLACES,
            shown["notes"],
        )

    def test_without_sites_it_says_what_to_state(self):
        self.assertRegex(
            self.told()["notes"][0],
            "^No scan yet. State site_x and site_y .* wafer_id.* scan_info .* sidecar",
        )
        self.state.add_prediction(1, prediction(2.0, 0, site_x=NAN, site_y=NAN))
        self.assertRegex(
            self.told()["notes"][0],
            "^No scan has stated where on a wafer it was taken. State site_x and site_y",
        )
        self.state.add_prediction(2, prediction(2.0, 0, site_x=0.0, site_y=0.0))
        notes = self.told()["notes"]
        self.assertEqual(notes[0], "1 scan states no site_x and site_y: it is on no map.")
        self.assertIn("state wafer_id", notes[1])

    def test_the_force_of_the_whole_device_judges_the_place_of_its_scan(self):
        for x in (0, 1):
            self.state.add_prediction((x + 1) * SECOND, on_wafer(x, 0, NAN, pull_off_force=1e-7))
        self.state.add_device(2 * SECOND, device_message(part_id="row 0"))
        shown = self.told()
        self.assertEqual([place["values"].get("margin") for place in shown["places"]], [None, 5.0])
        self.assertEqual(
            [place["values"].get("device_pull_off_force") for place in shown["places"]],
            [None, 2e-7],
        )

    def test_numbers_that_are_not_finite_are_no_trouble(self):
        for number, value in enumerate((NAN, math.inf, -math.inf)):
            self.state.add_prediction(number, emptied(on_wafer(0, 0), value))
            self.told()


class WordsTest(unittest.TestCase):
    def test_each_verdict_has_its_word(self):
        for sticks, word in ((0, "RELEASES"), (1, "MARGINAL"), (2, "STICKS"), (3, "NOT KNOWN")):
            self.assertEqual(verdict_of(prediction(2.0, sticks))["word"], word)
        self.assertEqual(verdict_of(prediction())["word"], "NO VERDICT")
        self.assertEqual(
            verdict_of(prediction(2.0, 0, status=StictionPrediction.NO_EQUILIBRIUM))["word"],
            "NO EQUILIBRIUM",
        )

    def test_a_beam_is_judged_by_its_peel_number(self):
        beam = prediction(peel_number=3.0, peel_number_lower=2.0, peel_number_upper=4.5, sticks=0)
        self.assertEqual(ratio_of(beam)["label"], "peel number")
        self.assertEqual(ratio_of(beam)["interval"], "95 %: 2 to 4.5")
        self.assertIsNone(ratio_of(prediction()))

    def test_a_part_has_its_word_its_scans_and_what_speaks_against_it(self):
        shown = part_of(part_message())
        self.assertEqual(
            (shown["name"], shown["level"], shown["word"]),
            ("part lot 3, serial number 0012", "releases", "RELEASES"),
        )
        self.assertEqual(shown["ratio"]["interval"], "95 %: 1.5 to 6")
        self.assertEqual(
            (shown["scans"], shown["worst"]), ("4 scans, 3 count", "lowest 2 of place 2")
        )
        self.assertEqual(
            (shown["verdict_by"], shown["warnings"], len(shown["flags"])),
            ("the prediction", ["one is odd"], 1),
        )
        self.assertEqual(part_of(part_message(part_id="", sticks=2))["name"], "serial number 0012")
        one = part_of(part_message(scan_count=1, counted_scans=1))
        self.assertEqual((one["scans"], one["worst"]), ("1 scan", None))
        bare = part_of(
            part_message(
                margin=NAN,
                worst_margin=NAN,
                counted_scans=0,
                sticks=3,
                reason="the device is not stated: it needs",
                verdict_by="",
            )
        )
        self.assertEqual((bare["word"], bare["ratio"], bare["worst"]), ("NO VERDICT", None, None))

    def test_a_part_that_two_have_judged_says_so_in_words(self):
        shown = part_of(part_message(verdict_by="prediction and half_space"))
        self.assertEqual(
            shown["verdict_by"], "the prediction of some scans and the half-space of others"
        )
        self.assertEqual(part_of(part_message(verdict_by=""))["verdict_by"], "")

    def test_two_scans_that_say_nothing_of_a_part_show_no_number(self):
        shown = part_of(
            part_message(
                scan_count=2,
                counted_scans=2,
                margin=6.18,
                margin_lower=9.57e-11,
                margin_upper=2.07e12,
                sticks=1,
                reason="why",
            )
        )
        self.assertEqual((shown["word"], shown["ratio"]), ("MARGINAL", None))
        self.assertEqual(shown["reason"], "2 scans say nothing of the margin yet. Why.")
        known = part_of(
            part_message(
                scan_count=2,
                counted_scans=2,
                margin=6.18,
                margin_lower=0.1,
                margin_upper=90.0,
                reason="why",
            )
        )
        self.assertEqual((known["ratio"]["interval"], known["reason"]), ("95 %: 0.1 to 90", "Why."))

    def test_a_part_is_the_newest_scans_or_said_to_be_before_it(self):
        state = PageState()
        state.add_part(1 * SECOND, part_message())
        state.add_prediction(1 * SECOND, prediction(serial_id="0012"))
        self.assertTrue(state.snapshot()["part"]["is_newest"])
        state.add_prediction(1 * SECOND, prediction(serial_id="0013"))
        self.assertFalse(state.snapshot()["part"]["is_newest"])
        state.add_prediction(2 * SECOND, prediction())
        self.assertFalse(state.snapshot()["part"]["is_newest"])
        json.dumps(state.snapshot(), allow_nan=False)

    def test_a_scan_is_called_by_its_own_name(self):
        state = PageState()
        state.add_prediction(1 * SECOND, prediction(scan_name="place 2"))
        self.assertEqual(state.snapshot()["scan"]["name"], "place 2")

    def test_what_a_prediction_was_made_of_and_with_is_told(self):
        shown = trace_of(
            prediction(version="1.2.3", settings_hash="00ff", scan_name="place 2", part_id="lot 3")
        )
        self.assertEqual(
            [(row["label"], row["text"]) for row in shown],
            [("scan", "place 2"), ("part", "lot 3"), ("settings", "00ff"), ("version", "1.2.3")],
        )

    def test_a_half_space_says_who_has_judged(self):
        solution = HalfSpaceSolution(
            sticks=0,
            verdict_by="half_space",
            reason="by it",
            margin=3.0,
            margin_lower=2.0,
            margin_upper=4.0,
            peel_number=NAN,
        )
        self.assertEqual(
            [half_space_of(solution)["verdict"][key] for key in ("word", "by", "level")],
            ["RELEASES", "the half-space", "releases"],
        )
        solution.verdict_by = "prediction"
        self.assertEqual(half_space_of(solution)["verdict"]["by"], "the prediction")
        solution.verdict_by, solution.margin = "", NAN
        self.assertIsNone(half_space_of(solution)["verdict"])

    def test_the_peak_is_that_of_the_way_out(self):
        points = [
            SeparationPoint(displacement=x, force=force, is_separation=out)
            for x, force, out in (
                (-1e-9, 1e-9, False),
                (0.0, 3e-9, False),
                (0.0, 5e-9, True),
                (-1e-9, 2e-9, True),
            )
        ]
        self.assertEqual(curve_of(prediction(curve=points))["peak"], [0.0, 5e-9])
        self.assertEqual(curve_of(prediction(curve=points[:2]))["peak"], [0.0, 3e-9])
        self.assertIsNone(curve_of(prediction()))

    def test_only_a_unit_gets_its_micro(self):
        self.assertEqual(
            typeset("releases after voltages up to 1.00 uN"),
            "releases after voltages up to 1.00 µN",
        )


class MapTest(unittest.TestCase):
    def test_no_contact_is_lost_where_a_map_is_made_smaller(self):
        regimes = np.zeros((1500, 1000), np.uint8)
        regimes[1499, 999], regimes[700, 300] = 3, 1
        self.assertEqual(severest(regimes).shape, (500, 334))
        found = rings(map_message(regimes))
        self.assertEqual(sorted(ring[2] for ring in found), [1, 3])
        place = min(found, key=lambda ring: ring[2])
        # within two pixels of the thinned map
        self.assertAlmostEqual(place[0], 0.3, delta=2 / 334)
        self.assertAlmostEqual(place[1], 700 / 1500, delta=2 / 500)

    def test_large_contacts_need_no_ring_and_an_empty_map_has_none(self):
        regimes = np.zeros((64, 64), np.uint8)
        self.assertEqual(rings(map_message(regimes)), [])
        regimes[10:30, 10:30] = 2
        self.assertEqual(rings(map_message(regimes)), [])

    def test_pictures_are_png_whatever_the_map_says(self):
        for make in (contact_png, height_png):
            self.assertEqual(make(map_message([[0, 1], [2, 255]]))[:4], b"\x89PNG")
        self.assertEqual(height_png(map_message(np.ones((4, 4))))[:4], b"\x89PNG")  # no range
        nothing = Image(
            height=1,
            width=2,
            step=8,
            encoding="32FC1",
            data=np.full(2, np.nan, np.float32).tobytes(),
        )
        self.assertEqual((height_png(nothing)[:4], height_range(nothing)), (b"\x89PNG", (0.0, 0.0)))

    def test_a_turned_map_has_its_top_to_the_right(self):
        with Picture.open(
            io.BytesIO(contact_png(map_message([[1, 2], [0, 0], [3, 0]]), quarters=1))
        ) as picture:
            self.assertEqual(np.asarray(picture).tolist(), [[3, 0, 1], [0, 0, 2]])


class ServerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.state = PageState()
        started = threading.Event()

        def serve():
            cls.server = PageServer(cls.state, "127.0.0.1", 0, 30.0)
            started.set()
            cls.server.run()

        cls.thread = threading.Thread(target=serve)
        cls.thread.start()
        started.wait(120)

    @classmethod
    def tearDownClass(cls):
        cls.server.stop()
        cls.thread.join(120)

    def get(self, path, host=None):
        request = urllib.request.Request(
            "http://127.0.0.1:%d%s" % (self.server.port, path),
            headers={"Host": host} if host else {},
        )
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return answer.status, answer.headers, answer.read()
        except urllib.error.HTTPError as error:
            return error.code, error.headers, error.read()

    def test_the_page_is_served_and_may_load_nothing_from_elsewhere(self):
        status, headers, content = self.get("/")
        self.assertEqual((status, b"Stiction station" in content), (200, True))
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        for file in FOLDER.iterdir():
            self.assertEqual(self.get("/" + file.name)[0], 200, file.name)
            addresses = re.findall(
                r"(?:https?:)?//[\w.]+\.\w+[^\s\"')]*", file.read_text(encoding="utf-8")
            )
            self.assertEqual(
                [one for one in addresses if one != "http://www.w3.org/2000/svg"], [], file.name
            )

    def test_other_files_and_maps_that_are_not_there_are_not_found(self):
        for path in (
            "/../page_server.py",
            "/%2e%2e/page_server.py",
            "/page_server.py",
            "/map/height.png",
            "/map/other.png",
            "/scan.csv",
            "/parts.csv",
            "/measure?id=1&x=0.5&y=0.5",
        ):
            self.assertEqual(self.get(path)[0], 404, path)

    def test_what_cannot_be_measured_is_refused(self):
        for places in ("", "x=0.5", "x=a&y=0", "x=2&y=0", "x=nan&y=0", "x=0&y=0&x=0&y=0&x=0&y=0"):
            self.assertEqual(self.get("/measure?id=1&" + places)[0], 400, places)

    def test_a_name_of_another_site_gets_nothing(self):
        self.assertEqual(self.get("/", "stiction.example:80")[0], 403)
        self.assertEqual(self.get("/", "localhost:1")[0], 200)

    def test_a_map_is_that_of_the_newest_scan(self):
        self.state.set_map("contacts", 1, map_message([[0, 1]]))
        first = self.get("/map/contacts.png")
        self.state.set_map("contacts", 2, map_message([[0, 3]]))
        second = self.get("/map/contacts.png")
        self.assertEqual((first[0], second[0], first[1]["Content-Type"]), (200, 200, "image/png"))
        self.assertNotEqual(first[2], second[2])

    def test_a_port_that_is_taken_and_an_address_that_is_not_ours_are_refused_in_a_sentence(self):
        self.assertRaisesRegex(
            CannotServe,
            "port %d of 127.0.0.1 is taken" % self.server.port,
            PageServer,
            self.state,
            "127.0.0.1",
            self.server.port,
            30.0,
        )
        self.assertRaisesRegex(
            CannotServe,
            "192.0.2.1 cannot be listened on",
            PageServer,
            self.state,
            "192.0.2.1",
            0,
            30.0,
        )


class OneMessageTest(unittest.TestCase):
    def test_heights_that_are_no_numbers_or_too_large_for_one_have_a_range_and_a_picture(self):
        for values in (
            [NAN] * 4,
            [math.inf, -math.inf, NAN, 1e-9],
            [1e308, -1e308, 1e308, 1e308],
            [0.0] * 4,
        ):
            message = Image(
                height=2, width=2, step=16, encoding="64FC1", data=np.asarray(values).tobytes()
            )
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self.assertTrue(height_png(message))
                json.dumps(
                    all_finite(
                        [height_range(message), measured_at(message, None, [(0.5, 0.5), (0, 0)])]
                    ),
                    allow_nan=False,
                )


class PatienceTest(unittest.TestCase):
    def setUp(self):
        self.state = PageState()
        started = threading.Event()

        def serve():
            self.server = PageServer(self.state, "127.0.0.1", 0, 30.0, patience=0.5)
            started.set()
            self.server.run()

        thread = threading.Thread(target=serve)
        thread.start()
        started.wait(120)
        self.addCleanup(thread.join, 120)
        self.addCleanup(self.server.stop)

    def ended(self, request):
        """All that comes until the server ends the connection."""
        with socket.socket() as client:
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            client.settimeout(120)
            client.connect(("127.0.0.1", self.server.port))
            client.sendall(request)
            time.sleep(2.0)  # takes nothing
            got = b""
            with contextlib.suppress(ConnectionResetError):
                for piece in iter(lambda: client.recv(65536), b""):
                    got += piece
            return got

    def test_a_connection_that_says_nothing_or_half_a_request_ends(self):
        self.assertEqual(self.ended(b""), b"")
        self.assertEqual(self.ended(b"GET / HTTP/1.1\r\nHost: localhost\r\n"), b"")
        self.assertIn(b" 200 OK", self.ended(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"))

    def test_a_body_in_pieces_is_refused_unread(self):
        request = b"POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n-5\r\n"
        self.assertIn(b" 400 ", self.ended(request))
        self.assertIn(b" 200 OK", self.ended(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"))

    def test_one_that_does_not_take_its_answer_ends(self):
        random = np.random.RandomState(1)
        self.state.set_map("height", 1, map_message(random.randint(0, 255, (500, 500))))
        asked = 100
        got = self.ended(b"GET /map/height.png HTTP/1.1\r\nHost: localhost\r\n\r\n" * asked)
        self.assertLess(got.count(b" 200 OK"), asked)


class ProgramTest(unittest.TestCase):
    def test_wrong_arguments_and_a_taken_port_end_it_with_a_sentence(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = str(taken.getsockname()[1])
            for arguments, reason in (
                (["--port", port], "port %s of 127.0.0.1 is taken" % port),
                (["--port", "70000"], "must be 0 to 65535"),
                (["--stale", "0"], "must be > 0"),
                (["--address", "no such host"], "cannot be listened on"),
            ):
                done = subprocess.run(
                    [STATION_PAGE] + arguments,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    universal_newlines=True,
                    timeout=120,
                )
                self.assertEqual(done.returncode, 2)
                self.assertIn(reason, done.stderr)
                self.assertNotIn("Traceback", done.stderr)

    def test_it_starts_without_a_master_and_ends_when_told(self):
        process = subprocess.Popen(
            [STATION_PAGE, "--port", "0", "--stale", "auto"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            env=dict(os.environ, ROS_MASTER_URI="http://127.0.0.1:9"),
        )
        line = process.stdout.readline()
        self.assertRegex(line, r"http://127.0.0.1:\d+ shows it to this machine alone")
        with urllib.request.urlopen(re.search(r"http://\S+", line).group(0), timeout=120) as answer:
            self.assertEqual(answer.status, 200)
        time.sleep(0.5)
        process.terminate()
        _, errors = process.communicate(timeout=120)
        self.assertEqual((process.returncode, errors), (0, ""))

    def test_it_follows_a_master_that_is_started_anew(self):
        """As when a launch file that owns the master is stopped and started again."""
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        environment = dict(
            os.environ,
            ROS_MASTER_URI="http://localhost:%d" % port,
            ROS_HOSTNAME="localhost",
            ROS_LOG_DIR=folder.name,
        )
        quiet = dict(env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        page = subprocess.Popen(
            [STATION_PAGE, "--port", "0"],
            stdout=subprocess.PIPE,
            universal_newlines=True,
            env=environment,
        )
        self.addCleanup(page.communicate)
        self.addCleanup(page.terminate)
        address = re.search(r"http://(\S+)", page.stdout.readline()).group(1)
        self.wait(address, lambda state: state["link"]["text"].startswith("No ROS master"))
        for round_trip in (1, 2):
            master = subprocess.Popen(["roscore", "-p", str(port)], **quiet)
            try:
                self.wait(
                    address,
                    lambda state: state["link"]["text"].startswith("No node publishes /prediction"),
                )
                subprocess.run(
                    [
                        "rostopic",
                        "pub",
                        "-1",
                        "/prediction",
                        "mems_stiction/StictionPrediction",
                        "{}",
                    ],
                    check=True,
                    timeout=300,
                    **quiet,
                )
                self.wait(address, lambda state: state["count"] == round_trip)
            finally:
                master.terminate()
                master.wait(timeout=120)
            self.wait(address, lambda state: "is gone" in state["link"]["text"])

    def wait(self, address, condition):
        """Until the state that a browser gets is so."""
        said = []

        async def states():
            connection = await tornado.websocket.websocket_connect("ws://%s/state" % address)
            while True:
                await connection.write_message("next")
                state = json.loads(await connection.read_message())
                said.append(state["link"]["text"])
                if condition(state):
                    return

        try:
            asyncio.run(asyncio.wait_for(states(), 300))
        except asyncio.TimeoutError:
            self.fail("waited in vain; the link says: %s" % said[-1:])


if __name__ == "__main__":
    unittest.main()
