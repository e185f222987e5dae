// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the maps' constants that are no configuration keys: units, meaning and where each value
// comes from. They are compile-time constants, so that inner loops cost nothing for them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lio {

// A cell of GaussianMap counts as a plane or as a vertical structure only when its points show one.
struct GaussianMapParameters {
  // A plane's variance along its normal is at most this share of that along its narrower tangent.
  // Chosen: 3 cm of noise on the narrowest plane have 0.06, the crown of a bush 1.
  static constexpr double kMaxThicknessRatio = 0.1;
  // A lidar whose ranges have more noise than this standard deviation [m] makes planes thicker by
  // the difference of the variances. Data sheets of spinning lidars say 0.02 to 0.03.
  static constexpr double kUsualRangeStd_m = 0.03;
  // ... but not beyond this share. Chosen: a third of a blob's.
  static constexpr double kMaxNoisyThicknessRatio = 0.35;
  // A plane's standard deviation along its narrower tangent is at least this share of the voxel's
  // edge. Chosen: a single ring is a few centimetres wide, and a cell that is evenly filled has
  // 0.29.
  static constexpr double kMinWidthPerVoxel = 0.12;
  // A plane's normal may err by this standard deviation [rad]. Chosen: half a cell of 1 m off its
  // middle the plane is 2.5 cm unsure, less than the floor of its thickness.
  static constexpr double kMaxNormalStd_rad = 0.05;
  // A vertical structure's standard deviation along the vertical is at least this share of the
  // voxel's edge: half of an evenly filled cell's. It is used in
  // docs/experiments/vertical_structures.md; chosen.
  static constexpr double kMinHeightPerVoxel = 0.15;
  // A post's larger horizontal standard deviation over the voxel's edge, at most: a wider one is
  // cut off by the cell's sides. It is used in the same experiment; chosen.
  static constexpr double kMaxVerticalWidthPerVoxel = 0.2;
  // A post's standard deviation along the vertical over its larger horizontal one, at least. A blob
  // has 1, a post of 0.3 m that ends in a cell of 1 m 1.5. Measured, as are 2 and 1:
  // docs/experiments/vertical_structures.md.
  static constexpr double kMinVerticalSlenderness = 1.5;
  // A vertical structure's horizontal standard deviation counts as this at least [m]. Chosen: the
  // side from which a trunk is seen moves its mean by about that much.
  static constexpr double kMinVerticalStd_m = 0.06;
  // A vertical structure that is no post is a clump of leaves if it has so many points. Measured
  // against 8 and against no clumps: docs/experiments/vertical_structures.md.
  static constexpr int kMinClumpPoints = 15;
  // A vertical structure whose mean lies so near to the plane of a cell beside it [m] is a part of
  // it. Arithmetic: over 1 m a tunnel's wall of 5 m radius bends by as much.
  static constexpr float kMaxOffWall_m = 0.1f;
  // A plane stands if its normal and the horizontal form at most the angle of this sine. Chosen: 45
  // deg.
  static constexpr float kMaxWallSine = 0.7f;
  // The points that the last scan brought lie this far [m] off those before at most, along any
  // level direction, besides so many standard deviations of the two means' difference. Chosen: a
  // thing looks different from each side by a few centimetres, and one that walks is 0.1 m farther
  // on in the next scan; 99.7 % of a normal distribution.
  static constexpr double kMaxShift_m = 0.1;
  static constexpr double kShift_sigmas = 3.0;
  // A plane whose points lie across it within this standard deviation [m], besides the noise of
  // their ranges, is smooth. Chosen: poses and beams err by some millimetres; grass and clods have
  // 0.02 and more.
  static constexpr double kEvenStd_m = 0.01;
  // So many points a cell remembers that shows no surface yet, so that the rings of a stop do not
  // hide what is seen while driving off. Measured against 2000: docs/experiments/narrow_places.md.
  static constexpr int kUnknownMemory_points = 100;
  // The mean view of a saved map's cell, whose points have views of one or zero, is at least so
  // long if the cell has one side. Chosen: half of the points.
  static constexpr float kMinView = 0.5f;
  // A point whose side nobody knows is on a saved map's plane within so many standard deviations of
  // the plane's thickness. Statistics: 99.7 % of a plane's points are.
  static constexpr float kOnPlane_sigmas = 3.f;
  // The sides of a saved map's surfaces are sorted by up and this share of a level direction, which
  // tells the sides of a wall. Chosen: small beside up, so that floors that lean are still sorted
  // by up.
  static constexpr double kLevelShare = 0.2;
  // A cell's patch is computed anew when its points have grown by this factor: the covariance of a
  // filled cell changes little with each point. Chosen.
  static constexpr double kRefitGrowth = 1.3;
  // So many points ahead, memory is asked for before it is needed. Chosen: some hundred
  // nanoseconds of work; no effect on results.
  static constexpr std::size_t kPrefetchDistance = 16;
  // The search for cells beyond the map's range passes over all cells in this many scans. Chosen:
  // it spreads the cost, and cells stay a few seconds longer than they must.
  static constexpr std::size_t kFarCellsWalk_scans = 64;
  // One point in so many has its ray followed, and for so many voxels. Chosen for the time that it
  // takes: docs/experiments/passed_cells.md. A prime, so that a scan's rays are of all its beams.
  static constexpr std::size_t kRaySampling = 127;
  static constexpr int kMaxRay_voxels = 40;
  // So many rays pass through the middle of a surface until it is gone. Chosen: one of them may be
  // wrong.
  static constexpr int kMinPasses = 2;
  // The cosine of the angle between a ray and the normal is at least so large where a ray passes
  // through a surface. Chosen: at 73 deg and more a small error of the pose moves the ray to the
  // other side of it.
  static constexpr float kMinPassCosine = 0.3f;
};

// Bounds the levels, each with cells of half the size.
struct MultiResolutionParameters {
  // Cells of the finer levels are dropped when farther away than this many of their edges.
  // Arithmetic: the beams of spinning lidars are 0.35 deg and more apart, 0.7 of an edge there, and
  // a cell has one ring at most.
  static constexpr double kMaxDistance_edges = 120.0;
  // A level serves a guess that may be off by this share of its cells' edge, one standard
  // deviation. Chosen: most points then lie in their own cell.
  static constexpr double kMaxOff_edges = 0.25;
};

// Bounds the angle between a surface and the beams that saw it:
// docs/experiments/grazing_incidence.md.
struct GrazingIncidenceParameters {
  // This is the sine of the least angle, 3.4 deg. Measured, as are 0.045 to 0.09, which give the
  // same results: docs/experiments/grazing_incidence.md.
  static constexpr float kMinSine = 0.06f;
};

// Tells how fast the mean over scans follows (low_mean.hpp).
struct LowMeanParameters {
  // A new scan has this share in the mean. Chosen: ten scans; views change within a second.
  static constexpr double kRate = 0.1;
};

// Tells when a place is narrow (place_width.hpp).
struct PlaceWidthParameters {
  // A place becomes narrow where the mean scan lies in fewer of the map's largest cells than the
  // first, and wide again where it lies in more than the second. Measured: walks in offices lie in
  // 27 to 31 cells of 1 m with views of 70 to 120 deg and in about 100 all around; a mine in 350, a
  // street in 1400 (docs/experiments/narrow_views.md).
  static constexpr double kNarrowBelow = 150.0;
  static constexpr double kWideAbove = 220.0;
  // More cells than this count as so many, and scans of fewer points tell nothing. Chosen: it is
  // far above both limits, and counting costs little in a wide place.
  static constexpr std::size_t kMaxCounted = 500;
};

// Tells when a map of small cells has too few surfaces for a scan: beams that are far apart leave
// most small cells with a single ring, which shows none, so that larger cells must help.
struct SparseSupportParameters {
  // The support becomes sparse where the mean scan has a smaller share of its points on surfaces
  // than the first, and dense again where it has more than the second. Measured:
  // docs/experiments/large_cells.md.
  static constexpr double kSparseBelow = 0.2;
  static constexpr double kDenseAbove = 0.3;
};

// Tells the two sheets of slabs and walls apart in a cloud without viewpoints.
struct SurfaceSidesParameters {
  // Neighbours of a point count up to there [m]. Chosen: floors of buildings are 0.2 to 0.4 m
  // thick.
  static constexpr float kRadius_m = 0.5f;
  // Points nearer to each other than this count once [m]. Chosen: less than kOwnSheet_m, so that
  // sheets stay apart; the neighbours of a point are then 300 a sheet at most.
  static constexpr float kSpacing_m = 0.05f;
  // Points nearer to a sheet than this lie on it [m]. Chosen: three times the range noise of 2 cm;
  // partition walls are 0.1 m thick and more.
  static constexpr float kOwnSheet_m = 0.07f;
  // The other sheet's standard deviation across itself is at most this [m]. Chosen: twice the range
  // noise; furniture spreads wider.
  static constexpr float kMaxSheetStd_m = 0.05f;
  // Nothing joins the sheets if so small a share of points is nearer than the gap [m]. Chosen: the
  // thinnest floors are thicker, and a fifth of a wall that stands on a floor is nearer.
  static constexpr float kGap_m = 0.15f;
  static constexpr float kMaxShareInGap = 0.08f;
  // A side holds when this share of a voxel's points has it. Chosen: half of them are of the other
  // sheet, and those at beams and edges have none.
  static constexpr double kMinShare = 0.2;
  // The other sheet needs so many points. Chosen: three define a plane, and one more tests it.
  static constexpr int kMinPoints = 4;
};

struct KeyframeMapParameters {
  // Factor on height differences where keyframes are ranked by distance, so that the storeys above
  // and below do not take places in the submap. Chosen: a storey counts as 10 m.
  static constexpr double kHeightFactor = 3.0;
  // A search goes this far at most [voxels]. Arithmetic: 4 m with the voxel of 0.5 m, twice the
  // largest standard deviation that a search allows for (CorrespondenceParameters::kMaxStd_m).
  static constexpr int kMaxSearch_voxels = 8;
};

struct PointMapParameters {
  // A search goes this far at most [voxels]. Arithmetic: 4.8 m with the leaf of 0.4 m, more than
  // twice the largest standard deviation that a search allows for
  // (CorrespondenceParameters::kMaxStd_m).
  static constexpr int kMaxSearch_voxels = 12;
};

}  // namespace lio
