// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The tuning constants of relocalization (docs/recovery.md). "Measured" values come from the
// experiments named there on simulated drives and walks; "chosen" ones follow from geometry or cost
// and were not searched for.
#pragma once

#include <cstddef>

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

struct RelocalizationParameters {
  BirdsEyeViewParameters view;
  VelocitySearchParameters velocity;
  PlaceSearchParameters place;
  ShiftSearchParameters shift;
  PlaceCandidateParameters candidate;
  PlaceVerificationParameters verification;
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
