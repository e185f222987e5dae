// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the constants of registration that are no configuration keys: units, meaning and where each
// value comes from ("chosen" where no experiment tells). They are compile-time constants, so that
// inner loops cost nothing for them.
#pragma once

#include <array>
#include <cstddef>

#include "lio/map/map_parameters.hpp"

namespace lio {

// Bounds how far from its predicted place a point may have its counterpart on the map, by the
// covariance of the guess.
struct CorrespondenceParameters {
  // Rotations and translations are compared at this range [m]: a rotation error moves a point by
  // its range times the angle. Chosen: between a room's ranges and a street's.
  static constexpr double kLever_m = 20.0;
  // The correspondence radius shrinks by this factor after each step of a match. Chosen: after
  // three steps 3 % are left; a smaller one leaves points behind that were not yet caught.
  static constexpr double kShrink = 0.3;
  // The standard deviation is at most this [m]. Chosen: beyond it most nearest neighbours are of
  // other surfaces.
  static constexpr double kMaxStd_m = 2.0;
  // A radius below this is taken as zero [m]. Chosen: a third of the floor of a surface's thickness
  // (NdtOptions::min_surface_std_m), to whose variance it adds a tenth.
  static constexpr double kSmallestStd_m = 0.01;
  // Searches go this many standard deviations far. Statistics: 99.7 % of a normal distribution.
  static constexpr double kSearchSigmas = 3.0;
};

// Tunes which directions of a pose count as observed by a match.
struct DegeneracyParameters {
  // A direction is observable when its information is this many times what the noise of the map's
  // normals alone induces. Measured: observable directions of streets have 40 times and more, the
  // axis of a corridor 0.05 to 1.6; 5 and 10 give the same results
  // (docs/experiments/covariance_of_a_match.md).
  static constexpr double kMinInformationRatio = 8.0;
  // This standard deviation is reported along degenerate directions [m, at the scale of
  // DirectionSplit]. Chosen: far above every prior of the filter, and not so far that matrices lose
  // digits.
  static constexpr double kDegenerateStd_m = 100.0;
  // The noise may be zero along a direction and gets this share of the information's trace there.
  // Chosen: above the rounding of doubles, 1e-16 of the trace.
  static constexpr double kRegularization = 1e-12;
};

// Geman-McClure's kernel, w = 1 / (1 + d^2 / width)^2, d in standard deviations.
struct RobustKernelParameters {
  // This is the kernel's width, squared. Chosen: the kernel's influence w d is largest at d = 1.63,
  // within which nine of ten normal errors lie.
  static constexpr float kWidthSq = 8.f;
  // A residual beyond five standard deviations, squared here, has no weight at all. Chosen: the
  // kernel would leave it 0.06.
  static constexpr float kMaxDistanceSq = 25.f;
};

// Holds the limits that every matcher has for its report.
struct MatchParameters {
  // Fewer matched points than these end a match. Chosen: six unknowns, with outliers among the
  // points.
  static constexpr int kMinMatched = 50;
  // The robust cost's curvature is at least this share of its information. Chosen: below it most
  // terms are outliers; it bounds how far they widen the covariance.
  static constexpr double kMinCurvatureRatio = 0.3;
  // The step that is left at the solution is taken when it is shorter than this [m and rad as one
  // norm]. Chosen: five times NDT's step that ends the iterations.
  static constexpr double kMaxLastStep = 5e-3;
  // A pose contradicts its guess where their distance is beyond what so many of a hundred have by
  // chance. Statistics.
  static constexpr double kAgreementProbability = 0.99;
  // A scan whose support at its guess is more than this share of that at its match has slid along
  // what it sees. Measured on simulated drives: .98 where a narrow view slid in an office, .89 and
  // less where a gyro was off (docs/experiments/dead_imu.md).
  static constexpr double kMaxSupportAtGuess = 0.95;
};

// Trunks, bushes and edges look different from each side, and some things that stand drive off.
struct WellConstrainedTranslationParameters {
  // If the translation since the last scan is known to this standard deviation [m], gicp leaves
  // them out, and ndt does so if the match contradicts its guess. Measured against always:
  // docs/experiments/vertical_structures.md.
  static constexpr double kMaxStd_m = 0.02;
  // If it is known to this [m], as at rest, ndt leaves them out, too: beams that meet them always
  // in the same columns hold back a body that creeps. Measured: without it a creep of 0.14 m
  // ends 15 mm short; known to 0.3 mm is enough there, but loses walks between hedges (the same
  // page).
  static constexpr double kAtRestStd_m = 0.001;
};

struct NdtParameters {
  // All points of a vertical structure share an error of this standard deviation [m], since the
  // visible part of a trunk depends on the side. Chosen: about half a trunk's width; used in
  // docs/experiments/vertical_structures.md.
  static constexpr double kSharedVerticalStd_m = 0.15;
  // In the weights of the points it counts as this [m]. Measured: with 0.15 a match that posts
  // alone hold along a road does not converge in 60 iterations; without it a match follows cars
  // that set off together with the vehicle (the same page).
  static constexpr double kSharedInWeightsStd_m = 0.08;
  // All points of a ring share errors of this standard deviation [m], which tilt a cell's plane
  // however many points it has. A laser's bias is 3 to 10 mm; fitted within that to scenes of the
  // tests: 3 mm takes a tunnel's axis for observed, 6 mm an open road's posts for noise.
  static constexpr float kAlikeStd_m = 0.005f;
  // Caps a^2 / l, a point's squared distance from a patch's mean over the patch's variance. Chosen:
  // two standard deviations off its middle a patch is extrapolated.
  static constexpr float kMaxLeverSq = 4.f;
  // The counts of points by cell hold while no point within CorrespondenceParameters::kLever_m has
  // moved farther [m]. Chosen: 5 % of a cell's edge; they set weights alone.
  static constexpr double kCountsHold_m = 0.05;
  // A cell that the last scan alone has made counts as if this share were of it: a match against a
  // map of one scan still tells something, with a covariance 20 times as large. Chosen.
  static constexpr float kMaxShareOfLastScan = 0.95f;
  // The map's axes are turned by this rotation [rad, rotation vector] and translation [m] against
  // the voxel grid's. Chosen: any odd ones do, so that no floor or wall lies on a voxel face, where
  // noise would split it.
  static constexpr std::array<double, 3> kGridRotation_rad{0.31, -0.23, 0.41};
  static constexpr std::array<double, 3> kGridTranslation_m{0.37, 0.41, 0.29};
};

struct GicpParameters {
  // A surface varies by this across its normal [m^2]: so far it is taken to extend. It counts
  // against a pair whose normals differ. Segal et al. (RSS 2009) take 1 here, too, and 0.001 along
  // the normal, in place of which we have the thickness.
  static constexpr float kTangentVar_m2 = 1.f;
  // A point without a normal has this variance added [m^2]. Chosen: it may lie on an edge, 0.2 m
  // off its neighbour's plane.
  static constexpr float kNoNormalVar_m2 = 0.04f;
  // Two normals of one surface have at least this cosine between them. Chosen: 45 deg, half way
  // between a wall and the next one.
  static constexpr float kMinCosine = 0.7f;
  // Neighbours are sought this far [m] beyond where the guess may be off, or this share of the
  // range where that is more. Chosen: the keyframes' points are so far apart, two beams of an
  // HDL-32E at long range.
  static constexpr double kMinSearch_m = 0.7;
  static constexpr double kSearchPerRange = 0.05;
  // Points of one voxel of this edge share the errors of the normals [m]. Chosen: the voxel over
  // which normals are fitted is 0.7 m.
  static constexpr double kClusterVoxel_m = 1.0;
  // The number of iterations grows by this factor where the guess may be far off. Chosen; a
  // lidar-only walk of 15 s had an APE of 88 cm without it and 7 cm with it.
  static constexpr int kFarOffIterationFactor = 3;
  // Neighbours are kept while no point within CorrespondenceParameters::kLever_m has moved farther
  // [m]. Chosen: a hundredth of the map's voxel.
  static constexpr double kKeepPairs_m = 5e-3;
  // The old value keeps this share when a scan's median range is smoothed. Chosen: ten scans, so
  // that one bus alongside makes no keyframes.
  static constexpr double kOpennessKeep = 0.9;
};

// Bounds the plane that is fitted around a scan's point, from the moments of 3 x 3 x 3 voxels.
struct ScanNormalParameters {
  // The 27 voxels need so many points together. Chosen: as NdtOptions::min_cell_points.
  static constexpr double kMinPoints = 6.0;
  // The variance along the normal is at most this share of that along the narrower tangent: as for
  // the cells of NDT.
  static constexpr double kMaxThicknessRatio = GaussianMapParameters::kMaxThicknessRatio;
  // The standard deviation along the narrower tangent is at least this share of the voxel's edge.
  // Chosen: a single ring is narrower, and three voxels evenly filled have 0.87.
  static constexpr double kMinWidthPerVoxel = 0.3;
  // The normal may err by this standard deviation. Chosen: twice that of NDT's cells, since a scan
  // has fewer points than the map.
  static constexpr double kMaxNormalStd_rad = 0.1;
  // A surface z = k x^2 / 2 seen over [-a, a] is a^2 / 3 wide and k^2 a^4 / 45 thick, both
  // variances; a distance o away it has bent by k o^2 / 2, whose square is this times thickness /
  // width^2 o^4. Arithmetic: 45 / (4 * 9).
  static constexpr double kBend = 1.25;
  // Points that are this many voxels from the next level's range count there, too. Arithmetic: the
  // neighbours of a point on the border, which lie in 3 x 3 x 3 voxels.
  static constexpr float kOverlap_voxels = 2.f;
  // There are so many levels of voxels, each twice as coarse as the one before. Arithmetic: with
  // 0.7 m and 0.03 rad up to 750 m.
  static constexpr std::size_t kNumLevels = 6;
};

struct LoamParameters {
  // A line between two points that are nearer to each other than this has no direction [m]. Chosen:
  // below the range noise.
  static constexpr double kMinLineLength_m = 0.01;
  // Scan to map. Neighbours are at most this many leaves off. Chosen: leaves are one apart.
  static constexpr double kLeavesPerSearch = 2.5;
  // Residuals beyond this [m] and what the guess may be off do not count. Chosen: three times
  // LoamOptions::huber_m.
  static constexpr double kGate_m = 0.3;
  // The number of rounds grows by this factor where the guess may be far off. Chosen; a lidar-only
  // walk of 15 s had an APE of 206 cm without it and 2.5 cm with it.
  static constexpr int kFarOffRoundFactor = 3;
  // Later rounds go half their step. Chosen: two sets of neighbours may alternate; half of
  // LoamOptions::max_rounds.
  static constexpr int kFullRounds = 4;
  // Points of a line or a plane spread at least this much over the map's leaf, as a standard
  // deviation. Chosen: less is a piece of one scan ring.
  static constexpr double kMinWidthPerLeaf = 0.3;
  // A plane's normal may err by this standard deviation [rad]: as a normal fitted in a scan may.
  static constexpr double kMaxNormalStd_rad = ScanNormalParameters::kMaxNormalStd_rad;
};

// Tunes scan-to-scan matching: A-LOAM's neighbours, and bounds that keep noise from tilting lines
// and planes.
struct LoamScanParameters {
  // Fewer matched features end a match. Chosen: a scan has fewer of them than of surface points
  // (MatchParameters::kMinMatched).
  static constexpr std::size_t kMinMatched = 30;
  // Neighbours on a scan are this far apart [m], or this share of the range where beams spread
  // more. Chosen: two beams, some 2 deg apart.
  static constexpr double kMinSearch_m = 1.0;
  static constexpr double kSearchPerRange = 0.06;
  static constexpr double kMaxSearch_m = 5.0;  // A-LOAM: DISTANCE_SQ_THRESHOLD of 25 m^2
  // The second point of a line or the third of a plane, on another ring, and a plane's second
  // point, on the same ring, are at least this far off [m]. Chosen: the range noise of 2 cm tilts
  // shorter ones by degrees.
  static constexpr float kMinAcross_m = 0.5f;
  static constexpr float kMinBaseline_m = 1.f;
  // The angle at the first of a plane's three points has at least this sine. Chosen: at less, 6
  // deg, they are nearly a line.
  static constexpr double kMinTriangle = 0.1;
  static constexpr int kMaxRingGap = 3;  // rings apart, at most; A-LOAM: NEARBY_SCAN of 2.5
  // Voxels of the search grid have this edge [m]: as long as the least search (kMinSearch_m).
  static constexpr float kGridVoxel_m = 1.f;
};

// Sets the prior standard deviations for the rate within a sweep, as used in
// docs/experiments/intra_sweep_rate.md.
struct IntraSweepRateParameters {
  // Chosen: the pose is where matching left it; they only keep directions that nothing holds.
  static constexpr double kPoseStd_m = 0.1;
  static constexpr double kPoseStd_rad = 0.02;
  // Chosen: no rate that a scan was deskewed by is off by more.
  static constexpr double kRateStd_radps = 0.5;
};

// Sets priors and limits of the beams' calibration.
struct BeamCalibrationParameters {
  // Standard deviations of the errors. Data sheets state a range accuracy of 2 to 3 cm (HDL-32E,
  // VLP-16, OS1) with noise and all, of which a laser's constant part is half or less; the beam
  // table has two digits, and angles are stated to 0.01 to 0.03 deg; an encoder is stated to 0.01
  // deg at most.
  static constexpr double kRangeStd_m = 0.01;
  static constexpr double kAngleStd_rad = 5e-4;
  static constexpr double kEncoderStd_rad = 1.2e-4;
  // Chosen: ranges at grazing incidence are a few millimetres times the term too long.
  static constexpr double kGrazingStd_m = 0.01;
  // The share of Roughness::HeightAt() by which rough ground looks higher. Theory: 0.3 to 0.6 for
  // Gaussian surfaces.
  static constexpr double kReliefStd = 0.5;
  // Errors that an earlier drive found have changed by so much since, with age and temperature:
  // each by itself, all of a kind together, and upper rings against lower ones.
  // Chosen: a fifth of what data sheets allow; no data sheet states it.
  static constexpr double kRangeAgeing_m = 2e-3;
  static constexpr double kAngleAgeing_rad = 1e-4;
  static constexpr double kEncoderAgeing_rad = 2e-5;
  // A cell counts if the beams of this share of its points are remembered: those of the points
  // before its plane was known are not. Chosen: fewer tell too little of the
  // beams that made its mean.
  static constexpr float kMinRemembered = 0.15f;
  // A map that bends has these deviations over a way of so many metres. Chosen: more than any that
  // was seen; they only keep directions that nothing holds.
  static constexpr float kDriftPath_m = 10.f;
  static constexpr double kMaxDriftVar_m2 = 1e-4;
  static constexpr double kMaxDriftVar_rad2 = 1e-6;
  // A scan counts with its share of new content times this. Measured: with one, errors were claimed
  // 1.4 times as large as they were (docs/experiments/beam_errors.md).
  static constexpr double kInformationPerShare = 2.0;
  // So many rows of a match, evenly spread, are enough, and fewer than so many are no match.
  // Chosen: a scan counts with a few percent of them anyway.
  static constexpr std::size_t kMaxRows = 500;
  static constexpr int kMinRows = 100;
  // Chosen: the map turns over in tens of scans.
  static constexpr int kSolvePeriod_scans = 10;
};

}  // namespace lio
