// Which faces of a mesh a deformation has folded over.
#ifndef CERES_ED_REGISTRATION_FINISH_FOLDED_FACES_H_
#define CERES_ED_REGISTRATION_FINISH_FOLDED_FACES_H_

#include <ceres_ed/geometry/welded_mesh.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The rotation R (det R = 1) that maximises tr(R' B): for B = sum_k b_k a_k' the one that takes the
// a_k nearest to the b_k. Where several do equally well, one of them.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& B);

// Finds folded faces. A vertex turns by the rotation that takes its edges at rest nearest to what
// they are now. A face is folded where the sum of its corners' rotations takes its normal at rest
// to the other side of the face as it is now, or where it has less than 5 % of its area at rest and
// the faces around it still have 20 % of theirs. One object serves one thread at a time.
class FoldFinder {
 public:
  // `rest` has one point a vertex, in the unit of the points that are asked about. Both must
  // outlive the object.
  FoldFinder(const WeldedMesh& mesh, const std::vector<Eigen::Vector3d>& rest);

  // Those of `faces` that are folded, in their order.
  std::vector<int> Find(const std::vector<int>& faces, const std::vector<Eigen::Vector3d>& points);
  // All that are folded, lowest index first.
  std::vector<int> FindAll(const std::vector<Eigen::Vector3d>& points);

  // How the edges of a vertex have turned.
  Eigen::Matrix3d Rotation(int vertex, const std::vector<Eigen::Vector3d>& points) const;

  // visit(u) for every neighbour u of `vertex`, lowest index first.
  template <typename Visitor>
  void ForNeighbors(int vertex, const Visitor& visit) const {
    for (int e = neighbor_offsets_[vertex]; e < neighbor_offsets_[vertex + 1]; ++e) {
      visit(neighbors_[e]);
    }
  }

  // The vertices within `rings` edges of those of `faces`, lowest index first.
  std::vector<int> Grow(const std::vector<int>& faces, int rings) const;
  // Every face with a vertex in `vertices`, lowest index first.
  std::vector<int> FacesAround(const std::vector<int>& vertices) const;
  // `faces` in groups that don't touch when each is grown by `rings`.
  std::vector<std::vector<int>> Groups(const std::vector<int>& faces, int rings) const;

 private:
  bool IsSqueezed(int face, const std::vector<Eigen::Vector3d>& points) const;

  const WeldedMesh& mesh_;
  const std::vector<Eigen::Vector3d>& rest_;
  std::vector<int> neighbor_offsets_;
  std::vector<int> neighbors_;
  // Of the search that has `stamp_`.
  std::vector<Eigen::Matrix3d> rotations_;
  std::vector<int> stamps_;
  int stamp_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_FOLDED_FACES_H_
