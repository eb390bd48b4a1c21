#include "ceres_ed/solver/normal_equations/group_products.h"

#include <ceres_ed/util/for_each_machine.h>

#include <algorithm>

namespace ceres_ed {
namespace {

constexpr int kRow = GroupSums::kRow;
// The number of points whose rows of products are formed at once; they fit into the first-level
// cache.
constexpr int kChunk = 32;

// Indices into lower triangles that are stored row by row.
constexpr int kMoment[3][3] = {{0, 1, 3}, {1, 2, 4}, {3, 4, 5}};
constexpr int kLever[4][4] = {{0, 1, 3, 6}, {1, 2, 4, 7}, {3, 4, 5, 8}, {6, 7, 8, 9}};

// Eight numbers, which the compiler keeps in as many registers as the processor needs for them.
using Vector8 = double __attribute__((vector_size(64)));

// Computes sum += sum_p weights[p stride] rows[p] for rows of kRow values.
CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
void AddWeightedRows(
    int count, const double* rows, const double* weights, int stride, double* sum) {
  auto* out = reinterpret_cast<Vector8*>(sum);
  const auto* in = reinterpret_cast<const Vector8*>(rows);
  constexpr int kVectors = kRow / 8;
  for (int half = 0; half < kVectors; half += 4) {
    Vector8 s0 = out[half];
    Vector8 s1 = out[half + 1];
    Vector8 s2 = out[half + 2];
    Vector8 s3 = out[half + 3];
    for (int p = 0; p < count; ++p) {
      const double w = weights[p * stride];
      const Vector8* row = in + p * kVectors + half;
      s0 += w * row[0];
      s1 += w * row[1];
      s2 += w * row[2];
      s3 += w * row[3];
    }
    out[half] = s0;
    out[half + 1] = s1;
    out[half + 2] = s2;
    out[half + 3] = s3;
  }
}

// Computes (h h^T) (x) M of each point.
CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
void FormPairRows(int count, const double* levers, const double* moments, double* rows) {
  for (int p = 0; p < count; ++p) {
    const double x = levers[3 * p];
    const double y = levers[3 * p + 1];
    const double z = levers[3 * p + 2];
    const double pairs[] = {x * x, x * y, y * y, x * z, y * z, z * z, x, y, z, 1.0};
    double* row = rows + p * kRow;
    for (int i = 0; i < GroupSums::kLevers; ++i) {
      for (int r = 0; r < GroupSums::kMoments; ++r) {
        row[GroupSums::kMoments * i + r] = pairs[i] * moments[6 * p + r];
      }
    }
    for (int i = 60; i < kRow; ++i) row[i] = 0.0;
  }
}

// Computes M and [p]_x M of each point, multiplied by each entry of h.
CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
void FormCameraRows(
    int count, const double* levers, const double* moments, const double* warped, double* rows) {
  constexpr int kEntries = GroupSums::kCameraMoments;
  for (int n = 0; n < count; ++n) {
    const double* M = moments + 6 * n;
    const double* p = warped + 3 * n;
    double entries[kEntries];
    for (int i = 0; i < 6; ++i) entries[i] = M[i];
    for (int c = 0; c < 3; ++c) {
      const double* columns[3] = {M + kMoment[0][c], M + kMoment[1][c], M + kMoment[2][c]};
      entries[6 + c] = p[1] * *columns[2] - p[2] * *columns[1];
      entries[9 + c] = p[2] * *columns[0] - p[0] * *columns[2];
      entries[12 + c] = p[0] * *columns[1] - p[1] * *columns[0];
    }
    double* row = rows + n * kRow;
    for (int j = 0; j < 4; ++j) {
      const double lever = j < 3 ? levers[3 * n + j] : 1.0;
      for (int i = 0; i < kEntries; ++i) row[kEntries * j + i] = lever * entries[i];
    }
    for (int i = 4 * kEntries; i < kRow; ++i) row[i] = 0.0;
  }
}

// Adds the camera's own block. It needs only the sums of the rows that the camera has with the
// nodes, because the last of the four lever entries is 1.
CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
void AddCameraMoments(int count, const double* rows, const double* warped, GroupSums* sums) {
  double totals[GroupSums::kCameraMoments] = {};
  double turned[9] = {};
  for (int n = 0; n < count; ++n) {
    const double* entries = rows + n * kRow + 3 * GroupSums::kCameraMoments;
    const double* p = warped + 3 * n;
    for (int i = 0; i < GroupSums::kCameraMoments; ++i) totals[i] += entries[i];
    // Multiplies the rows of [p]_x M by [p]_x^T: each row is crossed with p from the other side.
    for (int i = 0; i < 3; ++i) {
      const double* row = entries + 6 + 3 * i;
      turned[3 * i] += p[1] * row[2] - p[2] * row[1];
      turned[3 * i + 1] += p[2] * row[0] - p[0] * row[2];
      turned[3 * i + 2] += p[0] * row[1] - p[1] * row[0];
    }
  }
  using RowMajorMap = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  sums->turn_shift += RowMajorMap(totals + 6);
  sums->turn_turn += RowMajorMap(turned);
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) sums->shift_shift(r, c) += totals[kMoment[r][c]];
  }
}

}  // namespace

void GroupSums::SetZero(int num_nodes) {
  std::fill_n(pairs[0], kRow * num_nodes * (num_nodes + 1) / 2, 0.0);
  std::fill_n(camera_nodes[0], kRow * num_nodes, 0.0);
  std::fill_n(gradients[0], 12 * num_nodes, 0.0);
  turn_turn.setZero();
  turn_shift.setZero();
  shift_shift.setZero();
  turn_gradient.setZero();
  shift_gradient.setZero();
}

CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
void WarpPoints(int count,
                int num_nodes,
                const double* levers,
                const double* weights,
                const double* nodes,
                double* out) {
  for (int p = 0; p < count; ++p) {
    double sum[12] = {};
    for (int a = 0; a < num_nodes; ++a) {
      const double weight = weights[p * num_nodes + a];
      for (int i = 0; i < 12; ++i) sum[i] += weight * nodes[12 * a + i];
    }
    const double* h = levers + 3 * p;
    for (int i = 0; i < 3; ++i) {
      out[3 * p + i] = sum[i] * h[0] + sum[3 + i] * h[1] + sum[6 + i] * h[2] + sum[9 + i];
    }
  }
}

CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
void AddGroupGradients(const LinearizedPoints& points, GroupSums* sums) {
  for (int p = 0; p < points.count; ++p) {
    const double* lever = points.levers + 3 * p;
    const double* v = points.gradients + 3 * p;
    double products[12];
    for (int i = 0; i < 4; ++i) {
      for (int r = 0; r < 3; ++r) products[3 * i + r] = i < 3 ? lever[i] * v[r] : v[r];
    }
    for (int a = 0; a < points.num_nodes; ++a) {
      const double weight = points.weights[p * points.num_nodes + a];
      for (int i = 0; i < 12; ++i) sums->gradients[a][i] += weight * products[i];
    }
    if (points.warped == nullptr) continue;
    const Eigen::Map<const Eigen::Vector3d> gradient(v);
    sums->shift_gradient += gradient;
    sums->turn_gradient += Eigen::Map<const Eigen::Vector3d>(points.warped + 3 * p).cross(gradient);
  }
}

void AddGroupProducts(const LinearizedPoints& points, GroupSums* sums) {
  alignas(64) double rows[kChunk * kRow];
  double weights[kChunk];
  const int n = points.num_nodes;
  for (int begin = 0; begin < points.count; begin += kChunk) {
    const int count = std::min(kChunk, points.count - begin);
    const double* levers = points.levers + 3 * begin;
    const double* moments = points.moments + 6 * begin;
    const double* node_weights = points.weights + n * begin;
    FormPairRows(count, levers, moments, rows);
    for (int a = 0, pair = 0; a < n; ++a) {
      for (int b = 0; b <= a; ++b, ++pair) {
        for (int p = 0; p < count; ++p)
          weights[p] = node_weights[n * p + a] * node_weights[n * p + b];
        AddWeightedRows(count, rows, weights, 1, sums->pairs[pair]);
      }
    }
    if (points.warped == nullptr) continue;
    const double* warped = points.warped + 3 * begin;
    FormCameraRows(count, levers, moments, warped, rows);
    for (int a = 0; a < n; ++a) {
      AddWeightedRows(count, rows, node_weights + a, n, sums->camera_nodes[a]);
    }
    AddCameraMoments(count, rows, warped, sums);
  }
}

// Computes the sums of (h + s)_i (h + t)_j for pairs of lever entries (i, j). The last entries of
// h, s and t are 1, 0 and 0.
CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
void AddPairBlock(const double* sums,
                  const double* row_shift,
                  const double* column_shift,
                  double* out) {
  constexpr int kMoments = GroupSums::kMoments;
  double shifted[4][4][kMoments];
  for (int i = 0; i < 4; ++i) {
    const double s = i < 3 ? row_shift[i] : 0.0;
    for (int j = 0; j < 4; ++j) {
      const double* plain = sums + kMoments * kLever[i][j];
      const double* last = sums + kMoments * kLever[3][j];
      for (int r = 0; r < kMoments; ++r) shifted[i][j][r] = plain[r] + s * last[r];
    }
    for (int j = 0; j < 3; ++j) {
      for (int r = 0; r < kMoments; ++r) shifted[i][j][r] += column_shift[j] * shifted[i][3][r];
    }
  }
  for (int j = 0; j < 4; ++j) {
    for (int c = 0; c < 3; ++c) {
      double* column = out + (3 * j + c) * kNodeSize;
      for (int i = 0; i < 4; ++i) {
        for (int r = 0; r < 3; ++r) column[3 * i + r] += shifted[i][j][kMoment[r][c]];
      }
    }
  }
}

// With M in the map frame, [R_c p]_x = R_c [p]_x R_c^T. The rows of the rotation are therefore 2
// R_c [p]_x M, and those of the translation are R_c M.
void AddCameraBlock(const double* sums,
                    const double* column_shift,
                    const Eigen::Matrix3d& R_c,
                    double* out) {
  constexpr int kEntries = GroupSums::kCameraMoments;
  const double* last = sums + 3 * kEntries;
  for (int j = 0; j < 4; ++j) {
    double entries[kEntries];
    const double shift = j < 3 ? column_shift[j] : 0.0;
    for (int i = 0; i < kEntries; ++i) entries[i] = sums[kEntries * j + i] + shift * last[i];
    Eigen::Matrix3d M;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) M(r, c) = entries[kMoment[r][c]];
    }
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turned(entries + 6);
    Eigen::Map<Eigen::Matrix<double, 6, 3>> block(out + 6 * 3 * j);
    block.topRows<3>() += 2.0 * R_c * turned;
    block.bottomRows<3>() += R_c * M;
  }
}

}  // namespace ceres_ed
