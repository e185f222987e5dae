// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Keeps everything that is known of where a scan may be besides the motion prior, by bird's-eye
// views: its velocity before anything is mapped, a better prior by its shift since the last scan,
// its place after it was lost, its position along degenerate directions. It knows no map: what
// needs one calls back.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"
#include "lio/registration/motion_prior.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/relocalization/birds_eye_hold.hpp"
#include "lio/relocalization/search_request.hpp"
#include "lio/relocalization/tried_places.hpp"
#include "lio/relocalization/velocity_search.hpp"

namespace lio {

// Holds deskewed points in imu at `stamp`, the sweep's middle.
struct DeskewedScan {
  Timestamp stamp;
  std::span<const Eigen::Vector3f> points_imu;
};

// Matches the scan in question against the map, from a guess with its covariance (right error).
using MatchFrom = std::function<MatchResult(const Pose& T_map_imu_guess, const Matrix6& cov)>;

struct CandidateMatcher {
  MatchFrom match;           // with all points: max_matches times at most
  MatchFrom match_coarsely;  // with a few hundred points
  int max_matches = 1;
};

// Is a pose predicted so well that matching from it finds the scan, if it is there? The covariance
// is of [position (m); rotation (rad)].
[[nodiscard]] bool IsWithinConvergenceBasin(const Matrix6& prior_cov);

class Relocalizer {
 public:
  struct Found {
    MatchResult match;
    bool is_relocalized = false;  // the match is one that the place search led to
    bool is_clock_set = false;    // the match is at the request's alternative
  };

  // Forgets all scans: the map was cleared.
  void Clear() { *this = Relocalizer(); }

  // As SeenVelocity, in the map's axes.
  struct Velocity {
    std::optional<Vector3> v_map_imu_mps;
    std::optional<SpeedRange> by_buildings;
  };
  // Returns what this and all scans that were given since Clear() show. The prior gives only its
  // rotation and its vertical.
  [[nodiscard]] Velocity FindVelocity(const DeskewedScan& scan, const MotionPrior& prior);

  // Returns the prior with its position by the shift since the last located scan, where that is
  // clear.
  [[nodiscard]] MotionPrior Align(const DeskewedScan& scan, const MotionPrior& prior) const;

  // Finds the scan's place if `near_prior`, its match from the prior, is not the place; returns
  // `near_prior` if it is. Candidates are ranked by coarse matches; those that the matcher's bound
  // leaves untried come first in the search for the next scan.
  [[nodiscard]] Found Search(const SearchRequest& request, const DeskewedScan& scan,
                             const MotionPrior& prior, const MatchResult& near_prior,
                             const CandidateMatcher& matcher);

  // Corrects degenerate directions of a usable match, found from the prior. `points_imu` are all of
  // the scan's.
  void HoldDegenerate(std::span<const Eigen::Vector3f> points_imu, const MotionPrior& prior,
                      MatchResult& match);

  // Do fewer points lie on surfaces than at a right place, compared with the last located scan?
  // False before any scan was located.
  [[nodiscard]] bool MayBeElsewhere(const MatchResult& match) const;

  // The scan was located there, or it begins the map. Later searches start from it.
  void SetLocated(Timestamp stamp, std::vector<Eigen::Vector3f> points_imu,
                  const MatchResult& match);

 private:
  struct Located {
    Timestamp stamp;
    std::vector<Eigen::Vector3f> points_imu;
    MatchResult match;
  };

  void SearchPlaces(const SearchRequest& request, const DeskewedScan& scan,
                    const MotionPrior& prior, const CandidateMatcher& matcher, Found& found);
  void TryPlaces(const DeskewedScan& scan, const MotionPrior& prior,
                 const CandidateMatcher& matcher,
                 const std::function<bool(const MatchResult&)>& take);
  void TakeBestPlace(const DeskewedScan& scan, const MotionPrior& prior,
                     const CandidateMatcher& matcher, Found& found);
  void TakePlaceWithoutRival(const DeskewedScan& scan, const MotionPrior& prior,
                             const CandidateMatcher& matcher, Found& found);
  void TryAlternative(const Pose& alternative, const MotionPrior& prior, const MatchFrom& match,
                      Found& found) const;

  VelocitySearch velocity_search_;
  BirdsEyeHold hold_;
  TriedPlaces tried_;  // since the last located scan
  std::optional<Located> last_;
};

}  // namespace lio
