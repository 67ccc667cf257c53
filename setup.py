"""The Python package, for catkin and for pip.

catkin runs this by catkin_python_setup() in CMakeLists.txt, and builds the compiled part itself. `pip install .` builds core,
compiled part and stiction_batch with cmake, without ROS, and puts them into the package. MEMS_STICTION_BUILD_FOLDER names a folder
where that is done and kept, in place of one below build/.
"""

import os
import pathlib
import subprocess
import sys
import xml.etree.ElementTree

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent
PACKAGE = xml.etree.ElementTree.parse(str(SOURCE / "package.xml")).getroot()
IS_CATKIN = "CATKIN_BINARY_DIR" in os.environ


class CmakeBuild(build_ext):
    """The compiled part, and the core and stiction_batch beside it."""

    def build_extension(self, extension):
        folder = pathlib.Path(os.environ.get("MEMS_STICTION_BUILD_FOLDER", self.build_temp)).resolve()
        settings = {"MEMS_STICTION_WITH_ROS": "OFF", "MEMS_STICTION_BUILD_TESTS": "OFF", "MEMS_STICTION_WITH_PYTHON": "ON",
                    "PYTHON_EXECUTABLE": os.path.realpath(sys.executable)}
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.check_call(["cmake", "-S", str(SOURCE), "-B", str(folder)]
                              + ["-D%s=%s" % setting for setting in settings.items()])
        subprocess.check_call(["cmake", "--build", str(folder), "--target", "mems_stiction_python", "stiction_batch",
                               "--parallel", os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))])
        package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        subprocess.check_call(["cmake", "--install", str(folder), "--component", "wheel", "--prefix", str(package)])


setup(name=PACKAGE.findtext("name"), version=PACKAGE.findtext("version"),
      description=" ".join(PACKAGE.findtext("description").split()), license=PACKAGE.findtext("license"),
      maintainer=PACKAGE.findtext("maintainer"), maintainer_email=PACKAGE.find("maintainer").get("email"),
      packages=["mems_stiction"], package_dir={"": "python"}, package_data={"mems_stiction": ["*.pyi", "py.typed", "page/*"]},
      python_requires=">=3.8", install_requires=["numpy"],
      extras_require={"formats": ["h5py", "pyarrow"], "pictures": ["matplotlib"], "process": ["matplotlib", "pyyaml", "scipy", "statsmodels"],
                      "report": ["matplotlib", "jinja2", "pyyaml", "scipy"]},
      entry_points={} if IS_CATKIN else {"console_scripts": ["stiction_batch = mems_stiction.archive:main"]},
      ext_modules=[] if IS_CATKIN else [Extension("mems_stiction._core", [])], cmdclass={"build_ext": CmakeBuild})
