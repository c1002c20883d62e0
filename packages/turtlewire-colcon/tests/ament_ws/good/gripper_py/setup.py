from glob import glob

from setuptools import find_packages, setup

package_name = "gripper_py"

setup(
    name=package_name,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
        ("share/" + package_name + "/launch", glob("launch/*")),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="someone",
    maintainer_email="someone@example.com",
    description="A driver in Python",
    license="Apache-2.0",
    tests_require=["pytest"],
    entry_points={"console_scripts": ["grip = gripper_py.grip:main"]},
)
