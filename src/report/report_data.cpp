// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <fstream>
#include <sstream>

#include "columns.hpp"
#include "lio/eval/stamped_csv.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/pcd_file.hpp"
#include "lio/io/trajectory_file.hpp"
#include "lio/report/run_report.hpp"
#include "map_points.hpp"
#include "truth_parts.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string ReadAll(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Json ReadJson(const fs::path& file) {
  return fs::exists(file) ? Json::parse(ReadAll(file), nullptr, false) : Json();
}

Json TableJson(const fs::path& file, const std::vector<std::string>& wanted, Timestamp begin) {
  const StampedTable table = ReadStampedCsv(file, wanted);
  PlotColumns columns(begin);
  const std::size_t stride = RowStride(table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); i += stride) {
    columns.AddTime(table.stamps[i]);
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      columns.Add(table.columns[k], table.rows[i][k]);
    }
  }
  return columns.json();
}

Json PathJson(const fs::path& folder, Timestamp begin) {
  const fs::path file = PathOfRun(folder);
  if (!fs::exists(file) || fs::file_size(file) == 0) return nullptr;
  const StampedPoses poses = ReadTrajectory(file).poses;
  PlotColumns columns(begin);
  const std::size_t stride = RowStride(poses.size());
  for (std::size_t i = 0; i < poses.size(); i += stride) {
    columns.AddTime(poses[i].stamp);
    columns.Add("x", poses[i].pose.translation.x());
    columns.Add("y", poses[i].pose.translation.y());
    columns.Add("z", poses[i].pose.translation.z());
  }
  return columns.json();
}

// Reads rows of notices.tsv: time, severity, text.
Json NoticesJson(const fs::path& file, Timestamp begin) {
  Json rows = Json::array();
  std::istringstream text(ReadAll(file));
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    const std::size_t first = line.find('\t');
    const std::size_t second = line.find('\t', first + 1);
    const auto stamp = ParseStamp(std::string_view(line).substr(0, first));
    if (!stamp || second == std::string::npos) continue;
    rows.push_back({RoundedForPlot(SecondsBetween(begin, *stamp)),
                    line.substr(first + 1, second - first - 1), line.substr(second + 1)});
  }
  return rows;
}

// The page's time zero is the end of the first sweep.
Timestamp BeginOf(const fs::path& folder) {
  const StampedTable table = ReadStampedCsv(folder / "registration.csv", {"nis"});
  return table.stamps.empty() ? Timestamp{} : table.stamps.front();
}

}  // namespace

Json ReportData(const fs::path& folder, const ReportInputs& inputs) {
  const Timestamp begin = BeginOf(folder);
  Json data = {{"input", inputs.input},
               {"begin", StampText(begin)},
               {"assumptions", inputs.assumptions},
               {"verdict", ReadJson(folder / "verdict.json")},
               {"stats", ReadJson(folder / "stats.json")},
               {"options", ReadAll(folder / "options.yaml")},
               {"notices", NoticesJson(folder / "notices.tsv", begin)},
               {"path", PathJson(folder, begin)}};
  data["scans"] =
      TableJson(folder / "registration.csv",
                {"num_used", "num_matched", "fused", "nis", "residual_rms_m", "degenerate_mask",
                 "reduce_ms", "deskew_ms", "match_ms", "insert_ms", "filter_ms", "total_ms"},
                begin);
  if (fs::exists(folder / "states.csv")) {
    data["states"] = TableJson(folder / "states.csv", {}, begin);
  }
  if (fs::exists(folder / "map.pcd")) data["map"] = MapPointsJson(LoadPcd(folder / "map.pcd"));
  if (inputs.truth && !data["path"].is_null()) {
    data["truth"] = TruthParts(folder, *inputs.truth, begin);
  }
  return data;
}

}  // namespace lio
