# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Paths against the truth."""
import dataclasses
import json
import os
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _liod

Path = Union[str, "os.PathLike[str]"]
Poses = Tuple[npt.ArrayLike, npt.ArrayLike]


@dataclasses.dataclass(frozen=True)
class Evaluation:
    """The figures of a path, and a row for each pair of poses that was compared."""

    figures: Dict[str, Any]  # as lio-eval --json writes them; docs/evaluation.md explains each
    text: str                # as lio-eval prints it
    stamps_ns: npt.NDArray[np.int64]
    truth: npt.NDArray[np.float64]     # (N, 3) positions [m]
    estimate: npt.NDArray[np.float64]  # (N, 3), aligned with the truth
    position_error_m: npt.NDArray[np.float64]
    rotation_error_deg: npt.NDArray[np.float64]

    def __str__(self) -> str:
        return self.text


def evaluate(truth: Union[Path, Poses], run: Union[Path, Poses], *, align: str = "se3",
             max_gap_s: Optional[float] = None,
             time_offset_s: Union[float, str] = 0.0) -> Evaluation:
    """Measures how far a path is from the truth, as lio-eval does.

    truth: a TUM or KITTI file, or a tuple of stamps [ns] and poses of the shape (N, 4, 4).
    run: the same, or the folder of a run.
    align: none, yaw or se3.
    max_gap_s: interpolates across gaps of at most so many seconds; by default from the data.
    time_offset_s: is added to the run's stamps; "auto" finds that of the least error.

    Raises InputError for what cannot be read or compared, and UsageError for wrong options.
    """
    if isinstance(time_offset_s, str):
        if time_offset_s != "auto":
            raise _liod.UsageError("time_offset_s: expects 'auto', or a number from -1e6 to 1e6")
        offset = None
    else:
        offset = float(time_offset_s)
    scored = _liod.evaluate(truth, run, align, max_gap_s, offset)
    return Evaluation(json.loads(scored.json), scored.text, scored.stamps_ns, scored.truth,
                      scored.estimate, scored.position_error_m, scored.rotation_error_deg)
