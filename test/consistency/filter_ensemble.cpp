// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "consistency/filter_ensemble.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <limits>
#include <random>

#include "support/motion.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio::test {
namespace {

constexpr double kImuStep_s = 0.01;
constexpr int kImuPerScan = 10;
constexpr double kRest_s = 1.0;
constexpr double kNoGate = std::numeric_limits<double>::infinity();
constexpr double kStartStd[] = {0.01, 0.004, 0.02, 5e-4, 0.05};  // one value per block of three

// Holds what is the same for every run: the samples of a perfect IMU, and its motion.
struct Drive {
  std::vector<ImuSample> samples;
  std::vector<MotionState> states;

  explicit Drive(double duration_s) {
    const Motion motion = WindingDrive(kRest_s);
    samples = ExactSamples(motion, 0.0, duration_s, kImuStep_s);
    states.reserve(samples.size());
    for (const ImuSample& sample : samples) {
      states.push_back(StateOf(motion, SecondsOf(sample.stamp)));
    }
  }
};

ErrorMatrix StartCov() {
  ErrorMatrix cov = ErrorMatrix::Zero();
  for (int i = 0; i < kMapPose; ++i) cov(i, i) = kStartStd[i / 3] * kStartStd[i / 3];
  return cov;
}

// Holds one run: the truth, and the filter that follows it.
class Run {
 public:
  Run(const EnsembleOptions& options, const Drive& drive, std::uint64_t seed)
      : options_(options), drive_(drive), random_(seed) {
    told_imu_.gyro_density = options.told_imu_ratio * options.imu.gyro_density;
    told_imu_.accel_density = options.told_imu_ratio * options.imu.accel_density;
    told_imu_.gyro_bias_walk_density = options.told_imu_ratio * options.imu.gyro_bias_walk_density;
    told_imu_.accel_bias_walk_density =
        options.told_imu_ratio * options.imu.accel_bias_walk_density;
    Vector6 variance;
    variance << Vector3::Constant(options.position_std_m * options.position_std_m),
        Vector3::Constant(options.rotation_std_rad * options.rotation_std_rad);
    registration_cov_ = variance.asDiagonal();
    Start();
  }

  template <class Take>  // take(time, truth, filter, whitened innovation)
  void Go(const Take& take) {
    for (std::size_t k = 1; k < drive_.samples.size(); ++k) {
      const Pose motion = drive_.states[k - 1].T_world_imu.Inverse() * drive_.states[k].T_world_imu;
      TakeTruthFrom(k);
      truth_.T_map_imu = truth_.T_map_imu * motion;
      const ImuSample sample = Read(k);
      Propagate(filter_, last_, sample, told_imu_, kGravity);
      filter_.stamp = sample.stamp;
      last_ = sample;
      if (k % kImuPerScan != 0) continue;
      const Vector6 innovation = Fuse();
      take(kImuStep_s * static_cast<double>(k), truth_, filter_, innovation);
    }
  }

 private:
  void Start() {
    TakeTruthFrom(0);
    truth_.gyro_bias = 1e-3 * RandomVector<3>(random_);
    truth_.accel_bias = 0.05 * RandomVector<3>(random_);
    filter_.cov = StartCov();
    filter_.stamp = drive_.samples[0].stamp;
    // The truth is filter (+) error, so the filter begins at the truth (+) an error of the opposite
    // sign.
    using MovingCov = Eigen::Matrix<double, kMapStart, kMapStart>;
    ErrorVector error = ErrorVector::Zero();
    error.head<kMapStart>() =
        DrawFrom<kMapStart>(MovingCov(filter_.cov.topLeftCorner<kMapStart, kMapStart>()), random_);
    filter_.state = BoxPlus(truth_, error);
    filter_.state.T_map_imu = filter_.state.T_world_imu;
    truth_.T_map_imu = filter_.state.T_map_imu;
    if (options_.belief == Belief::kAbsolute) BelieveAbsolute();
    last_ = Read(0);
  }

  // Makes the pose in the map identical to the pose in the world, so that measuring one is
  // measuring the other.
  void BelieveAbsolute() {
    truth_.T_map_imu = truth_.T_world_imu;
    Eigen::Matrix<double, kStateDim, kStateDim> tie = ErrorMatrix::Identity();
    tie.block<6, 6>(kMapPose, kMapPose).setZero();
    const Matrix3 R = filter_.state.T_world_imu.rotation.toRotationMatrix();
    tie.block<3, 3>(kMapPose, kPos) = R.transpose();
    tie.block<3, 3>(kMapPose + 3, kRot) = Matrix3::Identity();
    filter_.cov = (tie * filter_.cov * tie.transpose()).eval();
  }

  void TakeTruthFrom(std::size_t k) {
    truth_.T_world_imu = drive_.states[k].T_world_imu;
    truth_.v_world_imu = drive_.states[k].v_world_imu;
    if (k == 0) return;
    const double step = std::sqrt(kImuStep_s);
    truth_.gyro_bias += step * options_.imu.gyro_bias_walk_density * RandomVector<3>(random_);
    truth_.accel_bias += step * options_.imu.accel_bias_walk_density * RandomVector<3>(random_);
  }

  ImuSample Read(std::size_t k) {
    const double per_sample = 1.0 / std::sqrt(kImuStep_s);
    ImuSample sample = drive_.samples[k];
    sample.w_imu_radps +=
        truth_.gyro_bias + per_sample * options_.imu.gyro_density * RandomVector<3>(random_);
    sample.f_imu_mps2 +=
        truth_.accel_bias + per_sample * options_.imu.accel_density * RandomVector<3>(random_);
    return sample;
  }

  Vector6 DrawNoise(double variance_ratio) {
    const Vector6 std = (variance_ratio * registration_cov_.diagonal()).cwiseSqrt();
    return std.cwiseProduct(RandomVector<6>(random_));
  }

  Vector6 Fuse() {
    const bool is_coupled = options_.map != Map::kFixed;
    PoseMeasurement measurement;
    measurement.T_map_imu = truth_.T_map_imu * ExpSe3(DrawNoise(1.0));
    const double told = options_.told_registration_ratio;
    measurement.cov = told * told * registration_cov_;
    const Vector6 residual = LogSe3(filter_.state.T_map_imu.Inverse() * measurement.T_map_imu);
    const Matrix6 S = filter_.cov.block<6, 6>(kMapPose, kMapPose) + measurement.cov;
    const Vector6 whitened = S.llt().matrixL().solve(residual);
    (void)FusePose(filter_, measurement, kNoGate);
    if (is_coupled) CoupleMap();
    if (is_coupled && options_.belief == Belief::kMapPose) BelieveCoupling(measurement);
    return whitened;
  }

  // Moves the true map as inserting the scan at the filter's own pose does.
  void CoupleMap() {
    const Vector6 walk = DrawNoise(options_.phi * options_.q);
    const Pose inserted = filter_.state.T_map_imu;
    const Vector6 mu = LogSe3(inserted.Inverse() * truth_.T_map_imu);
    truth_.T_map_imu = options_.map == Map::kGrown
                           ? inserted * ExpSe3((1.0 - options_.phi) * mu + walk)
                           : truth_.T_map_imu * ExpSe3(walk);
  }

  void BelieveCoupling(PoseMeasurement& measurement) {
    if (options_.map == Map::kGrown) {
      measurement.new_content_share = options_.phi;
      measurement.blend_cov = options_.q * measurement.cov;
    } else {  // it drifts likewise, with almost no content of the map replaced
      constexpr double kLittle = 1e-9;
      measurement.new_content_share = kLittle;
      measurement.blend_cov = options_.phi * options_.q / kLittle * measurement.cov;
    }
    BlendMapPose(filter_, measurement);
  }

  const EnsembleOptions& options_;
  const Drive& drive_;
  std::mt19937_64 random_;
  ProcessNoise told_imu_;
  Matrix6 registration_cov_;
  NavState truth_;
  Estimate filter_;
  ImuSample last_;
};

// Collects the results of the runs.
struct Tally {
  std::vector<std::vector<TimedValues>> nees{Blocks().size()};
  std::vector<std::vector<double>> in_sigmas{Blocks().size()};
  std::vector<TimedValues> nis;
  std::vector<TimedValues> innovations;  // six per run

  void BeginRun() {
    for (auto& runs : nees) runs.emplace_back();
    nis.emplace_back();
    innovations.resize(innovations.size() + 6);
  }
  void Add(double time_s, const NavState& truth, const Estimate& filter, const Vector6& whitened) {
    const ErrorVector error = BoxMinus(truth, filter.state);
    for (std::size_t b = 0; b < Blocks().size(); ++b) {
      const Block& block = Blocks()[b];
      const Eigen::MatrixXd cov =
          filter.cov.block(block.begin, block.begin, block.size, block.size);
      const Eigen::VectorXd part = error.segment(block.begin, block.size);
      nees[b].back().push_back({time_s, NormalisedSquare(part, cov)});
      for (int i = 0; i < block.size; ++i) {
        in_sigmas[b].push_back(part(i) / std::sqrt(cov(i, i)));
      }
    }
    nis.back().push_back({time_s, whitened.squaredNorm()});
    for (int i = 0; i < 6; ++i) {
      innovations[innovations.size() - 6 + static_cast<std::size_t>(i)].push_back(
          {time_s, whitened(i)});
    }
  }
};

}  // namespace

const std::vector<Block>& Blocks() {
  static const std::vector<Block> blocks = {{"position", kPos, 3},
                                            {"rotation", kRot, 3},
                                            {"velocity", kVel, 3},
                                            {"gyro bias", kGyroBias, 3},
                                            {"accel bias", kAccelBias, 3}};
  return blocks;
}

EnsembleResult RunEnsemble(const EnsembleOptions& options) {
  const Drive drive(options.duration_s);
  Tally tally;
  for (int i = 0; i < options.num_runs; ++i) {
    tally.BeginRun();
    Run run(options, drive, 1000 * options.seed + static_cast<std::uint64_t>(i));
    run.Go([&](double time_s, const NavState& truth, const Estimate& filter,
               const Vector6& whitened) { tally.Add(time_s, truth, filter, whitened); });
  }
  EnsembleResult result;
  for (std::size_t b = 0; b < Blocks().size(); ++b) {
    result.blocks.push_back(MakeBandedSeries(tally.nees[b], Blocks()[b].size));
    result.shares.push_back(SharesWithin(tally.in_sigmas[b]));
  }
  result.nis = MakeBandedSeries(tally.nis, 6);
  result.whiteness = ComputeWhiteness(tally.innovations, 0.0);
  return result;
}

std::string Table(const EnsembleResult& result) {
  std::string text = "  block        NEES/dof  in band    1, 2, 3 sigma\n";
  for (std::size_t b = 0; b < Blocks().size(); ++b) {
    const SigmaShares& s = result.shares[b];
    text += fmt::format("  {:<10} {:>10.4g} {:>7.0f} %   {:.3f} {:.3f} {:.3f}\n", Blocks()[b].name,
                        result.blocks[b].average_per_dof, 100.0 * result.blocks[b].share_in_band,
                        s[0], s[1], s[2]);
  }
  return text +
         fmt::format("  {:<10} {:>10.4g} {:>7.0f} %   lag 1 {:+.3f}, {:.0f} % of 20 lags white\n",
                     "NIS", result.nis.average_per_dof, 100.0 * result.nis.share_in_band,
                     result.whiteness.autocorrelation.front(),
                     100.0 * result.whiteness.share_in_band);
}

}  // namespace lio::test
