"""Publishes the pictures of screen_pictures as images for rviz, each drawn while somebody
listens."""

import collections
import copy
import threading

import rospy
from mems_stiction.msg import HalfSpaceSolution
from mems_stiction.scan_images import pixels
from sensor_msgs.msg import Image

MOST_REMEMBERED = 20  # predictions, and maps, whose half-space may still come
MAPS = ("contact_map", "half_space_contact_map")
TOPICS = ("force_curve", "half_space_curve", "contact_maps")


class Newest:
    """Values by the stamp of their scan, the newest of them."""

    def __init__(self):
        self._by_stamp = collections.OrderedDict()

    def add(self, stamp, value):
        self._by_stamp[stamp.to_nsec()] = value
        while len(self._by_stamp) > MOST_REMEMBERED:
            self._by_stamp.popitem(last=False)

    def of(self, stamp):
        return self._by_stamp.get(stamp.to_nsec())


class ScreenTopics:
    """The prediction's curve, the half-space's curve, and the contact maps of both."""

    def __init__(self):
        self._lock = threading.Lock()  # each topic has a thread
        self._prediction = self._solution = None
        self._predictions, self._maps = Newest(), {topic: Newest() for topic in MAPS}
        self._map_subscribers = []
        self._shown = {}  # what each picture was made of
        self._publishers = {
            topic: rospy.Publisher(topic, Image, queue_size=1, latch=True) for topic in TOPICS
        }
        rospy.Subscriber("half_space", HalfSpaceSolution, self._on_solution, queue_size=100)

    def add_prediction(self, prediction):
        prediction = copy.copy(prediction)  # whoever has it may drop its curve
        with self._lock:
            self._prediction = prediction
            self._predictions.add(prediction.header.stamp, prediction)

    def _on_solution(self, solution):
        with self._lock:
            self._solution = solution

    def _on_map(self, message, topic):
        with self._lock:
            self._maps[topic].add(message.header.stamp, pixels(message))

    def draw(self):
        """What has changed since it was drawn, for those who listen."""
        self._listen_to_maps()
        for topic, publisher in self._publishers.items():
            if publisher.get_num_connections() == 0:
                continue
            sources = self._sources_of(topic)
            shown = self._shown.get(topic)
            if shown and all(old is new for old, new in zip(shown, sources)):
                continue
            publisher.publish(self._image_of(topic, sources))
            self._shown[topic] = sources

    def _listen_to_maps(self):
        """The node computes contact maps for listeners alone."""
        is_wanted = self._publishers["contact_maps"].get_num_connections() > 0
        if is_wanted and not self._map_subscribers:
            self._map_subscribers = [
                rospy.Subscriber(topic, Image, self._on_map, topic, MOST_REMEMBERED, 2**24)
                for topic in MAPS
            ]
        elif not is_wanted:
            for subscriber in self._map_subscribers:
                subscriber.unregister()
            self._map_subscribers = []

    def _sources_of(self, topic):
        """The message that a picture is of, None before the first one, and what belongs to it."""
        with self._lock:
            if topic == "force_curve":
                return (self._prediction,)
            if self._solution is None:
                return (None,)
            stamp = self._solution.header.stamp
            if topic == "half_space_curve":
                return self._solution, self._predictions.of(stamp)
            return (self._solution,) + tuple(self._maps[name].of(stamp) for name in MAPS)

    @staticmethod
    def _image_of(topic, sources):
        from mems_stiction import screen_pictures  # slow to import: not before the subscriptions

        if sources[0] is None:
            return dark_image(topic)
        draw = {
            "force_curve": screen_pictures.force_curve_picture,
            "half_space_curve": screen_pictures.half_space_curve_picture,
            "contact_maps": screen_pictures.contact_maps_picture,
        }[topic]
        message = image_message(screen_pictures.pixels_of(draw(*sources)))
        message.header = sources[0].header
        return message


def dark_image(topic):
    """Before a topic's first picture: rviz shows a white panel for a topic without any."""
    from mems_stiction.screen_pictures import nothing_yet, pixels_of

    return image_message(pixels_of(nothing_yet("%s: none yet" % topic)))


def image_message(pixels_of_picture):
    """Of rows x columns x RGB."""
    message = Image()
    message.header.stamp = rospy.Time.now()
    message.height, message.width = pixels_of_picture.shape[:2]
    message.encoding = "rgb8"
    message.step = 3 * message.width
    message.data = pixels_of_picture.tobytes()
    return message
