// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "lio/io/cpu_clock.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/output_file.hpp"
#include "lio/run/passes.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

class Diagnoser {
 public:
  explicit Diagnoser(const DiagnosisRequest& request) : request_(request) {}

  Diagnosis Run() {
    RecordingRequest recording = request_.recording;
    recording.needs_rig = request_.rig_files.empty();
    recording.needs_truth = false;
    result_.recording = PrepareRecording(recording);
    if (!LoadGiven()) return std::move(result_);
    PassesResult first = Look(result_.options, true);
    result_.verdict = result_.with_fixes = std::move(first.verdict);
    result_.refusal = std::move(first.refusal);
    Treat();
    return std::move(result_);
  }

 private:
  // Loads the given options, and writes them as the one file over which fixes are laid: a fix also
  // overrides what was given by `sets`. Returns false where they have faults.
  bool LoadGiven() {
    std::vector<fs::path> files = result_.recording.rig_files;
    files.insert(files.end(), request_.rig_files.begin(), request_.rig_files.end());
    const LoadResult loaded = LoadOptions(files, request_.sets);
    result_.options = loaded.options;
    result_.faults = loaded.faults;
    files_ = {request_.recording.out / "given.yaml"};
    WriteText(files_.front(), PrintOptions(loaded.options));
    return result_.faults.empty();
  }

  // Replays with these options.
  PassesResult Look(Options options, bool is_first) {
    ++num_passes_;
    if (request_.num_threads) options.pipeline.num_threads = *request_.num_threads;
    LogInputOptions input_options;
    input_options.start_s = request_.start_s;
    if (request_.duration_s > 0.0) input_options.duration_s = request_.duration_s;
    input_options.clock = ThreadCpuNs;
    input_options.reads_ahead = options.pipeline.num_threads > 1;
    ReplaySettings settings;
    settings.program = fmt::format("{}: pass {}", request_.program, num_passes_);
    const fs::path folder = request_.recording.out / "pass";
    PassesResult pass =
        RunPasses({result_.recording.log, input_options, options, settings, folder});
    if (!pass.failure.empty()) throw WriteError(pass.failure);
    if (is_first && pass.refusal.empty()) result_.complaint = pass.complaint;
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    return pass;
  }

  // Lays fixes over the rig while passes are left and the fixes help.
  void Treat() {
    std::set<std::string> tried;
    result_.is_checked = true;
    for (const Cause* cause = NextCause(tried); cause != nullptr; cause = NextCause(tried)) {
      const Cause treated = *cause;
      tried.insert(treated.fix);
      const fs::path file =
          request_.recording.out / fmt::format("fix_{}.yaml", static_cast<int>(tried.size()));
      WriteText(file, treated.fix);
      files_.push_back(file);
      const LoadResult loaded = LoadOptions(files_, {});
      const bool has_pass = num_passes_ < request_.max_passes;
      if (!loaded.faults.empty() || (!has_pass && num_passes_ > 1)) {
        files_.pop_back();
        continue;
      }
      result_.is_checked = has_pass;
      if (has_pass) {
        PassesResult pass = Look(loaded.options, false);
        if (!pass.refusal.empty() || pass.verdict.trust > result_.with_fixes.trust) {
          files_.pop_back();
          continue;
        }
        result_.with_fixes = std::move(pass.verdict);
      }
      result_.options = loaded.options;
      result_.treated.push_back(treated);
      if (!has_pass) return;
    }
  }

  // The likeliest cause with a fix that was not tried yet; null where there is none.
  const Cause* NextCause(const std::set<std::string>& tried) const {
    const std::vector<Cause>& causes = result_.with_fixes.causes;
    const auto found = std::find_if(causes.begin(), causes.end(), [&](const Cause& cause) {
      return !cause.fix.empty() && !tried.contains(cause.fix);
    });
    return found == causes.end() ? nullptr : &*found;
  }

  const DiagnosisRequest& request_;
  std::vector<fs::path> files_;  // the options as given, then the fixes
  int num_passes_ = 0;
  Diagnosis result_;
};

}  // namespace

Diagnosis Diagnose(const DiagnosisRequest& request) {
  return Diagnoser(request).Run();
}

}  // namespace lio
