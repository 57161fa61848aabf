# SPDX-License-Identifier: Apache-2.0
"""For colcon; pip takes the same package from the pyproject.toml at the root of the repository."""

from pathlib import Path

from setuptools import find_packages, setup

NAME = "carom_ros"
HERE = Path(__file__).parent


def shared(folder: str) -> tuple[str, list[str]]:
    files = sorted(str(p.relative_to(HERE)) for p in (HERE / folder).iterdir() if p.is_file())
    return f"share/{NAME}/{folder}", files


setup(
    name=NAME,
    version="0.1.0",
    packages=find_packages(include=[NAME, f"{NAME}.*"]),
    package_data={NAME: ["*.xml"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        shared("launch"),
        shared("rviz"),
    ],
    install_requires=["setuptools"],
    zip_safe=False,
    maintainer="carom maintainers",
    maintainer_email="maintainers@users.noreply.example",
    description="ROS 2 node of carom: messages in, rigid bodies moving, poses out",
    license="Apache-2.0",
    entry_points={
        "console_scripts": [
            f"node = {NAME}.node_arguments:main",
            f"topic = {NAME}.topic.arguments:main",
        ],
        "carom.commands": [
            f"node = {NAME}.command:add_node_command",
            f"topic = {NAME}.command:add_topic_command",
        ],
    },
)
