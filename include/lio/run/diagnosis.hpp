// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds out what is wrong with a rig from a recording: replays it, takes the verdict, lays the fix
// of the likeliest cause over the rig, and replays again to see whether that helps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/pipeline/options.hpp"
#include "lio/run/recording.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

struct DiagnosisRequest {
  RecordingRequest recording;  // its folder `out` takes the files that are made on the way
  std::vector<std::filesystem::path> rig_files;  // empty: the rig beside the log, or a draft
  std::vector<std::string> sets;                 // "key=value", laid over the files
  std::string program;                           // is named at the progress bar
  std::optional<int> num_threads;
  double start_s = 0.0;
  double duration_s = 0.0;  // 0: to the end
  int max_passes = 3;       // at most so many replays; at least 1
};

struct Diagnosis {
  PreparedRecording recording;
  std::vector<std::string> faults;  // faults of the configuration; if any, all below is empty
  Verdict verdict;                  // with the rig as it was given
  std::string refusal;    // why that rig contradicts the recording; empty when it does not
  std::string complaint;  // names what was wrong with the log; empty when nothing was
  // The causes whose fixes are laid over the rig, in this order: each left at least as much trust
  // as there was before. One pass takes the first fix without a look at what it does.
  std::vector<Cause> treated;
  bool is_checked = false;  // a replay had all these fixes
  Verdict with_fixes;       // the verdict of that replay; where there is no fix, the given rig's
  Options options;          // with these fixes
};

// Throws what PrepareRecording throws, and WriteError for a full disk.
[[nodiscard]] Diagnosis Diagnose(const DiagnosisRequest& request);

}  // namespace lio
