// Small inputs for the tests of ed_fit, and what its outputs say.
#ifndef CERES_ED_TEST_CLI_ED_FIT_TEST_UTIL_H_
#define CERES_ED_TEST_CLI_ED_FIT_TEST_UTIL_H_

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/linear_algebra/linear_algebra_backend.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <test/cli/run_program.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {

// What ed_fit says on stderr of the libraries of this build: nothing where they are fast.
inline std::string BackendComplaints() {
  std::string lines;
  for (const std::string& warning : BackendWarnings(DescribeBackend(), BackendUse())) {
    lines += "ed_fit: warning: " + warning + "\n";
  }
  return lines;
}

// A closed ring of 1.5 x 1.04, thick on one side: nothing that it could slide or turn along.
inline Eigen::Vector3d RingPoint(double u, double v) {
  const double a = 2.0 * M_PI * u;
  const double b = 2.0 * M_PI * v;
  const Eigen::Vector3d center(0.6 * std::cos(a), 0.4 * std::sin(a), 0.05 * std::sin(2.0 * a));
  const Eigen::Vector3d outward(std::cos(a), std::sin(a), 0.0);
  const double radius = 0.12 + 0.05 * std::cos(a);
  return center + radius * (std::cos(b) * outward + std::sin(b) * Eigen::Vector3d::UnitZ());
}

// The outward unit normal there, by central differences.
inline Eigen::Vector3d RingNormal(double u, double v) {
  constexpr double kStep = 1e-6;
  const Eigen::Vector3d along_u = RingPoint(u + kStep, v) - RingPoint(u - kStep, v);
  const Eigen::Vector3d along_v = RingPoint(u, v + kStep) - RingPoint(u, v - kStep);
  return along_u.cross(along_v).normalized();
}

// Where the truth of the tests takes a point of the ring: bent up where x > 0, else at its place.
inline Eigen::Vector3d BentPoint(const Eigen::Vector3d& point) {
  const double x = std::max(point.x(), 0.0);
  return point + Eigen::Vector3d(0.0, 0.0, 0.4 * x * x);
}

// An ascii PLY of a ring; vertex `row * columns + column` has u = column / columns and
// v = row / rows.
struct RingOptions {
  int columns = 24;
  int rows = 12;
  bool bent = false;
  // Quads, else triangles; none where faces is false.
  bool quads = false;
  bool faces = true;
  // The normals of the ring that is not bent, and what nobody asked for: uchar red, int label.
  bool extras = false;
  double scale = 1.0;
  // The phase of the first vertex, in u and v.
  double phase = 0.0;
  // Rows of text behind those of the ring.
  std::vector<std::string> more_vertices;
  std::vector<std::string> more_faces;
  // Vertices that are written as NaN.
  std::function<bool(int)> is_nan = [](int) { return false; };
  // Columns whose faces are there.
  std::function<bool(int)> is_kept = [](int) { return true; };

  int size() const { return columns * rows; }
};

inline std::string RingVertexRows(const RingOptions& options) {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < options.size(); ++i) {
    const int column = i % options.columns;
    const int row = i / options.columns;
    const double u = double(column) / options.columns + options.phase;
    const double v = double(row) / options.rows + options.phase;
    Eigen::Vector3d point = options.bent ? BentPoint(RingPoint(u, v)) : RingPoint(u, v);
    point *= options.scale;
    if (options.is_nan(i)) point.x() = std::numeric_limits<double>::quiet_NaN();
    text << point.x() << ' ' << point.y() << ' ' << point.z();
    if (options.extras) {
      text << ' ' << RingNormal(u, v).transpose() << ' ' << i % 256 << ' ' << 7 * i;
    }
    text << '\n';
  }
  for (const std::string& vertex : options.more_vertices) text << vertex << '\n';
  return text.str();
}

inline std::string RingFaceRows(const RingOptions& options) {
  std::ostringstream text;
  for (int i = 0; options.faces && i < options.size(); ++i) {
    if (!options.is_kept(i % options.columns)) continue;
    const int right = i % options.columns + 1 < options.columns ? i + 1 : i + 1 - options.columns;
    const int above = (i + options.columns) % options.size();
    const int diagonal = (right + options.columns) % options.size();
    if (options.quads) {
      text << "4 " << i << ' ' << right << ' ' << diagonal << ' ' << above << '\n';
    } else {
      text << "3 " << i << ' ' << right << ' ' << above << '\n';
      text << "3 " << right << ' ' << diagonal << ' ' << above << '\n';
    }
  }
  for (const std::string& face : options.more_faces) text << face << '\n';
  return text.str();
}

inline std::string RingPly(const RingOptions& options) {
  const std::string faces = RingFaceRows(options);
  std::ostringstream text;
  text << "ply\nformat ascii 1.0\ncomment a ring\nelement vertex "
       << options.size() + static_cast<int>(options.more_vertices.size())
       << "\nproperty double x\nproperty double y\nproperty double z\n";
  if (options.extras) {
    text << "property double nx\nproperty double ny\nproperty double nz\n"
            "property uchar red\nproperty int label\n";
  }
  if (!faces.empty()) {
    text << "element face " << SplitLines(faces).size()
         << "\nproperty list uchar int vertex_indices\n";
  }
  text << "end_header\n" << RingVertexRows(options) << faces;
  return text.str();
}

// Both rings of a pair are meshes of few faces: their chords leave the true ring by up to
// 0.17 * (1 - cos(15 degrees)) = 0.0058, and half of that.
inline constexpr double kRingFacets = 0.009;
inline constexpr double kRingDiagonal = 1.9;

// A directory with a ring, source.ply, and the same one bent and of other points, target.ply.
class EdFitTest : public ::testing::Test {
 protected:
  EdFitTest() { WritePair({}, {}); }

  void WritePair(const RingOptions& source, RingOptions target) {
    WriteBytes(dir_ / "source.ply", RingPly(source));
    target.bent = true;
    target.columns = 31;
    target.rows = 17;
    WriteBytes(dir_ / "target.ply", RingPly(target));
  }

  // Writes only those faces of the target that lie in one half of its columns.
  void WriteHalfTarget() {
    RingOptions target;
    target.bent = true;
    target.columns = 31;
    target.rows = 17;
    target.is_kept = [](int column) { return column < 16; };
    WriteBytes(dir_ / "target.ply", RingPly(target));
  }

  // Fits source.ply to target.ply with few nodes; the result is out.ply.
  ProgramResult FitPair(const std::vector<std::string>& flags = {},
                        const RunOptions& options = {}) const {
    std::vector<std::string> arguments = {dir_ / "source.ply",
                                          dir_ / "target.ply",
                                          "--output=" + (dir_ / "out.ply"),
                                          "--node_spacing=0.2"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return RunProgramFile(AppPath("ed_fit"), arguments, options);
  }

  LoadedCloud Load(const std::string& name) const {
    StatusOr<LoadedCloud> loaded = LoadCloud(dir_ / name);
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    return loaded.ok() ? *std::move(loaded) : LoadedCloud();
  }

  nlohmann::json Report(const std::string& name = "report.json") const {
    return nlohmann::json::parse(std::ifstream(dir_ / name));
  }

  bool Exists(const std::string& name) const { return std::ifstream(dir_ / name).good(); }

  TemporaryDirectory dir_;
};

inline double LargestDistance(const std::vector<Eigen::Vector3d>& one,
                              const std::vector<Eigen::Vector3d>& other) {
  EXPECT_EQ(one.size(), other.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
    largest = std::max(largest, (one[i] - other[i]).norm());
  }
  return largest;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_CLI_ED_FIT_TEST_UTIL_H_
