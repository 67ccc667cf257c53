"""The Python package, for catkin and for pip.

catkin runs this by catkin_python_setup() in CMakeLists.txt, and builds the compiled part itself.
`pip install .` builds core, compiled part and stiction_batch with cmake, without ROS, and puts them
into the package. MEMS_STICTION_BUILD_FOLDER names a folder where that is done, in place of
build/pip; both are kept, so that a second installation builds what has changed.
"""

import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent
PACKAGE = xml.etree.ElementTree.parse(str(SOURCE / "package.xml")).getroot()
IS_CATKIN = "CATKIN_BINARY_DIR" in os.environ


def terminal():
    """The user's terminal, or None. pip keeps what a build prints to itself, so a line of progress
    goes past pip."""
    try:
        return open("/dev/tty", "w")
    except OSError:
        return None


def build(command):
    """Runs a build, shows how far the build is on the terminal, and its output to whoever reads it
    (pip install -v).

    @throw subprocess.CalledProcessError if the build fails
    """
    screen = terminal()
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True
    ) as running:
        for line in running.stdout:
            sys.stdout.write(line)
            progress = re.match(r"\[ *(\d+%|\d+/\d+)\]", line)
            if screen and progress:
                screen.write("\r\033[Kmems_stiction: compiling, %s" % progress.group(1))
                screen.flush()
    if screen:
        screen.write("\r\033[K")
        screen.close()
    if running.returncode != 0:
        raise subprocess.CalledProcessError(running.returncode, command)


class CmakeBuild(build_ext):
    """The compiled part, and the core and stiction_batch beside it."""

    def build_extension(self, extension):
        folder = pathlib.Path(
            os.environ.get("MEMS_STICTION_BUILD_FOLDER", SOURCE / "build" / "pip")
        ).resolve()
        settings = {
            "MEMS_STICTION_WITH_ROS": "OFF",
            "MEMS_STICTION_BUILD_TESTS": "OFF",
            "MEMS_STICTION_WITH_PYTHON": "ON",
            "PYTHON_EXECUTABLE": os.path.realpath(sys.executable),
        }
        folder.mkdir(parents=True, exist_ok=True)
        if (folder / "CMakeCache.txt").exists():
            (
                folder / "CMakeCache.txt"
            ).unlink()  # pip may build from a copy, with another python each time
        subprocess.check_call(
            ["cmake", "-S", str(SOURCE), "-B", str(folder)]
            + ["-D%s=%s" % setting for setting in settings.items()]
        )
        build(
            [
                "cmake",
                "--build",
                str(folder),
                "--target",
                "mems_stiction_python",
                "stiction_batch",
                "--parallel",
                os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1)),
            ]
        )
        package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        subprocess.check_call(
            ["cmake", "--install", str(folder), "--component", "wheel", "--prefix", str(package)]
        )


setup(
    name=PACKAGE.findtext("name"),
    version=PACKAGE.findtext("version"),
    description=" ".join(PACKAGE.findtext("description").split()),
    license=PACKAGE.findtext("license"),
    maintainer=PACKAGE.findtext("maintainer"),
    maintainer_email=PACKAGE.find("maintainer").get("email"),
    packages=["mems_stiction"],
    package_dir={"": "python"},
    package_data={"mems_stiction": ["*.pyi", "py.typed", "page/*"]},
    python_requires=">=3.8",
    install_requires=["numpy"],
    extras_require={
        "formats": ["h5py", "pyarrow"],
        "pictures": ["matplotlib"],
        "process": ["matplotlib", "pyyaml", "scipy", "statsmodels"],
        "report": ["matplotlib", "jinja2", "pyyaml", "scipy"],
    },
    entry_points={}
    if IS_CATKIN
    else {"console_scripts": ["stiction_batch = mems_stiction.archive:main"]},
    ext_modules=[] if IS_CATKIN else [Extension("mems_stiction._core", [])],
    cmdclass={"build_ext": CmakeBuild},
)
