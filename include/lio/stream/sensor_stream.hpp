// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Turns raw messages, in the order in which they arrive, into events in the order in which the
// estimator must consume them. It is the only owner of inertial samples and chunks: it validates,
// buffers, assembles sweeps, holds them until inertial samples cover them, and judges gaps and
// steps of the clocks by stamps and by the order of arrival; it asks no wall clock.
//
//   stream.AddImu(sample);
//   while (auto event = stream.Next(num_unmatched)) Consume(*event);
//
// `num_unmatched` counts the sweeps that were given out and have not been matched. A step of the
// inertial clock waits until there are none, and what comes meanwhile waits behind it, so the
// events do not depend on how fast scans are matched. The consumer handles each event before it
// asks for the next one.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "lio/base/counters.hpp"
#include "lio/sensor/rig.hpp"
#include "lio/sensor/scan_chunk.hpp"
#include "lio/stream/clock_step_arbiter.hpp"
#include "lio/stream/imu_buffer.hpp"
#include "lio/stream/imu_preprocessor.hpp"
#include "lio/stream/lidar_clock_corrector.hpp"
#include "lio/stream/saturation_detector.hpp"
#include "lio/stream/scan_assembler.hpp"
#include "lio/stream/scan_gate.hpp"
#include "lio/stream/sender_watch.hpp"
#include "lio/stream/stamp_correction.hpp"
#include "lio/stream/stream_event.hpp"

namespace lio {

struct StreamOptions {
  bool use_imu = true;                      // as PipelineOptions
  ImuUnits units = ImuUnits::kAutomatic;    // as ImuRig
  std::optional<ImuConvention> convention;  // at first; absent: as the units say
  double lidar_clock_offset_s = 0.0;        // added to the lidar's stamps; as LidarRig
  // Sweeps are moved by the clock offset that matched ones show. The next sweep waits while so many
  // have not been matched; absent: no sweep is moved.
  std::optional<std::size_t> max_unmatched;
  // A sweep is closed when stamps are this far past its end; as PipelineOptions.
  double incomplete_sweep_wait_s = 0.05;
};

class SensorStream {
 public:
  // Counts into `counters`, which outlives this.
  SensorStream(const StreamOptions& options, Counters& counters);

  void AddImu(const ImuSample& sample);
  void AddChunk(ScanChunk chunk, std::int64_t decode_ns);
  // No more messages come: what is still open is closed.
  void Flush();
  // Nothing of this stream is wanted: messages are counted and dropped.
  void Reject();

  [[nodiscard]] std::optional<StreamEvent> Next(std::size_t num_unmatched);

  // Sweeps that have been matched show this offset; it moves those that are given out later.
  void SetStampCorrection(Duration correction) { corrections_.SetNewest(correction); }

  // The estimator can use sweeps from this time on; absent: from the first inertial sample on.
  void SetBegin(std::optional<Timestamp> begin) { begin_ = begin; }
  void SetConvention(const ImuConvention& convention) { imu_.SetConvention(convention); }

  const ImuBuffer& imu() const { return imu_; }
  bool has_imu() const { return has_imu_; }  // false: lidar-only
  // They are those of the stream and what it gave out, with all that waits here.
  [[nodiscard]] Ledgers ledgers() const;
  bool is_flushed() const { return life_ != Life::kOpen; }

 private:
  struct Message {
    ImuSample sample;
    std::optional<ScanChunk> chunk;  // absent: it is the sample
    std::int64_t decode_ns = 0;

    [[nodiscard]] std::size_t num_points() const { return chunk ? chunk->points.size() : 0; }
  };
  struct Inbox {
    std::deque<Message> messages;
    std::size_t num_points = 0;
    std::int64_t num_chunks = 0;

    void Put(Message message);
    [[nodiscard]] Message Take();
  };
  enum class State {
    kFlowing,
    kJudgingStep,     // the inertial clock stepped; did the lidar's as well?
    kWaitingForIdle,  // the step is judged; sweeps before it are being matched
    kLosingImu,       // likewise, before lidar-only odometry begins
  };

  enum class Life {
    kOpen,
    kFlushed,  // no more messages come
    kClosed,   // and all that was open is closed
    kRejected,
  };
  struct PendingStep {
    ImuPreprocessor::Result result;  // its samples come first once the step is judged
    std::size_t num_examined = 0;    // messages of inbox_, to judge the step by
    std::size_t num_points_examined = 0;
    Timestamp newest_examined;  // the newest inertial stamp since the step
  };

  // Holds the senders that are kept.
  struct Senders {
    struct Lidar {
      std::int8_t sensor_id = 0;
      Timestamp newest;  // the newest chunk's
    };
    SenderWatch imu;
    std::optional<Lidar> lidar;  // the one that came first
  };

  bool RefuseForeign(const ImuSample& sample);
  bool RefuseForeign(const ScanChunk& chunk);
  void Enqueue(Message message);
  bool Advance(bool is_idle);
  void Process(Message message);
  void ProcessImu(const ImuSample& sample);
  void ProcessChunk(ScanChunk chunk, std::int64_t decode_ns);
  void TakeChunks(std::vector<LidarClockCorrector::Arrival> arrivals);
  void TakeChunk(LidarClockCorrector::Arrival arrival);
  void NotifyLidarClockSet(const LidarClockCorrector::Step& step);
  void AcceptAll(const std::vector<ImuSample>& samples);
  void Accept(const ImuSample& sent);
  ImuSample MarkSaturated(ImuSample sent);
  void Emit(std::vector<ImuReady> ready);
  [[nodiscard]] std::size_t NumSweepsReady() const;  // among the events
  void ForgetLateImu();
  void Notify(Timestamp stamp, Notice::Severity severity, std::string text);

  // Sweeps: sensor_stream_sweeps.cpp.
  void CloseSweepsBefore(Timestamp stamp);
  void TakeClosedSweeps();
  void OpenGate();
  void Admit(std::shared_ptr<Sweep> sweep);
  void GiveOut(SweepPtr sweep);
  bool NotifyIfClocksApart(Timestamp imu, Timestamp lidar);
  void GoLidarOnly(const std::string& evidence);
  void LoseImu();
  void CloseAll();

  // Steps of the inertial clock are taken in sensor_stream_step.cpp.
  void TakeStep(ImuPreprocessor::Result step);
  ClockStep StampsOfStep() const;
  void JudgeBy(const Message& message);
  void ShiftImuClock(Timestamp after_by_lidar);
  void EndStep();
  void StartSegment();
  void TakeLateImu(const ImuSample& sample);

  StreamOptions options_;
  Counters* counters_;
  bool has_imu_;
  Life life_ = Life::kOpen;
  State state_ = State::kFlowing;
  Inbox inbox_;  // not processed yet
  std::deque<StreamEvent> events_;
  Senders senders_;
  ImuPreprocessor preprocessor_;
  SaturationDetector saturation_;
  ImuBuffer imu_;
  ClockStepArbiter arbiter_;
  LidarClockCorrector lidar_clock_;
  ScanAssembler assembler_;
  ScanGate gate_;
  StampCorrection corrections_;
  PendingStep step_;
  Duration imu_clock_shift_;         // offset of an inertial clock that stepped alone
  std::vector<ImuSample> late_imu_;  // the first ones, where the lidar has begun alone
  std::optional<Timestamp> begin_;
};

}  // namespace lio
