// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The contest tells which of several places in a saved map is the right one. Coarse matches of the
// gathered cloud rank them all; the best few are then followed: every scan is matched at the
// leading place and at one of its rivals, and compared with how well it fits the new map that it
// belongs to. A place wins when several scans in a row fit it, they show every direction together,
// and clearly more points contradict every rival. Places that look nearly alike are
// followed for a part of the way, since a thing that was moved stays behind there. None wins among
// places that look alike, and a search over more of the way has to tell.
//
// Frames: `map` is the new map, `initial` the saved one.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/relocalization/gathered_cloud.hpp"

namespace lio {

// Matches points against the saved map, from the pose of their axes with its covariance.
using MatchInInitial = std::function<MatchResult(std::span<const Eigen::Vector3f> points,
                                                 const Pose& T_initial_guess, const Matrix6& cov)>;

// Holds a scan that the new map has located.
struct LocatedScan {
  std::span<const Eigen::Vector3f> points_imu;  // to match
  const MatchResult& match;                     // in the new map
};

// Says how well a scan fits the saved map at a place, against its new map.
struct PlaceFit {
  double share = 1.0;   // points that nothing contradicts, over the share in the new map
  double number = 1.0;  // points on surfaces, over those in the new map
  // Points on surfaces, less those that are contradicted by their weight, over the points on
  // surfaces of the new map.
  double score = 1.0;

  // Returns the share, less where there are fewer points than so many.
  [[nodiscard]] double ShareWith(double least_number) const {
    return share * std::min(1.0, number / least_number);
  }
};

struct FoundPlace {
  Pose T_initial_map;
  Matrix6 cov = Matrix6::Zero();  // pose of the body in the saved map, right error
};

class PlaceContest {
 public:
  // The places have this covariance, right error at the sample's centre.
  PlaceContest(CloudSample sample, const std::vector<Pose>& T_initial_map, const Matrix6& cov);

  // Ranks some more places. Returns true when all are ranked.
  [[nodiscard]] bool Rank(const MatchInInitial& match);
  // Follows the leader and a rival by another scan, with at most `max_matches` matches of it. Call
  // it after ranking. Returns the place that has won, if one has.
  [[nodiscard]] std::optional<FoundPlace> Check(const LocatedScan& scan,
                                                const MatchInInitial& match, int max_matches);
  // Returns true when no place can win any more.
  [[nodiscard]] bool is_over() const;

 private:
  struct Contender {
    Pose T_initial_map;
    double support = 0.0;  // SupportOf() the coarse match
    int num_checks = 0;
    int num_good_in_a_row = 0;
    std::deque<PlaceFit> last_fits = {};
    // Sums over the good checks in a row, about the sample's centre.
    Matrix6 information = Matrix6::Zero();
    Matrix6 noise = Matrix6::Zero();
    Matrix6 cov = Matrix6::Zero();

    [[nodiscard]] bool is_good() const;
    // Their scans together show every direction.
    [[nodiscard]] bool is_observable() const;
    [[nodiscard]] PlaceFit fit() const;  // the mean of the last ones
    [[nodiscard]] PlaceFit best_fit() const;
  };

  void KeepTheBest();
  void CheckAt(Contender& contender, const LocatedScan& scan, const MatchInInitial& match) const;
  void CountInformation(Contender& contender, const Pose& T_map_imu,
                        const Observability& observability) const;
  void OrderByFit();
  void MergeSame();
  [[nodiscard]] bool HasWinner() const;
  [[nodiscard]] bool IsBeatenByLeader(const Contender& rival) const;

  CloudSample sample_;
  Matrix6 place_cov_;
  std::vector<Contender> contenders_;  // the leader first, once all are ranked
  std::size_t num_ranked_ = 0;
  int num_scans_ = 0;    // checked
  double path_m_ = 0.0;  // way of the body over them
  std::optional<Vector3> last_position_map_;
};

}  // namespace lio
