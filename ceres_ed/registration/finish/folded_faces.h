// Finds the faces of a mesh that a deformation has folded over.
#ifndef CERES_ED_REGISTRATION_FINISH_FOLDED_FACES_H_
#define CERES_ED_REGISTRATION_FINISH_FOLDED_FACES_H_

#include <ceres_ed/geometry/welded_mesh.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the rotation R (det R = 1) that maximises tr(R' B). For B = sum_k b_k a_k' it is the
// rotation that maps the a_k closest to the b_k. If there are several, it returns one of them.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& B);

// Finds folded faces. The rotation of a vertex is the one that maps its edges at rest closest to
// its present edges. A face is folded if the sum of the rotations of its corners maps its normal at
// rest to the opposite side of the present face, or if it has less than 5 % of its area at rest
// while the faces around it still have 20 % of theirs. One object serves one thread at a time.
class FoldFinder {
 public:
  // `rest` has one point per vertex, in the unit of the points that are passed later. Both must
  // outlive the object.
  FoldFinder(const WeldedMesh& mesh, const std::vector<Eigen::Vector3d>& rest);

  // Returns those of `faces` that are folded, in their order.
  std::vector<int> Find(const std::vector<int>& faces, const std::vector<Eigen::Vector3d>& points);
  // Returns all folded faces, lowest index first.
  std::vector<int> FindAll(const std::vector<Eigen::Vector3d>& points);

  // Returns the rotation of the edges of a vertex.
  Eigen::Matrix3d Rotation(int vertex, const std::vector<Eigen::Vector3d>& points) const;

  // Calls visit(u) for every neighbour u of `vertex`, lowest index first.
  template <typename Visitor>
  void ForNeighbors(int vertex, const Visitor& visit) const {
    for (int e = neighbor_offsets_[vertex]; e < neighbor_offsets_[vertex + 1]; ++e) {
      visit(neighbors_[e]);
    }
  }

  // Returns the vertices within `rings` edges of the vertices of `faces`, lowest index first.
  std::vector<int> Grow(const std::vector<int>& faces, int rings) const;
  // Returns every face that has a vertex in `vertices`, lowest index first.
  std::vector<int> FacesAround(const std::vector<int>& vertices) const;
  // Returns `faces` in groups that do not touch each other when each is grown by `rings`.
  std::vector<std::vector<int>> Groups(const std::vector<int>& faces, int rings) const;

 private:
  bool IsSqueezed(int face, const std::vector<Eigen::Vector3d>& points) const;

  const WeldedMesh& mesh_;
  const std::vector<Eigen::Vector3d>& rest_;
  std::vector<int> neighbor_offsets_;
  std::vector<int> neighbors_;
  // The rotations that were computed in the search number `stamp_`.
  std::vector<Eigen::Matrix3d> rotations_;
  std::vector<int> stamps_;
  int stamp_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_FOLDED_FACES_H_
