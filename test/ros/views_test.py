#!/usr/bin/env python3
"""What a station shows: the latched preview, the views for rviz, the plot against the number of the
scan."""

import os
import subprocess
import tempfile
import unittest

import dynamic_reconfigure.client
import matplotlib.image
import numpy as np
import rospy
import rostest
from mems_stiction.msg import StictionPrediction
from roslib.packages import find_node
from sensor_msgs.msg import Image, PointCloud2
from stiction_client import (
    TIMEOUT,
    Collector,
    Counts,
    Station,
    rough_surface,
    wait_for_listener,
    wait_until,
)

NODES = ("/plot_trend", "/stiction_trend")  # that of the test, and that of view.launch
GREEN, RED = (53, 196, 106), (255, 90, 79)  # of trend_figure.VERDICTS


def has_colour(picture, colour):
    """Whether some pixel of rows x columns x RGB is near the colour; edges of letters are
    blended."""
    return bool((np.abs(picture.astype(int) - colour).max(axis=2) < 12).any())


def rgb(message):
    return np.frombuffer(message.data, np.uint8).reshape(message.height, message.width, 3)


class ViewsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("views_test")
        cls.counts = Counts()
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.station = Station()
        cls.settings = dynamic_reconfigure.client.Client("stiction_node", timeout=TIMEOUT)

    def live(self, surface):
        """The scan's stamp, once it is predicted and whatever belongs to it is sent: the node
        counts it last."""
        count = len(self.predictions.messages)
        stamp = self.station.send(surface)
        self.predictions.wait(count + 1)
        self.counts.wait(predicted=count + 1)
        return stamp

    def test_1_the_preview_is_made_for_listeners_only_and_a_late_one_gets_the_newest(self):
        surface = rough_surface(1)
        surface[5, 7] = np.nan
        first = self.live(surface)

        preview = Collector("preview", Image).connect()
        message = preview.wait(1)[0]  # no new scan was needed
        self.assertEqual((message.header.stamp, message.encoding), (first, "mono8"))
        pixels = np.frombuffer(message.data, np.uint8).reshape(surface.shape)
        self.assertEqual(pixels[5, 7], 0)
        self.assertEqual(np.count_nonzero(pixels == 0), 1)
        valid = np.isfinite(surface)
        low, high = np.percentile(surface[valid], [1, 99])
        self.assertTrue(
            (pixels[valid & (surface <= low)] <= 2).all()
            and (pixels[valid & (surface >= high)] >= 254).all()
        )

        second = self.live(rough_surface(2))
        self.assertEqual([message.header.stamp for message in preview.wait(2)], [first, second])
        # A late listener beside it gets the newest, and nothing older.
        late = Collector("preview", Image).connect()
        self.assertEqual(late.wait(1)[0].header.stamp, second)

        # Nobody listens: the next scan's is not made, so that the latched one is still that of the
        # scan before; then it is. A slow connection gets the newest alone, which proves nothing:
        # again.
        listeners, before = [preview, late], second
        for seed in range(3, 13):
            for collector in listeners:
                collector.close()
            newest = self.live(rough_surface(seed))
            listeners = [Collector("preview", Image).connect()]
            messages = listeners[0].messages
            wait_until(
                lambda: messages and messages[-1].header.stamp == newest,
                "the preview of the newest scan",
            )
            if len(messages) == 2:
                break
            before = newest
        self.assertEqual([message.header.stamp for message in messages], [before, newest])
        # No scan was cleaned for its preview.
        self.counts.wait(cleaned=len(self.predictions.messages))

    def test_2_the_views_for_rviz_have_a_frame_of_their_own(self):
        points = Collector("surface_points", PointCloud2).connect()
        markers = Collector("asperity_markers", rospy.AnyMsg).connect()
        stamp = self.live(rough_surface(2))
        self.assertEqual(points.wait(1)[0].header.stamp, stamp)
        self.assertEqual(points.messages[0].header.frame_id, "stiction_view")
        self.assertEqual(points.messages[0].width, 48 * 64)
        self.assertIn(b"640 nm x 480 nm", markers.wait(1)[0]._buff)

    def test_3_the_trend_follows_predictions_verdicts_and_losses(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = os.path.join(folder.name, "trend.png")
        plot = subprocess.Popen(
            [
                find_node("mems_stiction", "plot_trend")[0],
                "--output",
                path,
                "--count",
                "3",
                "--size",
                "900x500",
                "trend:=other_trend",
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        self.addCleanup(plot.kill)
        wait_until(lambda: os.path.exists(path), "the empty picture")
        for node in NODES:
            wait_for_listener("prediction", node)
            wait_for_listener("/diagnostics", node)

        trend = Collector("trend", Image).connect()  # of view.launch
        surface = rough_surface(
            2, rms_height=5e-10
        )  # so smooth that three contacts hold it: one carries no statement
        # A spring of 100 N/m over 1 um is far stronger than 3e-13 m^2 of this surface hold.
        self.settings.update_configuration(
            dict(spring_stiffness=100.0, travel=1e-6, contact_area=48 * 64 * 1e-16)
        )
        self.live(surface)
        self.assertEqual(self.predictions.messages[-1].sticks, StictionPrediction.STICKS_NO)
        headline = slice(20, 70)
        wait_until(
            lambda: trend.messages and has_colour(rgb(trend.messages[-1])[headline], GREEN),
            "a green headline",
        )
        self.assertFalse(has_colour(rgb(trend.messages[-1])[headline], RED))
        self.assertEqual((trend.messages[-1].width, trend.messages[-1].height), (1280, 720))

        rejected = int(self.counts["rejected"])
        self.station.send(np.full_like(surface, np.nan))
        self.counts.wait(rejected=rejected + 1)
        wait_until(
            lambda: not has_colour(rgb(trend.messages[-1])[headline], GREEN),
            "the headline on the lost scan",
        )

        self.settings.update_configuration(dict(spring_stiffness=1e-4))
        self.live(surface)
        self.assertEqual(self.predictions.messages[-1].sticks, StictionPrediction.STICKS_YES)
        wait_until(lambda: has_colour(rgb(trend.messages[-1])[headline], RED), "a red headline")

        # The other plot ends after two predictions and one loss, with the same story on a picture
        # of the size asked for.
        _, errors = plot.communicate(timeout=TIMEOUT)
        self.assertEqual(plot.returncode, 0, errors)
        picture = (255 * matplotlib.image.imread(path)[:, :, :3]).round()
        self.assertEqual(picture.shape, (500, 900, 3))
        self.assertTrue(has_colour(picture[:50], RED))
        self.assertEqual(os.listdir(folder.name), ["trend.png"])

    def test_3b_panels_are_dark_until_their_first_picture(self):
        plot = subprocess.Popen(
            [
                find_node("mems_stiction", "plot_trend")[0],
                "--placeholders",
                "other_preview",
                "trend:=placeholder_trend",
                "__name:=placeholder_trend",
            ]
        )
        self.addCleanup(plot.wait)
        self.addCleanup(plot.terminate)
        pictures = Collector("other_preview", Image)
        message = pictures.wait(1)[0]
        self.assertLess(np.median(rgb(message)), 64)
        self.assertGreater(rgb(message).max(), 128)  # its words
        wait_for_listener("other_preview", "/placeholder_trend")
        publisher = rospy.Publisher("other_preview", Image, queue_size=1, latch=True)
        publisher.publish(message)
        publishers = rospy.get_master().getSystemState
        wait_until(
            lambda: dict(publishers()[2][0])["/other_preview"] == [rospy.get_name()],
            "the dark picture to be gone",
        )

    def test_4_wrong_arguments_are_named(self):
        for arguments, reason in (
            (["--output", "trend.jpg"], "must end in .png"),
            (["--size", "1280"], "WIDTHxHEIGHT"),
            (["--output", "/no/such/folder/t.png"], "there is no folder"),
            (["--last", "-1"], "--last: '-1' is not allowed, must be a whole number >= 0"),
        ):
            done = subprocess.run(
                [find_node("mems_stiction", "plot_trend")[0]] + arguments,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                universal_newlines=True,
                timeout=TIMEOUT,
            )
            self.assertEqual(done.returncode, 2)
            self.assertIn(reason, done.stderr)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "views", ViewsTest)
