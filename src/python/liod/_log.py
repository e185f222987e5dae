# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Logs of LCM as events."""
import os
import pathlib
from typing import Union

from . import _liod

Event = Union[_liod.ImuSamples, _liod.Scan, _liod.Estimate]
Path = Union[str, "os.PathLike[str]"]


def read_log(path: Path, channel_prefix: str = "LIO_") -> _liod.LogReader:
    """Returns the events of an LCM log, in the log's order, as an iterator.

    Events are ImuSamples (those that came one after another), Scan (a whole sweep, put together
    from its chunks), and Estimate (liod's own messages, where the log has them). Damage is passed
    over and counted. Raises InputError for what is no log.
    """
    return _liod.LogReader(path, channel_prefix)


def config_directory() -> pathlib.Path:
    """Returns the folder with the configurations that come with liod, e.g. default.yaml."""
    return pathlib.Path(_liod.config_directory())
