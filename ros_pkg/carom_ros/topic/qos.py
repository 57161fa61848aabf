# SPDX-License-Identifier: Apache-2.0
"""The profile that the --qos-* options and the publishers of a topic make."""

import argparse

import rclpy.qos as q
from rclpy.duration import Duration

_FIELDS = ("history", "depth", "reliability", "durability", "lifespan", "deadline", "liveliness",
           "liveliness_lease_duration")  # fmt: skip


def chosen(args: argparse.Namespace) -> q.QoSProfile:
    """The profile the options name, each option over the profile."""
    preset = q.QoSPresetProfiles.get_from_short_key(args.qos_profile or args.qos_default)
    profile = q.QoSProfile(**{name: getattr(preset, name) for name in _FIELDS})
    if args.qos_history:
        profile.history = q.HistoryPolicy.get_from_short_key(args.qos_history)
    if args.qos_depth is not None:
        profile.depth = args.qos_depth
    elif profile.history == q.HistoryPolicy.KEEP_LAST and profile.depth < 1:
        profile.depth = 10
    if args.qos_reliability:
        profile.reliability = q.ReliabilityPolicy.get_from_short_key(args.qos_reliability)
    if args.qos_durability:
        profile.durability = q.DurabilityPolicy.get_from_short_key(args.qos_durability)
    if args.qos_liveliness:
        profile.liveliness = q.LivelinessPolicy.get_from_short_key(args.qos_liveliness)
    if args.qos_liveliness_lease_duration_seconds is not None:
        seconds = args.qos_liveliness_lease_duration_seconds
        profile.liveliness_lease_duration = Duration(nanoseconds=int(seconds * 1e9))
    return profile


def matching(args: argparse.Namespace, publishers: list) -> q.QoSProfile:
    """The chosen profile, and where reliability or durability are left open, what every publisher
    of the topic offers: latched topics are read as such without an option."""
    profile = chosen(args)
    if args.qos_profile or not publishers:
        return profile
    offered = [info.qos_profile for info in publishers]
    if not args.qos_reliability:
        reliable = all(each.reliability == q.ReliabilityPolicy.RELIABLE for each in offered)
        kinds = q.ReliabilityPolicy
        profile.reliability = kinds.RELIABLE if reliable else kinds.BEST_EFFORT
    if not args.qos_durability:
        latched = all(each.durability == q.DurabilityPolicy.TRANSIENT_LOCAL for each in offered)
        kinds = q.DurabilityPolicy
        profile.durability = kinds.TRANSIENT_LOCAL if latched else kinds.VOLATILE
        if latched and args.qos_depth is None:
            profile.depth = max(profile.depth, 100)
    return profile
