// A description of each point by the waves that live there.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_WAVE_KERNEL_H_
#define CERES_ED_REGISTRATION_INTRINSIC_WAVE_KERNEL_H_

#include <ceres_ed/registration/intrinsic/eigenfunctions.h>

#include <Eigen/Core>

namespace ceres_ed {

// The wave kernel signature (Aubry, Schlickewei and Cremers 2011): for an energy e,
//   WKS(x, e) = sum_k exp(-(e - log lambda_k)^2 / (2 sigma^2)) phi_k(x)^2 / sum_k exp(...)
// Returns one row for each vertex and one column for each of `count` >= 2 energies, which are
// evenly spread over [log first, log last]; sigma is four of their steps. A bend does not change
// it, and neither does a reflection: left and right have the same signature. `first` and `last` are
// eigenvalues, 0 < first < last; two surfaces that are compared need the same.
Eigen::MatrixXd WaveKernelSignature(const SpectralBasis& basis,
                                    double first,
                                    double last,
                                    int count);

// Divides each column of two signatures by the standard deviation of the first one, so that all
// energies tell points apart equally well.
void ScaleSignatures(Eigen::MatrixXd* first, Eigen::MatrixXd* second);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_WAVE_KERNEL_H_
