// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lio/eval/report.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kHolePeriods = 3.0;  // lines break where so many samples are missing

// Holds columns with one row per pair; a hole in the recording becomes a row of nulls, which breaks
// lines.
class Columns {
 public:
  void Add(const char* name, double value) { columns_[name].push_back(value); }
  void Add(const std::string& name, const Vector3& p) {
    columns_[name + "_x"].push_back(p.x());
    columns_[name + "_y"].push_back(p.y());
    columns_[name + "_z"].push_back(p.z());
  }
  void Break() {
    for (auto& [name, column] : columns_.items()) column.push_back(nullptr);
  }
  const Json& json() const { return columns_; }

 private:
  Json columns_ = Json::object();
};

double LongestHole(const Association& a) {
  const double period_s = std::max(a.truth_period_s, a.estimate_period_s);
  return std::max(kHolePeriods * period_s, a.max_gap_s);
}

}  // namespace

Json PictureData(const Evaluation& e, const ReportedFiles& files) {
  const PosePairs& pairs = e.association.pairs;
  const ErrorSeries errors = ComputeErrorSeries(e);
  const Pose T_estimate_truth = e.alignment.T_truth_estimate.Inverse();
  const bool has_time = e.duration_s > 0;
  const double hole_s = LongestHole(e.association);
  Columns columns;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PosePair& pair = pairs[i];
    if (has_time && i > 0 && SecondsBetween(pairs[i - 1].stamp, pair.stamp) > hole_s) {
      columns.Break();
    }
    columns.Add("time",
                has_time ? SecondsBetween(pairs[0].stamp, pair.stamp) : static_cast<double>(i));
    columns.Add("truth", T_estimate_truth * pair.truth.translation);
    columns.Add("estimate", pair.estimate.translation);
    columns.Add("position_error_m", errors.position_m[i]);
    columns.Add("rotation_error_deg", errors.rotation_deg[i]);
    columns.Add("truth_height_m", pair.truth.translation.z() - pairs[0].truth.translation.z());
    columns.Add("estimate_height_m",
                pair.estimate.translation.z() - pairs[0].estimate.translation.z());
  }
  return {
      {"has_time", has_time}, {"columns", columns.json()}, {"summary", EvaluationJson(e, files)}};
}

}  // namespace lio
