// Uses the header-only cost functions: no library of ceres_ed is linked.
#include <cost_functions/node_parameters.h>

int main() {
  double node[ceres_ed::kNodeSize];
  ceres_ed::SetNodeToRest(node);
  return ceres_ed::NodeAffine(node).isIdentity(0.0) ? 0 : 1;
}
