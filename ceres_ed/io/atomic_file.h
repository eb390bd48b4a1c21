// Files that are replaced as a whole: a reader sees the old file or the complete new one.
#ifndef CERES_ED_IO_ATOMIC_FILE_H_
#define CERES_ED_IO_ATOMIC_FILE_H_

#include <ceres_ed/util/status.h>

#include <memory>
#include <ostream>
#include <string>
#include <string_view>

namespace ceres_ed {

// A file that is being written. The bytes go to a temporary file in the same directory. Commit()
// renames it to `path`; without Commit(), the destructor removes it. A symbolic link is followed. A
// device or pipe (/dev/stdout) is written to directly, since it can't be renamed.
class AtomicFile {
 public:
  // Opens the file. The error names `path` and the reason why it can't be written.
  static StatusOr<std::unique_ptr<AtomicFile>> Create(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Returns the stream for the contents. Its state need not be checked: Commit() reports a failed
  // write.
  std::ostream& stream();

  // Completes the file: after success `path` has everything that was written to stream(). Otherwise
  // the error gives the system's reason (for example a full disk), and the old file is unchanged.
  // Call it at most once.
  Status Commit();

 private:
  class Buffer;
  AtomicFile();

  std::string path_;
  std::string final_path_;
  // Empty if the file is written to directly.
  std::string temporary_path_;
  std::unique_ptr<Buffer> buffer_;
  std::unique_ptr<std::ostream> stream_;
};

// Returns ".tmp.HOST.PID", with which the names of temporary files go on after the name of the file
// that they become.
std::string TemporaryEnding();

// Removes the temporary files that processes of this machine have left in a folder when they were
// killed. Files of processes at work, and of other machines, stay. Call it before this process
// writes there.
void RemoveAbandonedFiles(const std::string& folder);

// Writes `contents` to `path` by an AtomicFile, with its errors.
Status WriteFileAtomically(const std::string& path, std::string_view contents);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_ATOMIC_FILE_H_
