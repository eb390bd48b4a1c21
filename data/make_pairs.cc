// Writes the sample pairs: make_pairs DIRECTORY [PAIR ...]. See README.md beside this file.
#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/simulation/pairs.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace {

using ceres_ed::PointCloud;
using ceres_ed::Status;
using ceres_ed::SyntheticPair;

// Four significant digits: the rest is noise that would differ between compilers.
double Rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return std::stod(text);
}

nlohmann::ordered_json Counts(const PointCloud& cloud) {
  return {{"points", cloud.size()}, {"faces", cloud.triangles.size()}};
}

std::string Info(const SyntheticPair& pair) {
  const double diagonal = ceres_ed::Diagonal(pair.target.points);
  const auto displacement =
      ceres_ed::Summarize(ceres_ed::PointDistances(pair.source, pair.truth)).InPercentOf(diagonal);
  const auto rigid = ceres_ed::Similarity::FitPoints(pair.source.points, pair.truth.points);
  PointCloud moved = pair.source;
  for (auto& point : moved.points) point = *rigid * point;
  const auto left =
      ceres_ed::Summarize(ceres_ed::PointDistances(moved, pair.truth)).InPercentOf(diagonal);
  const auto& motion = pair.target_from_source;
  const double angle = 2.0 * std::acos(std::min(1.0, std::abs(motion.rotation.w())));
  nlohmann::ordered_json info = {
      {"name", pair.name},
      {"shape", ceres_ed::SyntheticShapeName(pair.shape)},
      {"units", "metres"},
      {"size", pair.size},
      {"seed", pair.seed},
      {"target_noise", Rounded(pair.noise)},
      {"source", Counts(pair.source)},
      {"target", Counts(pair.target)},
      {"target_diagonal", Rounded(diagonal)},
      {"displacement_percent",
       {{"mean", Rounded(displacement.mean)}, {"max", Rounded(displacement.max)}}},
      {"after_best_rigid_percent", {{"mean", Rounded(left.mean)}, {"max", Rounded(left.max)}}},
      {"rigid_part",
       {{"rotation_deg", Rounded(angle * 180.0 / 3.14159265358979)},
        {"translation", Rounded(motion.translation.norm())}}},
      {"overlap", Rounded(pair.overlap)},
      {"visible_points", pair.visible.empty() ? pair.source.size() : pair.visible.size()}};
  return info.dump(2) + "\n";
}

std::string Lines(const std::vector<int>& indices) {
  std::string text;
  for (const int index : indices) text += std::to_string(index) + "\n";
  return text;
}

std::string Landmarks(const SyntheticPair& pair) {
  std::string text = "source_index,x,y,z\n";
  for (const auto& [index, p] : pair.landmarks) {
    char line[128];
    std::snprintf(line, sizeof(line), "%d,%.6f,%.6f,%.6f\n", index, p.x(), p.y(), p.z());
    text += line;
  }
  return text;
}

Status Write(const SyntheticPair& pair, const std::string& folder) {
  const auto optional_file = [&folder](const char* name, bool is_there, const std::string& text) {
    return is_there ? ceres_ed::WriteFileAtomically(folder + name, text) : Status::Ok();
  };
  for (Status status : {ceres_ed::WriteCloud(folder + "source.ply", pair.source),
                        ceres_ed::WriteCloud(folder + "target.ply", pair.target),
                        ceres_ed::WriteCloud(folder + "gt.ply", pair.truth),
                        ceres_ed::WriteFileAtomically(folder + "info.json", Info(pair)),
                        optional_file("visible.txt", !pair.visible.empty(), Lines(pair.visible)),
                        optional_file("landmarks.csv", !pair.landmarks.empty(), Landmarks(pair)),
                        optional_file("fixed.txt", !pair.fixed.empty(), Lines(pair.fixed))}) {
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: make_pairs DIRECTORY [PAIR ...]\n");
    return 1;
  }
  const std::vector<std::string> known = ceres_ed::SyntheticPairNames();
  std::vector<std::string> names(argv + 2, argv + argc);
  if (names.empty()) names = known;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      std::fprintf(stderr, "make_pairs: no pair '%s'\n", name.c_str());
      return 1;
    }
    const std::string folder = std::string(argv[1]) + "/" + name + "/";
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (Status status = Write(ceres_ed::MakeSyntheticPair(name), folder); !status.ok()) {
      std::fprintf(stderr, "make_pairs: %s\n", status.message().c_str());
      return 2;
    }
    std::printf("%s\n", folder.c_str());
  }
  return 0;
}
