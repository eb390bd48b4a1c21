#include "ceres_ed/io/landmarks/landmark_file.h"

#include "io_test_util.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kMarkups[] = R"({
    "@schema": "https://raw.githubusercontent.com/slicer/markups-schema-v1.0.3.json#",
    "markups": [
        {
            "type": "Fiducial",
            "coordinateSystem": "RAS",
            "coordinateUnits": "mm",
            "controlPoints": [
                {
                    "id": "1",
                    "label": "nasion",
                    "position": [1.5, -2.0, 3.0],
                    "selected": true,
                    "positionStatus": "defined"
                },
                {
                    "id": "2",
                    "label": "later",
                    "position": [0.0, 0.0, 0.0],
                    "positionStatus": "undefined"
                },
                {
                    "id": "3",
                    "label": "",
                    "position": [4, 5, 6],
                    "positionStatus": "defined"
                }
            ],
            "display": {"opacity": 0.25}
        }
    ]
}
)";

constexpr char kFcsv[] =
    "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
    "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
    "vtkMRMLMarkupsFiducialNode_0,1.5,-2.25,3e1,0,0,0,1,1,1,0,\"left, upper\",,\n"
    "vtkMRMLMarkupsFiducialNode_1,4,5,6,0,0,0,1,1,1,0,F-2,,vtkMRMLScalarVolumeNode1\r\n";

class LandmarkFiles : public ::testing::Test {
 protected:
  LandmarkFile Read(const std::string& name,
                    const std::string& text,
                    LandmarkSide side = LandmarkSide::kSource) {
    WriteBytes(directory_ / name, text);
    StatusOr<LandmarkFile> file = ReadLandmarkFile(directory_ / name, side);
    EXPECT_TRUE(file.ok()) << file.status().message();
    return file.ok() ? *std::move(file) : LandmarkFile();
  }
  std::string ErrorOf(const std::string& name, const std::string& text) {
    WriteBytes(directory_ / name, text);
    const std::string message = ReadLandmarkFile(directory_ / name).status().message();
    const std::string path = directory_ / name + ": ";
    EXPECT_EQ(message.substr(0, path.size()), path);
    return message.substr(std::min(path.size(), message.size()));
  }
  // "name x y z" of each point.
  static std::vector<std::string> Rows(const LandmarkFile& file) {
    std::vector<std::string> rows;
    for (const NamedLandmark& point : file.points) {
      std::ostringstream row;
      row << point.name << ' '
          << point.position.transpose().format(
                 Eigen::IOFormat(Eigen::StreamPrecision, Eigen::DontAlignCols, " "));
      rows.push_back(row.str());
    }
    return rows;
  }

  TemporaryDirectory directory_;
};

TEST_F(LandmarkFiles, MarkupsOfSlicerHaveLabelsAndSayTheirSpace) {
  const LandmarkFile file = Read("a.mrk.json", kMarkups);
  EXPECT_THAT(Rows(file), ElementsAre("nasion 1.5 -2 3", "3 4 5 6"));
  EXPECT_EQ(file.space, AnatomicalSpace::kRas);
  EXPECT_THAT(file.warnings,
              ElementsAre(directory_ / "a.mrk.json" + ": 1 point that is not defined left out"));
  std::string text = kMarkups;
  text.replace(text.find("\"RAS\""), 5, "\"LPS\"");
  EXPECT_EQ(Read("b.json", text).space, AnatomicalSpace::kLps);
}

TEST_F(LandmarkFiles, FcsvHasLabelsInQuotesAndSaysItsSpace) {
  const LandmarkFile file = Read("a.fcsv", kFcsv);
  EXPECT_THAT(Rows(file), ElementsAre("left, upper 1.5 -2.25 30", "F-2 4 5 6"));
  EXPECT_EQ(file.space, AnatomicalSpace::kLps);
  std::string text = kFcsv;
  text.replace(text.find("LPS"), 3, "0");
  EXPECT_EQ(Read("b.fcsv", text).space, AnatomicalSpace::kRas);
  // Slicer 3 had other columns and no line of its space.
  const LandmarkFile old = Read("c.fcsv", "# columns = label,x,y,z,sel,vis\nP1,1,2,3,1,1\n");
  EXPECT_THAT(Rows(old), ElementsAre("P1 1 2 3"));
  EXPECT_EQ(old.space, AnatomicalSpace::kRas);
  EXPECT_THAT(old.warnings, ElementsAre(HasSubstr("no CoordinateSystem, so it is taken as RAS")));
}

TEST_F(LandmarkFiles, OtherFormatsAreRead) {
  const LandmarkFile scalismo =
      Read("a.json", R"([{"id":"A","coordinates":[1,2.5,3]},{"id":"B","coordinates":[4,5,6]}])");
  EXPECT_THAT(Rows(scalismo), ElementsAre("A 1 2.5 3", "B 4 5 6"));
  EXPECT_EQ(scalismo.space, AnatomicalSpace::kUnknown);
  EXPECT_THAT(Rows(Read("a.pts", "Version 1.0\n2\nS000 1 2 3\nC001 4 5 6\n")),
              ElementsAre("S000 1 2 3", "C001 4 5 6"));
  EXPECT_THAT(Rows(Read("b.pts", "version: 1\nn_points:  2\n{\n1 2 3\n4 5 6\n}\n")),
              ElementsAre("1 1 2 3", "2 4 5 6"));
  EXPECT_THAT(Rows(Read("c.pts", "# by hand\n1,2,3\n4\t5 6 # last\n")),
              ElementsAre("1 1 2 3", "2 4 5 6"));
  EXPECT_THAT(Rows(Read("a.csv", "# mm\nlabel,x,y,z,nearest\n 7 ,1,2,3,99\n\"8\",4,5,6,98\n")),
              ElementsAre("7 1 2 3", "8 4 5 6"));
  EXPECT_THAT(Rows(Read("b.csv", "tip,1,2,3\nbase,4,5,6\n")),
              ElementsAre("tip 1 2 3", "base 4 5 6"));
  EXPECT_THAT(Rows(Read("c.csv", "1,2,3\n4,5,6\n")), ElementsAre("1 1 2 3", "2 4 5 6"));
  EXPECT_EQ(Read("d.csv", "label,r,a,s,defined\nF,1,2,3,1\n").space, AnatomicalSpace::kRas);
  EXPECT_EQ(Read("e.csv", "label,l,p,s,defined\nF,1,2,3,1\n").space, AnatomicalSpace::kLps);
}

TEST_F(LandmarkFiles, ATableWithTwoPointsARowHasASourceAndATarget) {
  const std::string text =
      "label,source_x,source_y,source_z,target_x,target_y,target_z\nF,1,2,3,4,5,6\n";
  EXPECT_THAT(Rows(Read("a.csv", text)), ElementsAre("F 1 2 3"));
  EXPECT_THAT(Rows(Read("a.csv", text, LandmarkSide::kTarget)), ElementsAre("F 4 5 6"));
  // The names of the columns in a comment.
  const std::string comment = "# by hand, mm; " + text;
  EXPECT_THAT(Rows(Read("b.csv", comment)), ElementsAre("F 1 2 3"));
  EXPECT_THAT(Rows(Read("b.csv", comment, LandmarkSide::kTarget)), ElementsAre("F 4 5 6"));
  EXPECT_THAT(Rows(Read("c.csv", "# x,y,z,name\nname,z,y,x\nF,1,2,3\n")), ElementsAre("F 3 2 1"));
}

TEST_F(LandmarkFiles, OtherPositionsAreWrittenAndAllElseIsKept) {
  const std::vector<Eigen::Vector3d> moved = {{0.1, -1e-9, 7}, {8, 9, 1.0 / 3.0}};
  std::string fcsv = kFcsv;
  fcsv.replace(fcsv.find("1.5,-2.25,3e1"), 13, "0.1,-1e-09,7");
  fcsv.replace(fcsv.find(",4,5,6"), 6, ",8,9,0.3333333333333333");
  ASSERT_TRUE(WriteLandmarkFile(directory_ / "b.fcsv", Read("a.fcsv", kFcsv), moved).ok());
  EXPECT_EQ(ReadBytes(directory_ / "b.fcsv"), fcsv);

  ASSERT_TRUE(
      WriteLandmarkFile(directory_ / "b.csv", Read("a.csv", "z,y,x,name\n3,2,1,a\n6,5,4,b"), moved)
          .ok());
  EXPECT_EQ(ReadBytes(directory_ / "b.csv"),
            "z,y,x,name\n7,-1e-09,0.1,a\n0.3333333333333333,9,8,b");

  ASSERT_TRUE(
      WriteLandmarkFile(directory_ / "b.mrk.json", Read("a.mrk.json", kMarkups), moved).ok());
  const std::string json = ReadBytes(directory_ / "b.mrk.json");
  EXPECT_THAT(json, HasSubstr("\"opacity\": 0.25"));
  EXPECT_THAT(json, HasSubstr("\"label\": \"later\""));
  EXPECT_LT(json.find("@schema"), json.find("markups\""));
  EXPECT_THAT(Rows(Read("c.mrk.json", json)), ElementsAre("nasion 0.1 -1e-09 7", "3 8 9 0.333333"));
}

TEST_F(LandmarkFiles, SayWhatIsWrongAndWhere) {
  EXPECT_EQ(ErrorOf("a.csv", "label,x,y\na,1,2\n"),
            "line 1: the header is 'label,x,y', expected the columns label and x, y, z among "
            "others");
  EXPECT_EQ(ErrorOf("a.csv", "a,1,2,3\nb,1,two,3\n"),
            "line 2: a coordinate is 'two', expected a finite number");
  EXPECT_EQ(ErrorOf("a.csv", "a,1,2,3\na,1,2,4\n"),
            "points 1 and 2 are both named 'a', expected names that differ");
  EXPECT_EQ(ErrorOf("a.pts", "1 2\n"), "line 1: 2 fields, expected x y z, or a name and x y z");
  EXPECT_EQ(ErrorOf("a.pts", ""), "no landmarks, expected at least one named point");
  EXPECT_EQ(ErrorOf("a.json", "[{\"id\":\"A\",\"coordinates\":[1,null,3]}]"),
            "/0/coordinates/1 is 'null', expected a finite number");
  EXPECT_THAT(ErrorOf("a.json", "{\"markups\":[{\"coordinateSystem\":\"IJK\"}]}"),
              HasSubstr("/markups/0/coordinateSystem is 'IJK', expected LPS or RAS"));
  EXPECT_THAT(ErrorOf("a.json", "{\"program\": \"ed_fit\"}"), HasSubstr("it is a report"));
  EXPECT_THAT(ErrorOf("a.json", "{"), HasSubstr("no JSON, or cut off: "));
}

TEST_F(LandmarkFiles, TurningBetweenSpacesChangesTheSignsOfXAndY) {
  const Eigen::Vector3d point(1, 2, 3);
  using S = AnatomicalSpace;
  EXPECT_EQ(BetweenSpaces(point, S::kRas, S::kLps), Eigen::Vector3d(-1, -2, 3));
  EXPECT_EQ(BetweenSpaces(point, S::kLps, S::kRas), Eigen::Vector3d(-1, -2, 3));
  EXPECT_EQ(BetweenSpaces(point, S::kLps, S::kLps), point);
  EXPECT_EQ(BetweenSpaces(point, S::kUnknown, S::kLps), point);
}

// Names that each format has its own trouble with.
const std::vector<NamedLandmark> kNewPoints = {{"nasion", {1.0 / 3.0, -2.5e-7, 3e10}},
                                               {"left, upper", {0.1, 0.2, 0.3}},
                                               {"3 \"of\" #4", {-1, 2, 5}}};

TEST_F(LandmarkFiles, NewOnesAreReadBackWithTheSameBits) {
  for (const std::string ending : {".mrk.json", ".fcsv", ".csv"}) {
    for (const AnatomicalSpace space : {AnatomicalSpace::kLps, AnatomicalSpace::kRas}) {
      const std::string path = directory_ / ("new" + ending);
      const Status status = WriteNewLandmarkFile(path, kNewPoints, space);
      ASSERT_TRUE(status.ok()) << status.message();
      const auto read = ReadLandmarkFile(path);
      ASSERT_TRUE(read.ok()) << read.status().message();
      EXPECT_EQ(read->space, space) << ending;
      EXPECT_THAT(read->warnings, IsEmpty());
      ASSERT_EQ(read->points.size(), kNewPoints.size());
      for (std::size_t i = 0; i < kNewPoints.size(); ++i) {
        EXPECT_EQ(read->points[i].name, kNewPoints[i].name) << ending;
        EXPECT_EQ(read->points[i].position, kNewPoints[i].position) << ending;
      }
    }
  }
}

TEST_F(LandmarkFiles, NewOnesSayWhatTheirFormatCannotHold) {
  const auto message = [this](const std::string& name, const std::string& label, bool known) {
    return WriteNewLandmarkFile(directory_ / name,
                                {{label, {1, 2, 3}}},
                                known ? AnatomicalSpace::kLps : AnatomicalSpace::kUnknown)
        .message();
  };
  EXPECT_EQ(message("new.pts", "nasion", false), "");
  EXPECT_EQ(ReadLandmarkFile(directory_ / "new.pts")->points[0].name, "nasion");
  EXPECT_EQ(message("new.csv", "nasion", false), "");
  EXPECT_EQ(ReadLandmarkFile(directory_ / "new.csv")->space, AnatomicalSpace::kUnknown);
  EXPECT_THAT(message("new.pts", "left upper", true),
              HasSubstr("can't hold the name 'left upper'"));
  EXPECT_THAT(message("new.pts", "version", true), HasSubstr("can't hold the name"));
  EXPECT_THAT(message("new.json", "nasion", false), HasSubstr("expected LPS or RAS"));
  EXPECT_THAT(message("new.txt", "nasion", true), HasSubstr("ends in .json, .fcsv, .pts or .csv"));
  EXPECT_THAT(message("new.csv", "two\nlines", true), HasSubstr("a name of one line"));
}

}  // namespace
}  // namespace ceres_ed
