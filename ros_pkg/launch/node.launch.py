# SPDX-License-Identifier: Apache-2.0
"""ros2 launch carom_ros node.launch.py scene:=scene.yaml rviz:=true"""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PythonExpression
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description() -> LaunchDescription:
    layout = Path(get_package_share_directory("carom_ros")) / "rviz" / "carom.rviz"
    scene, speed = LaunchConfiguration("scene"), LaunchConfiguration("real_time_factor")
    return LaunchDescription(
        [
            DeclareLaunchArgument("scene", default_value="", description="file or shipped name"),
            DeclareLaunchArgument("real_time_factor", default_value="1.0"),
            DeclareLaunchArgument("mesh_dir", default_value="", description="for MESH_RESOURCE"),
            DeclareLaunchArgument("rviz", default_value="false"),
            Node(
                package="carom_ros",
                executable="node",
                name="carom",
                output="screen",
                # Without a scene the argument must be absent, not empty.
                arguments=[scene],
                condition=IfCondition(PythonExpression(["'", scene, "' != ''"])),
                parameters=_parameters(speed),
            ),
            Node(
                package="carom_ros",
                executable="node",
                name="carom",
                output="screen",
                condition=IfCondition(PythonExpression(["'", scene, "' == ''"])),
                parameters=_parameters(speed),
            ),
            Node(
                package="rviz2",
                executable="rviz2",
                arguments=["-d", str(layout)],
                condition=IfCondition(LaunchConfiguration("rviz")),
            ),
        ]
    )


def _parameters(speed: LaunchConfiguration) -> list[dict[str, object]]:
    return [
        {
            "real_time_factor": ParameterValue(speed, value_type=float),
            "mesh_dir": ParameterValue(LaunchConfiguration("mesh_dir"), value_type=str),
        }
    ]
