#include "ceres_ed/slam/checkpoint.h"

#include <ceres_ed/slam/frame/corner_store.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/slam.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <test/slam/bumpy_sequence.h>
#include <test/slam/slam_runs.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

struct Row {
  double number = 0.0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::array<std::uint8_t, 3> color = {};
  int pair[2] = {};
};

struct Everything {
  int whole = 0;
  double number = 0.0;
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  std::string text;
  std::vector<Row> rows;

  void Exchange(CheckpointArchive* archive) {
    archive->Value("whole", &whole);
    archive->Enter("group");
    archive->Value("number", &number);
    archive->Value("turn", &turn);
    archive->Text("text", &text);
    archive->Leave();
    archive->Column("number", &rows, [](Row& row) -> double& { return row.number; });
    archive->Column(
        "place", &rows, [](Row & row) -> auto& { return row.place; });
    archive->Column(
        "color", &rows, [](Row & row) -> auto& { return row.color; });
    archive->Column(
        "pair", &rows, [](Row & row) -> auto& { return row.pair; });
  }
};

Everything Example() {
  Everything e;
  e.whole = -7;
  e.number = 0.1;
  e.turn = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  e.text = "a path of no UTF-8: \xff\n";
  e.rows.resize(2);
  e.rows[1].number = 1.0 / 3.0;
  e.rows[1].place = {1.0, 2.0, 3.0};
  e.rows[1].color = {0, 128, 255};
  e.rows[1].pair[1] = 9;
  return e;
}

std::string Save(Everything e) {
  CheckpointWriter writer;
  e.Exchange(&writer);
  return writer.TakeBytes();
}

std::string OpenError(const std::string& bytes) {
  return CheckpointReader::Open(bytes).status().message();
}

TEST(Checkpoint, LoadsWhatWasSaved) {
  const auto reader = CheckpointReader::Open(Save(Example()));
  ASSERT_TRUE(reader.ok()) << reader.status().message();
  Everything e;
  e.rows.resize(2);
  e.Exchange(reader->get());
  ASSERT_TRUE((*reader)->status().ok()) << (*reader)->status().message();
  const Everything expected = Example();
  EXPECT_EQ(e.whole, expected.whole);
  EXPECT_EQ(e.number, expected.number);
  EXPECT_EQ(e.turn.coeffs(), expected.turn.coeffs());
  EXPECT_EQ(e.text, expected.text);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(e.rows[i].number, expected.rows[i].number);
    EXPECT_EQ(e.rows[i].place, expected.rows[i].place);
    EXPECT_EQ(e.rows[i].color, expected.rows[i].color);
    EXPECT_EQ(e.rows[i].pair[1], expected.rows[i].pair[1]);
  }
}

TEST(Checkpoint, SaysWhatIsMissingOrOfAnotherSize) {
  const auto reader = CheckpointReader::Open(Save(Example()));
  ASSERT_TRUE(reader.ok());
  double number = 5.0;
  (*reader)->Value("whole", &number);
  EXPECT_EQ(number, 5.0);
  EXPECT_FALSE((*reader)->status().ok());

  const auto other = CheckpointReader::Open(Save(Example()));
  std::vector<Row> rows(3);
  (*other)->Column(
      "place", &rows, [](Row & row) -> auto& { return row.place; });
  EXPECT_THAT((*other)->status().message(), HasSubstr("place has 6 numbers, expected 9"));
  // The first error is reported, and names in a group that does not exist do not crash.
  (*other)->Enter("nowhere");
  (*other)->Value("whole", &number);
  (*other)->Leave();
  EXPECT_THAT((*other)->status().message(), HasSubstr("place"));
}

TEST(Checkpoint, RefusesEveryFlippedByteAndEveryCut) {
  const std::string good = Save(Example());
  ASSERT_TRUE(CheckpointReader::Open(good).ok());
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x11);
    EXPECT_FALSE(CheckpointReader::Open(bad).ok()) << "byte " << i;
    EXPECT_FALSE(CheckpointReader::Open(good.substr(0, i)).ok()) << "cut at " << i;
  }
  EXPECT_THAT(OpenError("{}"), HasSubstr("is no checkpoint"));
}

TEST(Checkpoint, RefusesLengthsAndDepthsThatNoFileHas) {
  // A list of 2^63 entries, a map of as many, and lists in lists.
  for (const std::string& bytes : {"\x9b\x80" + std::string(7, '\0'),
                                   "\xbb\x80" + std::string(7, '\0'),
                                   "\xa1" + std::string(1 << 20, '\x61'),
                                   std::string(1 << 20, '\x81')}) {
    EXPECT_THAT(OpenError(bytes), HasSubstr("is no checkpoint"));
  }
}

TEST(Checkpoint, SaysOfWhatVersionAnOlderOneIs) {
  // The error names the version of a checkpoint with a short header, as version 2 wrote it.
  const nlohmann::json old = {{"format", "ceres_ed checkpoint"},
                              {"version", 2},
                              {"payload", nlohmann::json::binary({1, 2, 3})}};
  std::string bytes;
  nlohmann::json::to_cbor(old, bytes);
  EXPECT_THAT(OpenError(bytes), HasSubstr("is of checkpoint version 2, expected 7"));
}

TEST(Checkpoint, SavesRowsAsTheyLieInMemory) {
  ChunkedRows<float> rows(3);
  rows.Resize(700);
  for (std::size_t r = 0; r < rows.size(); ++r) rows[r][2] = static_cast<float>(r);
  std::vector<std::array<std::uint16_t, 3>> list = {{1, 2, 3}, {4, 5, 6}};
  CheckpointWriter writer;
  writer.Rows("rows", &rows);
  writer.Rows("list", &list);
  const std::string bytes = writer.TakeBytes();

  const auto reader = CheckpointReader::Open(bytes);
  ASSERT_TRUE(reader.ok()) << reader.status().message();
  ChunkedRows<float> loaded(3);
  std::vector<std::array<std::uint16_t, 3>> loaded_list;
  (*reader)->Rows("rows", &loaded);
  (*reader)->Rows("list", &loaded_list);
  ASSERT_TRUE((*reader)->status().ok());
  ASSERT_EQ(loaded.size(), 700u);
  for (std::size_t r = 0; r < rows.size(); ++r) EXPECT_EQ(loaded[r][2], static_cast<float>(r));
  EXPECT_EQ(loaded_list, list);
  // Rows with another width.
  ChunkedRows<double> wide(11);
  (*reader)->Rows("rows", &wide);
  EXPECT_EQ(wide.size(), 0u);
  EXPECT_THAT((*reader)->status().message(), HasSubstr("expected a multiple of 88"));
}

// A sheet that moves up and down.
BumpyScene HeavingScene() {
  BumpyScene scene;
  scene.heave = 0.001;
  return scene;
}

// Tracks frames [first, last) of a scene.
std::vector<FrameReport> Track(int first,
                               int last,
                               DeformableSlam* slam,
                               const BumpyScene& scene = HeavingScene()) {
  std::vector<FrameReport> reports;
  for (int i = first; i < last; ++i) {
    const DepthImage depth = scene.RenderDepth(i);
    const ColorImage color = scene.RenderColor(i);
    SlamFrame frame;
    frame.number = i;
    frame.depth = &depth;
    frame.color = &color;
    reports.push_back(slam->Process(frame));
  }
  return reports;
}

std::string SaveSlam(DeformableSlam* slam) {
  CheckpointWriter writer;
  slam->Exchange(&writer);
  return writer.TakeBytes();
}

TEST(Checkpoint, RefusesACornerOfANodeThatDoesNotExist) {
  for (const int node : {-1, 5}) {
    CornerStore saved;
    Corner corner;
    corner.num_nodes = 2;
    corner.nodes[0] = 1;
    corner.nodes[1] = node;
    saved.Add(corner);
    CheckpointWriter writer;
    saved.Exchange(/*num_nodes=*/5, &writer);
    const auto reader = CheckpointReader::Open(writer.TakeBytes());
    ASSERT_TRUE(reader.ok());
    CornerStore loaded;
    loaded.Exchange(/*num_nodes=*/5, reader->get());
    EXPECT_THAT((*reader)->status().message(), HasSubstr("a corner is bound to a node"));
    EXPECT_EQ(loaded.num_corners(), 0);
  }
}

TEST(Checkpoint, KeepsTheWeightsOfCornersAndTheirOrderAtANode) {
  CornerStore saved;
  Corner corner;
  corner.num_nodes = 1;
  corner.nodes[0] = 2;
  corner.weights[0] = 1.0;
  corner.weight = 0.25;
  for (int i = 0; i < 3; ++i) saved.Add(corner);
  // The next corner takes the slot of the one that is removed.
  saved.FollowOnly({0, 2});
  saved.Remove(1);
  saved.Add(corner);
  EXPECT_EQ(saved.OfNode(2), (std::vector<int>{0, 1, 2}));

  CheckpointWriter writer;
  saved.Exchange(/*num_nodes=*/5, &writer);
  const auto reader = CheckpointReader::Open(writer.TakeBytes());
  ASSERT_TRUE(reader.ok());
  CornerStore loaded;
  loaded.Exchange(/*num_nodes=*/5, reader->get());
  ASSERT_TRUE((*reader)->status().ok()) << (*reader)->status().message();
  EXPECT_EQ(loaded.OfNode(2), saved.OfNode(2));
  EXPECT_EQ(loaded.followed(), saved.followed());
  for (int slot = 0; slot < 3; ++slot) EXPECT_EQ(loaded[slot].weight, 0.25) << "slot " << slot;
}

TEST(Checkpoint, ALoadedRunGoesOnAsTheSavedOne) {
  const std::unique_ptr<DeformableSlam> saved = MakeBumpySlam();
  Track(0, 4, saved.get());
  const std::string bytes = SaveSlam(saved.get());

  const std::unique_ptr<DeformableSlam> loaded = MakeBumpySlam();
  // Everything that the object held before is replaced.
  Track(2, 3, loaded.get());
  const auto reader = CheckpointReader::Open(bytes);
  ASSERT_TRUE(reader.ok());
  loaded->Exchange(reader->get());
  ASSERT_TRUE((*reader)->status().ok()) << (*reader)->status().message();
  EXPECT_EQ(SaveSlam(loaded.get()), bytes);

  const std::vector<FrameReport> one = Track(4, 8, saved.get());
  const std::vector<FrameReport> other = Track(4, 8, loaded.get());
  EXPECT_EQ(one.back().status, FrameStatus::kTracked);
  EXPECT_GT(one.back().features, 0);
  EXPECT_EQ(one.back().energy, other.back().energy);
  EXPECT_EQ(one.back().features, other.back().features);
  EXPECT_TRUE(SaveSlam(saved.get()) == SaveSlam(loaded.get()));
}

TEST(Checkpoint, KeepsTheActiveSet) {
  SlamOptions options;
  options.levels.strategy.active = ActiveSetRule::kInformation;
  options.levels.strategy.active_bound = 1e-4;
  // The camera travels along a strip, so that tissue stays behind.
  const ShortSequence& sequence = StripSequence();
  const std::unique_ptr<DeformableSlam> saved = MakeSlam(sequence.camera, options);
  FrameReport report;
  for (int k = 0; k < 5; ++k) report = saved->Process(sequence.Frame(k));
  EXPECT_GT(report.active, report.point_relevant);
  const std::string bytes = SaveSlam(saved.get());
  const std::unique_ptr<DeformableSlam> loaded = MakeSlam(sequence.camera, options);
  const auto reader = CheckpointReader::Open(bytes);
  ASSERT_TRUE(reader.ok());
  loaded->Exchange(reader->get());
  ASSERT_TRUE((*reader)->status().ok()) << (*reader)->status().message();
  for (int k = 5; k < 8; ++k) {
    const FrameReport one = saved->Process(sequence.Frame(k));
    const FrameReport other = loaded->Process(sequence.Frame(k));
    EXPECT_EQ(one.active, other.active) << "frame " << k;
    EXPECT_EQ(one.energy, other.energy) << "frame " << k;
  }
  EXPECT_TRUE(SaveSlam(saved.get()) == SaveSlam(loaded.get()));
}

// Corners leave the view, are forgotten, and give their slots to new ones.
TEST(Checkpoint, ALongRunGoesOnAsTheSavedOne) {
  constexpr int kSaveAt = 12;
  const ShortSequence sequence(SyntheticSceneKind::kHeart,
                               /*num_frames=*/16,
                               SyntheticSequenceOptions().period,
                               SyntheticSequenceOptions().noise);
  const std::unique_ptr<DeformableSlam> saved = MakeSlam(sequence.camera);
  for (int k = 0; k < kSaveAt; ++k) saved->Process(sequence.Frame(k));
  const std::string bytes = SaveSlam(saved.get());

  const std::unique_ptr<DeformableSlam> loaded = MakeSlam(sequence.camera);
  const auto reader = CheckpointReader::Open(bytes);
  ASSERT_TRUE(reader.ok());
  loaded->Exchange(reader->get());
  ASSERT_TRUE((*reader)->status().ok()) << (*reader)->status().message();
  for (std::size_t k = kSaveAt; k < sequence.frames.size(); ++k) {
    const FrameReport one = saved->Process(sequence.Frame(static_cast<int>(k)));
    const FrameReport other = loaded->Process(sequence.Frame(static_cast<int>(k)));
    EXPECT_EQ(one.energy, other.energy) << "frame " << k;
    EXPECT_EQ(one.features, other.features) << "frame " << k;
  }
  EXPECT_TRUE(SaveSlam(saved.get()) == SaveSlam(loaded.get()));
}

}  // namespace
}  // namespace ceres_ed
