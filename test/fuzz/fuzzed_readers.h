// The readers of files that a user may give, as the fuzzer and the replay of its corpus call them.
#ifndef CERES_ED_TEST_FUZZ_FUZZED_READERS_H_
#define CERES_ED_TEST_FUZZ_FUZZED_READERS_H_

#include <string>
#include <vector>

namespace ceres_ed {

struct FuzzedReader {
  // The name of its folder in corpus/.
  const char* name;
  // The ending of the file that it reads, with the dot.
  const char* ending;
  // Reads `path`, and returns what is wrong with the outcome; empty if nothing is. An error must be
  // one printable line that names the file. What was read and can be written must be the same after
  // it was written and read again; `scratch` is a path for that.
  std::string (*fault)(const std::string& path, const std::string& scratch);
};

// Returns all readers, in the order of their names.
const std::vector<FuzzedReader>& FuzzedReaders();

// Returns the reader of that name, or null.
const FuzzedReader* FindFuzzedReader(const std::string& name);

// Writes `bytes` to a file of this process, which is removed at its end, has it read, and returns
// the fault. Not for several threads.
std::string FaultOfBytes(const FuzzedReader& reader, const std::string& bytes);

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_FUZZ_FUZZED_READERS_H_
