#include <ceres_ed/pipeline/cohort/cohort_checks.h>
#include <ceres_ed/pipeline/cohort/manifest.h>

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ManifestTest : public ::testing::Test {
 protected:
  StatusOr<Manifest> Read(const std::string& text, CohortKind kind = CohortKind::kShapes) {
    WriteBytes(folder_ / "table.csv", text);
    return ReadManifest(folder_ / "table.csv", kind, true);
  }
  std::string Error(const std::string& text, CohortKind kind = CohortKind::kShapes) {
    const StatusOr<Manifest> manifest = Read(text, kind);
    return manifest.ok() ? "no error" : manifest.status().message();
  }

  TemporaryDirectory folder_;
};

TEST_F(ManifestTest, ReadsWhatTheHeaderNames) {
  const auto manifest = Read(
      "group,path,landmarks,name,unit\n"
      "a,x/one.ply,x/one.fcsv,first,mm\n"
      "b,two.ply,,,\n");
  ASSERT_TRUE(manifest.ok()) << manifest.status().message();
  ASSERT_EQ(manifest->members.size(), 2u);
  const CohortMember& first = manifest->members[0];
  EXPECT_EQ(first.name, "first");
  EXPECT_EQ(first.path, folder_ / "x/one.ply");
  EXPECT_EQ(first.landmarks, folder_ / "x/one.fcsv");
  EXPECT_EQ(first.unit, "mm");
  EXPECT_EQ(first.group, "a");
  const CohortMember& second = manifest->members[1];
  EXPECT_EQ(second.name, "two");
  EXPECT_EQ(second.row, 1);
  EXPECT_THAT(second.landmarks, IsEmpty());
}

TEST_F(ManifestTest, ReadsPairs) {
  const auto manifest = Read("source,target\na.ply,b.ply\n", CohortKind::kPairs);
  ASSERT_TRUE(manifest.ok());
  EXPECT_EQ(manifest->members[0].source, folder_ / "a.ply");
  EXPECT_EQ(manifest->members[0].path, folder_ / "b.ply");
  EXPECT_EQ(manifest->members[0].name, "a_b");
}

TEST_F(ManifestTest, TakesTheMeshesOfAFolderWithTheirLandmarks) {
  for (const char* const name : {"b.ply", "a.stl", "a.mrk.json", "notes.txt", ".hidden.ply"}) {
    WriteBytes(folder_ / name, "");
  }
  const auto manifest = ReadManifest(folder_.path(), CohortKind::kShapes, true);
  ASSERT_TRUE(manifest.ok()) << manifest.status().message();
  ASSERT_EQ(manifest->members.size(), 2u);
  EXPECT_EQ(manifest->members[0].name, "a");
  EXPECT_EQ(manifest->members[0].landmarks, folder_ / "a.mrk.json");
  EXPECT_EQ(manifest->members[1].name, "b");
  EXPECT_THAT(ReadManifest(folder_.path(), CohortKind::kShapes, false)->members[0].landmarks,
              IsEmpty());
}

TEST_F(ManifestTest, MistakesAreNamedWithTheirPlace) {
  EXPECT_THAT(Error(""), HasSubstr("is empty"));
  EXPECT_THAT(Error("name,file\na,b\n"), HasSubstr("line 1: no column 'path'"));
  EXPECT_THAT(Error("path\n"), HasSubstr("has no shapes"));
  EXPECT_THAT(Error("name,path\na,b.ply,c\n"), HasSubstr("line 2: 3 fields, expected 2"));
  EXPECT_THAT(Error("name,path\na,\n"), HasSubstr("line 2: no path"));
  EXPECT_THAT(Error("name,path\n../x,b.ply\n"), HasSubstr("line 2: the name is '../x'"));
  EXPECT_THAT(Error("name,path\na,b.ply\na,c.ply\n"),
              HasSubstr("the name 'a' stands in row 1 and in row 2"));
  EXPECT_THAT(Error("path,unit\nb.ply,mile\n"), HasSubstr("line 2: the unit is 'mile'"));
  EXPECT_THAT(Error("path,path\nb.ply,c.ply\n"), HasSubstr("'path' occurs twice"));
  EXPECT_THAT(Error("path\nb.ply\n", CohortKind::kPairs), HasSubstr("no column 'source'"));
}

TEST_F(ManifestTest, UnusedColumnsAreNoted) {
  const auto manifest = Read("path,groop,age\nb.ply,x,7\n");
  ASSERT_TRUE(manifest.ok());
  EXPECT_THAT(manifest->notes,
              ElementsAre(HasSubstr("'groop' is not used; is it 'group'?"),
                          HasSubstr("'age' is not used")));
}

TEST(Shard, TakesEveryNthMember) {
  const StatusOr<Shard> shard = ParseShard("2/3");
  ASSERT_TRUE(shard.ok());
  EXPECT_FALSE(shard->Contains(0));
  EXPECT_TRUE(shard->Contains(1));
  EXPECT_TRUE(shard->Contains(4));
  EXPECT_TRUE(ParseShard("")->IsWhole());
}

TEST(Shard, SaysWhatIsExpected) {
  for (const char* const text : {"0/3", "4/3", "2", "a/b", "1/3x", "1/0", "-1/2"}) {
    EXPECT_THAT(ParseShard(text).status().message(), HasSubstr("expected i/n")) << text;
  }
}

TEST(CohortChecks, NameTheTableAndTheRowOfAPairWithAUnit) {
  CohortSettings settings;
  settings.pairs = "pairs.csv";
  Manifest manifest;
  manifest.kind = CohortKind::kPairs;
  manifest.members.resize(1);
  manifest.members[0].name = "first";
  manifest.members[0].unit = "mm";
  EXPECT_EQ(CheckMembers(settings, settings.pairs, manifest).message(),
            "pairs.csv: row 1, first: has the unit mm, expected --unit with that of TEMPLATE");
  settings.unit = "m";
  EXPECT_TRUE(CheckMembers(settings, settings.pairs, manifest).ok());
}

}  // namespace
}  // namespace ceres_ed
