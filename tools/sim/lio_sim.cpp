// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-sim simulates a drive through a synthetic world and writes the log of its sensors and the
// truth.
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>
#include <numbers>
#include <stdexcept>

#include "lio/io/command_line.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/input_guard.hpp"
#include "lio/io/program.hpp"
#include "lio/io/progress_bar.hpp"
#include "lio/sim/data_file.hpp"
#include "lio/sim/picture.hpp"
#include "lio/sim/realism.hpp"
#include "lio/sim/recorder.hpp"

namespace {

using namespace lio;

struct Arguments {
  std::string scenario;
  std::optional<double> duration_s;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> sensor_seed;
  std::string lidar;
  std::string imu;
  std::optional<double> imu_rate_hz;
  sim::ImuVariant imu_variant = sim::ImuVariant::kNormal;
  double latitude_deg = 22.3;  // Hong Kong
  double altitude_m = 0.0;
  sim::Realism realism = sim::Realism::kField;
  sim::EffectChoice effects;
  std::vector<std::string> faults;
  std::string scans;
  bool starts_moving = false;
  std::optional<sim::Carrier> carrier;
  bool lists = false;
  int num_threads = 1;
  std::string folder;
  std::string picture;
};

std::string ScenarioTable() {
  std::string table = "Scenarios:\n";
  for (const sim::ScenarioEntry& entry : sim::AllScenarios()) {
    table += "  " + entry.name +
             std::string(10 - std::min<std::size_t>(9, entry.name.size()), ' ') + entry.summary +
             "\n";
  }
  return table;
}

std::string Footer() {
  return ScenarioTable() +
         "\nFaults with their defaults; start and duration are seconds of the log:\n" +
         sim::DescribeFaults() + R"(
Writes log.lcm (LIO_IMU, LIO_SCAN), truth.tum (pose of the IMU, at its rate), truth_states.csv
(velocity, biases, rates) and config.yaml, which lio-replay and liod read with --config.

Examples:
  lio-sim --scenario street --out out/street
  lio-replay --config out/street/config.yaml out/street/log.lcm --out out/street/run
  lio-sim --scenario street --fault imu_gap:start=20,duration=1 --fault dust --out out/faulty
  lio-sim --scenario loop --lidar vlp16 --imu consumer_mems --seed 7 --out out/loop

Exit codes: 0 done, 2 usage, 3 data files of a sensor, 74 a file or stdout could not be written in
full.
)";
}

void AddErrors(CLI::App& app, Arguments& arguments) {
  const std::map<std::string, sim::Realism> grades = {{"ideal", sim::Realism::kIdeal},
                                                      {"datasheet", sim::Realism::kDatasheet},
                                                      {"field", sim::Realism::kField}};
  app.add_option("--realism", arguments.realism,
                 "errors of the sensors: ideal (none), datasheet (as data sheets state them),\n"
                 "field (and those a sensor has on a vehicle)")
      ->transform(CLI::CheckedTransformer(grades).description(""))
      ->default_str("field")
      ->type_name("NAME");
  app.add_option("--without", arguments.effects.without,
                 "effect of the field that is left out; can be given several times: " +
                     CLI::detail::join(sim::FieldEffects(), ", "))
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--with", arguments.effects.with,
                 "effect of the field that is added to a lower grade; can be given several times")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--fault", arguments.faults,
                 "fault to simulate, as KIND:KEY=VALUE,...; can be given several times; see below")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void AddCarrier(CLI::App& app, Arguments& arguments) {
  const std::map<std::string, sim::Carrier> carriers = {{"person", sim::Carrier::kPerson},
                                                        {"robot", sim::Carrier::kRobot},
                                                        {"drone", sim::Carrier::kDrone}};
  app.add_option("--carrier", arguments.carrier,
                 "who carries the sensors through mine, warehouse and hedgerows:\n"
                 "person, robot, drone")
      ->transform(CLI::CheckedTransformer(carriers).description(""))
      ->type_name("NAME");
}

void AddArguments(CLI::App& app, Arguments& arguments) {
  const std::map<std::string, sim::ImuVariant> variants = {
      {"normal", sim::ImuVariant::kNormal},
      {"gravity-removed", sim::ImuVariant::kGravityRemoved},
      {"in-g", sim::ImuVariant::kInG},
      {"in-deg", sim::ImuVariant::kInDeg},
      {"in-g-and-deg", sim::ImuVariant::kInGAndDeg},
      {"z-down", sim::ImuVariant::kZDown},
      {"turned", sim::ImuVariant::kTurned}};
  app.add_flag("--list", arguments.lists, "print the scenarios' names, one per line");
  app.add_option("--scenario", arguments.scenario,
                 "place and drive to simulate; see the list below");
  app.add_option("--out", arguments.folder, "folder to write into; it is created if missing");
  app.add_option(
      "--picture", arguments.picture,
      "draw the place from above and the path into this PPM file; works alone or with --out");
  app.add_option("--duration", arguments.duration_s, "length of the log [s], and of the place");
  app.add_option("--seed", arguments.seed, "seed of the world and of the noise")
      ->check(WholeNumberFromZero())
      ->capture_default_str();
  app.add_option("--sensor-seed", arguments.sensor_seed,
                 "seed of the sensors' errors alone: another recording of the same drive")
      ->check(WholeNumberFromZero());
  app.add_option("--lidar", arguments.lidar,
                 "lidar model: hdl32e, vlp16, hdl64e, os1_64, rosette70 or a file like theirs\n"
                 "(default: hdl32e, in office, mine, warehouse and hedgerows vlp16)");
  app.add_option("--imu", arguments.imu,
                 "IMU model: xsens_mti10, consumer_mems, ideal or a data file like theirs\n"
                 "(default: xsens_mti10)");
  app.add_option("--imu-rate", arguments.imu_rate_hz, "sample rate of the IMU [Hz]")
      ->check(NumberWithin(100.0, 1000.0));
  app.add_option("--imu-variant", arguments.imu_variant,
                 "units and axes of the IMU's samples: normal, gravity-removed, in-g, in-deg,\n"
                 "in-g-and-deg, z-down (forward, right, down), turned (right, forward, up)")
      ->transform(CLI::CheckedTransformer(variants).description(""))
      ->type_name("NAME");
  app.add_option("--latitude", arguments.latitude_deg,
                 "latitude of the place, which sets gravity [deg]")
      ->capture_default_str()
      ->check(NumberWithin(-90.0, 90.0));
  app.add_option("--altitude", arguments.altitude_m,
                 "altitude of the place, which sets gravity [m]")
      ->check(NumberWithin(-1000.0, 20000.0))
      ->capture_default_str();
  app.add_option(
         "--scans", arguments.scans,
         "log of the same drive and lidar, without errors of the clocks, whose scans are\n"
         "taken instead of casting them: only the IMU, clocks and faults are simulated anew")
      ->check(CLI::ExistingFile);
  app.add_flag("--moving-start", arguments.starts_moving,
               "begin the log in motion instead of at rest");
  AddCarrier(app, arguments);
  AddErrors(app, arguments);
  app.add_option("--threads", arguments.num_threads,
                 "number of threads, at most as many as the machine has; the files do not\n"
                 "depend on it")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  app.footer(Footer());
}

sim::RecordOptions MakeOptions(const Arguments& arguments, const sim::Scenario& scenario) {
  sim::RecordOptions options;
  options.lidar =
      sim::LoadLidarModel(arguments.lidar.empty() ? scenario.lidar_model : arguments.lidar);
  options.imu = sim::LoadImuModel(arguments.imu.empty() ? scenario.imu_model : arguments.imu);
  if (arguments.imu_rate_hz) options.imu.rate_hz = *arguments.imu_rate_hz;
  options.imu_variant = arguments.imu_variant;
  options.gravity_mps2 =
      sim::NormalGravity(arguments.latitude_deg * std::numbers::pi / 180.0, arguments.altitude_m);
  for (const std::string& fault : arguments.faults) {
    options.faults.push_back(sim::ParseFault(fault));
  }
  sim::SetRealism(arguments.realism, arguments.effects, options);
  options.scans = arguments.scans;
  options.seed = arguments.sensor_seed.value_or(arguments.seed);
  options.num_threads = std::min(arguments.num_threads, tbb::info::default_concurrency());
  return options;
}

// Holds the wall-clock time and the CPU time of all threads that the recording took [s].
struct Spent {
  double wall_s = 0.0;
  double cpu_s = 0.0;
};

void PrintStats(const sim::Scenario& scenario, const sim::RecordOptions& options,
                const sim::RecordStats& stats, const Spent& spent) {
  const double mega_rays = 1e-6 * static_cast<double>(stats.num_rays);
  std::printf("%s: %.1f s, %lld sweeps of %s, %.1f M rays, %.1f M points, %lld IMU samples\n",
              scenario.name.c_str(), scenario.duration_s, static_cast<long long>(stats.num_sweeps),
              options.lidar.name.c_str(), mega_rays, 1e-6 * static_cast<double>(stats.num_points),
              static_cast<long long>(stats.num_imu));
  const double per_cent = 100.0 / static_cast<double>(std::max<std::int64_t>(1, stats.num_points));
  std::printf(
      "%.2f %% of the points lie between two surfaces (mixed pixels), %.2f %% are mirrored,\n"
      "%.2f %% lie behind glass\n",
      per_cent * static_cast<double>(stats.num_in_between),
      per_cent * static_cast<double>(stats.num_mirrored),
      per_cent * static_cast<double>(stats.num_through_glass));
  std::printf(
      "%.1f s on %d thread%s, %.1f times real time: %.2f M rays/s, %.2f in a second of CPU\n",
      spent.wall_s, options.num_threads, options.num_threads == 1 ? "" : "s",
      scenario.duration_s / spent.wall_s, mega_rays / spent.wall_s, mega_rays / spent.cpu_s);
}

int Fail(const std::string& message, int code) {
  std::cerr << "lio-sim: " << message << "\n";
  return code;
}

// Writes the picture and the log as asked. Throws when a file cannot be written.
void Write(const Arguments& arguments, const sim::Scenario& scenario,
           const sim::RecordOptions& options) {
  using Clock = std::chrono::steady_clock;
  if (!arguments.picture.empty()) {
    sim::WritePpm(sim::DrawFromAbove(scenario, {}, options.num_threads), arguments.picture);
  }
  if (arguments.folder.empty()) return;
  const auto start = Clock::now();
  const std::clock_t cpu_start = std::clock();
  sim::RecordStats stats;
  {
    constexpr std::int64_t kSteps = 1000;
    ProgressBar bar("simulate", kSteps);
    stats = sim::Record(scenario, options, arguments.folder, [&](double share) {
      bar.Update(static_cast<std::int64_t>(share * kSteps));
    });
  }
  PrintStats(scenario, options, stats,
             {std::chrono::duration<double>(Clock::now() - start).count(),
              static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC});
}

void GuardInputs(const Arguments& arguments) {
  Paths outputs;
  if (!arguments.folder.empty()) outputs = sim::FilesOf(arguments.folder);
  outputs.emplace_back(arguments.picture);
  RefuseToOverwrite({arguments.scans, arguments.lidar, arguments.imu}, outputs);
}

int Run(const Arguments& arguments) {
  std::optional<sim::Scenario> scenario;
  sim::RecordOptions options;
  try {
    scenario = sim::MakeScenario(arguments.scenario, {arguments.seed, arguments.duration_s,
                                                      arguments.starts_moving, arguments.carrier});
    options = MakeOptions(arguments, *scenario);
  } catch (const std::invalid_argument& error) {
    return Fail(error.what(), kExitUsage);
  } catch (const OutputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    return Fail(error.what(), kExitConfiguration);
  }
  try {
    Write(arguments, *scenario, options);
  } catch (const std::filesystem::filesystem_error& error) {
    return Fail("cannot create " + error.path1().string() + ": " + error.code().message(),
                kExitUsage);
  } catch (const WriteError&) {
    throw;
  } catch (const std::exception& error) {
    return Fail(error.what(), kExitUsage);
  }
  return kExitDone;
}

int Main(int argc, char** argv) {
  CLI::App app{"Simulates a lidar and an IMU on a drive through a synthetic world.", "lio-sim"};
  Arguments arguments;
  AddArguments(app, arguments);
  if (const auto code = ParseCommandLine(app, argc, argv, LIO_VERSION)) return *code;
  if (arguments.lists) {
    for (const sim::ScenarioEntry& entry : sim::AllScenarios()) std::cout << entry.name << "\n";
    return kExitDone;
  }
  if (arguments.scenario.empty())
    return Fail("--scenario is required; --list prints the scenarios", kExitUsage);
  if (arguments.folder.empty() && arguments.picture.empty())
    return Fail("--out is required; it names the folder to write into", kExitUsage);
  GuardInputs(arguments);
  return Run(arguments);
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram("lio-sim", [&] { return Main(argc, argv); });
}
