// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Exceptions of the Python package, and the way in which long calls leave Python.
#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>

#include "lio/io/input_error.hpp"

namespace lio::python {

// The configuration is faulty, or the data contradict it.
struct ConfigurationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Runs `work` without Python's global lock, so that other threads of Python go on. It may not touch
// an object of Python. As in the programs, a std::runtime_error that is none of ours is about the
// input.
template <typename Work>
auto RunUnlocked(Work&& work) {
  const pybind11::gil_scoped_release released;
  try {
    return work();
  } catch (const UsageError&) {
    throw;
  } catch (const ConfigurationError&) {
    throw;
  } catch (const OutputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

}  // namespace lio::python
