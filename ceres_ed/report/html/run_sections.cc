#include "ceres_ed/report/html/run_sections.h"

#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/report/html/svg_plot.h>
#include <ceres_ed/report/view/number_text.h>

#include <set>
#include <string>
#include <vector>

namespace ceres_ed {

using nlohmann::ordered_json;

namespace {

// Returns the texts of a list.
std::vector<std::string> TextsOf(const ordered_json& list) {
  std::vector<std::string> texts;
  if (!list.is_array()) return texts;
  for (const ordered_json& text : list) texts.push_back(ValueText(text));
  return texts;
}

std::string GradeInWords(const std::string& grade) {
  if (grade == "good") return "Good: nothing speaks against this result.";
  if (grade == "doubtful") return "Doubtful: look at this result before you use it.";
  if (grade == "bad") return "Bad: do not use this result as it is.";
  return grade;
}

}  // namespace

void AddVerdict(const ordered_json& report, HtmlPage* page) {
  const std::string grade = TextOf(report, {"verdict", "grade"});
  if (!grade.empty()) {
    const bool is_known = grade == "good" || grade == "doubtful" || grade == "bad";
    page->Notice(is_known ? grade : "note", "Verdict.", GradeInWords(grade));
    const ordered_json& reasons = MemberOf(report, {"verdict", "reasons"});
    HtmlTable table = {"Reasons of the verdict", {"reason", "value", "better beyond"}, {}, 1};
    if (reasons.is_array()) {
      for (const ordered_json& reason : reasons) {
        table.rows.push_back({TextOf(reason, {"text"}),
                              ValueText(MemberOf(reason, {"value"}), 3),
                              ValueText(MemberOf(reason, {"bound"}), 3)});
      }
    }
    page->Table(table);
    const std::vector<std::string> advice = TextsOf(MemberOf(report, {"verdict", "advice"}));
    if (!advice.empty()) page->Paragraph("What you can try:");
    page->List(advice);
  }
  for (const std::string& warning : TextsOf(MemberOf(report, {"warnings"}))) {
    page->Notice("doubtful", "Warning.", warning);
  }
}

void AddTimes(const ordered_json& report, HtmlPage* page) {
  const ordered_json& times = MemberOf(report, {"time_s"});
  if (!times.is_object()) return;
  std::vector<PlotBar> bars;
  HtmlTable table = {"Time of each stage in seconds", {"stage", "seconds"}, {}, 1};
  for (const auto& [name, value] : times.items()) {
    if (!value.is_number()) continue;
    const double seconds = value.get<double>();
    table.rows.push_back({name, ShortNumber(seconds)});
    if (name != "total" && seconds > 0.0)
      bars.push_back({name, seconds, ShortNumber(seconds) + " s"});
  }
  page->Section("Time");
  page->Plot(
      BarPlot({"", "", "Bars of the seconds of each stage; the table has the figures"}, bars),
      "Time by stage; " + ShortNumber(NumberOf(times, {"total"})) + " s in all, with " +
          ValueText(MemberOf(report, {"threads"})) + " threads.");
  page->FoldedTable("Figures of the times", table);
}

void AddFrameTimes(const ordered_json& report, HtmlPage* page) {
  const ordered_json& times = MemberOf(report, {"time_s"});
  if (!times.is_object()) return;
  constexpr double kMilli = 1000.0;
  std::vector<PlotBar> bars;
  HtmlTable table = {
      "Time of each stage of a frame in milliseconds", {"stage", "median", "mean", "max"}, {}, 1};
  for (const auto& [name, stage] : times.items()) {
    if (!stage.is_object()) continue;
    const double mean = kMilli * NumberOf(stage, {"mean"});
    table.rows.push_back({name,
                          ShortNumber(kMilli * NumberOf(stage, {"median"})),
                          ShortNumber(mean),
                          ShortNumber(kMilli * NumberOf(stage, {"max"}))});
    if (name != "t_total" && mean > 0.0) bars.push_back({name, mean, ShortNumber(mean) + " ms"});
  }
  page->Section("Time");
  const ordered_json& latency = MemberOf(report, {"latency_ms"});
  page->Plot(
      BarPlot({"", "", "Bars of the mean time of each stage of a frame; the table has the figures"},
              bars),
      "Mean time of a frame by stage; " + ShortNumber(NumberOf(times, {"total"})) +
          " s in all, with " + ValueText(MemberOf(report, {"threads"})) +
          " threads. From the pictures to the result of a frame: " +
          ValueText(MemberOf(latency, {"p50"}), 3) + " ms in the median, " +
          ValueText(MemberOf(latency, {"p95"}), 3) + " ms at 95 %.");
  page->Table(table);
}

void AddChecks(const ordered_json& report, HtmlPage* page) {
  const ordered_json& checks = MemberOf(report, {"checks"});
  if (!checks.is_array() || checks.empty()) return;
  page->Section("Checks of the inputs");
  HtmlTable table = {"What the checks have found", {"kind", "finding", "what to do"}, {}, 3};
  for (const ordered_json& check : checks) {
    table.rows.push_back(
        {TextOf(check, {"severity"}), TextOf(check, {"text"}), TextOf(check, {"fix"})});
  }
  page->Table(table);
}

void AddFlags(const ordered_json& report, HtmlPage* page) {
  const ordered_json& flags = MemberOf(report, {"flags"});
  const std::string command = TextOf(report, {"command"});
  if (!flags.is_object() && command.empty()) return;
  page->Section("Command and flags");
  if (!command.empty()) {
    page->Paragraph("This command repeats the run, from the folder in which it was started:");
    page->Code(command);
  }
  if (!flags.is_object()) return;
  std::set<std::string> given;
  for (const std::string& name : TextsOf(MemberOf(report, {"flags_given"}))) given.insert(name);
  HtmlTable table = {"All flags", {"flag", "value", "given"}, {}, 3};
  for (const auto& [name, value] : flags.items()) {
    table.rows.push_back(
        {"--" + name, FlagText(value), given.count(name) > 0 ? "given" : "default"});
  }
  page->FoldedTable("All " + std::to_string(table.rows.size()) + " flags", table);
}

}  // namespace ceres_ed
