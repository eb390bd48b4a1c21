#include "ceres_ed/pipeline/cohort/collected_member.h"

#include <ceres_ed/pipeline/cohort/member_folder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <system_error>
#include <utility>

namespace ceres_ed {
namespace {

// Adds the members of a folder that are not known yet.
void AddMembers(const CohortIndex& index,
                std::map<std::string, std::size_t>* rows,
                CollectedMembers* all) {
  for (const CohortMember& member : index.members) {
    if (!rows->emplace(member.name, all->members.size()).second) continue;
    CollectedMember collected;
    collected.member = member;
    collected.member.row = static_cast<int>(all->members.size());
    collected.record.name = member.name;
    collected.record.message = "it has not been run";
    all->members.push_back(std::move(collected));
  }
}

// Reads the record of a member in a folder, if it is there and better than what is known.
void TakeRecord(const std::string& folder, const std::string& shared_key, CollectedMember* member) {
  if (member->record.state == MemberState::kDone) return;
  const std::string path = MemberPath(folder, member->member.name);
  std::error_code ignored;
  if (!std::filesystem::exists(path + "/record.json", ignored)) return;
  StatusOr<MemberRecord> record = ReadRecord(path + "/record.json");
  if (!record.ok()) {
    member->record.message = record.status().message();
    return;
  }
  if (record->shared_key != shared_key) {
    member->record.message = path + " was made with another template or other flags";
    return;
  }
  if (record->state == MemberState::kMissing) return;
  member->record = *std::move(record);
  member->folder = path;
}

// Returns what orders members; smaller is worse. Times are no part of it.
std::array<double, 4> Order(const MemberRecord& record) {
  double rank = 1.0;
  if (record.state == MemberState::kFailed) rank = 0.0;
  if (record.state == MemberState::kDone) rank = 4.0 - static_cast<double>(record.grade);
  const auto descending = [](double value) { return std::isfinite(value) ? -value : 0.0; };
  const double unmatched =
      std::max(std::isfinite(record.unmatched_source) ? record.unmatched_source : 0.0,
               std::isfinite(record.unmatched_target) ? record.unmatched_target : 0.0);
  return {rank, -unmatched, descending(record.landmark_rms), descending(record.stretch)};
}

}  // namespace

int CollectedMembers::Count(MemberState state) const {
  return static_cast<int>(std::count_if(
      members.begin(), members.end(), [state](const auto& m) { return m.record.state == state; }));
}

int CollectedMembers::Count(Grade grade) const {
  return static_cast<int>(std::count_if(members.begin(), members.end(), [grade](const auto& m) {
    return m.record.state == MemberState::kDone && m.record.grade == grade;
  }));
}

StatusOr<CollectedMembers> ReadMembers(const std::vector<std::string>& folders) {
  CollectedMembers all;
  std::map<std::string, std::size_t> rows;
  for (const std::string& folder : folders) {
    StatusOr<CohortIndex> index = ReadCohortIndex(folder);
    if (!index.ok()) return index.status();
    if (&folder == &folders.front()) all.index = *index;
    if (index->kind != all.index.kind) {
      return Status::Error(folder + ": has " + NameOf(index->kind) + ", expected " +
                           NameOf(all.index.kind) + " as in " + folders.front());
    }
    AddMembers(*index, &rows, &all);
  }
  for (const std::string& folder : folders) {
    for (CollectedMember& member : all.members) {
      TakeRecord(folder, all.index.shared_key, &member);
    }
  }
  return all;
}

std::vector<int> WorstFirst(const std::vector<CollectedMember>& members) {
  std::vector<std::array<double, 4>> order;
  order.reserve(members.size());
  for (const CollectedMember& member : members) order.push_back(Order(member.record));
  std::vector<int> numbers(members.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  std::stable_sort(
      numbers.begin(), numbers.end(), [&order](int a, int b) { return order[a] < order[b]; });
  return numbers;
}

}  // namespace ceres_ed
