// What a program shows while it works: a progress bar, notes and warnings.
#ifndef CERES_ED_APPS_SUPPORT_CONSOLE_H_
#define CERES_ED_APPS_SUPPORT_CONSOLE_H_

#include <ceres_ed/pipeline/run_observer.h>

#include <optional>
#include <string>
#include <utility>

#include <apps/support/program.h>
#include <apps/support/progress_bar.h>

namespace ceres_ed {

// Nothing is ever printed into the progress bar: it is wiped first, and drawn again with the next
// step.
class Console {
 public:
  // `quiet` shows neither the bar, nor notes, nor summaries; warnings are shown all the same.
  Console(std::string program, bool quiet) : program_(std::move(program)), quiet_(quiet) {}

  // Draw a step of the bar, or wipe it.
  void ShowProgress(int done, int total, const std::string& note);
  void WipeProgress();

  // Print "PROGRAM: SENTENCE" and "PROGRAM: warning: SENTENCE" to stderr.
  void Note(const std::string& sentence);
  void Warn(const std::string& sentence);

  // Prints lines to stdout.
  void Summarize(const std::string& lines);

 private:
  std::string program_;
  bool quiet_;
  std::optional<ProgressBar> bar_;
};

// Shows a run on a console; Ctrl-C stops it. `Observer` is RunObserver, or has more.
template <typename Observer = RunObserver>
class ConsoleObserver : public Observer {
 public:
  // As of Console.
  ConsoleObserver(std::string program, bool quiet) : console_(std::move(program), quiet) {}

  void OnNote(const std::string& sentence) override { console_.Note(sentence); }
  void OnWarning(const std::string& sentence) override { console_.Warn(sentence); }
  void OnProgress(int done, int total, const std::string& note) override {
    console_.ShowProgress(done, total, note);
  }
  bool ShouldStop() override { return StopRequested(); }

 protected:
  Console& console() { return console_; }

 private:
  Console console_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_CONSOLE_H_
