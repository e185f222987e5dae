# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The estimator, fed with arrays."""
import json
import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Dict, List, Optional, Tuple, Union

from . import _liod

Path = Union[str, "os.PathLike[str]"]
Config = Union[Path, Mapping[str, Any]]


def _plain(value: Any) -> Any:
    """Returns arrays and numbers of NumPy, paths and mappings as what JSON has for them."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"config: {value!r} is no value of a configuration")


def _settings(config: Mapping[str, Any], path: str = "") -> Iterator[str]:
    """Yields KEY=VALUE for each leaf, as lio-replay takes them by --set."""
    for key, value in config.items():
        name = f"{path}{key}"
        if isinstance(value, Mapping) and value:
            yield from _settings(value, f"{name}.")
        else:
            yield f"{name}={json.dumps(value, default=_plain)}"


def _sources(config: Union[None, Config, Iterable[Config]]) -> Tuple[List[Path], List[str]]:
    """Returns the files and the settings of a configuration."""
    if config is None:
        parts: Iterable[Config] = ()
    elif isinstance(config, (str, bytes, os.PathLike, Mapping)):
        parts = (config,)
    else:
        parts = config
    files: List[Path] = []
    sets: List[str] = []
    for part in parts:
        if isinstance(part, Mapping):
            sets.extend(_settings(part))
        else:
            files.append(os.fspath(part))
    return files, sets


class Odometry(_liod.Odometry):
    """LiDAR-inertial odometry: samples and scans in, estimates out.

    Each call does all the work that its data make possible before it returns, and returns the
    estimates that became ready: mostly none or one. A scan is matched as soon as the inertial
    samples reach its end. The results depend on the data and their order alone. Other threads of
    Python run meanwhile.
    """

    def __init__(self, config: Union[None, Config, Iterable[Config]] = None, *,
                 out: Optional[Path] = None, overwrite: bool = False, imu_rate: bool = False,
                 keep_map: bool = False) -> None:
        """Makes an estimator.

        config: a YAML file, a mapping with the same keys, or several of them; the later ones win,
            and mappings win over files. Raises ConfigurationError with all faults, one a line.
        out: a folder for the files that lio-replay writes; finish() completes them.
        overwrite: may replace an earlier run in that folder.
        imu_rate: gives an estimate for each inertial sample, too.
        keep_map: keeps the points of the map for map_points, and for map.pcd in `out`.
        """
        files, sets = _sources(config)
        super().__init__(files, sets, "" if out is None else out, overwrite, imu_rate, keep_map)

    def verdict(self) -> Dict[str, Any]:
        """Returns the content of verdict.json so far: may the result be trusted, and why not?"""
        verdict: Dict[str, Any] = json.loads(self.verdict_json())
        return verdict

    def __enter__(self) -> "Odometry":
        return self

    def __exit__(self, error: Any, *_: Any) -> None:
        if error is None and not self.is_finished:
            self.finish()
