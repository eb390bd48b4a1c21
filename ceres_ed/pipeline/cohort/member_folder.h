// The folders of the results of members, each of which appears whole and at once.
#ifndef CERES_ED_PIPELINE_COHORT_MEMBER_FOLDER_H_
#define CERES_ED_PIPELINE_COHORT_MEMBER_FOLDER_H_

#include <ceres_ed/util/status.h>

#include <set>
#include <string>

namespace ceres_ed {

// Returns OUTPUT/members/NAME, where the results of a member are.
std::string MemberPath(const std::string& output, const std::string& name);

// The folder in which a process works on one member: OUTPUT/.work/HOST.PID.NAME. No two processes
// have the same one. After Commit() it is the folder of the member; otherwise the destructor
// removes it.
class MemberFolder {
 public:
  // Makes the folder. The error gives the system's reason.
  static StatusOr<MemberFolder> Create(const std::string& output, const std::string& name);
  ~MemberFolder();
  MemberFolder(MemberFolder&& other) noexcept;
  MemberFolder(const MemberFolder&) = delete;
  MemberFolder& operator=(const MemberFolder&) = delete;
  MemberFolder& operator=(MemberFolder&&) = delete;

  // Returns the path of a file in the folder.
  std::string File(const std::string& name) const { return path_ + "/" + name; }

  // Renames the folder to MemberPath(). What was there before is replaced. A process that is killed
  // leaves the old results, the new ones, or (between two renames) none.
  Status Commit();

 private:
  MemberFolder() = default;

  std::string path_;
  std::string final_path_;
};

// Removes the folders in which processes of this machine worked that are no more, and returns the
// names of their members: something may be wrong with these.
std::set<std::string> RemoveAbandonedWork(const std::string& output);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_MEMBER_FOLDER_H_
