# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The errors of liod. Their texts are those that the programs print."""
from ._liod import ConfigurationError, Error, InputError, OutputError, UsageError, WriteError

__all__ = ["ConfigurationError", "Error", "InputError", "OutputError", "UsageError", "WriteError"]
