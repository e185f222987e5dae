// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/imu_simulator.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "lio/imu/imu_convention.hpp"
#include "lio/sim/scenario.hpp"

namespace lio::sim {
namespace {

constexpr double kLocalGravity_mps2 = 9.788;

Trajectory StillTilted() {
  MotionPlan plan;
  plan.knots.resize(4);
  plan.T_body_imu.rotation = ExpSo3({0.2, -0.1, 0.5});
  return Trajectory(plan);
}

ImuSetup SetupOf(const std::string& model, double rate_hz) {
  ImuSetup setup;
  setup.model = LoadImuModel(model);
  setup.model.rate_hz = rate_hz;
  setup.gravity_mps2 = kLocalGravity_mps2;
  setup.seed = 3;
  return setup;
}

std::vector<SimulatedImu> Samples(const ImuSetup& setup, const Trajectory& trajectory,
                                  double seconds) {
  ImuSimulator imu(setup, trajectory);
  std::vector<SimulatedImu> samples;
  const auto num = static_cast<std::int64_t>(seconds * setup.model.rate_hz);
  for (std::int64_t k = 0; k <= num; ++k) {
    samples.push_back(imu.Sample(std::llround(1e9 * static_cast<double>(k) / setup.model.rate_hz)));
  }
  return samples;
}

struct State {
  Vector3 position;
  Vector3 velocity;
  Quaternion rotation;
};

// Holds the derivative of a state by time, with the rotation as quaternion coefficients (x y z w).
struct Slope {
  Vector3 position;
  Vector3 velocity;
  Eigen::Vector4d rotation;
};

Slope SlopeOf(const State& s, const ImuSample& imu) {
  const Quaternion w(0.0, imu.w_imu_radps.x(), imu.w_imu_radps.y(), imu.w_imu_radps.z());
  return {s.velocity, s.rotation.normalized() * imu.f_imu_mps2 - Vector3(0, 0, kLocalGravity_mps2),
          0.5 * (s.rotation * w).coeffs()};
}

State Advance(const State& s, const Slope& slope, double dt) {
  return {s.position + dt * slope.position, s.velocity + dt * slope.velocity,
          Quaternion(Eigen::Vector4d(s.rotation.coeffs() + dt * slope.rotation))};
}

// Makes a step of the classic fourth-order Runge-Kutta method over two sample intervals; the middle
// sample serves as the midpoint.
State Step(const State& s, const ImuSample& begin, const ImuSample& middle, const ImuSample& end) {
  const double h = SecondsBetween(begin.stamp, end.stamp);
  const Slope a = SlopeOf(s, begin);
  const Slope b = SlopeOf(Advance(s, a, 0.5 * h), middle);
  const Slope c = SlopeOf(Advance(s, b, 0.5 * h), middle);
  const Slope d = SlopeOf(Advance(s, c, h), end);
  const Slope mean = {(a.position + 2 * b.position + 2 * c.position + d.position) / 6,
                      (a.velocity + 2 * b.velocity + 2 * c.velocity + d.velocity) / 6,
                      (a.rotation + 2 * b.rotation + 2 * c.rotation + d.rotation) / 6};
  State next = Advance(s, mean, h);
  next.rotation.normalize();
  return next;
}

struct Drift {
  double position_m = 0.0;
  double rotation_deg = 0.0;
};

// Returns the largest distance from the truth while integrating from the true start.
Drift StrapdownDrift(const std::vector<SimulatedImu>& samples) {
  const Kinematics& start = samples.front().truth;
  State state{start.T_world_imu.translation, start.v_world_mps, start.T_world_imu.rotation};
  Drift drift;
  for (std::size_t k = 0; k + 2 < samples.size(); k += 2) {
    state = Step(state, samples[k].sample, samples[k + 1].sample, samples[k + 2].sample);
    const Pose& truth = samples[k + 2].truth.T_world_imu;
    drift.position_m = std::max(drift.position_m, (state.position - truth.translation).norm());
    drift.rotation_deg =
        std::max(drift.rotation_deg,
                 state.rotation.angularDistance(truth.rotation) * 180.0 / std::numbers::pi);
  }
  return drift;
}

struct RatedScenario {
  const char* scenario;
  double rate_hz;
};

class Strapdown : public ::testing::TestWithParam<RatedScenario> {};

TEST_P(Strapdown, OfTheIdealImuStaysWithinACentimetreAndAHundredthOfADegreeAfterAMinute) {
  ScenarioOptions options;
  options.duration_s = 60.0;
  const Scenario scenario = MakeScenario(GetParam().scenario, options);
  const Drift drift =
      StrapdownDrift(Samples(SetupOf("ideal", GetParam().rate_hz), *scenario.trajectory, 60.0));
  RecordProperty("drift_um", static_cast<int>(1e6 * drift.position_m));
  EXPECT_LT(drift.position_m, 0.01);
  EXPECT_LT(drift.rotation_deg, 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    Scenarios, Strapdown,
    ::testing::Values(RatedScenario{"street", 200.0}, RatedScenario{"street", 1000.0},
                      RatedScenario{"tunnel", 200.0}, RatedScenario{"garage", 1000.0},
                      RatedScenario{"campus", 1000.0}, RatedScenario{"hall", 1000.0},
                      RatedScenario{"office", 1000.0}),
    [](const auto& test) {
      return std::string(test.param.scenario) + "_" +
             std::to_string(static_cast<int>(test.param.rate_hz)) + "_hz";
    });

TEST(ImuSimulator, AtRestReadsGravityUpwardAndNoRate) {
  const Trajectory trajectory = StillTilted();
  const SimulatedImu imu = Samples(SetupOf("ideal", 200.0), trajectory, 0.1).back();
  const Vector3 up = imu.truth.T_world_imu.rotation.conjugate() * Vector3(0, 0, kLocalGravity_mps2);
  EXPECT_LT((imu.sample.f_imu_mps2 - up).norm(), 1e-9);
  EXPECT_LT(imu.sample.w_imu_radps.norm(), 1e-12);
}

TEST(ImuSimulator, VariantsRemoveGravityOrReadInG) {
  const Trajectory trajectory = StillTilted();
  ImuSetup setup = SetupOf("ideal", 200.0);
  setup.variant = ImuVariant::kGravityRemoved;
  EXPECT_LT(Samples(setup, trajectory, 0.1).back().sample.f_imu_mps2.norm(), 1e-9);
  setup.variant = ImuVariant::kInG;
  EXPECT_NEAR(Samples(setup, trajectory, 0.1).back().sample.f_imu_mps2.norm(),
              kLocalGravity_mps2 / 9.80665, 1e-9);
}

TEST(ImuSimulator, VariantsAreWhatTheEstimatorReadsThemAs) {
  const Scenario scenario = MakeScenario("campus", {1, 10.0, true});
  const auto last = [&](ImuVariant variant) {
    ImuSetup setup = SetupOf("ideal", 200.0);
    setup.variant = variant;
    return Samples(setup, *scenario.trajectory, 0.5).back().sample;
  };
  const Matrix3 z_down = Vector3(1, -1, -1).asDiagonal();
  const Matrix3 turned = (Matrix3() << 0, 1, 0, -1, 0, 0, 0, 0, 1).finished();
  const struct {
    ImuVariant variant;
    ImuConvention reading;
  } cases[] = {{ImuVariant::kInG, {true, false}},
               {ImuVariant::kInDeg, {false, true}},
               {ImuVariant::kInGAndDeg, {true, true}},
               {ImuVariant::kZDown, {false, false, z_down}},
               {ImuVariant::kTurned, {false, false, turned}}};
  const ImuSample normal = last(ImuVariant::kNormal);
  for (const auto& [variant, reading] : cases) {
    const ImuSample read = ToSi(reading, last(variant));
    EXPECT_LT((read.w_imu_radps - normal.w_imu_radps).norm(), 1e-9) << Describe(reading);
    EXPECT_LT((read.f_imu_mps2 - normal.f_imu_mps2).norm(), 1e-9) << Describe(reading);
  }
}

// The Allan deviation of white noise over tau is density / sqrt(tau), whatever the rate.
double AllanDeviation(const std::vector<double>& values, std::size_t num_averaged) {
  std::vector<double> means;
  for (std::size_t i = 0; i + num_averaged <= values.size(); i += num_averaged) {
    double sum = 0.0;
    for (std::size_t k = 0; k < num_averaged; ++k) sum += values[i + k];
    means.push_back(sum / static_cast<double>(num_averaged));
  }
  double sum_sq = 0.0;
  for (std::size_t i = 1; i < means.size(); ++i) {
    sum_sq += (means[i] - means[i - 1]) * (means[i] - means[i - 1]);
  }
  return std::sqrt(0.5 * sum_sq / static_cast<double>(means.size() - 1));
}

void KeepWhiteNoiseOnly(InertialModel& model) {
  const double density = model.noise_density;
  model = {};
  model.noise_density = density;
}

TEST(ImuSimulator, PresetsHaveTheirNoiseDensityAtAnyRateByAllanDeviation) {
  const Trajectory trajectory = StillTilted();
  const Vector3 gravity =
      trajectory.At(0.0).T_world_imu.rotation.conjugate() * Vector3(0, 0, kLocalGravity_mps2);
  for (const char* preset : {"xsens_mti10", "consumer_mems"}) {
    for (const double rate_hz : {100.0, 1000.0}) {
      ImuSetup setup = SetupOf(preset, rate_hz);
      const double gyro_density = setup.model.gyro.noise_density;
      const double accel_density = setup.model.accel.noise_density;
      ASSERT_GT(gyro_density, 0.0);
      KeepWhiteNoiseOnly(setup.model.gyro);
      KeepWhiteNoiseOnly(setup.model.accel);
      std::vector<double> gyro, accel;
      for (const SimulatedImu& imu : Samples(setup, trajectory, 100.0)) {
        gyro.push_back(imu.sample.w_imu_radps.x());
        accel.push_back(imu.sample.f_imu_mps2.y() - gravity.y());
      }
      for (const double tau_s : {1.0 / rate_hz, 0.1, 1.0}) {
        const auto num = static_cast<std::size_t>(std::lround(tau_s * rate_hz));
        // The tolerance is three standard errors of N differences.
        const double tolerance = 3.0 * std::sqrt(0.75 * tau_s / 100.0);
        const double to_density = std::sqrt(tau_s);
        EXPECT_NEAR(AllanDeviation(gyro, num) * to_density / gyro_density, 1.0, tolerance)
            << preset << " at " << rate_hz << " Hz, tau " << tau_s;
        EXPECT_NEAR(AllanDeviation(accel, num) * to_density / accel_density, 1.0, tolerance)
            << preset << " at " << rate_hz << " Hz, tau " << tau_s;
      }
    }
  }
}

TEST(ImuSimulator, BiasesWalkWithTheirDensityFromTheTurnOnBias) {
  const Trajectory trajectory = StillTilted();
  double walk_sq = 0.0;
  double turn_on_sq = 0.0;
  constexpr int kRuns = 60;
  constexpr double kSeconds = 20.0;
  for (int run = 0; run < kRuns; ++run) {
    ImuSetup setup = SetupOf("consumer_mems", 100.0);
    setup.model.gyro.bias_instability = 0.0;
    setup.seed = static_cast<std::uint64_t>(run);
    const auto samples = Samples(setup, trajectory, kSeconds);
    const Vector3 first = samples.front().gyro_bias_radps;
    turn_on_sq += first.squaredNorm() / 3.0;
    walk_sq += (samples.back().gyro_bias_radps - first).squaredNorm() / 3.0;
  }
  const InertialModel model = LoadImuModel("consumer_mems").gyro;
  const double tolerance = 3.0 / std::sqrt(2.0 * 3.0 * kRuns);
  EXPECT_NEAR(std::sqrt(turn_on_sq / kRuns) / model.turn_on_bias_std, 1.0, tolerance);
  EXPECT_NEAR(std::sqrt(walk_sq / kRuns) / (model.bias_walk_density * std::sqrt(kSeconds)), 1.0,
              tolerance);
}

TEST(ImuSimulator, BiasInstabilityKeepsItsSpreadAndForgetsInItsTime) {
  const Trajectory trajectory = StillTilted();
  double product = 0.0;
  double start_sq = 0.0;
  double end_sq = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    ImuSetup setup = SetupOf("ideal", 100.0);
    setup.model.accel.bias_instability = 0.01;
    setup.model.accel.bias_instability_time_s = 5.0;
    setup.seed = static_cast<std::uint64_t>(run);
    const auto samples = Samples(setup, trajectory, 5.0);
    product += samples.front().accel_bias_mps2.dot(samples.back().accel_bias_mps2);
    start_sq += samples.front().accel_bias_mps2.squaredNorm();
    end_sq += samples.back().accel_bias_mps2.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(start_sq / (3.0 * kRuns)), 0.01, 0.001);
  EXPECT_NEAR(std::sqrt(end_sq / (3.0 * kRuns)), 0.01, 0.001);
  EXPECT_NEAR(product / std::sqrt(start_sq * end_sq), std::exp(-1.0), 0.12);
}

TEST(ImuSimulator, SaturatesAndQuantises) {
  const Trajectory trajectory = StillTilted();
  ImuSetup setup = SetupOf("ideal", 200.0);
  setup.model.accel.full_scale = 5.0;
  setup.model.accel.step = 0.25;
  for (const SimulatedImu& imu : Samples(setup, trajectory, 0.1)) {
    for (const double axis : imu.sample.f_imu_mps2) {
      EXPECT_LE(std::abs(axis), 5.0);
      EXPECT_EQ(axis, 0.25 * std::round(axis / 0.25));
    }
  }
}

TEST(ImuSimulator, ScaleAndMisalignmentActOnTheTruth) {
  const Trajectory trajectory = StillTilted();
  ImuSetup setup = SetupOf("ideal", 200.0);
  setup.model.accel.scale_std_ratio = 0.01;
  setup.model.accel.misalignment_std_rad = 0.01;
  const auto samples = Samples(setup, trajectory, 0.1);
  const Vector3 truth =
      samples[0].truth.T_world_imu.rotation.conjugate() * Vector3(0, 0, kLocalGravity_mps2);
  const double error = (samples[0].sample.f_imu_mps2 - truth).norm();
  EXPECT_GT(error, 0.01);
  EXPECT_LT(error, 0.6);
  EXPECT_EQ(samples[0].sample.f_imu_mps2, samples[5].sample.f_imu_mps2);  // constant
}

TEST(NormalGravity, AgreesWithKnownPlaces) {
  const double degrees = std::numbers::pi / 180.0;
  EXPECT_NEAR(NormalGravity(0.0, 0.0), 9.780325, 1e-5);
  EXPECT_NEAR(NormalGravity(45.0 * degrees, 0.0), 9.806199, 1e-5);
  EXPECT_NEAR(NormalGravity(90.0 * degrees, 0.0), 9.832185, 1e-5);
  EXPECT_NEAR(NormalGravity(22.3 * degrees, 0.0), 9.788, 5e-4);
  EXPECT_NEAR(NormalGravity(0.0, 1000.0), 9.780325 - 0.003086, 1e-5);
}

}  // namespace
}  // namespace lio::sim
