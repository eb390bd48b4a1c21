#include "ceres_ed/solver/decoupling/active_set.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ceres_ed {

int ActiveSet::Look(const SolvedLevelOne& level) {
  held_share_ = std::numeric_limits<double>::quiet_NaN();
  // Only the motion of the PR nodes counts: the PI nodes are put back.
  std::vector<char> mask = level.candidates;
  DeformationState put_back = *level.after;
  for (std::size_t j = 0; j < mask.size(); ++j) {
    if (level.moved_hidden[j] == 0) continue;
    mask[j] = 1;
    const int node = static_cast<int>(j);
    std::copy_n(level.before->node(node), kNodeSize, put_back.node(node));
  }
  if (!frontier_.Evaluate(*level.builder, mask, *level.before, put_back, level.num_threads)) {
    return 0;
  }
  const std::vector<int>& places = frontier_.nodes();
  const double product = bound_ * level.energy;
  // An infinite bound times no energy is not a number.
  const double budget = std::isnan(product) ? 0.0 : product;
  const FrontierSearch search = frontier_.Search(budget);
  double held = search.left;
  for (const ReleasedNode& released : search.released) {
    if (level.moved_hidden[places[released.place]] == 0) held += released.gain;
  }
  if (level.energy > 0.0) held_share_ = held / level.energy;

  const auto name = [&](int place) {
    return level.names != nullptr ? (*level.names)[places[place]] : places[place];
  };
  std::vector<int> chosen;
  chosen.reserve(search.released.size());
  for (const ReleasedNode& released : search.released) chosen.push_back(name(released.place));
  int num_new = 0;
  for (const int node : chosen) num_new += nodes_.Has(node) ? 0 : 1;
  if (is_new_frame_) {
    nodes_.Clear();
    judged_.Clear();
    moves_unjudged_ = false;
    is_new_frame_ = false;
  }
  for (const int node : chosen) nodes_.Add(node);
  for (int i = 0; i < static_cast<int>(places.size()); ++i) judged_.Add(name(i));
  if (!search.released.empty() && search.MeanOfPushed() >= search.released.back().decrement) {
    moves_unjudged_ = true;
  }
  nodes_.Sort();
  judged_.Sort();
  return num_new;
}

void ActiveSet::Clear() {
  nodes_.Clear();
  judged_.Clear();
  moves_unjudged_ = is_new_frame_ = false;
  held_share_ = std::numeric_limits<double>::quiet_NaN();
}

void ActiveSet::Load(const Contents& contents) {
  Clear();
  for (const int node : contents.nodes) {
    if (node >= 0) nodes_.Add(node);
  }
  for (const int node : contents.judged) {
    if (node >= 0) judged_.Add(node);
  }
  moves_unjudged_ = contents.moves_unjudged != 0;
}

}  // namespace ceres_ed
