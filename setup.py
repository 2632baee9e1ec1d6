"""For catkin (cmake/ros.cmake), which calls it; packages and version are told to no one else."""
from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import find_packages, setup

setup(**generate_distutils_setup(packages=find_packages("python"), package_dir={"": "python"},
                                 scripts=["scripts/monarch"]))
