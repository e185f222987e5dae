// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/euroc.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lio::test {
namespace {

struct Row {
  Timestamp stamp;
  std::vector<double> values;
};

std::vector<Row> ReadRows(const std::filesystem::path& file, std::size_t num_values) {
  std::ifstream in(file);
  std::vector<Row> rows;
  std::string line;
  while (std::getline(in, line)) {
    if (line.empty() || line.front() == '#') continue;
    Row row;
    std::istringstream words(line);
    std::string word;
    std::getline(words, word, ',');
    row.stamp.ns = std::stoll(word);  // the values after a point are zero
    while (std::getline(words, word, ',')) row.values.push_back(std::stod(word));
    if (row.values.size() != num_values) throw std::runtime_error(file.string() + ": " + line);
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error(file.string() + ": cannot be read or is empty");
  return rows;
}

// The extrinsic is from the data's own description.
Pose ImuFromCamera() {
  Matrix3 R;
  R << 0.0148655429818, -0.999880929698, 0.00414029679422,  //
      0.999557249008, 0.0149672133247, 0.025715529948,      //
      -0.0257744366974, 0.00375618835797, 0.999660727178;
  return {Quaternion(R).normalized(), {-0.0216401454975, -0.064676986768, 0.00981073058949}};
}

}  // namespace

RealDrive ReadEuroc(const std::filesystem::path& folder, const std::string& name) {
  RealDrive drive;
  for (const Row& row : ReadRows(folder / (name + "_imu.csv"), 6)) {
    const std::vector<double>& v = row.values;
    drive.samples.push_back({row.stamp, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
  }
  const Pose T_camera_imu = ImuFromCamera().Inverse();
  for (const Row& row : ReadRows(folder / (name + "_truth_left_camera.csv"), 7)) {
    const std::vector<double>& v = row.values;
    const Quaternion R_camera_world = Quaternion(v[3], v[4], v[5], v[6]).normalized();
    const Pose T_world_camera{R_camera_world.conjugate(), {v[0], v[1], v[2]}};
    drive.T_world_imu.push_back({row.stamp, T_world_camera * T_camera_imu});
  }
  return drive;
}

}  // namespace lio::test
