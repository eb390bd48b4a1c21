// Keeps the camera near an expected pose.
#include <ceres_ed/energy/block_energy.h>
#include <ceres_ed/energy/catalogue/catalogue.h>

#include <cmath>

#include <Eigen/Core>
#include <cost_functions/pose_prior_cost.h>

namespace ceres_ed {

Status RegisterPosePrior(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "pose_prior";
  info.summary = "the camera stays near where it is thought to be";
  info.equation = "2 vec(R_prior^-1 R_c) / rotation_sigma, (T_c - T_prior) / translation_sigma";
  info.unit = "-";
  info.parameters = {
      RealParameter("rotation_sigma", "degree", 1e-9, 360.0, 1.0, "spread of rotation"),
      RealParameter("translation_sigma", "length", 1e-12, 1e12, 0.01, "spread of translation")};
  return registry->Register(info, [](const ParameterValues& values) {
    constexpr double kRadiansPerDegree = M_PI / 180.0;
    Eigen::Matrix<double, 6, 6> sqrt_information = Eigen::Matrix<double, 6, 6>::Zero();
    sqrt_information.diagonal() << Eigen::Vector3d::Constant(
        1.0 / (values.Get("rotation_sigma") * kRadiansPerDegree)),
        Eigen::Vector3d::Constant(1.0 / values.Get("translation_sigma"));
    const auto add = [sqrt_information](const EnergyContext& context, ResidualSink* sink) {
      if (!context.has_camera) return;
      AddBlockResidual(
          sink,
          1.0,
          PosePriorCost(
              context.camera_prior.rotation, context.camera_prior.translation, sqrt_information),
          CameraRotationBlock{},
          CameraTranslationBlock{});
    };
    return MakeEnergy(EnergyKind::kPrior, add);
  });
}

}  // namespace ceres_ed
