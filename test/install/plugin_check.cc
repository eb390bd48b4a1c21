// plugin_check ED_FIT PLUGIN SOURCE.ply OUT: holds a sheet of 0.2 m x 0.2 m at one edge and pulls
// its middle down, with and without the energy `floor` of a plugin, and checks that the floor keeps
// what it promises and spares the rest.
#include <ceres_ed/io/cloud_io.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

using namespace ceres_ed;  // NOLINT(google-build-using-namespace): a program, not a header

namespace {

// The diagonal of the sheet, which is the unit of length of energies.
const double kDiagonal = std::sqrt(0.08);
constexpr double kPull = 0.1;

std::vector<Eigen::Vector3d> Load(const std::string& path) {
  const auto loaded = LoadCloud(path);
  CHECK(loaded.ok()) << loaded.status().message();
  return loaded->cloud.points;
}

// Vertices of the column that is pulled; writes them and those of the edge into files for ed_fit.
std::vector<int> WriteHandles(const std::vector<Eigen::Vector3d>& sheet, const std::string& out) {
  std::ofstream fixed(out + "/fixed.txt");
  std::ofstream landmarks(out + "/landmarks.csv");
  landmarks << "source_index,x,y,z\n";
  std::vector<int> pulled;
  for (int i = 0; i < static_cast<int>(sheet.size()); ++i) {
    const Eigen::Vector3d& point = sheet[i];
    if (point.x() < -0.0999) fixed << i << "\n";
    if (point.x() < 0.0 || point.x() > 0.004) continue;
    landmarks << i << "," << point.x() << "," << point.y() << "," << -kPull * kDiagonal << "\n";
    pulled.push_back(i);
  }
  CHECK(!pulled.empty());
  return pulled;
}

// Lowest point and largest distance of a pulled one from its height, in diagonals.
struct Heights {
  double lowest = 0.0;
  double miss = 0.0;
};

Heights Fit(const std::string& command, const std::string& output, const std::vector<int>& pulled) {
  CHECK_EQ(std::system((command + " --output='" + output + "'").c_str()), 0) << command;
  const std::vector<Eigen::Vector3d> points = Load(output);
  Heights heights;
  for (const Eigen::Vector3d& point : points) {
    heights.lowest = std::min(heights.lowest, point.z() / kDiagonal);
  }
  for (const int i : pulled) {
    heights.miss = std::max(heights.miss, std::abs(points.at(i).z() / kDiagonal + kPull));
  }
  return heights;
}

}  // namespace

int main(int argc, char** argv) {
  CHECK_EQ(argc, 5);
  const std::string source = argv[3];
  const std::string out = argv[4];
  const std::vector<int> pulled = WriteHandles(Load(source), out);
  const std::string command = "'" + std::string(argv[1]) + "' '" + source + "' --fixed='" + out +
                              "/fixed.txt' --landmarks='" + out + "/landmarks.csv'";
  const Heights without = Fit(command, out + "/without.ply", pulled);
  const Heights with =
      Fit(command + " --plugin='" + argv[2] + "' --energy=floor:weight=1e4,height=-0.12",
          out + "/with.ply",
          pulled);
  std::printf(
      "lowest point %.3f without the floor, %.3f with it at -0.12; handles miss %.4f, %.4f\n",
      without.lowest,
      with.lowest,
      without.miss,
      with.miss);
  const bool holds = without.lowest < -0.15 && with.lowest > -0.125;
  return holds && without.miss < 0.01 && with.miss < 0.01 ? 0 : 1;
}
