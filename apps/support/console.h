// What a program shows during its work: a progress bar, notes and warnings.
#ifndef CERES_ED_APPS_SUPPORT_CONSOLE_H_
#define CERES_ED_APPS_SUPPORT_CONSOLE_H_

#include <ceres_ed/pipeline/run_observer.h>

#include <optional>
#include <string>
#include <utility>

#include <apps/support/program.h>
#include <apps/support/progress_bar.h>

namespace ceres_ed {

// Prints to the terminal. The progress bar is removed before anything is printed, and drawn again
// at the next step.
class Console {
 public:
  // If `quiet`, neither the bar nor notes nor summaries are shown. Warnings are always shown.
  Console(std::string program, bool quiet) : program_(std::move(program)), quiet_(quiet) {}

  // Draw a step of the bar, or remove the bar.
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

// An observer that shows a run on a console. Ctrl-C stops the run. `Observer` is RunObserver, or a
// class that is derived from it.
template <typename Observer = RunObserver>
class ConsoleObserver : public Observer {
 public:
  // The arguments are those of Console.
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
