// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// liod --check: would a start with these arguments get as far as listening?
#pragma once

#include "app/daemon_arguments.hpp"

namespace lio {

// Looks at all that a start would use, except the network: the initial map is loaded, the folder of
// --out is looked at, the URL is read. Tells each fault in a line on stderr and, when there is
// none, on stdout what would be used. Returns the exit code of a start with the first of the
// faults, in the order in which a start would meet them. `has_faulty_options`: the configuration's
// faults have been told already, and `options` are not those of the files.
[[nodiscard]] int CheckDaemon(const DaemonArguments& arguments, const Options& options,
                              bool has_faulty_options);

}  // namespace lio
