// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes a diagnosis for people, for programs, and as a rig that can be used.
#pragma once

#include <string>

#include "lio/run/diagnosis.hpp"

namespace lio {

// Lines for users: the recording, the trust, each cause (likeliest first) with sigma, evidence and
// fix, and what a replay with the fixes gave. `input` is what the user named.
[[nodiscard]] std::string DiagnosisText(const Diagnosis& diagnosis, const std::string& input);

// Returns the content of verdict.json for the given rig, with `input`, `kind`, `assumptions`,
// `refusal`, `treated` (kinds) and `with_fixes` (as verdict.json, or null where nothing was treated
// or checked) besides.
[[nodiscard]] std::string DiagnosisJson(const Diagnosis& diagnosis, const std::string& input);

// Returns the rig with the fixes as commented YAML, which LoadOptions takes. The comments at its
// top say what was assumed, what was found and whether a replay agrees.
[[nodiscard]] std::string DiagnosedRigYaml(const Diagnosis& diagnosis, const std::string& input);

}  // namespace lio
