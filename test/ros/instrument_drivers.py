"""Drivers of profilometers, imitated message for message as their sources fill them, and surfaces
that they see."""

import genpy.dynamic
import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion, TransformStamped
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Float32MultiArray, Header, MultiArrayDimension, MultiArrayLayout

ROWS, COLS = 48, 64
PITCH = 20e-6  # [m]
FRAME = "gocator_3100_optical_frame"
INVALID = np.finfo(np.float32).min
LINES, POINTS = 40, 50
POINT_PITCH, LINE_PITCH = 10e-6, 15e-6  # [m]
SENSOR = "sensor_optical_frame"


def heights_of(message):
    kind = {"32FC1": np.float32, "64FC1": np.float64}[message.encoding]
    return np.frombuffer(message.data, kind).reshape(message.height, message.width)


def field(seed):
    """ROWS x COLS float32 [m]: a cap on a tilted plane, off the middle, with micrometres of noise;
    row 0 has the largest y, x grows along columns."""
    y, x = np.mgrid[0:ROWS, 0:COLS] * PITCH
    cap = np.maximum(0.0, 2e-5 - ((x - 3e-4) ** 2 + (y - 7e-4) ** 2) / 4e-3)
    return (
        0.01 * x - 0.02 * y + cap + np.random.RandomState(seed).normal(scale=1e-6, size=x.shape)
    ).astype(np.float32)


def snapshot(heights, stamp, frame=FRAME):
    """As the driver of the Gocator 3100 fills it: PCL's PointXYZ in 16 bytes, rows and columns, x
    falls along the columns."""
    points = np.zeros(
        heights.shape, dtype=[("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("padding", "<f4")]
    )
    rows, cols = heights.shape
    points["x"] = ((cols // 2 - np.arange(cols)) * PITCH)[None, :]
    points["y"] = ((rows // 2 - np.arange(rows)) * PITCH)[:, None]
    points["z"] = np.where(np.isnan(heights), INVALID, heights)[:, ::-1]
    message = PointCloud2(
        height=rows,
        width=cols,
        is_bigendian=False,
        point_step=16,
        row_step=16 * cols,
        is_dense=True,
        data=points.tobytes(),
    )
    message.header.stamp, message.header.frame_id = stamp, frame
    message.fields = [
        PointField(name=name, offset=4 * place, datatype=PointField.FLOAT32, count=1)
        for place, name in enumerate("xyz")
    ]
    return message


def lines_of(seed=0):
    """LINES x POINTS float32 [m] in the order of the map: a cap on a tilted plane, off the middle,
    with noise; row 0 has the largest y."""
    rows, cols = np.mgrid[0:LINES, 0:POINTS]
    cap = np.maximum(
        0.0, 1e-5 - ((cols * POINT_PITCH - 1.5e-4) ** 2 + (rows * LINE_PITCH - 4e-4) ** 2) / 3e-3
    )
    noise = np.random.RandomState(seed).normal(scale=1e-6, size=cap.shape)
    return (0.02 * cols * POINT_PITCH - 0.01 * rows * LINE_PITCH + cap + noise).astype(np.float32)


def line(heights, stamp, size=16, missing=np.nan):
    """One line as the drivers fill it: PCL's PointXYZ (16 bytes) of the LJ-V7000 with NaN,
    PointXYZI (32) of the scanCONTROL with +infinity."""
    kind = [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("padding", "<f4")] + (
        [("intensity", "<f4"), ("more", "<f4", 3)] if size == 32 else []
    )
    points = np.zeros(heights.size, dtype=kind)
    points["x"] = np.arange(heights.size) * POINT_PITCH
    points["z"] = np.where(np.isnan(heights), missing, heights)
    message = PointCloud2(
        height=1,
        width=heights.size,
        is_bigendian=False,
        point_step=size,
        row_step=size * heights.size,
        is_dense=False,
        data=points.tobytes(),
    )
    message.header.stamp, message.header.frame_id = stamp, SENSOR
    names = [("x", 0), ("y", 4), ("z", 8)] + ([("intensity", 16)] if size == 32 else [])
    message.fields = [
        PointField(name=name, offset=offset, datatype=PointField.FLOAT32, count=1)
        for name, offset in names
    ]
    return message


def stage_at(stamp, way, frame="stage"):
    """The transform that a stage publishes which carries the scanner along y."""
    transform = TransformStamped()
    transform.header.stamp, transform.header.frame_id = stamp, frame
    transform.child_frame_id = SENSOR
    transform.transform.rotation.w = 1.0
    transform.transform.translation.y = way
    return transform


# The fields of grid_map_msgs/GridMap (ANYbotics, package grid_map, BSD licence): with those of the
# messages in it they give the definition's checksum, which is all that names it on the wire.
GRID_MAP = """grid_map_msgs/GridMapInfo info
string[] layers
string[] basic_layers
std_msgs/Float32MultiArray[] data
uint16 outer_start_index
uint16 inner_start_index
"""
GRID_MAP_INFO = """std_msgs/Header header
float64 resolution
float64 length_x
float64 length_y
geometry_msgs/Pose pose
"""


KINDS = (Header, Float32MultiArray, MultiArrayLayout, MultiArrayDimension, Pose, Point, Quaternion)
TEXTS = dict(
    {"grid_map_msgs/GridMapInfo": GRID_MAP_INFO},
    **{kind._type: kind._full_text.split("=" * 80)[0] for kind in KINDS},
)
GridMap = genpy.dynamic.generate_dynamic(
    "grid_map_msgs/GridMap",  # its text and those of all messages in it, as a bag keeps them
    GRID_MAP + "".join("=" * 80 + "\nMSG: %s\n%s\n" % part for part in TEXTS.items()),
)["grid_map_msgs/GridMap"]


def grid_map(heights, stamp, start=(0, 0)):
    """As grid_map's converter fills it: by columns, x falls along rows and y along columns, from
    where the circular buffer begins."""
    cells = np.roll(heights[:, ::-1].T, start, axis=(0, 1))
    rows, cols = cells.shape
    message = GridMap(layers=["elevation"], basic_layers=["elevation"])
    message.info.header.stamp, message.info.header.frame_id = stamp, "map"
    message.info.resolution = PITCH
    message.info.length_x, message.info.length_y = rows * PITCH, cols * PITCH
    message.info.pose.orientation.w = 1.0
    layer = Float32MultiArray(data=cells.T.ravel())
    layer.layout.dim = [
        MultiArrayDimension("column_index", cols, rows * cols),
        MultiArrayDimension("row_index", rows, rows),
    ]
    message.data = [layer]
    message.outer_start_index, message.inner_start_index = start
    return message
