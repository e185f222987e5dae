# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""LiDAR-inertial odometry: logs, the estimator, conversion and evaluation, with NumPy arrays.

    import liod

    odometry = liod.Odometry("my_rig.yaml")
    for event in liod.read_log("drive.lcm"):
        for estimate in odometry.add(event):
            print(estimate.stamp_ns, estimate.position, estimate.status)
    odometry.finish()

docs/python.md of liod has all of it. Units are SI, stamps are integer nanoseconds, and a pose
T_target_source maps coordinates of source to target.
"""
from ._conversion import Conversion, convert
from ._errors import (ConfigurationError, Error, InputError, OutputError, UsageError, WriteError)
from ._evaluation import Evaluation, evaluate
from ._liod import (Estimate, ImuSamples, LogReader, Match, Notice, Scan, Source, Status,
                    __version__)
from ._log import Event, config_directory, read_log
from ._odometry import Odometry

__all__ = [
    "ConfigurationError", "Conversion", "Error", "Estimate", "Evaluation", "Event", "ImuSamples",
    "InputError", "LogReader", "Match", "Notice", "Odometry", "OutputError", "Scan", "Source",
    "Status", "UsageError", "WriteError", "__version__", "config_directory", "convert",
    "evaluate", "read_log",
]

# Whoever prints a class sees the package that it is from, not the module inside.
for _class in (Estimate, ImuSamples, LogReader, Match, Notice, Scan, Source, Status):
    _class.__module__ = "liod"
del _class
