from setuptools import setup

setup(
    name="sliders",
    version="1.2.3",
    packages=["sliders"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/sliders"]),
        ("share/sliders", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    entry_points={"console_scripts": ["sliders = sliders.main:main"]},
)
