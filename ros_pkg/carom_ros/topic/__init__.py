# SPDX-License-Identifier: Apache-2.0
"""carom topic: the verbs of `ros2 topic` for people whose ROS came as wheels, without the CLI."""
