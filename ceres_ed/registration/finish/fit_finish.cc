#include "ceres_ed/registration/finish/fit_finish.h"

#include <ceres_ed/geometry/welded_mesh.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/registration/finish/unfold.h>
#include <ceres_ed/registration/finish/vertex_finish.h>
#include <ceres_ed/registration/fit_progress.h>
#include <ceres_ed/registration/nonrigid_loop.h>
#include <ceres_ed/registration/unit_frame.h>
#include <ceres_ed/util/timer.h>

#include <cstddef>
#include <string>

#include <glog/logging.h>

namespace ceres_ed {

void FitFinish::Report(const char* stage, double part) const {
  const auto& on_progress = fit_.options->on_progress;
  if (on_progress) on_progress({stage, PartOfFit(stage, part), 0, 0.0, 0.0});
}

void FitFinish::FinishEveryVertex(const DeformationState& state, PointCloud* fitted) {
  const bool is_whole =
      result_->status == SolveStatus::kConverged || result_->status == SolveStatus::kMaxIterations;
  if (!fit_.options->finish || fit_.target == nullptr || !is_whole) return;
  if (result_->rigid_only || result_->rigid_suffices) return;
  if (MustEnd(fit_, result_)) return;
  const Timer timer;
  const PointCloud moved = Transformed(unit_from_target_, *fitted);
  std::vector<Eigen::Vector3d> normals;
  WarpNormals(
      state, result_->skinning, fit_.source->cloud().normals, fit_.options->num_threads, &normals);
  FinishInput input;
  input.source = fit_.source;
  input.points = &moved.points;
  input.normals = &normals;
  input.target = fit_.target;
  input.noise = fit_.noise;
  input.landmarks = fit_.landmarks;
  input.fixed = fit_.fixed;
  input.matching = fit_.options->matching;
  if (!fit_.options->extra_energies.empty()) input.fit = &fit_;
  input.should_stop = [this] { return MustEnd(fit_, result_); };
  input.on_progress = [this](double part) { Report("finish", part); };
  const FinishResult finish = FinishVertices(input, fit_.options->finish_options);
  if (finish.moved) {
    std::vector<Eigen::Vector3d> displacements = finish.points;
    for (std::size_t p = 0; p < moved.size(); ++p) displacements[p] -= moved.points[p];
    AddToFinish(displacements, fitted);
    result_->matches.rms_plane = finish.rms_plane;
    result_->matches.rms_point = finish.rms_point;
  }
  result_->times.finish = timer.Seconds();
}

void FitFinish::AddToFinish(const std::vector<Eigen::Vector3d>& displacements, PointCloud* fitted) {
  const Similarity source_from_unit = (unit_from_target_ * result_->rigid).Inverse();
  VertexField& finish = result_->warp.finish;
  finish.points = source_.points;
  finish.displacements.resize(displacements.size(), Eigen::Vector3d::Zero());
  for (std::size_t p = 0; p < displacements.size(); ++p) {
    if (displacements[p].isZero(0.0)) continue;
    finish.displacements[p] +=
        source_from_unit.scale * (source_from_unit.rotation * displacements[p]);
  }
  *fitted = source_;
  const Status applied =
      ApplyWarp(result_->warp, result_->skinning, fitted, fit_.options->num_threads);
  CHECK(applied.ok()) << applied.message();
}

void FitFinish::Unfold(PointCloud* fitted) {
  if (!fit_.options->unfold || !fitted->HasTriangles() || MustEnd(fit_, result_)) return;
  Report("unfold", 0.0);
  const Timer timer;
  const WeldedMesh mesh = BuildWeldedMesh(fit_.source->cloud(), fit_.source->topology());
  UnfoldInput input;
  input.mesh = &mesh;
  input.target = fit_.target;
  input.should_stop = [this] { return MustEnd(fit_, result_); };
  for (const auto* constraints : {&fit_.landmarks, &fit_.fixed}) {
    for (const Correspondence& held : *constraints) {
      input.held.push_back(mesh.vertex_of_point[held.point]);
    }
  }
  std::vector<Eigen::Vector3d> rest;
  std::vector<Eigen::Vector3d> before;
  for (const int point : mesh.point_of_vertex) {
    rest.push_back(fit_.source->cloud().points[point]);
    before.push_back(unit_from_target_ * fitted->points[point]);
  }
  input.rest = &rest;
  std::vector<Eigen::Vector3d> after = before;
  const UnfoldResult unfold = UnfoldFaces(input, &after);
  result_->unfolded = unfold.before - unfold.after;
  if (result_->unfolded > 0) {
    std::vector<Eigen::Vector3d> displacements;
    for (const int v : mesh.vertex_of_point) displacements.push_back(after[v] - before[v]);
    AddToFinish(displacements, fitted);
  }
  if (!mesh.triangles.empty()) {
    result_->evidence.folded =
        static_cast<double>(unfold.after) / static_cast<double>(mesh.triangles.size());
  }
  has_folds_ = unfold.after > 0;
  if (has_folds_) {
    result_->warnings.push_back(std::to_string(unfold.after) + " of " +
                                std::to_string(mesh.triangles.size()) +
                                " faces stay folded over or squeezed flat");
  }
  result_->times.finish += timer.Seconds();
}

}  // namespace ceres_ed
