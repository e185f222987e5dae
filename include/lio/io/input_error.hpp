// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines the exceptions that end a program, each with one line for the user. Damage inside an
// otherwise sound input is not among them: it is counted, and the work goes on.
#pragma once

#include <stdexcept>

namespace lio {

// The command line asks for something impossible, e.g. an ambiguous topic. The exit code is 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The input is missing, of an unknown kind or unusable. The exit code is 5.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A file cannot be created: the command line named a wrong place. The exit code is 2.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A file cannot be written in full: the disk is full, or a file would grow beyond a limit. The exit
// code is 74.
struct WriteError : OutputError {
  using OutputError::OutputError;
};

}  // namespace lio
