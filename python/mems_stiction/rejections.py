"""The scans that a node could not predict, as its diagnostics count them."""

import rospy
from diagnostic_msgs.msg import DiagnosticArray


class Rejections:
    """`count` scans were dropped or rejected so far; `last_reason` says why the latest was.
    `is_known`: the node has told."""

    def __init__(self):
        self.is_known = False
        self.count = 0
        self.last_reason = ""
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._on_diagnostics, queue_size=10)

    def _on_diagnostics(self, message):
        for status in message.status:
            values = {entry.key: entry.value for entry in status.values}
            if "rejected" in values and "dropped" in values:
                self.count = int(values["rejected"]) + int(values["dropped"])
                self.is_known = True
                self.last_reason = values.get("last_reason", "")
