// A libFuzzer target. The option --reader=NAME tells which reader gets the bytes
// (fuzzed_readers.h).
#include "fuzzed_readers.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

const ceres_ed::FuzzedReader* reader = nullptr;

}  // namespace

// libFuzzer itself ignores options that begin with two dashes.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string option = "--reader=";
  for (int i = 1; i < *argc; ++i) {
    const std::string argument = (*argv)[i];
    if (argument.compare(0, option.size(), option) == 0) {
      reader = ceres_ed::FindFuzzedReader(argument.substr(option.size()));
    }
  }
  if (reader != nullptr) return 0;
  std::fprintf(stderr, "fuzz_reader: --reader=NAME is missing or unknown, expected one of:");
  for (const ceres_ed::FuzzedReader& known : ceres_ed::FuzzedReaders()) {
    std::fprintf(stderr, " %s", known.name);
  }
  std::fprintf(stderr, "\n");
  std::exit(1);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string fault =
      FaultOfBytes(*reader, std::string(reinterpret_cast<const char*>(data), size));
  if (fault.empty()) return 0;
  std::fprintf(stderr, "%s: %s\n", reader->name, fault.c_str());
  std::abort();
}
