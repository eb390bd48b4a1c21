// The part of NormalEquations that determines where products are added, and that divides the
// residuals among tasks.
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace ceres_ed {
namespace {

// The largest number of tasks. More tasks would share more entries.
constexpr int kMaxTasks = 4;
// The work of distributing the sums of a group to its blocks, and the smallest work for which a
// task is useful. Both are in units of the work for one point.
constexpr int kGroupWork = 8;
constexpr std::int64_t kMinTaskWork = 500;
// The number of strips from which tasks are formed.
constexpr int kNumBins = 256;

// The factor splits a node into its affine matrix and its translation.
static_assert(kNodeSize == kSplitBlockSize && kNodeTranslationOffset == kSplitOffset);

constexpr int kUnowned = -1;
constexpr int kSharedEntry = -2;

}  // namespace

void NormalEquations::AddSlot(int a, int b, bool affine) {
  Slot slot;
  slot.affine = affine;
  if (a >= 0 && b >= 0) {
    slot.row = std::max(a, b);
    slot.column = std::min(a, b);
  }
  slots_.push_back(slot);
}

void NormalEquations::AddGroupSlots(const PointGroup& group, const DeformationGraph& graph) {
  const auto first = static_cast<int>(group_blocks_.size());
  for (int a = 0; a < group.num_nodes; ++a) {
    const int node = points_.nodes(group)[a];
    group_blocks_.push_back(block_of_node_[node]);
    group_positions_.push_back(graph.position(node));
    if (num_dual_points_ > 0) {
      AddSlot(group_blocks_.back(), group_blocks_.back(), true);
      continue;
    }
    for (int b = 0; b <= a; ++b) AddSlot(group_blocks_[first + a], group_blocks_[first + b], true);
  }
  if (num_dual_points_ > 0) AddDualSlots(group);
  if (!VariesCamera(group)) return;
  for (int a = 0; a < group.num_nodes; ++a) {
    AddSlot(num_variable_nodes(), group_blocks_[first + a], true);
  }
  AddSlot(num_variable_nodes(), num_variable_nodes(), true);
}

// Returns how many slots AddSlots() adds.
std::size_t NormalEquations::NumSlots() const {
  std::size_t count = 3 * edges_.size() + rotations_.size();
  for (const PointGroup& group : points_.groups()) count += NumGroupSlots(group);
  for (const Item& item : items_) count += NumItemSlots(item);
  return count;
}

void NormalEquations::AddSlots(const DeformationGraph& graph) {
  group_slots_.clear();
  group_blocks_.clear();
  group_positions_.clear();
  slots_.reserve(NumSlots());
  for (const PointGroup& group : points_.groups()) {
    group_slots_.push_back(static_cast<int>(slots_.size()));
    AddGroupSlots(group, graph);
  }
  for (Edge& edge : edges_) {
    edge.first_slot = static_cast<int>(slots_.size());
    AddSlot(edge.blocks[0], edge.blocks[0], true);
    AddSlot(edge.blocks[1], edge.blocks[0], false);
    AddSlot(edge.blocks[1], edge.blocks[1], true);
  }
  for (Rotation& rotation : rotations_) {
    rotation.slot = static_cast<int>(slots_.size());
    AddSlot(rotation.block, rotation.block, true);
  }
  for (Item& item : items_) {
    item.first_slot = static_cast<int>(slots_.size());
    const Part* parts = &parts_[item.first_part];
    if (item.num_dual > 0) {
      AddDualItemSlots(item);
      continue;
    }
    for (int a = 0; a < item.num_parts; ++a) {
      for (int b = 0; b <= a; ++b) {
        AddSlot(parts[a].block, parts[b].block, parts[a].affine && parts[b].affine);
      }
    }
  }
}

int NormalEquations::NumGroupSlots(const PointGroup& group) const {
  const int n = group.num_nodes;
  if (num_dual_points_ > 0) return n * (1 + group.num_points);
  return n * (n + 1) / 2 + (VariesCamera(group) ? n + 1 : 0);
}

// Divides the residuals among tasks of equal work. The tasks are strips across the longest axis of
// the graph, so that neighbouring tasks share few entries.
void NormalEquations::DealOut(const DeformationGraph& graph) {
  Eigen::AlignedBox3d box;
  for (const int node : variable_nodes_) box.extend(graph.position(node));
  int axis = 0;
  if (!box.isEmpty()) box.sizes().maxCoeff(&axis);
  const double bins_per_unit = box.isEmpty() ? 0.0 : kNumBins / std::max(box.sizes()[axis], 1e-300);
  const auto bin_of = [&](int node) {
    if (box.isEmpty()) return 0;
    const double place = (graph.position(node)[axis] - box.min()[axis]) * bins_per_unit;
    return static_cast<int>(std::clamp(place, 0.0, kNumBins - 1.0));
  };
  const auto item_bin = [&](const Item& item) {
    const BlockRef& block = item.residual.blocks[0];
    return block.kind == BlockRef::Kind::kNode ? bin_of(block.node) : 0;
  };
  // The work in each strip.
  std::array<std::int64_t, kNumBins> work{};
  for (const PointGroup& group : points_.groups()) {
    work[bin_of(points_.nodes(group)[0])] += group.num_points + kGroupWork;
  }
  for (const Edge& edge : edges_) ++work[bin_of(edge.nodes[0])];
  for (const Rotation& rotation : rotations_) ++work[bin_of(rotation.node)];
  for (const Item& item : items_) work[item_bin(item)] += 1 + NumItemSlots(item);
  std::int64_t total = 0;
  for (const std::int64_t w : work) total += w;
  const int num_tasks =
      static_cast<int>(std::clamp<std::int64_t>(total / kMinTaskWork, 1, kMaxTasks));
  // Consecutive strips of about the same total work form a task.
  std::array<int, kNumBins> task_of_bin{};
  std::int64_t before = 0;
  for (int i = 0; i < kNumBins; ++i) {
    task_of_bin[i] = total > 0 ? static_cast<int>(before * num_tasks / total) : 0;
    before += work[i];
    task_of_bin[i] = std::min(task_of_bin[i], num_tasks - 1);
  }
  tasks_.resize(num_tasks);
  for (Task& task : tasks_) task.Clear();
  for (std::size_t g = 0; g < points_.groups().size(); ++g) {
    const int bin = bin_of(points_.nodes(points_.groups()[g])[0]);
    tasks_[task_of_bin[bin]].groups.push_back(static_cast<int>(g));
  }
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    tasks_[task_of_bin[bin_of(edges_[i].nodes[0])]].edges.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < rotations_.size(); ++i) {
    tasks_[task_of_bin[bin_of(rotations_[i].node)]].rotations.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < items_.size(); ++i) {
    tasks_[task_of_bin[item_bin(items_[i])]].items.push_back(static_cast<int>(i));
  }
}

std::vector<BlockPair> NormalEquations::BlockPairs() const {
  std::vector<BlockPair> pairs;
  for (const Slot& slot : slots_) {
    if (slot.row > slot.column) pairs.push_back({slot.row, slot.column, slot.affine});
  }
  return BlockStructure(BlockSizes(), pairs).Pairs();
}

bool NormalEquations::SetStructure(const BlockStructure* structure) {
  structure_ = nullptr;
  for (Slot& slot : slots_) {
    if (slot.row < 0) continue;
    slot.entry = structure->FindEntry(slot.row, slot.column);
    if (slot.entry < 0 || (slot.affine && !structure->head_pair(slot.entry))) return false;
  }
  structure_ = structure;
  FindTargets(*structure);
  return true;
}

template <typename Visitor>
void NormalEquations::ForEachSlot(const Task& task, const Visitor& visitor) {
  const auto visit = [&](int first, int count) {
    for (int slot = first; slot < first + count; ++slot) {
      if (slots_[slot].row >= 0) visitor(&slots_[slot]);
    }
  };
  for (const int g : task.groups) visit(group_slots_[g], NumGroupSlots(points_.groups()[g]));
  for (const int i : task.edges) visit(edges_[i].first_slot, 3);
  for (const int i : task.rotations) visit(rotations_[i].slot, 1);
  for (const int i : task.items) visit(items_[i].first_slot, NumItemSlots(items_[i]));
}

// If only one task uses an entry, the sums are added in place. Otherwise each of its tasks has a
// place for the entry in the shared memory; for a diagonal block the gradient follows the values.
void NormalEquations::FindTargets(const BlockStructure& structure) {
  shares_.clear();
  shared_size_ = 0;
  std::vector<int> owners(structure.num_entries(), kUnowned);
  for (int t = 0; t < static_cast<int>(tasks_.size()); ++t) {
    ForEachSlot(tasks_[t], [&](Slot* slot) {
      int& owner = owners[slot->entry];
      owner = owner == kUnowned || owner == t ? t : kSharedEntry;
    });
  }
  std::vector<std::ptrdiff_t> places(structure.num_entries());
  std::vector<int> placed_for(structure.num_entries(), -1);
  const auto num_values = static_cast<std::ptrdiff_t>(structure.num_values());
  for (int t = 0; t < static_cast<int>(tasks_.size()); ++t) {
    ForEachSlot(tasks_[t], [&](Slot* slot) {
      const int entry = slot->entry;
      if (owners[entry] != kSharedEntry) {
        slot->target = static_cast<std::ptrdiff_t>(structure.value_offset(entry));
        return;
      }
      if (placed_for[entry] != t) {
        placed_for[entry] = t;
        places[entry] = static_cast<std::ptrdiff_t>(shared_size_);
        shares_.push_back({entry, slot->row, slot->column, places[entry]});
        const int size = structure.size(slot->row);
        shared_size_ += static_cast<std::size_t>(size) * structure.size(slot->column);
        if (slot->row == slot->column) shared_size_ += size;
      }
      slot->target = num_values + places[entry];
    });
  }
}

}  // namespace ceres_ed
