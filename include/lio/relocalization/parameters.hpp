// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The tuning constants of relocalization (docs/recovery.md). "Chosen" values follow from geometry
// or cost and were not searched for; "measured" ones name the page or the drives, all simulated.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lio/registration/registration_parameters.hpp"

namespace lio {

struct BirdsEyeViewParameters {
  float half_width_m = 60.f;  // half of the view's square; chosen: farther off a VLP-16 sees little
  float column_m = 0.5f;      // edge of a column of points; chosen: wider than trunks and posts
  float min_height_m = 0.4f;  // from a column's lowest to its highest point; chosen: above kerbs
  // Cells of this edge say how near is near. Chosen: matching converges from there.
  float cell_m = 0.25f;
  int coarse_cell = 4;  // edge of the coarse cells, in cells; chosen: 1 m, as the coarse step
  std::size_t min_structures = 20;   // chosen: fewer do not tell one place from another
  std::size_t max_structures = 300;  // chosen: bounds the cost of a score
  // A structure with others in line on both sides, so far each way, says nothing of the position
  // along that line (a wall, a rail). Chosen: longer than a parked car is wide.
  int line_half_length_m = 3;
  int num_line_directions = 24;  // chosen: 7.5 deg apart, 0.4 m at 3 m, within a column
  // If fewer are off all lines, those on lines count as well. Chosen: twice min_structures.
  std::size_t min_off_lines = 40;
};

struct VelocitySearchParameters {
  float step_mps = 0.5f;  // step of the grid; chosen: 5 cm between two sweeps, well within a cell
  int max_steps = 90;     // to each side: 45 m/s; chosen: faster than cars drive on motorways
  float peak_width_m = 1.f;  // chosen: what is farther from the best shift is a rival
  // The best score leads its rivals by so many roots of the score. Chosen: two standard deviations
  // of a count; nine starts on a motorway are all clear by it.
  double min_lead = 2.0;
  // Scores above this share of the best are averaged. Measured at nine starts on a motorway,
  // with ConstantVelocityParameters::velocity_seed_std_mps: five begin at the first try, two
  // before.
  double flat_top = 0.88;
  // A velocity is believed from so many scans on. Measured: a single pair is ambiguous among
  // repeating structures (docs/experiments/starts_in_motion.md).
  std::size_t min_scans = 3;
  // No vehicle is as high. Data sheet: 4.0 m are allowed in Europe and China, 4.3 m in most of the
  // United States.
  float min_building_height_m = 4.5f;
  // ... and they exclude a velocity whose score is lower than the best one by so many roots of
  // that.
  double likely_sigmas = 3.0;  // statistics: 99.7 %
  // So many scans are awaited for buildings, if any are seen, to tell a velocity by themselves.
  // Chosen: two fewer than a start may take.
  std::size_t max_scans_of_buildings = 6;
};

// After E. Olson, "Real-Time Correlative Scan Matching", ICRA 2009: coarse grid, then fine grid.
struct PlaceSearchParameters {
  float coarse_step_m = 1.f;               // chosen: half of it is what a coarse cell forgives
  float coarse_step_rad = 0.035f;          // chosen: 1 m at 30 m
  float fine_step_m = 0.25f;               // chosen: a cell of the view
  float fine_step_rad = 0.00875f;          // chosen: 0.25 m at 30 m
  std::size_t max_coarse_structures = 60;  // chosen: bounds the cost
  std::size_t max_refined = 100;           // coarse poses that are refined; chosen: bounds the cost
  // Found poses, at most. Chosen: so many places of a walk may look alike; used in
  // docs/experiments/relocalization.md.
  std::size_t max_found = 12;
  // Found poses nearer than both of these are the same. Chosen: two and three coarse steps.
  float same_m = 2.f;
  float same_rad = 0.1f;
};

// Without an inertial filter a match is held along degenerate directions: the values are those of
// docs/experiments/open_road.md.
struct ShiftSearchParameters {
  float step_m = 0.25f;    // chosen: a cell of the view
  double min_std_m = 0.2;  // lower bound of a result's; chosen: about a cell's width
  // A score that is lower by its chance is e^-1.5 as likely. Measured, as are 0.7 to 6:
  // docs/experiments/starts_in_motion.md.
  double log_odds = 1.5;
  double range_sigmas = 3.0;  // searched, of the prediction's, ... statistics: 99.7 %
  double min_range_m = 1.5;   // ... at least, ... chosen: six steps, so that a peak shows its sides
  double max_range_m = 5.0;   // ... at most; chosen by cost
  // A view from above tells how far a body has gone in a degenerate direction that is level by so
  // much of its length, with turns in metres. Chosen: within 45 deg.
  double min_level_share = 0.7;
  std::size_t max_views = 8;    // from earlier scans; chosen by cost, used in that page
  float view_spacing_m = 1.5f;  // between them; chosen: posts look new; used in that page
};

struct PlaceCandidateParameters {
  double range_sigmas = 2.0;  // searched around the prior; chosen by cost: 95 % of each axis
  double max_shift_m = 60.0;  // chosen: farther off less than half of the views overlaps
  // The body was unseen from so long on since the last located scan. Chosen: a sweep and a half at
  // 10 Hz, within which no body stops.
  double unseen_from_s = 0.15;
  // A candidate has this standard deviation. Chosen: a fine step and what structures lack in place,
  // and about a coarse step of the turn.
  double std_m = 0.5;
  double std_rad = 0.03;
};

struct PlaceVerificationParameters {
  // A prior with a smaller standard deviation, felt by points at the lever, is within the basin of
  // convergence of matching.
  double max_prior_std_m = CorrespondenceParameters::kMaxStd_m;
  double lever_m = CorrespondenceParameters::kLever_m;
  // This share of the points that come to a surface of the map must lie on it, over the last scan's
  // share. Measured: 98 % lie on it at the true pose on the worst walks, 78 % at most elsewhere
  // (docs/experiments/relocalization.md).
  double min_share = 0.9;
  // The same holds from an unsure prior, for a scan that may be bent. Measured: as min_share.
  double likely_share = 0.8;
  double min_number = 0.2;  // points on surfaces, of the last scan's; chosen: fewer say little
  int min_upright = 50;     // points on what stands, of the last scan's; chosen: as kMinMatched
  // As many end the search and overrule inertial prediction. Chosen; used in
  // docs/experiments/clock_steps.md.
  double plenty_number = 0.6;
  // A scan that has fewer is tried turned, if nothing measures turns. Chosen: a view changes by
  // less from scan to scan, and at a wrong turn of 6 deg and more it had less.
  double same_number = 0.8;
  double apart_m = 0.5;  // chosen: two poses nearer than this are not told apart by matching
  // A better match has so many times the points on surfaces. Chosen; used in
  // docs/experiments/clock_steps.md.
  double clearly_more = 1.2;
  double much_nearer = 0.3;  // times as far, for a match near one of two poses; chosen: a third
};

// Tunes the search for things that stand up in a cloud, in voxels.
struct StandingPointsParameters {
  float voxel_m = 1.f;     // chosen: lower than any ceiling is above its floor
  int min_points = 5;      // a voxel's spread needs so many; chosen: fewer spread by chance
  float min_std_m = 0.2f;  // their spread in height; chosen: a wall through the voxel has 0.29
  float column_m = BirdsEyeViewParameters{}.column_m;  // edge; a column gives one structure
};

// How finely a map is searched.
struct MapSearchScale {
  float cell_m;       // edge of the finest cells: matching converges from there
  float reach_cells;  // a point marks the cells that are within so many cells of it
  int num_levels;     // each level's blocks are twice as wide as the last one's
  float step_rad;     // step of the turn: a cell at half of the range or more
  float max_range_m;  // bound on the range of points that are sought
  float margin_m;     // a body may be so far beyond the map's points
  float same_m;       // places nearer than this are the same
  double std_m;       // standard deviations of a place that is found
  double std_rad;
  std::size_t max_num;  // points that are sought; bounds the cost
};

// After W. Hess et al., "Real-Time Loop Closure in 2D LIDAR SLAM", ICRA 2016: branch and bound over
// a pyramid of grids.
struct MapSearchParameters {
  // Things that stand up in a large map are sought from above. Chosen: cells of 0.5 to 32 m, a few
  // of which cover a map, a margin of some lanes, and places two coarse steps apart.
  static constexpr MapSearchScale kFromAbove{.cell_m = 0.5f,
                                             .reach_cells = 1.f,
                                             .num_levels = 7,
                                             .step_rad = 0.0175f,
                                             .max_range_m = 40.f,
                                             .margin_m = 10.f,
                                             .same_m = 2.f,
                                             .std_m = PlaceCandidateParameters{}.std_m,
                                             .std_rad = PlaceCandidateParameters{}.std_rad,
                                             .max_num = 120};
  // All points are sought in a building, in three dimensions: seen from above, its storeys lie over
  // each other, and its stairs stand everywhere. Measured in an office: 0.99 of the points lie in
  // marked cells at the right pose, and at one of 10 000 others 0.84; with cells of 0.5 m these
  // were 1.00 and 0.99 (docs/experiments/start_in_a_map.md). From 0.5 m off, matches slide along
  // stairs: standard deviations are those of a cell and a step.
  static constexpr MapSearchScale kInBuilding{.cell_m = 0.25f,
                                              .reach_cells = 0.5f,
                                              .num_levels = 5,
                                              .step_rad = 0.0167f,
                                              .max_range_m = 15.f,
                                              .margin_m = 2.f,
                                              .same_m = 1.f,
                                              .std_m = 0.15,
                                              .std_rad = 0.015,
                                              .max_num = 200};
  // A map of fewer cells is one of a building. Chosen by memory: 100 m by 60 m by 20 m, 25 MB.
  double max_cells_of_building = 8e6;
  // A block of shifts is two to this power cells wide in its grid. Chosen: all grids take three
  // times the memory of the finest then; fewer bound a score looser.
  int log2_cells_per_block = 2;
  int max_cells_per_side = 8192;    // chosen by memory: 4 km, whose grids take 220 MB
  float max_coordinate_m = 100e3f;  // bound on a map's points; arithmetic: a float holds 8 mm there
  // A place seen from above is refined by so many fine steps to each side, over which its score is
  // the same. Arithmetic: four of PlaceSearchParameters::fine_step_m are two cells, and a cell
  // beside counts as well.
  int num_refine_steps = 4;
  double min_share = 0.4;  // share of what is sought in the map; chosen: scans see new things, too
  double min_score_ratio = VelocitySearchParameters{}.flat_top;  // share of the best score
  std::size_t max_places = 16;        // chosen by cost: four scans of coarse matches
  std::size_t max_nodes = 4'000'000;  // nodes that wait; chosen by memory: 64 MB
  // One scan pays for so many look-ups in a grid. Chosen by time: about 20 ms; a search of a street
  // of 440 m takes 10 to 12 scans of them (docs/experiments/start_in_a_map.md).
  std::int64_t max_lookups_per_scan = 4'000'000;
};

struct HeightVotesParameters {
  float column_m = MapSearchParameters::kFromAbove.cell_m;  // edge of a column of the map
  float bin_m = 0.25f;           // height of a bin; chosen: matching converges from half a metre
  std::size_t max_points = 400;  // voters; chosen: bounds the cost
  double min_vote_ratio = 0.6;   // share of the best height's; chosen: storeys look nearly alike
  float apart_m = 1.f;          // chosen: two heights nearer than this are one, no storey is as low
  std::size_t max_heights = 4;  // storeys that are tried; chosen by cost
};

struct GatheredCloudParameters {
  float thin_m = 0.25f;  // the cloud has a point in each such voxel; as map.pcd, nearly
  float max_range_m =
      MapSearchParameters::kFromAbove.max_range_m;  // from the body, of what is sought
  std::size_t max_points = 400'000;  // then it begins anew; chosen: some hundred metres of a street
  std::size_t max_sample = 2000;     // points that stand for the cloud: as many as of a scan
};

// When the rival of a place is beaten by it.
struct RivalParameters {
  int num_checks = 2;  // matches of a rival before it counts as beaten; chosen: one may fail
  // A rival is beaten when its share of points that contradict it, over the winner's, is this, ...
  // Chosen; no wrong place won by it (docs/experiments/start_in_a_map.md).
  double min_residual_ratio = 1.5;
  double least_residual = 0.02;  // ... which is taken to be no less; chosen: moved things ...
  // ... that stay behind: on a way of so many metres a rival is beaten by this many, too, if its
  // points on surfaces, less those against it by this weight, are fewer than this share of the
  // winner's. Chosen: other things are in view then. In an office 0.01 to 0.03 of the points are
  // against places of other storeys, 0.001 against the right one, and flights of stairs are alike
  // (docs/experiments/start_in_a_map.md).
  double moved_on_m = 2.0;
  double least_residual_moved_on = 0.005;
  double weight_against = 10.0;
  double max_score_ratio = 0.9;
};

struct PlaceContestParameters {
  // A coarse match has so many points. Chosen: 50 of them must come to a surface
  // (MatchParameters::kMinMatched), and in a strange place few do.
  int num_coarse_points = 800;
  int max_coarse_per_scan = 20;    // coarse matches of a scan; chosen: some milliseconds
  std::size_t max_contenders = 8;  // places that are followed; chosen: two matches a scan, in turn
  double min_support_ratio = 0.5;  // share of the best coarse match, to be followed; chosen: half
  // A place that matched the scan before has this standard deviation. Chosen: above what a scan's
  // match moves it by, below max_step_m and max_step_rad.
  double settled_std_m = 0.1;
  double settled_std_rad = 0.01;
  // This share of the points that come to a surface must lie on it, over that of the scan in its
  // own new map. Measured: 0.96 and more at right places, 0.94 at most one storey off
  // (docs/experiments/start_in_a_map.md).
  double min_fit = 0.95;
  // So many points must lie on surfaces, over those in the scan's own new map, or for a rival at
  // the leader; with fewer the fit is worse. Chosen: a saved map has fewer points on near things
  // than the last scans have.
  double min_number_ratio = 0.6;
  // A right place stays where it is from scan to scan. Chosen: three settled_std_m, and two of the
  // turn.
  double max_step_m = 0.3;
  double max_step_rad = 0.02;
  int num_checks = 5;  // scans in a row that must say so; chosen: half a second
  // They show every direction together, with so many times the information that noise induces.
  // Chosen: the axis of a corridor has 1.6 at most (DegeneracyParameters::kMinInformationRatio),
  // and that the scans agree on a place says more than one match does.
  double min_information_ratio = 4.0;
  // After so many scans the search begins anew, or after so many if the leader fits. Chosen: three
  // and ten seconds at 10 Hz.
  int max_scans = 30;
  int max_scans_of_good = 100;
};

struct PlaceSeekerParameters {
  std::size_t min_structures = BirdsEyeViewParameters{}.min_structures;
  int min_scans = 5;  // before the first search; chosen: half a second
  // Moved by so much, or after so many scans, another search is worth it. Chosen: other things are
  // in view, or two seconds have brought more of them.
  double again_after_m = 2.0;
  int again_after_scans = 20;
  // The search goes so far around a guess, to each side, of its yaw, and up and down. Chosen: a
  // parking lot's error by hand or GNSS, 30 deg, and less than half a storey.
  float guess_range_m = 10.f;
  float guess_range_rad = 0.5f;
  float guess_range_up_m = 1.5f;
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
  RivalParameters rival;
  PlaceContestParameters contest;
  PlaceSeekerParameters seeker;
  double aligned_std_m = 0.5;  // an aligned prior's; chosen: 5 m/s over a sweep
  // One scan has so many full matches: from the prior, two of a search, after the deskew was
  // refined. Chosen by cost: up to 16 ran before, and found places no better.
  int max_matches_per_scan = 4;
  // After a time that nobody saw it has more, to try the rivals of a place. Chosen by cost: some 20
  // ms, once an outage.
  int max_matches_unseen = 8;
  // A coarse match, which ranks candidates, has so many points. Chosen: an eighth of a full
  // match's.
  int num_coarse_points = 300;
  // A place nearer than both of these to one that was tried is the same. Chosen: matching converges
  // from there.
  double tried_same_m = 1.0;
  double tried_same_rad = 0.1;
};

inline constexpr RelocalizationParameters kRelocalization;

}  // namespace lio
