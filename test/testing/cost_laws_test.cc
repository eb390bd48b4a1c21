#include "ceres_ed/testing/cost_laws.h"

#include <ceres_ed/testing/cost_evaluation.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The residual r = (x^2 - y, sin(y) x) over the blocks x (size 1) and y (size 2, the second entry
// has no effect), with faults that a test can choose.
struct Fault {
  bool wrong_jacobian = false;
  bool unwritten_jacobian = false;
  bool overrun = false;
  bool tests_first_block_only = false;
  bool residuals_by_mask = false;
  bool residuals_by_array = false;
  bool nan_at_zero = false;
  bool fails_off_rest = false;
  double offset = 0.0;
};

class FaultyCost final : public ceres::CostFunction {
 public:
  explicit FaultyCost(const Fault& fault) : fault_(fault) {
    set_num_residuals(2);
    *mutable_parameter_block_sizes() = {1, 2};
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const double x = parameters[0][0];
    const double y = parameters[1][0];
    if (fault_.fails_off_rest && x != 1.0) return false;
    residuals[0] = x * x - y + fault_.offset;
    residuals[1] = std::sin(y - 1.0) * x;
    if (fault_.nan_at_zero && x == 0.0) residuals[1] = std::nan("");
    if (fault_.overrun) residuals[2] = 0.0;
    if (fault_.residuals_by_array && jacobians == nullptr) residuals[0] += 1e-6;
    if (jacobians == nullptr) return true;
    if (fault_.residuals_by_mask && jacobians[1] == nullptr) residuals[0] += 1e-15;
    if (jacobians[0] != nullptr) {
      jacobians[0][0] = 2.0 * x + (fault_.wrong_jacobian ? 1e-6 : 0.0);
      jacobians[0][1] = std::sin(y - 1.0);
    }
    if (jacobians[1] != nullptr && !(fault_.tests_first_block_only && jacobians[0] == nullptr)) {
      jacobians[1][0] = -1.0;
      jacobians[1][1] = 0.0;
      jacobians[1][2] = std::cos(y - 1.0) * x;
      if (!fault_.unwritten_jacobian) jacobians[1][3] = 0.0;
    }
    return true;
  }

 private:
  Fault fault_;
};

CostClaims Claims() {
  CostClaims claims;
  claims.rest = {{1.0}, {1.0, 5.0}};
  return claims;
}

std::vector<std::string> Check(const Fault& fault) {
  return CheckCostLaws(FaultyCost(fault), Claims());
}

TEST(CheckCostLaws, FindsNothingWrongWithARightCost) { EXPECT_THAT(Check({}), IsEmpty()); }

TEST(CheckCostLaws, FindsAWrongJacobian) {
  Fault fault;
  fault.wrong_jacobian = true;
  EXPECT_THAT(Check(fault),
              Contains(AllOf(HasSubstr("at rest: the Jacobian of block 0 is 2.000001"),
                             HasSubstr("residual 0, parameter 0, expected 2 "))));
}

TEST(CheckCostLaws, FindsAnEntryThatIsNotWritten) {
  Fault fault;
  fault.unwritten_jacobian = true;
  EXPECT_THAT(Check(fault), Contains(HasSubstr("not all are written")));
}

TEST(CheckCostLaws, FindsWritingBehindTheEnd) {
  Fault fault;
  fault.overrun = true;
  EXPECT_THAT(Check(fault), Contains(HasSubstr("written behind the end")));
}

TEST(CheckCostLaws, FindsACostThatTestsTheFirstJacobianOnly) {
  Fault fault;
  fault.tests_first_block_only = true;
  EXPECT_THAT(Check(fault), Contains(HasSubstr("when blocks (0) are held constant")));
}

TEST(CheckCostLaws, FindsResidualsThatDependOnWhatIsAskedFor) {
  Fault by_mask;
  by_mask.residuals_by_mask = true;
  EXPECT_THAT(Check(by_mask), Contains(HasSubstr("are held constant")));
  Fault by_array;
  by_array.residuals_by_array = true;
  EXPECT_THAT(Check(by_array), Contains(HasSubstr("when no Jacobians are asked for")));
}

TEST(CheckCostLaws, FindsValuesThatAreNotFinite) {
  Fault fault;
  fault.nan_at_zero = true;
  EXPECT_THAT(Check(fault), Contains(HasSubstr("at all parameters zero: residuals")));
}

TEST(CheckCostLaws, FindsAnEvaluationThatFails) {
  Fault fault;
  fault.fails_off_rest = true;
  EXPECT_THAT(Check(fault), Contains(HasSubstr("near rest, state 1: the evaluation fails")));
}

TEST(CheckCostLaws, FindsACostThatIsNotZeroAtRest) {
  Fault fault;
  fault.offset = 0.5;
  EXPECT_THAT(Check(fault), Contains(HasSubstr("at rest: |r|^2 is 0.25, expected 0")));
}

TEST(CheckCostLaws, FindsAStateBelowTheClaimedMinimum) {
  Fault fault;
  fault.offset = 0.5;
  CostClaims claims = Claims();
  claims.squared_norm_at_rest = 0.25;
  EXPECT_THAT(CheckCostLaws(FaultyCost(fault), claims),
              Contains(HasSubstr("less than the 0.25 at rest")));
  claims.squared_norm_at_rest.reset();
  EXPECT_THAT(CheckCostLaws(FaultyCost(fault), claims), IsEmpty());
}

TEST(CheckCostLaws, FindsAnInvarianceThatDoesNotHold) {
  CostClaims claims = Claims();
  claims.invariances.push_back(
      {"a change of the idle parameter", [](ParameterBlocks* b) { (*b)[1][1] += 7.0; }});
  EXPECT_THAT(CheckCostLaws(FaultyCost({}), claims), IsEmpty());
  claims.invariances.push_back({"a shift of x", [](ParameterBlocks* b) { (*b)[0][0] += 0.1; }});
  EXPECT_THAT(CheckCostLaws(FaultyCost({}), claims), Contains(HasSubstr("under a shift of x")));
}

TEST(CheckCostLaws, FindsBlockSizesOfAnotherState) {
  CostClaims claims = Claims();
  claims.rest = {{1.0}, {1.0}};
  EXPECT_THAT(CheckCostLaws(FaultyCost({}), claims),
              Contains(HasSubstr("block sizes are (1, 2), expected")));
}

TEST(NumericJacobian, EqualsTheClosedFormToTenDigits) {
  const RowMajorMatrix J = NumericJacobian(FaultyCost({}), {{0.7}, {0.2, 0.0}}, 1, 1e-2);
  EXPECT_NEAR(J(0, 0), -1.0, 1e-11);
  EXPECT_NEAR(J(1, 0), 0.7 * std::cos(0.2 - 1.0), 1e-11);
  EXPECT_NEAR(J(1, 1), 0.0, 1e-11);
}

}  // namespace
}  // namespace ceres_ed
