// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/consistency_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 6> kAxisNames = {"x", "y", "z", "rx", "ry", "rz"};

// Returns the band of the instants that most runs cover.
Band WidestRunsBand(const BandedSeries& series) {
  Band narrowest = series.band_per_dof.front();
  for (const Band& band : series.band_per_dof) {
    if (band.high - band.low < narrowest.high - narrowest.low) narrowest = band;
  }
  return narrowest;
}

Json SeriesJson(const BandedSeries& series) {
  const Band band = WidestRunsBand(series);
  return {{"dof", series.dof},
          {"average_per_dof", series.average_per_dof},
          {"end_average_per_dof", series.end_average_per_dof},
          {"band_per_dof", {band.low, band.high}},
          {"num_instants", series.time_s.size()},
          {"share_in_band", series.share_in_band}};
}

Json RmsJson(const RmsPair& rms) {
  return {{"real", rms.real},
          {"predicted", rms.predicted},
          {"predicted_to_real_ratio", rms.real > 0 ? Json(rms.predicted / rms.real) : Json()}};
}

// Returns the index of the run with the largest tilt of all, if any has one.
std::optional<std::size_t> RunOfLargestTilt(const Consistency& c) {
  const auto sigmas = [](const auto& tilt) { return tilt ? tilt->sigmas : -1.0; };
  const auto largest = std::ranges::max_element(c.run_largest_tilt, {}, sigmas);
  if (largest == c.run_largest_tilt.end() || !*largest) return std::nullopt;
  return static_cast<std::size_t>(largest - c.run_largest_tilt.begin());
}

Json TiltJson(const Consistency& c) {
  const std::optional<std::size_t> run = RunOfLargestTilt(c);
  if (!run) return {};
  const TiltSample& tilt = *c.run_largest_tilt[*run];
  return {{"sigmas", tilt.sigmas}, {"time_s", tilt.time_s}, {"run", c.runs[*run]}};
}

std::string TiltText(const Consistency& c) {
  const std::optional<std::size_t> run = RunOfLargestTilt(c);
  if (!run) return "";
  const TiltSample& tilt = *c.run_largest_tilt[*run];
  return fmt::format("largest tilt    {:.2f} sigma of roll and pitch, at {:.1f} s of {}\n",
                     tilt.sigmas, tilt.time_s, c.runs[*run]);
}

Json WhitenessJson(const Whiteness& whiteness) {
  return {{"autocorrelation", whiteness.autocorrelation},
          {"band", whiteness.band},
          {"share_in_band", whiteness.share_in_band}};
}

Json CurveJson(const BandedSeries& series) {
  Json low = Json::array(), high = Json::array();
  for (const Band& band : series.band_per_dof) {
    low.push_back(band.low);
    high.push_back(band.high);
  }
  return {{"time", series.time_s}, {"mean", series.mean_per_dof}, {"low", low}, {"high", high}};
}

std::string SeriesRow(const char* name, const BandedSeries& series) {
  const Band band = WidestRunsBand(series);
  return fmt::format("{:<15} {:>3} {:>10.3f} {:>10.3f}    {:.3f} .. {:.3f} {:>10.1f} %\n", name,
                     series.dof, series.average_per_dof, series.end_average_per_dof, band.low,
                     band.high, series.share_in_band * 100);
}

std::string RmsRow(const char* name, const char* unit, const RmsPair& rms) {
  return fmt::format("{:<15} {:>3} {:>12.5f} {:>12.5f} {:>10.3f}\n", name, unit, rms.real,
                     rms.predicted, rms.real > 0 ? rms.predicted / rms.real : 0.0);
}

}  // namespace

std::string ConsistencyText(const Consistency& c) {
  std::string text =
      fmt::format("runs        {}\n\n{:<15} {:>3} {:>10} {:>10}    {:<14} {:>11}\n", c.runs.size(),
                  "mean per dof", "dof", "all", "end", "95 % band", "inside");
  text += SeriesRow("NEES pose", c.pose);
  text += SeriesRow("NEES position", c.position);
  text += SeriesRow("NEES rotation", c.rotation);
  if (c.nis) text += SeriesRow("NIS", *c.nis);
  text +=
      fmt::format("\n{:<15} {:>3} {:>12} {:>12} {:>10}\n", "RMS", "", "real", "predicted", "ratio");
  text += RmsRow("horizontal", "m", c.horizontal_m) + RmsRow("vertical", "m", c.vertical_m);
  text += RmsRow("tilt", "deg", c.tilt_deg) + RmsRow("yaw", "deg", c.yaw_deg);
  text += TiltText(c);
  text += fmt::format("\n{:<15} {:>10} {:>10} {:>10}\n", "share inside", "1 sigma", "2 sigma",
                      "3 sigma");
  for (std::size_t axis = 0; axis < kAxisNames.size(); ++axis) {
    const SigmaShares& shares = c.sigma_shares[axis];
    text += fmt::format("{:<15} {:>8.1f} % {:>8.1f} % {:>8.1f} %\n", kAxisNames[axis],
                        shares[0] * 100, shares[1] * 100, shares[2] * 100);
  }
  text += fmt::format("{:<15} {:>8.1f} % {:>8.1f} % {:>8.1f} %\n", "Gaussian", 68.3, 95.4, 99.7);
  if (c.nis_whiteness && !c.nis_whiteness->band.empty()) {
    text +=
        fmt::format("\nNIS whiteness   lag-1 correlation {:+.3f}, {:.0f} % of {} lags in band\n",
                    c.nis_whiteness->autocorrelation[0], c.nis_whiteness->share_in_band * 100,
                    c.nis_whiteness->band.size());
  }
  for (const std::string& note : c.notes) text += "note: " + note + "\n";
  return text;
}

Json ConsistencyJson(const Consistency& c) {
  Json runs = Json::array();
  for (std::size_t i = 0; i < c.runs.size(); ++i) {
    const std::optional<TiltSample>& tilt = c.run_largest_tilt[i];
    runs.push_back({{"name", c.runs[i]},
                    {"nees_pose_per_dof", c.run_pose_average_per_dof[i]},
                    {"largest_tilt_sigmas", tilt ? Json(tilt->sigmas) : Json()}});
  }
  Json shares = Json::object();
  for (std::size_t axis = 0; axis < kAxisNames.size(); ++axis) {
    shares[kAxisNames[axis]] = c.sigma_shares[axis];
  }
  return {{"num_runs", c.runs.size()},
          {"runs", runs},
          {"nees",
           {{"pose", SeriesJson(c.pose)},
            {"position", SeriesJson(c.position)},
            {"rotation", SeriesJson(c.rotation)}}},
          {"rms",
           {{"horizontal_m", RmsJson(c.horizontal_m)},
            {"vertical_m", RmsJson(c.vertical_m)},
            {"tilt_deg", RmsJson(c.tilt_deg)},
            {"yaw_deg", RmsJson(c.yaw_deg)}}},
          {"largest_tilt", TiltJson(c)},
          {"sigma_shares", shares},
          {"nis", c.nis ? SeriesJson(*c.nis) : Json()},
          {"nis_whiteness", c.nis_whiteness ? WhitenessJson(*c.nis_whiteness) : Json()},
          {"notes", c.notes}};
}

Json ConsistencyPictureData(const Consistency& c) {
  return {{"pose", CurveJson(c.pose)},
          {"position", CurveJson(c.position)},
          {"rotation", CurveJson(c.rotation)},
          {"nis", c.nis ? CurveJson(*c.nis) : Json()},
          {"summary", ConsistencyJson(c)}};
}

}  // namespace lio
