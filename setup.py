"""The Python modules of the package, for catkin: run by catkin_python_setup() in CMakeLists.txt, not by hand."""

from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(packages=["mems_stiction"], package_dir={"": "python"},
                                package_data={"mems_stiction": ["page/*"]}))
