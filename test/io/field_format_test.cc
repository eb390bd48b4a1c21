#include <ceres_ed/io/field/field_format.h>
#include <ceres_ed/io/field/gzip_writer.h>
#include <ceres_ed/io/field/nifti_file.h>
#include <ceres_ed/io/field/rigid_file.h>

#include <cstring>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// A field of 2 x 3 x 1 points; component c of point p is 10 p + c.
DisplacementField MakeField() {
  DisplacementField field;
  field.grid.size = {2, 3, 1};
  field.grid.spacing = {0.5, 0.25, 2.0};
  field.grid.origin = {-1.0, 7.0, 0.125};
  for (int p = 0; p < 6; ++p) {
    for (int c = 0; c < 3; ++c) field.vectors.push_back(static_cast<float>(10 * p + c));
  }
  field.description = "what is moved where";
  return field;
}

std::string Written(const std::string& ending) {
  const TemporaryDirectory directory;
  const std::string path = directory / ("field" + ending);
  const StatusOr<const FieldFormat*> format = FieldFormatOf(path);
  EXPECT_TRUE(format.ok()) << format.status().message();
  const Status status = (*format)->write(path, MakeField());
  EXPECT_TRUE(status.ok()) << status.message();
  return ReadBytes(path);
}

// Returns the numbers behind the header of `size` bytes.
float NumberAt(const std::string& bytes, std::size_t header, std::size_t index) {
  float number = 0.0f;
  std::memcpy(&number, bytes.data() + header + 4 * index, sizeof(number));
  return number;
}

TEST(FieldFormat, IsChosenByTheEndingInAnyCase) {
  EXPECT_EQ((*FieldFormatOf("a/b.NII.gz"))->ending, std::string(".nii.gz"));
  EXPECT_EQ((*FieldFormatOf("b.vti"))->space, FieldSpace::kAny);
  EXPECT_EQ((*FieldFormatOf("b.mha"))->space, FieldSpace::kLps);
  for (const std::string path : {"field", "field.gz", ".nrrd", "field.png"}) {
    const StatusOr<const FieldFormat*> format = FieldFormatOf(path);
    ASSERT_FALSE(format.ok()) << path;
    EXPECT_THAT(format.status().message(), StartsWith(path + ": "));
    EXPECT_THAT(format.status().message(), HasSubstr(".nrrd, .nii.gz, .nii,"));
  }
}

TEST(NrrdFile, SaysSpaceUnitsAndWhatIsMoved) {
  const std::string bytes = Written(".nrrd");
  EXPECT_THAT(bytes, StartsWith("NRRD0005\n# what is moved where\n"));
  EXPECT_THAT(bytes, HasSubstr("\nsizes: 3 2 3 1\n"));
  EXPECT_THAT(bytes, HasSubstr("\nspace: left-posterior-superior\n"));
  EXPECT_THAT(bytes, HasSubstr("\nspace directions: none (0.5,0,0) (0,0.25,0) (0,0,2)\n"));
  EXPECT_THAT(bytes, HasSubstr("\nspace origin: (-1,7,0.125)\n"));
  EXPECT_THAT(bytes, HasSubstr("\nspace units: \"mm\" \"mm\" \"mm\"\n"));
}

TEST(MetaImageFile, HasTheVectorsBehindItsHeader) {
  const std::string bytes = Written(".mha");
  EXPECT_THAT(bytes, HasSubstr("\nDimSize = 2 3 1\n"));
  EXPECT_THAT(bytes, HasSubstr("\nElementNumberOfChannels = 3\n"));
  const std::string end = "ElementDataFile = LOCAL\n";
  const std::size_t header = bytes.find(end) + end.size();
  ASSERT_EQ(bytes.size(), header + 6 * 12);
  EXPECT_EQ(NumberAt(bytes, header, 7), 21.0f);
}

TEST(MetaImageFile, NamesItsSecondFile) {
  const TemporaryDirectory directory;
  const std::string path = directory / "field.mhd";
  ASSERT_TRUE((*FieldFormatOf(path))->write(path, MakeField()).ok());
  EXPECT_THAT(ReadBytes(path), HasSubstr("\nElementDataFile = field.raw\n"));
  EXPECT_EQ(ReadBytes(directory / "field.raw").size(), 6u * 12u);
}

TEST(NiftiFile, HasFiveDimensionsAndOneComponentAfterTheOther) {
  const std::string bytes = Written(".nii");
  ASSERT_EQ(bytes.size(), 352u + 6 * 12);
  const auto* numbers = reinterpret_cast<const std::int16_t*>(bytes.data() + 40);
  const std::vector<int> dim(numbers, numbers + 8);
  EXPECT_EQ(dim, (std::vector<int>{5, 2, 3, 1, 1, 3, 1, 1}));
  std::int16_t intent = 0;
  std::memcpy(&intent, bytes.data() + 68, sizeof(intent));
  EXPECT_EQ(intent, 1007);
  EXPECT_EQ(bytes.substr(344, 4), std::string("n+1\0", 4));
  EXPECT_THAT(bytes.substr(148), StartsWith("what is moved where"));
  EXPECT_EQ(NumberAt(bytes, 352, 1), 10.0f);
  EXPECT_EQ(NumberAt(bytes, 352, 6), 1.0f);
}

TEST(NiftiFile, RefusesMorePointsThanItCanCount) {
  DisplacementField field = MakeField();
  field.grid.size = {40000, 1, 1};
  const Status status = WriteNiftiField("/nowhere/f.nii", field);
  EXPECT_EQ(status.message(),
            "/nowhere/f.nii: 40000 points along an axis, expected at most 32767 in a NIfTI file");
}

TEST(FieldFiles, AreTheSameBytesEachTime) {
  for (const std::string ending : {".nrrd", ".nii.gz", ".mha", ".vti"}) {
    EXPECT_EQ(Written(ending), Written(ending)) << ending;
  }
}

TEST(FieldFiles, SayWhyTheyCannotBeWritten) {
  for (const std::string ending : {".nrrd", ".nii", ".nii.gz", ".mha", ".mhd", ".vti"}) {
    const std::string path = "/nowhere/field" + ending;
    const Status status = (*FieldFormatOf(path))->write(path, MakeField());
    EXPECT_THAT(status.message(), StartsWith("/nowhere/field.")) << ending;
    EXPECT_THAT(status.message(), HasSubstr("cannot write")) << ending;
  }
}

TEST(MatrixFile, IsTheMatrixInFourLines) {
  const TemporaryDirectory directory;
  Similarity similarity;
  similarity.scale = 2.0;
  similarity.translation = {0.5, -1.0, 3.0};
  ASSERT_TRUE(WriteMatrixFile(directory / "m.txt", similarity).ok());
  EXPECT_EQ(ReadBytes(directory / "m.txt"), "2 0 0 0.5\n0 2 0 -1\n0 0 2 3\n0 0 0 1\n");
}

}  // namespace
}  // namespace ceres_ed
