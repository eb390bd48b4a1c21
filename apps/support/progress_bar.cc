#include "apps/support/progress_bar.h"

#include <algorithm>
#include <cmath>
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

std::string TimeLeft(double seconds_gone, int done, int total) {
  if (seconds_gone < 1.0 || done <= 0 || done >= total) return "";
  const double left = seconds_gone * (total - done) / done;
  const long seconds = std::max(1L, std::lround(left));
  if (seconds < 120) return "about " + std::to_string(seconds) + " s left";
  return "about " + std::to_string((seconds + 30) / 60) + " min left";
}

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
  std::string left = TimeLeft(clock_.Seconds(), done, total_);
  if (!left.empty()) left = ", " + left;
  std::fprintf(stderr,
               "\r%s [%s] %d/%d %s%s%s",
               title_.c_str(),
               bar.c_str(),
               done,
               total_,
               note.c_str(),
               left.c_str(),
               kClearToEndOfLine);
  std::fflush(stderr);
}

}  // namespace ceres_ed
