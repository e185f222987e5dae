// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the errors of a lidar's beams (sensor/beam_errors.hpp) from the matches of a drive.
//
// A point that lies off its surface by r, along the normal n, differs from the cell's mean by the
// errors of its own beam, less the mean errors of the beams that the cell was seen by:
//   r = n . (B - mean(B)) theta + (f - mean(f)) gamma + J xi + a J zeta + noise
// with B theta the displacement by the errors theta, J xi that by the error of the scan's pose, and
// a J zeta that by the drift of the map over the way a since the cell was seen: a map that grows
// from wrong matches bends, so xi and zeta (6 unknowns each) are eliminated from each scan. gamma
// is how much longer ranges are at grazing incidence: f = n . d (1 / |n . d| - 1), d the beam. It
// keeps the elevations of beams that see mostly ground free of that effect, and is not corrected.
//
// Cells have errors of their own, which all scans that see them share, so a scan counts with the
// share of the map that is new in it; while the vehicle stands nothing is learned. The errors have
// the prior of a data sheet. The model of the beams' errors is that of Glennie, Lichti, "Static
// calibration and analysis of the Velodyne HDL-64E S2", Remote Sensing 2(6), 2010; the difference
// to the map's own errors is ours (docs/experiments/beam_errors.md).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/map/cell_beams.hpp"
#include "lio/sensor/beam_errors.hpp"

namespace lio {

// One point on a plane of the map. Vectors are in one frame that does not turn with the sensor.
struct BeamRow {
  std::uint16_t ring = 0;
  BeamAxes axes;           // the point's
  const CellBeams* cell;   // the plane's
  Eigen::Vector3f normal;  // the plane's
  float residual_m = 0.f;  // from the plane to the point, less errors() and relief() height_m
  float height_m = 0.f;    // Roughness::HeightAt() of the point
  float weight = 0.f;      // 1 / m^2
  Vector6f jacobian;       // by the scan's pose
};

class BeamCalibration {
 public:
  // Starts from what is known of this lidar, if anything is.
  explicit BeamCalibration(const BeamKnowledge& known = {});

  // Forgets the rows of the scan before, if they were not kept. `path_m`: the vehicle's way up to
  // here. `stands_for`: each row is one of so many of the match.
  void BeginScan(float path_m, int stands_for);
  void Add(const BeamRow& row);
  void ForgetScan() { scan_.num_rows = 0; }
  // Learns no more: for scans that it has learned from already, which would count twice.
  void Freeze() { is_frozen_ = true; }
  // The scan at hand was inserted, and has brought this share of the map. `is_blind`: it does not
  // see all directions.
  void Keep(double new_content_share, bool is_blind);

  // The errors that are left pull the pose: the covariance of the gradient (score) that they give
  // to the cost of the scan at hand. Absent as long as nothing is known.
  [[nodiscard]] std::optional<Matrix6> ScoreCov() const;

  // Measured minus true. Unknown as long as no scan was kept, unless something was known before.
  [[nodiscard]] const BeamErrors& errors() const { return errors_; }
  // Rough ground looks higher by this share of Roughness::HeightAt(), 0 to 1.
  [[nodiscard]] float relief() const { return relief_; }
  // The errors with their standard deviations, which take a moment.
  [[nodiscard]] BeamKnowledge Found() const;
  // Is what was found of use elsewhere, or from the start on? Not where most scans were blind: in a
  // plain tunnel a map that bends and elevations that err look alike, and more is claimed to be
  // known of them than is (docs/experiments/beam_errors.md).
  [[nodiscard]] bool IsOfUseElsewhere() const { return 2 * num_blind_ <= num_kept_; }

 private:
  static constexpr int kNumNuisance = 12;  // xi and zeta
  using Nuisance = Eigen::Matrix<double, kNumNuisance, 1>;
  using NuisanceSquare = Eigen::Matrix<double, kNumNuisance, kNumNuisance>;
  using NuisanceColumns = Eigen::Matrix<double, kNumNuisance, Eigen::Dynamic>;
  struct Term {
    int unknown = 0;
    float value = 0.f;
  };

  void SetPrior(const BeamKnowledge& known);
  void FindTerms(const BeamRow& row);
  void AddTerms(int ring, const BeamShift& shift, float share);
  void MakeRoomFor(int num_unknowns);
  void Solve();

  // The knowledge before the first scan, as normal equations.
  Eigen::MatrixXd prior_information_;
  Eigen::VectorXd prior_score_;
  // The normal equations of all scans, poses eliminated, and of the scan at hand.
  Eigen::MatrixXd information_;
  Eigen::VectorXd score_;
  struct OfScan {
    Eigen::MatrixXd information;  // its lower triangle
    NuisanceColumns mixed;
    NuisanceSquare nuisance;
    Eigen::VectorXd score;
    Nuisance nuisance_score;
    float path_m = 0.f;
    int num_rows = 0;
    int stands_for = 1;
  };
  OfScan scan_;
  std::vector<Term> terms_;                 // the row at hand has them
  Eigen::LDLT<Eigen::MatrixXd> posterior_;  // errors_ have it, with the prior
  BeamErrors errors_;
  float relief_ = 0.f;
  int num_kept_ = 0;
  int num_blind_ = 0;  // kept scans that were blind
  bool is_frozen_ = false;
};

}  // namespace lio
