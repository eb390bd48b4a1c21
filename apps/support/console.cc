#include "apps/support/console.h"

#include <ceres_ed/util/shown_text.h>

#include <cstdio>

namespace ceres_ed {

void Console::ShowProgress(int done, int total, const std::string& note) {
  if (!bar_.has_value() || bar_->total() != total) bar_.emplace(program_, total, quiet_);
  bar_->Update(done, ShownText(note));
}

void Console::WipeProgress() { bar_.reset(); }

void Console::Note(const std::string& sentence) {
  if (quiet_) return;
  WipeProgress();
  std::fprintf(stderr, "%s: %s\n", program_.c_str(), ShownText(sentence).c_str());
}

void Console::Warn(const std::string& sentence) {
  WipeProgress();
  std::fprintf(stderr, "%s: warning: %s\n", program_.c_str(), ShownText(sentence).c_str());
}

void Console::Summarize(const std::string& lines) {
  if (quiet_) return;
  WipeProgress();
  std::fputs(ShownText(lines).c_str(), stdout);
}

}  // namespace ceres_ed
