#include "ceres_ed/io/warp_io.h"

#include "io_test_util.h"

#include <cstring>
#include <functional>
#include <limits>
#include <string>

#include <cost_functions/node_parameters.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

bool SameBits(const double* a, const double* b, std::size_t size) {
  return std::memcmp(a, b, size * sizeof(double)) == 0;
}

Warp MakeWarp() {
  unsigned int random = 7;
  const auto next = [&random] {
    random = random * 1664525u + 1013904223u;
    return (static_cast<double>(random) - 2e9) / 3e7;
  };
  Warp warp;
  warp.state.Resize(20);
  for (int j = 0; j < 20; ++j) {
    warp.graph.AddNode({next(), next(), next()});
    for (int i = 0; i < kNodeSize; ++i) warp.state.node(j)[i] = next();
  }
  warp.state.node(3)[0] = -0.0;
  warp.state.node(3)[1] = 5e-324;
  warp.state.node(3)[2] = 1e308;
  for (int j = 1; j < 20; ++j) warp.graph.AddEdge({j, j - 1, 1.0 / j});
  warp.target_from_source.scale = 1.0 / 3.0;
  warp.target_from_source.rotation = Eigen::Quaterniond(0.1, -0.2, 0.3, 0.7).normalized();
  warp.target_from_source.translation = {1e-7, 1e9, -1.0 / 7.0};
  warp.binding.neighbors = 6;
  warp.binding.distance = DistanceRule::kEuclidean;
  return warp;
}

TEST(WarpFile, ReadsBackToTheSameBits) {
  const TemporaryDirectory directory;
  const Warp warp = MakeWarp();
  ASSERT_TRUE(WriteWarp(directory / "w.json", warp).ok());
  const StatusOr<Warp> again = ReadWarp(directory / "w.json");
  ASSERT_TRUE(again.ok()) << again.status().message();
  ASSERT_EQ(again->graph.num_nodes(), 20);
  ASSERT_EQ(again->state.num_nodes(), 20);
  for (int j = 0; j < 20; ++j) {
    EXPECT_TRUE(SameBits(again->graph.position(j).data(), warp.graph.position(j).data(), 3)) << j;
    EXPECT_TRUE(SameBits(again->state.node(j), warp.state.node(j), kNodeSize)) << j;
  }
  ASSERT_EQ(again->graph.num_edges(), 19);
  for (int e = 0; e < 19; ++e) {
    EXPECT_EQ(again->graph.edges()[e].from, warp.graph.edges()[e].from);
    EXPECT_EQ(again->graph.edges()[e].to, warp.graph.edges()[e].to);
    EXPECT_EQ(again->graph.edges()[e].weight, warp.graph.edges()[e].weight);
  }
  EXPECT_EQ(again->target_from_source.scale, warp.target_from_source.scale);
  EXPECT_EQ(again->target_from_source.rotation.coeffs(), warp.target_from_source.rotation.coeffs());
  EXPECT_EQ(again->target_from_source.translation, warp.target_from_source.translation);
  EXPECT_EQ(again->binding.neighbors, 6);
  EXPECT_EQ(again->binding.distance, DistanceRule::kEuclidean);
  ASSERT_TRUE(WriteWarp(directory / "again.json", *again).ok());
  EXPECT_EQ(ReadBytes(directory / "again.json"), ReadBytes(directory / "w.json"));
}

Warp MakeFinishedWarp() {
  Warp warp = MakeWarp();
  for (int p = 0; p < 50; ++p) {
    warp.finish.points.emplace_back(1.0 / (p + 3), -p / 7.0, 1e5 / (p + 1));
    warp.finish.displacements.emplace_back(1e-9 / (p + 7), p == 4 ? -0.0 : p / 11.0, 5e-324);
  }
  return warp;
}

TEST(WarpFile, ReadsInnerNodesBack) {
  const TemporaryDirectory directory;
  Warp warp = MakeWarp();
  EXPECT_EQ(warp.graph.num_inner_nodes(), 0);
  warp.state.Resize(22);
  warp.graph.AddInnerNode({1.0, 2.0, 3.0});
  warp.graph.AddInnerNode({4.0, 5.0, 6.0});
  ASSERT_TRUE(WriteWarp(directory / "w.json", warp).ok());
  const StatusOr<Warp> again = ReadWarp(directory / "w.json");
  ASSERT_TRUE(again.ok()) << again.status().message();
  EXPECT_EQ(again->graph.num_nodes(), 22);
  EXPECT_EQ(again->graph.num_surface_nodes(), 20);
  EXPECT_EQ(again->graph.position(21), warp.graph.position(21));
}

TEST(WarpFile, RemembersThatTheSourceWasMended) {
  const TemporaryDirectory directory;
  Warp warp = MakeWarp();
  for (const bool repaired : {true, false}) {
    warp.repaired = repaired;
    ASSERT_TRUE(WriteWarp(directory / "w.json", warp).ok());
    const StatusOr<Warp> again = ReadWarp(directory / "w.json");
    ASSERT_TRUE(again.ok()) << again.status().message();
    EXPECT_EQ(again->repaired, repaired);
  }
  EXPECT_EQ(ReadBytes(directory / "w.json").find("repaired"), std::string::npos);
}

TEST(WarpFile, ReadsTheFinishBackToTheSameBits) {
  const TemporaryDirectory directory;
  const Warp warp = MakeFinishedWarp();
  ASSERT_TRUE(WriteWarp(directory / "w.json", warp).ok());
  const StatusOr<Warp> again = ReadWarp(directory / "w.json");
  ASSERT_TRUE(again.ok()) << again.status().message();
  ASSERT_EQ(again->finish.points.size(), 50u);
  ASSERT_EQ(again->finish.displacements.size(), 50u);
  for (int p = 0; p < 50; ++p) {
    EXPECT_TRUE(SameBits(again->finish.points[p].data(), warp.finish.points[p].data(), 3)) << p;
    EXPECT_TRUE(
        SameBits(again->finish.displacements[p].data(), warp.finish.displacements[p].data(), 3))
        << p;
  }
}

TEST(WarpFile, WithoutAFinishHasNoWordOfIt) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(WriteWarp(directory / "w.json", MakeWarp()).ok());
  EXPECT_FALSE(json::parse(ReadBytes(directory / "w.json")).contains("finish"));
  const StatusOr<Warp> again = ReadWarp(directory / "w.json");
  ASSERT_TRUE(again.ok()) << again.status().message();
  EXPECT_TRUE(again->finish.empty());
}

TEST(WarpFile, FinishThatIsNotFiniteIsNotWritten) {
  const TemporaryDirectory directory;
  Warp warp = MakeFinishedWarp();
  warp.finish.displacements[7].x() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(WriteWarp(directory / "w.json", warp).message(),
              HasSubstr("w.json: cannot write: point 7 of the finish is not finite"));
}

TEST(WarpFile, HoldsTheDocumentedFields) {
  const TemporaryDirectory directory;
  Warp warp;
  warp.graph.AddNode({1, 2, 3});
  warp.graph.AddNode({4, 5, 6});
  warp.graph.AddEdge({1, 0, 0.5});
  warp.state.Resize(2);
  for (int i = 0; i < kNodeSize; ++i) warp.state.node(0)[i] = 10.0 + i;
  ASSERT_TRUE(WriteWarp(directory / "w.json", warp).ok());
  const json root = json::parse(ReadBytes(directory / "w.json"));
  EXPECT_EQ(root["format"], "ceres_ed_warp");
  EXPECT_EQ(root["version"], 1);
  EXPECT_EQ(root["target_from_source"]["rotation"], json({1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(root["binding"]["distance"], "surface");
  EXPECT_EQ(root["nodes"][0]["g"], json({1.0, 2.0, 3.0}));
  EXPECT_EQ(root["nodes"][0]["A"], json({10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0}));
  EXPECT_EQ(root["nodes"][0]["t"], json({19.0, 20.0, 21.0}));
  EXPECT_EQ(root["edges"], json::array({json::array({1, 0, 0.5})}));
}

TEST(WarpFile, NumberThatIsNotFiniteIsNotWritten) {
  const TemporaryDirectory directory;
  Warp warp = MakeWarp();
  warp.state.node(4)[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(WriteWarp(directory / "w.json", warp).message(),
              HasSubstr("w.json: cannot write: node 4 is not finite"));
  EXPECT_EQ(directory.NumFiles(), 0u);
}

// Returns the error, without "w.json: ", for a valid warp file after `spoil` has changed it.
std::string ErrorAfter(const std::function<void(json&)>& spoil) {
  const TemporaryDirectory directory;
  const std::string path = directory / "w.json";
  EXPECT_TRUE(WriteWarp(path, MakeWarp()).ok());
  json root = json::parse(ReadBytes(path));
  spoil(root);
  WriteBytes(path, root.dump());
  const StatusOr<Warp> warp = ReadWarp(path);
  return warp.ok() ? "no error" : warp.status().message().substr(path.size() + 2);
}

TEST(WarpFile, NamesTheBadFieldOfTheFinish) {
  EXPECT_EQ(ErrorAfter([](json& w) { w["finish"] = 1; }), "finish is number, expected an object");
  EXPECT_EQ(ErrorAfter([](json& w) { w["finish"] = json::object(); }), "finish.points is missing");
  EXPECT_EQ(ErrorAfter([](json& w) {
              w["finish"]["points"] = json::array({{1, 2, 3}});
            }),
            "finish.points[0] has 3 values, expected 6 numbers");
}

TEST(WarpFile, NamesTheBadField) {
  EXPECT_EQ(ErrorAfter([](json& w) { w["extra"] = 1; }), "no error");
  EXPECT_EQ(ErrorAfter([](json& w) { w = json::array(); }),
            "the file is array, expected an object");
  EXPECT_EQ(ErrorAfter([](json& w) { w.erase("format"); }), "format is missing");
  EXPECT_THAT(ErrorAfter([](json& w) { w["format"] = "other"; }), StartsWith("format is not"));
  EXPECT_EQ(ErrorAfter([](json& w) { w["version"] = 2; }),
            "version is 2, this program reads up to 1");
  EXPECT_THAT(ErrorAfter([](json& w) { w["version"] = "1"; }), StartsWith("version is '1'"));
  EXPECT_EQ(ErrorAfter([](json& w) { w["repaired"] = 1; }), "repaired is not true or false");
  EXPECT_EQ(ErrorAfter([](json& w) { w.erase("nodes"); }), "nodes is missing");
  EXPECT_EQ(ErrorAfter([](json& w) { w["nodes"] = 3; }), "nodes is number, expected an array");
  EXPECT_EQ(ErrorAfter([](json& w) { w["nodes"] = json::array(); }),
            "nodes is empty, expected at least one");
  EXPECT_EQ(ErrorAfter([](json& w) { w["nodes"][2].erase("t"); }), "nodes[2].t is missing");
  EXPECT_EQ(ErrorAfter([](json& w) { w["nodes"][2]["A"].push_back(1.0); }),
            "nodes[2].A has 10 values, expected 9 numbers");
  EXPECT_EQ(ErrorAfter([](json& w) { w["nodes"][2]["g"][1] = nullptr; }),
            "nodes[2].g[1] is null, expected a finite number");
  EXPECT_EQ(ErrorAfter([](json& w) { w["nodes"][5] = 1; }),
            "nodes[5] is number, expected an object");
}

TEST(WarpFile, NamesTheValueThatIsOutOfRange) {
  EXPECT_EQ(ErrorAfter([](json& w) { w["edges"][1][0] = 20; }),
            "edges[1][0] is 20, expected a whole number from 0 to 19");
  EXPECT_EQ(ErrorAfter([](json& w) { w["edges"][1][1] = -1; }),
            "edges[1][1] is -1, expected a whole number from 0 to 19");
  EXPECT_EQ(ErrorAfter([](json& w) { w["edges"][1][1] = 18446744073709551615u; }),
            "edges[1][1] is 18446744073709551615, expected a whole number from 0 to 19");
  EXPECT_EQ(ErrorAfter([](json& w) { w["edges"][1][1] = 0.5; }),
            "edges[1][1] is 0.5, expected a whole number from 0 to 19");
  EXPECT_EQ(ErrorAfter([](json& w) { w["edges"][1][1] = w["edges"][1][0]; }),
            "edges[1] joins a node to itself");
  EXPECT_EQ(ErrorAfter([](json& w) { w["edges"][1][2] = -0.5; }),
            "edges[1][2] is negative, expected at least 0");
  EXPECT_EQ(ErrorAfter([](json& w) { w["binding"]["neighbors"] = 9; }),
            "binding.neighbors is 9, expected a whole number from 1 to 8");
  EXPECT_THAT(ErrorAfter([](json& w) { w["binding"]["distance"] = "l1"; }),
              StartsWith("binding.distance is unknown"));
  EXPECT_EQ(ErrorAfter([](json& w) { w["target_from_source"]["scale"] = 0.0; }),
            "target_from_source.scale is 0.0, expected more than 0");
  EXPECT_EQ(ErrorAfter([](json& w) {
              w["target_from_source"]["rotation"] = {2, 0, 0, 0};
            }),
            "target_from_source.rotation has the norm 2.0, expected 1");
}

TEST(WarpFile, TextThatIsNoJsonIsAnError) {
  const TemporaryDirectory directory;
  const std::string path = directory / "w.json";
  ASSERT_TRUE(WriteWarp(path, MakeWarp()).ok());
  const std::string bytes = ReadBytes(path);
  // The loop ends before the last brace and the line end, so each file is cut off.
  for (std::size_t size = 0; size + 2 < bytes.size(); size += 7) {
    WriteBytes(path, bytes.substr(0, size));
    EXPECT_THAT(ReadWarp(path).status().message(), HasSubstr("w.json: no JSON, or cut off"));
  }
  WriteBytes(path, "{\"format\": 1e999}");
  EXPECT_THAT(ReadWarp(path).status().message(), HasSubstr("beyond the range of double"));
  EXPECT_THAT(ReadWarp(directory / "none.json").status().message(),
              HasSubstr("No such file or directory"));
}

}  // namespace
}  // namespace ceres_ed
