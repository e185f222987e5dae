// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/scan_assembler.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/motion.hpp"
#include "support/property.hpp"

namespace lio {
namespace {

using test::StampAt;

constexpr int kChunks = 4;
constexpr double kChunkSpan_s = 0.025;
constexpr double kSweepSpan_s = kChunks * kChunkSpan_s;

// Returns chunk `index` of sweep `seq`: three points over its span, numbered through the sweep by
// x.
ScanChunk MakeChunk(int seq, int index) {
  ScanChunk chunk;
  chunk.stamp = StampAt(seq * kSweepSpan_s + index * kChunkSpan_s);
  chunk.scan_seq = seq;
  chunk.chunk_index = static_cast<std::int16_t>(index);
  chunk.chunk_count = kChunks;
  for (int i = 0; i < 3; ++i) {
    LidarPoint point;
    point.x_m = static_cast<float>(3 * index + i);
    point.t_offset_ns = static_cast<std::uint32_t>(i) * 12'000'000u;
    chunk.points.push_back(point);
  }
  return chunk;
}

std::vector<ScanChunk> MakeSweep(int seq) {
  std::vector<ScanChunk> chunks;
  for (int i = 0; i < kChunks; ++i) chunks.push_back(MakeChunk(seq, i));
  return chunks;
}

struct Assembly {
  Counters counters;
  ScanAssembler assembler{counters};

  void Add(const ScanChunk& chunk) { assembler.Add(chunk, 7); }
  std::vector<Sweep> TakeAll() {
    std::vector<Sweep> sweeps;
    while (std::optional<Sweep> sweep = assembler.Take()) sweeps.push_back(std::move(*sweep));
    return sweeps;
  }
};

// The points of all chunks are there, in the order of the chunks, at their own instants.
void ExpectWhole(const Sweep& sweep, int seq) {
  EXPECT_EQ(sweep.scan_seq, seq);
  EXPECT_EQ(sweep.num_missing_chunks, 0);
  EXPECT_EQ(sweep.start, MakeChunk(seq, 0).stamp);
  EXPECT_EQ(sweep.end, MakeChunk(seq, kChunks - 1).stamp + Duration{24'000'000});
  ASSERT_EQ(sweep.points.size(), 3u * kChunks);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    EXPECT_EQ(sweep.points[i].x_m, static_cast<float>(i));
    const auto offset_ns = static_cast<std::uint32_t>(25'000'000 * (i / 3) + 12'000'000 * (i % 3));
    EXPECT_EQ(sweep.points[i].t_offset_ns, offset_ns);
  }
}

TEST(ScanAssembler, SweepClosesWithItsLastChunk) {
  Assembly a;
  for (int i = 0; i < kChunks - 1; ++i) a.Add(MakeChunk(0, i));
  EXPECT_FALSE(a.assembler.Take().has_value());
  a.Add(MakeChunk(0, kChunks - 1));
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 1u);
  ExpectWhole(sweeps[0], 0);
  EXPECT_EQ(sweeps[0].decode_ns, 7 * kChunks);
  EXPECT_EQ(a.counters.num_chunks, kChunks);
}

TEST(ScanAssembler, SweepOfOneChunkPassesAsItIs) {
  Assembly a;
  ScanChunk chunk = MakeChunk(0, 0);
  chunk.chunk_count = 1;
  a.Add(chunk);
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 1u);
  EXPECT_EQ(sweeps[0].start, chunk.stamp);
  EXPECT_EQ(sweeps[0].end, chunk.stamp + Duration{24'000'000});
  EXPECT_EQ(sweeps[0].points.size(), 3u);
}

// Chunks of two neighbouring sweeps come in any order: both sweeps are complete, in the order of
// time.
TEST(ScanAssembler, OrderAmongTwoSweepsIsFree) {
  test::CheckProperty([] {
    std::vector<ScanChunk> chunks = MakeSweep(3);
    for (const ScanChunk& chunk : MakeSweep(4)) chunks.push_back(chunk);
    for (std::size_t i = chunks.size() - 1; i > 0; --i) {
      std::swap(chunks[i], chunks[*rc::gen::inRange<std::size_t>(0, i + 1)]);
    }
    Assembly a;
    for (const ScanChunk& chunk : chunks) a.Add(chunk);
    const std::vector<Sweep> sweeps = a.TakeAll();
    RC_ASSERT(sweeps.size() == 2u);
    RC_ASSERT(a.counters.num_chunks_missing == 0);
    RC_ASSERT(a.counters.num_chunks_late == 0);
    ExpectWhole(sweeps[0], 3);
    ExpectWhole(sweeps[1], 4);
  });
}

TEST(ScanAssembler, MissingChunkMakesASmallerCountedSweep) {
  Assembly a;
  for (const int index : {0, 1, 3}) a.Add(MakeChunk(0, index));
  for (const ScanChunk& chunk : MakeSweep(1)) a.Add(chunk);
  EXPECT_FALSE(a.assembler.Take().has_value()) << "the missing chunk may still come";
  a.Add(MakeChunk(2, 0));  // begins the sweep after the next one
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 2u);
  EXPECT_EQ(sweeps[0].num_missing_chunks, 1);
  EXPECT_EQ(sweeps[0].points.size(), 9u);
  ExpectWhole(sweeps[1], 1);
  EXPECT_EQ(a.counters.num_chunks_missing, 1);
}

TEST(ScanAssembler, SweepTellsHowMuchOfItsTurnWasOverBeforeItsFirstChunk) {
  Assembly a;
  for (const int index : {1, 3}) a.Add(MakeChunk(0, index));
  for (const int seq : {1, 2}) a.Add(MakeChunk(seq, seq == 1 ? 3 : 0));
  a.assembler.CloseAll();
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 3u);
  EXPECT_EQ(sweeps[0].share_before, 0.25);
  EXPECT_EQ(sweeps[1].share_before, 0.75);
  EXPECT_EQ(sweeps[2].share_before, 0.0);
}

TEST(ScanAssembler, TimeClosesAnIncompleteSweep) {
  Assembly a;
  for (const int index : {0, 1}) a.Add(MakeChunk(0, index));
  const Timestamp last = MakeChunk(0, 1).stamp + Duration{24'000'000};
  a.assembler.CloseUpTo(last);
  EXPECT_FALSE(a.assembler.Take().has_value());
  a.assembler.CloseUpTo(last + Duration{1});
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 1u);
  EXPECT_EQ(sweeps[0].num_missing_chunks, 2);
  EXPECT_EQ(sweeps[0].end, last);
}

// Once the length of a sweep is known, its end is, too: chunks that are still to come are waited
// for, however few and long they are.
TEST(ScanAssembler, SweepThatIsStillComingInIsNotClosed) {
  Assembly a;
  for (const ScanChunk& chunk : MakeSweep(0)) a.Add(chunk);
  a.Add(MakeChunk(1, 0));
  const Timestamp end = MakeChunk(1, kChunks - 1).stamp + Duration{24'000'000};
  a.assembler.CloseUpTo(end);
  EXPECT_EQ(a.TakeAll().size(), 1u);
  a.assembler.CloseUpTo(end + Duration{1});
  EXPECT_EQ(a.TakeAll().size(), 1u);
}

TEST(ScanAssembler, MissingFirstChunkMovesTheStart) {
  Assembly a;
  for (const int index : {2, 3}) a.Add(MakeChunk(0, index));
  a.assembler.CloseAll();
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 1u);
  EXPECT_EQ(sweeps[0].start, MakeChunk(0, 2).stamp);
  EXPECT_EQ(sweeps[0].points[0].t_offset_ns, 0u);
  EXPECT_EQ(sweeps[0].points[3].t_offset_ns, 25'000'000u);
}

TEST(ScanAssembler, DuplicateChunksAreCountedAndIgnored) {
  Assembly a;
  for (const ScanChunk& chunk : MakeSweep(0)) {
    a.Add(chunk);
    if (chunk.chunk_index < kChunks - 1) a.Add(chunk);
  }
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 1u);
  ExpectWhole(sweeps[0], 0);
  EXPECT_EQ(a.counters.num_chunks_duplicate, kChunks - 1);
}

TEST(ScanAssembler, ChunkOfASweepThatIsClosedIsLate) {
  Assembly a;
  for (const int index : {0, 1, 3}) a.Add(MakeChunk(0, index));
  a.assembler.CloseAll();
  a.Add(MakeChunk(0, 2));
  a.assembler.CloseAll();
  EXPECT_EQ(a.TakeAll().size(), 1u);
  EXPECT_EQ(a.counters.num_chunks_late, 1);
}

TEST(ScanAssembler, ChunkOfAnOlderClosedSweepIsLateToo) {
  Assembly a;
  for (const int index : {0, 1, 3}) a.Add(MakeChunk(0, index));
  a.assembler.CloseAll();
  for (const ScanChunk& chunk : MakeSweep(1)) a.Add(chunk);
  a.Add(MakeChunk(2, 0));
  a.Add(MakeChunk(0, 2));  // two sweeps too late, while the third is coming in
  for (int i = 1; i < kChunks; ++i) a.Add(MakeChunk(2, i));
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 3u) << "a straggler must not hold up the sweep that is complete";
  ExpectWhole(sweeps[2], 2);
  EXPECT_EQ(a.counters.num_chunks_late, 1);
}

TEST(ScanAssembler, InconsistentChunksAreCountedAndDropped) {
  Assembly a;
  std::vector<ScanChunk> bad(5, MakeChunk(0, 0));
  bad[0].chunk_index = kChunks;
  bad[1].chunk_index = -1;
  bad[2].chunk_count = 0;
  bad[3].chunk_count = -5;
  bad[4].points[1].t_offset_ns = 600'000'000;  // half a second and more in one sweep
  for (const ScanChunk& chunk : bad) a.Add(chunk);
  a.assembler.CloseAll();
  EXPECT_TRUE(a.TakeAll().empty());
  EXPECT_EQ(a.counters.num_chunks_bad, 5);
}

// Sweeps of four chunks, a chunk of somebody else's in the midst of one, and the rest: all sweeps
// are whole and nothing is missing.
TEST(ScanAssembler, OneHostileChunkClosesNoSweepAndMakesNoLoss) {
  for (const int count : {2, 9, 64, 300, 1024, 32'767}) {
    for (const int seq : {2, 3, 40'000, -7}) {
      Assembly a;
      for (const ScanChunk& chunk : MakeSweep(0)) a.Add(chunk);
      for (const int index : {0, 1, 2}) a.Add(MakeChunk(1, index));
      ScanChunk hostile = MakeChunk(2, 0);
      hostile.scan_seq = seq;
      hostile.chunk_count = static_cast<std::int16_t>(count);
      hostile.chunk_index = static_cast<std::int16_t>(count - 1);
      hostile.sensor_id = 5;
      a.Add(hostile);
      a.Add(MakeChunk(1, 3));
      a.assembler.CloseAll();
      const bool is_plausible = count == 2 && seq < 100;
      EXPECT_EQ(a.counters.num_chunks_missing, is_plausible ? 1 : 0) << count << " " << seq;
      EXPECT_EQ(a.counters.num_chunks_bad, count > 256 ? 1 : 0) << count << " " << seq;
      const std::vector<Sweep> sweeps = a.TakeAll();
      ASSERT_GE(sweeps.size(), 2u);
      ExpectWhole(sweeps[1], 1);
    }
  }
}

TEST(ScanAssembler, AFalseCountBetweenTwoOpenSweepsClosesNeither) {
  Assembly a;
  for (const ScanChunk& chunk : MakeSweep(0)) a.Add(chunk);
  for (const int index : {0, 1, 3}) a.Add(MakeChunk(1, index));
  a.Add(MakeChunk(2, 0));
  ScanChunk hostile = MakeChunk(3, 0);
  hostile.chunk_count = 32'767;
  a.Add(hostile);
  a.Add(MakeChunk(1, 2));
  for (const int index : {1, 2, 3}) a.Add(MakeChunk(2, index));
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 3u);
  for (int seq = 0; seq < 3; ++seq) ExpectWhole(sweeps[static_cast<std::size_t>(seq)], seq);
  EXPECT_EQ(a.counters.num_chunks_missing, 0);
}

TEST(ScanAssembler, AHostileChunkThatComesFirstMakesNoLoss) {
  for (const int count : {300, 5000, 32'767}) {
    Assembly a;
    ScanChunk hostile = MakeChunk(0, 0);
    hostile.scan_seq = 77;
    hostile.chunk_count = static_cast<std::int16_t>(count);
    a.Add(hostile);
    for (const int seq : {1, 2}) {
      for (const ScanChunk& chunk : MakeSweep(seq)) a.Add(chunk);
    }
    a.assembler.CloseAll();
    EXPECT_EQ(a.counters.num_chunks_missing, 0) << count;
  }
}

TEST(ScanAssembler, ALidarThatBeginsToSendMoreChunksIsBelievedAfterOne) {
  Assembly a;
  for (const ScanChunk& chunk : MakeSweep(0)) a.Add(chunk);
  for (const int seq : {1, 2, 3}) {
    for (int i = 0; i < 600; ++i) {
      ScanChunk chunk = MakeChunk(seq, 0);
      chunk.chunk_index = static_cast<std::int16_t>(i);
      chunk.chunk_count = 600;
      a.Add(chunk);
    }
    a.assembler.CloseAll();
  }
  EXPECT_EQ(a.counters.num_chunks_bad, 1) << "the first one has no other to bear it out";
  EXPECT_EQ(a.counters.num_chunks_missing, 1);
  EXPECT_EQ(a.TakeAll().size(), 4u);
}

TEST(ScanAssembler, ChunkThatDisagreesOnTheCountIsNotMixedIn) {
  Assembly a;
  a.Add(MakeChunk(0, 0));
  ScanChunk other = MakeChunk(0, 1);
  other.chunk_count = kChunks + 1;
  a.Add(other);
  a.assembler.CloseAll();
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 1u);
  EXPECT_EQ(sweeps[0].points.size(), 3u);
}

// The sender restarts and counts from zero again: the number is the same, the time another.
TEST(ScanAssembler, ChunkThatAStepOfTheClockTearsOffIsDropped) {
  for (const double step_s : {-0.3, 0.25, 0.4}) {
    Assembly assembly;
    for (const ScanChunk& chunk : MakeSweep(1)) assembly.Add(chunk);
    for (int i = 0; i < 3; ++i) assembly.Add(MakeChunk(2, i));
    ScanChunk torn = MakeChunk(2, 3);
    torn.stamp = torn.stamp + Duration::FromSeconds(step_s);
    assembly.Add(torn);
    assembly.assembler.CloseAll();
    const std::vector<Sweep> sweeps = assembly.TakeAll();
    ASSERT_EQ(sweeps.size(), 2u);
    EXPECT_EQ(sweeps[1].num_missing_chunks, 1);
    EXPECT_EQ(sweeps[1].end, MakeChunk(2, 2).stamp + Duration{24'000'000});
    EXPECT_EQ(assembly.counters.num_chunks_bad, 1);
  }
}

TEST(ScanAssembler, SameNumberMuchLaterIsAnotherSweep) {
  Assembly a;
  for (const int index : {0, 1}) a.Add(MakeChunk(0, index));
  for (ScanChunk chunk : MakeSweep(0)) {
    chunk.stamp = chunk.stamp + Duration::FromSeconds(60.0);
    a.Add(chunk);
  }
  a.assembler.CloseAll();
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 2u);
  EXPECT_EQ(sweeps[0].points.size(), 6u);
  EXPECT_EQ(sweeps[1].points.size(), 12u);
}

// All but the first chunk of sweep 7 are stamped 3 s too early; other sweeps follow.
ScanChunk SetBack(ScanChunk chunk) {
  chunk.stamp = chunk.stamp - Duration{3'000'000'000};
  return chunk;
}

TEST(ScanAssembler, SweepCutByAJumpBackDoesNotStayOpen) {
  Assembly a;
  a.Add(MakeChunk(7, 0));
  for (int i = 1; i < kChunks; ++i) a.Add(SetBack(MakeChunk(7, i)));
  EXPECT_TRUE(a.TakeAll().empty());
  a.Add(SetBack(MakeChunk(8, 0)));
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 1u);
  EXPECT_EQ(sweeps[0].start, MakeChunk(7, 0).stamp);
  EXPECT_EQ(sweeps[0].num_missing_chunks, kChunks - 1);
}

TEST(ScanAssembler, SegmentThatIsOverIsClosedAndNothingElse) {
  Assembly a;
  a.Add(MakeChunk(7, 0));
  a.Add(SetBack(MakeChunk(7, 1)));
  a.assembler.CloseSegment(MakeChunk(7, 1).stamp, SetBack(MakeChunk(7, 1)).stamp);
  ASSERT_EQ(a.TakeAll().size(), 1u);
  a.assembler.CloseAll();
  const std::vector<Sweep> rest = a.TakeAll();
  ASSERT_EQ(rest.size(), 1u);
  EXPECT_EQ(rest[0].start, SetBack(MakeChunk(7, 1)).stamp);
}

TEST(ScanAssembler, SweepOfEmptyChunksIsAnEmptySweep) {
  Assembly a;
  for (ScanChunk chunk : MakeSweep(0)) {
    chunk.points.clear();
    a.Add(chunk);
  }
  const std::vector<Sweep> sweeps = a.TakeAll();
  ASSERT_EQ(sweeps.size(), 1u);
  EXPECT_TRUE(sweeps[0].points.empty());
}

TEST(ScanAssembler, ASweepIsBoundedByItsPoints) {
  Assembly a;
  for (int i = 0; i < 10; ++i) {
    ScanChunk chunk = MakeChunk(0, 0);
    chunk.chunk_index = static_cast<std::int16_t>(i);
    chunk.chunk_count = 10;
    chunk.points.assign(1 << 20, {});
    a.Add(chunk);
  }
  EXPECT_EQ(a.counters.num_chunks_bad, 6);
  a.assembler.CloseAll();
  EXPECT_EQ(a.TakeAll().at(0).points.size(), std::size_t{4 << 20});
}

}  // namespace
}  // namespace lio
