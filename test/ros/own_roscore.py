"""A roscore of a test's own, on a port that was free. To be imported before rospy, which reads
ROS_MASTER_URI then."""

import os
import signal
import socket
import subprocess

with socket.socket() as free:
    free.bind(("127.0.0.1", 0))
    PORT = free.getsockname()[1]
os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % PORT

import rosgraph  # noqa: E402
from stiction_client import wait_until  # noqa: E402


def master_is_there():
    try:
        rosgraph.Master("/own_roscore").getPid()
        return True
    except OSError:
        return False


class Roscore:
    """roscore and the processes that it starts."""

    def start(self):
        self.process = subprocess.Popen(
            ["roscore", "-p", str(PORT)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        wait_until(master_is_there, "roscore")
        wait_until(
            lambda: "/rosout" in str(rosgraph.Master("/own_roscore").getSystemState()), "rosout"
        )

    def _send(self, number):
        children = subprocess.run(
            ["pgrep", "-P", str(self.process.pid)], stdout=subprocess.PIPE, universal_newlines=True
        ).stdout
        for process in [self.process.pid] + [int(child) for child in children.split()]:
            os.kill(process, number)

    def kill(self):
        self._send(signal.SIGKILL)
        self.process.wait()
        wait_until(lambda: not master_is_there(), "the end of roscore")

    def stop(self):
        """It takes calls and answers none."""
        self._send(signal.SIGSTOP)

    def go_on(self):
        self._send(signal.SIGCONT)

    def be_there(self):
        """Whatever became of it."""
        if self.process.poll() is not None:
            self.start()
        else:
            self.go_on()
