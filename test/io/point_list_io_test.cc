#include "ceres_ed/io/point_list_io.h"

#include "io_test_util.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class PointLists : public ::testing::Test {
 protected:
  StatusOr<std::vector<Landmark>> Landmarks(const std::string& bytes) {
    WriteBytes(path_, bytes);
    return ReadLandmarks(path_, 100);
  }
  StatusOr<std::vector<int>> Vertices(const std::string& bytes) {
    WriteBytes(path_, bytes);
    return ReadVertexList(path_, 100);
  }
  std::string LandmarkError(const std::string& bytes) { return Behind(Landmarks(bytes).status()); }
  std::string VertexError(const std::string& bytes) { return Behind(Vertices(bytes).status()); }

  TemporaryDirectory directory_;
  std::string path_ = directory_ / "list.csv";

 private:
  std::string Behind(const Status& status) const {
    return status.ok() ? "no error" : status.message().substr(path_.size() + 2);
  }
};

TEST_F(PointLists, LandmarksAreReadInTheOrderOfTheFile) {
  const std::string text =
      "\xEF\xBB\xBF# made by hand\n\nsource_index, x, y, z\n  7 , 1.5,-2, 3e-1 # "
      "nose\n\n0,0,0,+4\n7,"
      "1.5,-2,0.3";
  for (const std::string& bytes : {text, WithCrLf(text)}) {
    const StatusOr<std::vector<Landmark>> landmarks = Landmarks(bytes);
    ASSERT_TRUE(landmarks.ok()) << landmarks.status().message();
    ASSERT_EQ(landmarks->size(), 2u);
    EXPECT_EQ((*landmarks)[0].point, 7);
    EXPECT_EQ((*landmarks)[0].position, Eigen::Vector3d(1.5, -2, 0.3));
    EXPECT_EQ((*landmarks)[1].point, 0);
    EXPECT_EQ((*landmarks)[1].position, Eigen::Vector3d(0, 0, 4));
  }
}

TEST_F(PointLists, LandmarksNeedNoHeader) {
  const StatusOr<std::vector<Landmark>> landmarks = Landmarks("99,1,2,3\n");
  ASSERT_TRUE(landmarks.ok()) << landmarks.status().message();
  EXPECT_EQ((*landmarks)[0].point, 99);
}

TEST_F(PointLists, LandmarkErrorsNameLineAndValue) {
  EXPECT_EQ(LandmarkError("# c\n1,2,3\n"), "line 2: 3 fields, expected 4: source_index,x,y,z");
  EXPECT_EQ(LandmarkError("1;2;3;4\n"),
            "line 1: the row is '1;2;3;4', expected numbers or the header source_index,x,y,z");
  EXPECT_EQ(LandmarkError("1,2,3,4,5\n"), "line 1: 5 fields, expected 4: source_index,x,y,z");
  EXPECT_EQ(LandmarkError("1,2,y,3\n"), "line 1: y is 'y', expected a finite number");
  EXPECT_EQ(LandmarkError("1,nan,0,3\n"), "line 1: x is 'nan', expected a finite number");
  EXPECT_EQ(LandmarkError("1,0,0,1e999\n"), "line 1: z is '1e999', expected a finite number");
  EXPECT_EQ(LandmarkError("1,0,,1\n"), "line 1: y is '', expected a finite number");
  EXPECT_EQ(LandmarkError("1.5,0,0,0\n"),
            "line 1: '1.5' is no vertex index, expected a whole number");
  EXPECT_EQ(LandmarkError("100,0,0,0\n"), "line 1: vertex 100 is out of range, expected 0 to 99");
  EXPECT_EQ(LandmarkError("-1,0,0,0\n"), "line 1: vertex -1 is out of range, expected 0 to 99");
  EXPECT_EQ(LandmarkError("99999999999999999999,0,0,0\n"),
            "line 1: vertex 99999999999999999999 is out of range, expected 0 to 99");
  EXPECT_EQ(LandmarkError("x,y,z,source_index\n"),
            "line 1: the row is 'x,y,z,source_index', expected numbers or the header "
            "source_index,x,y,z");
  EXPECT_EQ(LandmarkError("1,0,0,0\nsource_index,x,y,z\n"),
            "line 2: 'source_index' is no vertex index, expected a whole number");
  EXPECT_EQ(LandmarkError("5,0,0,0\n\n5,0,0,1\n"),
            "line 3: vertex 5 has another position than in line 1, expected one");
  EXPECT_EQ(LandmarkError("source_index,x,y,z\n"), "no landmarks, expected at least one");
  EXPECT_EQ(LandmarkError(""), "no landmarks, expected at least one");
  EXPECT_THAT(ReadLandmarks(directory_ / "none.csv", 1).status().message(),
              HasSubstr("none.csv: cannot read: No such file or directory"));
}

TEST_F(PointLists, VerticesAreSortedAndUnique) {
  const StatusOr<std::vector<int>> vertices =
      Vertices("# base\r\n12\r\n3, 4,5\t99\r\n\r\n0 3 # again\r\n");
  ASSERT_TRUE(vertices.ok()) << vertices.status().message();
  EXPECT_THAT(*vertices, ElementsAre(0, 3, 4, 5, 12, 99));
}

TEST_F(PointLists, EmptyVertexListIsAllowed) {
  const StatusOr<std::vector<int>> vertices = Vertices("# none\n");
  ASSERT_TRUE(vertices.ok());
  EXPECT_THAT(*vertices, IsEmpty());
}

TEST_F(PointLists, VertexErrorsNameLineAndValue) {
  EXPECT_EQ(VertexError("1\n2 x3\n"), "line 2: 'x3' is no vertex index, expected a whole number");
  EXPECT_EQ(VertexError("1.0\n"), "line 1: '1.0' is no vertex index, expected a whole number");
  EXPECT_EQ(VertexError("1\n\n100"), "line 3: vertex 100 is out of range, expected 0 to 99");
  EXPECT_EQ(VertexError("-2"), "line 1: vertex -2 is out of range, expected 0 to 99");
  EXPECT_THAT(ReadVertexList(directory_.path(), 1).status().message(),
              HasSubstr("is a directory, expected a file"));
}

}  // namespace
}  // namespace ceres_ed
