// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The tuning constants of relocalization (docs/recovery.md). "Measured" values come from the
// experiments named there on simulated drives and walks; "chosen" ones follow from geometry or cost
// and were not searched for.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lio {

struct BirdsEyeViewParameters {
  float half_width_m = 60.f;  // of the view's square; chosen: farther off a VLP-16 sees little
  float column_m = 0.5f;      // edge of a column that points are gathered in; chosen
  float min_height_m = 0.4f;  // from a column's lowest to its highest point; chosen: above kerbs
  float cell_m = 0.25f;       // edge of the cells that say how near is near; chosen
  int coarse_cell = 4;        // edge of the coarse cells, in cells; chosen: 1 m
  std::size_t min_structures = 20;   // fewer do not tell one place from another; chosen
  std::size_t max_structures = 300;  // bounds the cost of a score; chosen
  // A structure with others in line on both sides, so far each way, says nothing of the position
  // along that line (a wall, a rail). Chosen.
  int line_half_length_m = 3;
  int num_line_directions = 24;    // 7.5 deg apart; chosen
  std::size_t min_off_lines = 40;  // with fewer off all lines, those on lines count as well; chosen
};

struct VelocitySearchParameters {
  float step_mps = 0.5f;      // of the grid; chosen: 5 cm between two sweeps, well within a cell
  int max_steps = 90;         // to each side: 45 m/s; chosen
  float peak_width_m = 1.f;   // what is farther from the best shift is a rival; chosen
  double min_lead = 2.0;      // of the best score over its rivals, in roots of the score; measured
  double flat_top = 0.88;     // scores above this share of the best are averaged; measured
  std::size_t min_scans = 3;  // a single pair is ambiguous among repeating structures; measured
};

// After E. Olson, "Real-Time Correlative Scan Matching", ICRA 2009: coarse grid, then fine grid.
struct PlaceSearchParameters {
  float coarse_step_m = 1.f;               // half of it is what a coarse cell forgives; chosen
  float coarse_step_rad = 0.035f;          // 1 m at 30 m; chosen
  float fine_step_m = 0.25f;               // a cell of the view; chosen
  float fine_step_rad = 0.00875f;          // 0.25 m at 30 m; chosen
  std::size_t max_coarse_structures = 60;  // bounds the cost; chosen
  std::size_t max_refined = 100;           // coarse poses that are refined; chosen
  std::size_t max_found = 12;              // measured: places on a walk that look alike
  float same_m = 2.f;                      // found poses nearer than both of these are the same
  float same_rad = 0.1f;
};

struct ShiftSearchParameters {
  float step_m = 0.25f;         // a cell of the view; chosen
  double min_std_m = 0.2;       // of a result: a cell's width; chosen
  double log_odds = 6.0;        // a score lower by its chance is e^-6 as likely; measured
  double range_sigmas = 3.0;    // of the match, that are searched, ...
  double min_range_m = 1.5;     // ... at least, ...
  double max_range_m = 5.0;     // ... at most; chosen by cost
  std::size_t max_views = 8;    // of earlier scans; measured on a motorway
  float view_spacing_m = 1.5f;  // between them; measured
};

struct PlaceCandidateParameters {
  double range_sigmas = 2.0;  // of the prior, that are searched; chosen
  double max_shift_m = 60.0;  // farther off the views do not overlap
  double std_m = 0.5;         // of a candidate: a fine step, and what structures lack; chosen
  double std_rad = 0.03;
};

struct PlaceVerificationParameters {
  // A prior with a smaller standard deviation, felt by points at the lever, is within reach of
  // matching. Chosen: the largest correspondence radius.
  double max_prior_std_m = 2.0;
  double lever_m = 20.0;
  // The share of points on a surface of the map, of those that come to one, was 98 % at the true
  // pose on the worst walks and 78 % at most elsewhere: so much of the last scan's share is enough.
  double min_share = 0.9;
  double min_number = 0.2;     // points on surfaces, of those of the last scan; chosen
  double plenty_number = 0.6;  // as many end the search and overrule inertial prediction; measured
  double apart_m = 0.5;        // two poses nearer than this are not told apart; chosen
  double clearly_more = 1.2;   // times the points on surfaces, for a better match; measured
  double much_nearer = 0.3;    // times as far, for a match that is near one of two poses; chosen
};

// Things that stand up in a cloud, in voxels.
struct StandingPointsParameters {
  float voxel_m = 1.f;     // chosen: lower than any ceiling is above its floor
  int min_points = 5;      // of a voxel that shows how its points spread; chosen
  float min_std_m = 0.2f;  // of their height: a wall through the whole voxel has 0.29
  float column_m = 0.5f;   // edge of a column, which gives one structure; as BirdsEyeView's
};

// After W. Hess et al., "Real-Time Loop Closure in 2D LIDAR SLAM", ICRA 2016: branch and bound over
// a pyramid of grids.
struct MapSearchParameters {
  float cell_m = 0.5f;                // of the finest grid; chosen: matching converges from there
  int num_levels = 7;                 // cells of 0.5 to 32 m; chosen
  int max_cells_per_side = 8192;      // 4 km, whose grids take 220 MB; chosen
  float step_rad = 0.0175f;           // a cell at 30 m
  int num_refine_steps = 4;           // fine steps to each side, over what a score is the same
  float margin_m = 10.f;              // so far beyond the points of the map a body may be; chosen
  std::size_t max_structures = 120;   // bounds the cost; chosen
  float max_range_m = 40.f;           // of structures, where a step of the turn is 0.7 m
  double min_share = 0.4;             // of the structures, that must be in the map; chosen
  double min_score_ratio = 0.88;      // of the best score; chosen
  std::size_t max_places = 16;        // chosen by cost: four scans of coarse matches
  std::size_t max_nodes = 4'000'000;  // that wait; 48 MB
  // Look-ups in a grid for one scan: about 20 ms.
  std::int64_t max_lookups_per_scan = 4'000'000;
};

struct HeightVotesParameters {
  float column_m = 0.5f;
  float bin_m = 0.25f;
  std::size_t max_points = 400;  // that vote; chosen
  double min_vote_ratio = 0.6;   // of the votes for the best height; chosen
  float apart_m = 1.f;           // two heights nearer than this are one; chosen
  std::size_t max_heights = 4;   // storeys that are tried; chosen
};

struct GatheredCloudParameters {
  float thin_m = 0.25f;              // the cloud has a point in each such voxel; as map.pcd, nearly
  float max_range_m = 40.f;          // from the body, of what is sought; as MapSearchParameters
  std::size_t max_points = 400'000;  // then it begins anew; chosen: some hundred metres of a street
  std::size_t max_sample = 2000;     // points that stand for the cloud: as many as of a scan
};

struct PlaceContestParameters {
  int num_coarse_points = 800;     // as many as come to a surface need be 50; chosen
  int max_coarse_per_scan = 20;    // coarse matches of a scan; chosen: some milliseconds
  std::size_t max_contenders = 8;  // places that are followed; chosen
  double min_support_ratio = 0.5;  // of the best coarse match, for a place to be followed; chosen
  double settled_std_m = 0.1;      // of a place that matched the scan before; chosen
  double settled_std_rad = 0.01;
  // Share of the points on surfaces of those that come to one, over that of the scan in its own new
  // map: 0.96 and more at right places, 0.94 at most one storey off
  // (docs/experiments/start_in_a_map.md).
  double min_fit = 0.95;
  // Points on surfaces, over those in the scan's own new map; with fewer the fit is worse. Chosen:
  // a saved map has fewer points on near things than the last scans have.
  double min_number_ratio = 0.6;
  double max_step_m = 0.3;  // a right place stays where it is from scan to scan; chosen
  double max_step_rad = 0.02;
  int num_checks = 5;        // scans in a row that must say so; chosen: half a second
  int num_rival_checks = 2;  // matches of a rival before it counts as beaten; chosen
  // A beaten rival's share of points that contradict it, over the winner's, ...
  double min_residual_ratio = 1.5;  // ... at least; chosen
  double least_residual = 0.02;     // the winner's is taken to be no less; chosen
  int max_scans = 30;               // then the search begins anew; chosen
};

struct PlaceSeekerParameters {
  std::size_t min_structures = 20;  // as BirdsEyeViewParameters
  int min_scans = 5;                // before the first search; chosen: half a second
  double again_after_m = 2.0;       // moved by so much, ...
  int again_after_scans = 20;     // ... or after so many scans, another search is worth it; chosen
  float guess_range_m = 10.f;     // around a guess, to each side, ...
  float guess_range_rad = 0.5f;   // ... of its yaw, ...
  float guess_range_up_m = 1.5f;  // ... and up and down: less than half a storey; chosen
};

struct RelocalizationParameters {
  BirdsEyeViewParameters view;
  VelocitySearchParameters velocity;
  PlaceSearchParameters place;
  ShiftSearchParameters shift;
  PlaceCandidateParameters candidate;
  PlaceVerificationParameters verification;
  StandingPointsParameters standing;
  MapSearchParameters map_search;
  HeightVotesParameters height;
  GatheredCloudParameters gathered;
  PlaceContestParameters contest;
  PlaceSeekerParameters seeker;
  double aligned_std_m = 0.5;  // of a prior that was aligned: 5 m/s over a sweep; chosen
  // Full matches for one scan: from the prior, two of a search, after the deskew was refined.
  int max_matches_per_scan = 4;
  // Points of a coarse match, which ranks candidates: an eighth of a full match's. Chosen.
  int num_coarse_points = 300;
  double tried_same_m = 1.0;  // a place nearer than both of these to one that was tried is the same
  double tried_same_rad = 0.1;
};

inline constexpr RelocalizationParameters kRelocalization;

}  // namespace lio
