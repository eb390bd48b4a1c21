// The records of members, and what is made of them.
#include <ceres_ed/pipeline/cohort/collected_member.h>
#include <ceres_ed/pipeline/cohort/content_key.h>
#include <ceres_ed/pipeline/cohort/member_folder.h>
#include <ceres_ed/pipeline/cohort/member_record.h>
#include <ceres_ed/pipeline/report.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

MemberRecord Record(const std::string& name, Grade grade, double unmatched) {
  MemberRecord record;
  record.name = name;
  record.state = MemberState::kDone;
  record.grade = grade;
  record.unmatched_source = unmatched;
  record.shared_key = "shared";
  return record;
}

TEST(MemberRecord, IsReadAsItWasWritten) {
  const TemporaryDirectory folder;
  MemberRecord record = Record("a", Grade::kDoubtful, 0.25);
  record.key = "1234";
  record.landmarks = 3;
  record.landmark_rms = 1.5;
  record.seconds = 2.5;
  record.message = "half of it is \"missing\"";
  ASSERT_TRUE(WriteReport(folder / "record.json", RecordReport(record)).ok());
  const StatusOr<MemberRecord> read = ReadRecord(folder / "record.json");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(RecordReport(*read), RecordReport(record));
  EXPECT_TRUE(std::isnan(read->stretch));
}

TEST(MemberRecord, SaysWhatIsNoRecord) {
  const TemporaryDirectory folder;
  for (const char* const text : {"[]", "{}", "{\"name\": 3}", "{\"name\": \"a\"}", "nothing"}) {
    WriteBytes(folder / "record.json", text);
    EXPECT_THAT(ReadRecord(folder / "record.json").status().message(), HasSubstr("record.json"));
  }
}

TEST(ContentKey, TellsPartsApart) {
  ContentKey one;
  one.AddText("a");
  one.AddText("bc");
  ContentKey other;
  other.AddText("ab");
  other.AddText("c");
  EXPECT_NE(one.Text(), other.Text());
  EXPECT_EQ(one.Text().size(), 16u);
}

TEST(ContentKey, FollowsTheContentsOfFilesAndFolders) {
  const TemporaryDirectory folder;
  const auto key = [&folder](const std::string& name) {
    ContentKey content;
    content.AddFile(folder / name);
    return content.Text();
  };
  WriteBytes(folder / "a", "1");
  WriteBytes(folder / "b", "1");
  EXPECT_EQ(key("a"), key("b"));
  WriteBytes(folder / "b", "2");
  EXPECT_NE(key("a"), key("b"));
  EXPECT_NE(key("a"), key("none"));
  std::filesystem::create_directory(folder / "d");
  WriteBytes(folder / "d/x", "1");
  const std::string before = key("d");
  std::filesystem::rename(folder / "d/x", folder / "d/y");
  EXPECT_NE(key("d"), before);
}

TEST(MemberFolder, AppearsWholeOrNotAtAll) {
  const TemporaryDirectory output;
  {
    StatusOr<MemberFolder> folder = MemberFolder::Create(output.path(), "a");
    ASSERT_TRUE(folder.ok());
    WriteBytes(folder->File("x"), "1");
    EXPECT_FALSE(std::filesystem::exists(MemberPath(output.path(), "a")));
  }
  EXPECT_FALSE(std::filesystem::exists(MemberPath(output.path(), "a")));
  for (const char* const text : {"2", "3"}) {
    StatusOr<MemberFolder> folder = MemberFolder::Create(output.path(), "a");
    ASSERT_TRUE(folder.ok());
    WriteBytes(folder->File("x"), text);
    ASSERT_TRUE(folder->Commit().ok());
    EXPECT_EQ(ReadBytes(MemberPath(output.path(), "a") + "/x"), text);
  }
  EXPECT_TRUE(std::filesystem::is_empty(output / ".work"));
}

// Writes a folder of a cohort with these records.
void WriteCohort(const std::string& folder, const std::vector<MemberRecord>& records) {
  CohortIndex index;
  index.shared_key = "shared";
  for (const MemberRecord& record : records) {
    CohortMember member;
    member.name = record.name;
    index.members.push_back(member);
    const std::string path = MemberPath(folder, record.name);
    std::filesystem::create_directories(path);
    if (record.state == MemberState::kMissing) continue;
    ASSERT_TRUE(WriteReport(path + "/record.json", RecordReport(record)).ok());
  }
  ASSERT_TRUE(WriteCohortIndex(folder, index).ok());
}

std::vector<std::string> Names(const std::vector<CollectedMember>& members,
                               const std::vector<int>& order) {
  std::vector<std::string> names;
  for (const int number : order) names.push_back(members[number].member.name);
  return names;
}

TEST(CollectedMembers, ComeWorstFirst) {
  const TemporaryDirectory folder;
  MemberRecord failed = Record("failed", Grade::kBad, 0.0);
  failed.state = MemberState::kFailed;
  MemberRecord missing = Record("missing", Grade::kBad, 0.0);
  missing.state = MemberState::kMissing;
  WriteCohort(folder.path(),
              {Record("good", Grade::kGood, 0.1),
               Record("better", Grade::kGood, 0.05),
               missing,
               Record("bad", Grade::kBad, 0.0),
               failed,
               Record("doubtful", Grade::kDoubtful, 0.0)});
  const StatusOr<CollectedMembers> all = ReadMembers({folder.path()});
  ASSERT_TRUE(all.ok()) << all.status().message();
  EXPECT_THAT(Names(all->members, WorstFirst(all->members)),
              ElementsAre("failed", "missing", "bad", "doubtful", "good", "better"));
  EXPECT_EQ(all->Count(Grade::kGood), 2);
  EXPECT_EQ(all->Count(MemberState::kMissing), 1);
}

TEST(CollectedMembers, OfSeveralFoldersAreJoined) {
  const TemporaryDirectory one;
  const TemporaryDirectory two;
  MemberRecord missing = Record("b", Grade::kBad, 0.0);
  missing.state = MemberState::kMissing;
  WriteCohort(one.path(), {Record("a", Grade::kGood, 0.0), missing});
  WriteCohort(two.path(), {Record("b", Grade::kGood, 0.0), Record("c", Grade::kGood, 0.0)});
  const StatusOr<CollectedMembers> all = ReadMembers({one.path(), two.path()});
  ASSERT_TRUE(all.ok());
  ASSERT_EQ(all->members.size(), 3u);
  EXPECT_EQ(all->members[1].folder, MemberPath(two.path(), "b"));
  EXPECT_EQ(all->Count(MemberState::kDone), 3);
}

TEST(CollectedMembers, OfAnotherTemplateAreMissing) {
  const TemporaryDirectory folder;
  MemberRecord other = Record("a", Grade::kGood, 0.0);
  other.shared_key = "other";
  WriteCohort(folder.path(), {other});
  const StatusOr<CollectedMembers> all = ReadMembers({folder.path()});
  ASSERT_TRUE(all.ok());
  EXPECT_EQ(all->Count(MemberState::kMissing), 1);
  EXPECT_THAT(all->members[0].record.message, HasSubstr("another template or other flags"));
}

TEST(CollectedMembers, NeedAFolderOfACohort) {
  const TemporaryDirectory folder;
  EXPECT_THAT(ReadMembers({folder.path()}).status().message(), HasSubstr("cohort.json"));
  for (const char* const text : {"[]",
                                 "{}",
                                 "{\"kind\": \"shapes\"}",
                                 "{\"kind\": \"shapes\", \"members\": [1]}",
                                 "{\"kind\": \"shapes\", \"members\": [{\"name\": \"../x\"}]}"}) {
    WriteBytes(folder / "cohort.json", text);
    EXPECT_FALSE(ReadMembers({folder.path()}).ok()) << text;
  }
}

}  // namespace
}  // namespace ceres_ed
