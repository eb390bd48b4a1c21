#include "ceres_ed/energy/builtin_energies.h"

#include <ceres_ed/energy/point_energy.h>
#include <ceres_ed/energy/prior_stores.h>

#include <cmath>
#include <memory>

#include <cost_functions/node_prior_cost.h>
#include <cost_functions/point_to_plane_cost.h>
#include <cost_functions/point_to_point_cost.h>
#include <cost_functions/pose_prior_cost.h>
#include <cost_functions/regularization_cost.h>
#include <cost_functions/rotation_cost.h>

namespace ceres_ed {
namespace {

class RotationEnergy final : public EnergyTerm {
 public:
  EnergyKind kind() const override { return EnergyKind::kPrior; }

  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    auto* store = FindStore<RotationStore>(sink);
    for (int j = 0; j < context.graph->num_nodes(); ++j) {
      const BlockRef block = BlockRef::Node(j);
      if (store != nullptr) {
        store->Add();
        sink->AddStored(store, &block, 1, 1.0);
      } else {
        sink->Add(std::unique_ptr<ceres::CostFunction>(RotationCost::Create()), &block, 1);
      }
    }
  }
};

class RegularizationEnergy final : public EnergyTerm {
 public:
  EnergyKind kind() const override { return EnergyKind::kPrior; }

  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    const DeformationGraph& graph = *context.graph;
    auto* store = FindStore<EdgeStore>(sink);
    for (const GraphEdge& edge : graph.edges()) {
      const BlockRef blocks[] = {BlockRef::Node(edge.from), BlockRef::Node(edge.to)};
      const RegularizationCost cost(
          graph.position(edge.from), graph.position(edge.to), edge.weight);
      if (store != nullptr) {
        store->Add(cost);
        sink->AddStored(store, blocks, 2, 1.0);
      } else {
        sink->Add(std::unique_ptr<ceres::CostFunction>(cost.MakeCostFunction()), blocks, 2);
      }
    }
  }
};

class NodePriorEnergy final : public EnergyTerm {
 public:
  EnergyKind kind() const override { return EnergyKind::kPrior; }

  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    if (context.node_prior == nullptr) return;
    for (int j = 0; j < context.graph->num_nodes(); ++j) {
      const BlockRef block = BlockRef::Node(j);
      sink->Add(
          std::unique_ptr<ceres::CostFunction>(NodePriorCost::Create((*context.node_prior)[j])),
          &block,
          1);
    }
  }
};

class PosePriorEnergy final : public EnergyTerm {
 public:
  PosePriorEnergy(double rotation_sigma, double translation_sigma)
      : sqrt_information_(Eigen::Matrix<double, 6, 6>::Zero()) {
    sqrt_information_.diagonal() << Eigen::Vector3d::Constant(1.0 / rotation_sigma),
        Eigen::Vector3d::Constant(1.0 / translation_sigma);
  }

  EnergyKind kind() const override { return EnergyKind::kPrior; }

  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    if (!context.has_camera) return;
    const BlockRef blocks[] = {BlockRef::CameraRotation(), BlockRef::CameraTranslation()};
    sink->Add(
        std::unique_ptr<ceres::CostFunction>(PosePriorCost::Create(
            context.camera_prior.rotation, context.camera_prior.translation, sqrt_information_)),
        blocks,
        2);
  }

 private:
  Eigen::Matrix<double, 6, 6> sqrt_information_;
};

std::unique_ptr<EnergyTerm> MakePosePrior(const ParameterValues& values) {
  constexpr double kRadiansPerDegree = M_PI / 180.0;
  return std::make_unique<PosePriorEnergy>(values.Get("rotation_sigma") * kRadiansPerDegree,
                                           values.Get("translation_sigma"));
}

std::unique_ptr<EnergyTerm> MakePointToPoint(CorrespondenceList list) {
  return MakePointEnergy(list, [](const Correspondence& c) { return PointToPointCost(c.target); });
}

void RegisterOrDie(EnergyRegistry* registry, EnergyInfo info, EnergyRegistry::Factory factory) {
  const Status status = registry->Register(std::move(info), std::move(factory));
  CHECK(status.ok()) << status.message();
}

void RegisterPriors(EnergyRegistry* registry) {
  RegisterOrDie(registry,
                {"rotation",
                 "each node's affine matrix stays near a rotation",
                 "c1.c2, c1.c3, c2.c3, c1.c1-1, c2.c2-1, c3.c3-1 (Eq. 5)",
                 "-",
                 EnergyKind::kPrior,
                 {}},
                [](const ParameterValues&) { return std::make_unique<RotationEnergy>(); });
  RegisterOrDie(registry,
                {"regularization",
                 "neighbouring nodes agree on where each of them goes",
                 "sqrt(alpha_jk) [A_j (g_k - g_j) + g_j + t_j - (g_k + t_k)] (Eq. 6)",
                 "length",
                 EnergyKind::kPrior,
                 {}},
                [](const ParameterValues&) { return std::make_unique<RegularizationEnergy>(); });
  RegisterOrDie(registry,
                {"node_prior",
                 "nodes stay near where they are thought to be",
                 "t_j - t_prior",
                 "length",
                 EnergyKind::kPrior,
                 {}},
                [](const ParameterValues&) { return std::make_unique<NodePriorEnergy>(); });
  RegisterOrDie(
      registry,
      {"pose_prior",
       "the camera stays near where it is thought to be",
       "2 vec(R_prior^-1 R_c) / rotation_sigma, (T_c - T_prior) / translation_sigma",
       "-",
       EnergyKind::kPrior,
       {{"rotation_sigma", ParameterType::kReal, "degree", 1e-9, 360.0, 1.0, "spread of rotation"},
        {"translation_sigma",
         ParameterType::kReal,
         "length",
         1e-12,
         1e12,
         0.01,
         "spread of translation"}}},
      MakePosePrior);
}

void RegisterObservations(EnergyRegistry* registry) {
  RegisterOrDie(
      registry,
      {"point_to_point",
       "warped points come to their matched target points",
       "v~ - v^ (Eq. 7)",
       "length",
       EnergyKind::kObservation,
       {}},
      [](const ParameterValues&) { return MakePointToPoint(&EnergyContext::correspondences); });
  RegisterOrDie(registry,
                {"point_to_plane",
                 "warped points come to the tangent planes of their matched target points",
                 "n . (v~ - v^)",
                 "length",
                 EnergyKind::kObservation,
                 {}},
                [](const ParameterValues&) {
                  return MakePointEnergy(
                      &EnergyContext::correspondences,
                      [](const Correspondence& c) { return PointToPlaneCost(c.target, c.normal); });
                });
  RegisterOrDie(registry,
                {"landmark",
                 "points that the user names come to the places that the user gives",
                 "v~ - v^ (Eq. 7)",
                 "length",
                 EnergyKind::kObservation,
                 {}},
                [](const ParameterValues&) { return MakePointToPoint(&EnergyContext::landmarks); });
}

}  // namespace

void RegisterBuiltinEnergies(EnergyRegistry* registry) {
  RegisterPriors(registry);
  RegisterObservations(registry);
}

}  // namespace ceres_ed
