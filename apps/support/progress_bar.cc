#include "apps/support/progress_bar.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <glog/logging.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

constexpr int kBarWidth = 24;
// Removes the rest of a longer line.
constexpr char kClearToEndOfLine[] = "\x1b[K";

}  // namespace

ProgressBar::ProgressBar(std::string title, int total, bool quiet)
    : title_(std::move(title)), total_(total), visible_(!quiet && isatty(STDERR_FILENO) != 0) {
  CHECK_GT(total, 0);
}

ProgressBar::~ProgressBar() {
  if (visible_) std::fprintf(stderr, "\r%s", kClearToEndOfLine);
}

void ProgressBar::Update(int done, const std::string& note) {
  if (!visible_) return;
  const int filled = kBarWidth * std::clamp(done, 0, total_) / total_;
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  std::fprintf(stderr,
               "\r%s [%s] %d/%d %s%s",
               title_.c_str(),
               bar.c_str(),
               done,
               total_,
               note.c_str(),
               kClearToEndOfLine);
  std::fflush(stderr);
}

}  // namespace ceres_ed
