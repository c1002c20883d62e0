from pathlib import Path

from setuptools import find_packages, setup

package_name = "learning_tf2_py"

setup(
    name=package_name,
    version="0.1.0",
    package_dir={
        "": "."
    },  # an editable installation is then a path, not a finder that each Python imports
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        (
            f"share/{package_name}/launch",
            [str(file) for file in Path("launch").glob("*.launch.py")],
        ),
    ],
    install_requires=["setuptools"],
    extras_require={"test": ["pytest"]},
    zip_safe=True,
    maintainer="turtlewire",
    maintainer_email="turtlewire@users.noreply.github.com",
    description="One turtle follows another: a TF2 broadcaster, a TF2 listener and launch files",
    license="Apache-2.0",
    entry_points={
        "console_scripts": [
            "static_turtle_tf2_broadcaster = learning_tf2_py.static_turtle_tf2_broadcaster:main",
            "turtle_tf2_broadcaster = learning_tf2_py.turtle_tf2_broadcaster:main",
            "turtle_tf2_listener = learning_tf2_py.turtle_tf2_listener:main",
            "fixed_frame_tf2_broadcaster = learning_tf2_py.fixed_frame_tf2_broadcaster:main",
            "dynamic_frame_tf2_broadcaster = learning_tf2_py.dynamic_frame_tf2_broadcaster:main",
            "turtle_tf2_blocking_listener = learning_tf2_py.turtle_tf2_blocking_listener:main",
            "turtle_tf2_async_listener = learning_tf2_py.turtle_tf2_async_listener:main",
            "turtle_tf2_time_travel = learning_tf2_py.turtle_tf2_time_travel:main",
            "swarm = learning_tf2_py.swarm:main",
            "swarm_with_simulator = learning_tf2_py.swarm_with_simulator:main",
        ],
    },
)
