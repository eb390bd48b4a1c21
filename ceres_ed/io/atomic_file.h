// Files that are either the old one or the complete new one, never half of each.
#ifndef CERES_ED_IO_ATOMIC_FILE_H_
#define CERES_ED_IO_ATOMIC_FILE_H_

#include <ceres_ed/util/status.h>

#include <memory>
#include <ostream>
#include <string>
#include <string_view>

namespace ceres_ed {

// A file under construction. Bytes go to a temporary name in the same directory; Commit() renames
// it to `path`, and the destructor removes it where there was no Commit(). A symbolic link is
// followed; a device or pipe (/dev/stdout) is written to directly, for there is nothing to rename.
class AtomicFile {
 public:
  // Returns the open file, or an error that names `path` and why it can't be written.
  static StatusOr<std::unique_ptr<AtomicFile>> Create(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Where the contents go. Its state need not be checked: Commit() reports a failed write.
  std::ostream& stream();

  // Returns ok when `path` holds everything written to stream(); else an error with the system's
  // reason (disk full ...), and the old file is as it was. To be called once at most.
  Status Commit();

 private:
  class Buffer;
  AtomicFile();

  std::string path_;
  std::string final_path_;
  // Empty when the file is written to directly.
  std::string temporary_path_;
  std::unique_ptr<Buffer> buffer_;
  std::unique_ptr<std::ostream> stream_;
};

// Returns ok when `path` holds exactly `contents`; else an error as of AtomicFile.
Status WriteFileAtomically(const std::string& path, std::string_view contents);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_ATOMIC_FILE_H_
