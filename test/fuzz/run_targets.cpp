// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The files that a run leaves, as lio-eval and the report read them.
#include "fuzz/scratch_file.hpp"
#include "fuzz/target_helpers.hpp"
#include "fuzz/targets.hpp"
#include "lio/eval/consistency_report.hpp"
#include "lio/eval/stamped_csv.hpp"
#include "lio/report/run_report.hpp"

namespace lio::fuzz {

void Table(ByteView bytes) {
  const std::filesystem::path file = ScratchFile("table.csv", bytes);
  MayRefuse([&] {
    const StampedTable all = ReadStampedCsv(file);
    for (const std::vector<double>& row : all.rows) {
      if (row.size() != all.columns.size()) std::abort();
    }
    if (all.stamps.size() != all.rows.size()) std::abort();
  });
  MayRefuse([&] { (void)ReadStampedCsv(file, {"fused", "nis"}); });
}

// Each file ends at a zero byte.
void RunFolder(ByteView bytes) {
  const std::filesystem::path folder = ScratchFolder() / "run";
  for (const std::string name :
       {"truth.tum", "trajectory.tum", "covariance.csv", "registration.csv", "states.csv",
        "stats.json", "verdict.json", "notices.tsv"}) {
    (void)ScratchFile("run/" + name, CutPart(bytes));
  }
  MayRefuse([&] {
    const RunErrors errors = ComputeRunErrors(LoadRun(folder, "truth.tum"));
    const Consistency consistency = JudgeConsistency({errors});
    (void)ConsistencyText(consistency);
    (void)ConsistencyJson(consistency).dump();
  });
  MayRefuse([&] { (void)ReportPage(ReportData(folder, {"", folder / "truth.tum", {}})); });
}

}  // namespace lio::fuzz
