#include "small_fit.h"

#include <ceres_ed/report/html/assets.h>
#include <ceres_ed/report/html/comparison_page.h>
#include <ceres_ed/report/html/evidence_words.h>
#include <ceres_ed/report/html/fit_page.h>
#include <ceres_ed/report/html/page.h>
#include <ceres_ed/report/html/viewer.h>

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;
// Pages are too long to be printed.
bool Has(const std::string& page, const std::string& part) {
  return page.find(part) != std::string::npos;
}

// A text that breaks out of a page at every place where it is not escaped.
const std::string kEvil =
    "</script><script>window.evil=1</script><img src=x onerror=evil()>\"' onload=evil() "
    "\x1b\x01\xff"
    "\xE2\x80\xA8.ply";

ordered_json EvilReport() {
  ordered_json report = {{"program", kEvil},
                         {"status", kEvil},
                         {"message", kEvil},
                         {"command", kEvil},
                         {"source", {{"path", kEvil}, {"points", kEvil}}},
                         {"target", {{"path", kEvil}}},
                         {"verdict",
                          {{"grade", kEvil},
                           {"reasons", {{{"text", kEvil}, {"value", kEvil}, {"bound", 1}}}},
                           {"advice", {kEvil}}}},
                         {"warnings", {kEvil}},
                         {"checks", {{{"severity", kEvil}, {"text", kEvil}, {"fix", kEvil}}}},
                         {"nodes", {{"total", kEvil}}}};
  report["flags"][kEvil] = kEvil;
  report["flags_given"] = {kEvil};
  report["backend"][kEvil] = kEvil;
  report["time_s"][kEvil] = 1.0;
  report["energy"]["terms"][kEvil] = {{"weighted", 1.0}};
  report["energy"]["rounds"] = {{{"terms", {{kEvil, 1.0}}}}, {{"terms", {{kEvil, 2.0}}}}};
  return report;
}

FitView EvilView() {
  SmallFit fit = MakeSmallFit();
  FitParts parts = fit.Parts();
  parts.landmarks = {{kEvil, {3, Eigen::Vector3d::Zero()}}};
  FitView view = MakeFitView(parts);
  view.scene.notes.push_back(kEvil);
  view.scene.panels[0].title = kEvil;
  view.scene.surfaces[0].name = kEvil;
  view.scene.surfaces[0].fields[0].name = kEvil;
  view.scene.surfaces[0].fields[0].key = kEvil;
  return view;
}

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(FitPage, NoTextFromOutsideBecomesMarkup) {
  const std::string page = FitPage(EvilReport(), EvilView(), "");
  const std::string harmless =
      FitPage(ordered_json::object(), MakeFitView(MakeSmallFit().Parts()), "");
  EXPECT_TRUE(Has(page, "window.evil=1")) << "the text is there, as text";
  EXPECT_EQ(Count(page, "<script"), Count(harmless, "<script"));
  EXPECT_EQ(Count(page, "</script"), Count(harmless, "</script"));
  EXPECT_FALSE(Has(page, "<img src=x"));
  EXPECT_FALSE(Has(page.substr(0, page.find("<script")), "\"' onload"));
  for (const char c : {'\x1b', '\x01', '\xff'}) {
    EXPECT_EQ(page.find(c), std::string::npos) << int(c);
  }
  EXPECT_FALSE(Has(page, "\xE2\x80\xA8"));
}

TEST(FitPage, MembersOfTheWrongTypeAreNoFault) {
  for (const ordered_json& wrong : {ordered_json(),
                                    ordered_json(3),
                                    ordered_json("text"),
                                    ordered_json::array({1, "a", nullptr}),
                                    ordered_json{{"a", 1}}}) {
    ordered_json report = ordered_json::object();
    for (const char* const name : {"program",
                                   "version",
                                   "status",
                                   "message",
                                   "source",
                                   "target",
                                   "nodes",
                                   "energy",
                                   "landmarks",
                                   "checks",
                                   "verdict",
                                   "time_s",
                                   "warnings",
                                   "flags",
                                   "flags_given",
                                   "command",
                                   "backend",
                                   "covariance",
                                   "threads"}) {
      report[name] = wrong;
    }
    const FitView view = MakeFitView(MakeSmallFit().Parts());
    EXPECT_TRUE(Has(FitPage(report, view, ""), "</html>"));
    report["energy"] = {{"terms", {{"a", wrong}}}, {"rounds", {wrong, {{"terms", wrong}}}}};
    report["verdict"] = {{"grade", wrong}, {"reasons", {wrong}}, {"advice", wrong}};
    EXPECT_TRUE(Has(FitPage(report, view, ""), "</html>"));
    EXPECT_TRUE(Has(FitPage(wrong, view, ""), "</html>"));
  }
}

TEST(FitPage, SaysVerdictReasonsAndAdvice) {
  ordered_json report;
  report["verdict"] = {
      {"grade", "doubtful"},
      {"reasons", {{{"text", "a fifth is unmatched"}, {"value", 0.2}, {"bound", 0.1}}}},
      {"advice", {"give landmarks"}}};
  const std::string page = FitPage(report, MakeFitView(MakeSmallFit().Parts()), "");
  EXPECT_TRUE(Has(page, "class=\"notice doubtful\""));
  EXPECT_TRUE(Has(page, "a fifth is unmatched"));
  EXPECT_TRUE(Has(page, "<td class=\"n\">0.200</td>"));
  EXPECT_TRUE(Has(page, "give landmarks"));
}

TEST(FitPage, SaysInWordsWhatTheFitShows) {
  ordered_json report;
  report["evidence"] = {{"source", {{"matched", 0.4}, {"missed", 0.0}, {"unseen", 0.6}}},
                        {"target", {{"matched", 0.9}, {"missed", 0.1}, {"unseen", 0.0}}},
                        {"residual", 0.002},
                        {"noise", 0.001},
                        {"edge_stretch", std::log(1.25)},
                        {"folded", 0.0},
                        {"bend", 0.05}};
  EXPECT_THAT(
      EvidenceSentences(report),
      ::testing::ElementsAre(
          "40.0 % of the source lies on the target; of 60.0 % the target shows nothing; "
          "nothing that the target shows is missed.",
          "90.0 % of the target lies on the source; 10.0 % is missed although the source "
          "shows it.",
          "The matched parts are 0.200 % of the diagonal apart (root mean square); the noise "
          "of the target is 0.100 %.",
          "95 % of the lengths on the source change by less than a factor of 1.25.",
          "Points are 5.00 % of the diagonal from the best rigid motion of the source, in "
          "the mean."));
  report["evidence"] = {{"source", "nothing"}, {"residual", -1.0}};
  EXPECT_TRUE(EvidenceSentences(report).empty());
}

TEST(FitPage, FetchesNothing) {
  const std::string page = FitPage(EvilReport(), EvilView(), "");
  EXPECT_TRUE(Has(page, "default-src 'none'"));
  for (const char* const what : {"<link", "<iframe", "@import", "src=\"http", "url("}) {
    EXPECT_FALSE(Has(page, what)) << what;
  }
}

TEST(FitPage, HasTheSameBytesForTheSameFit) {
  EXPECT_TRUE(FitPage(EvilReport(), EvilView(), "") == FitPage(EvilReport(), EvilView(), ""));
}

TEST(FitPage, ThreeJsComesWithItsLicence) {
  const std::string page = FitPage({}, MakeFitView(MakeSmallFit().Parts()), "");
  if (ThreeJs().empty()) {
    EXPECT_TRUE(Has(page, "without three.js"));
  } else {
    EXPECT_TRUE(Has(page, "Permission is hereby granted"));
  }
}

TEST(Viewer, WithoutThreeJsThereIsAPictureAndAWordAboutIt) {
  HtmlPage page("");
  AddViewer(MakeFitView(MakeSmallFit().Parts()).scene, "picture", &page, /*has_three=*/false);
  const std::string html = page.Finish();
  EXPECT_TRUE(Has(html, "built without three.js (Debian&#39;s libjs-three)"));
  EXPECT_TRUE(Has(html, "data:image/png;base64,cGljdHVyZQ=="));
  EXPECT_FALSE(Has(html, "<canvas"));
  EXPECT_FALSE(Has(html, "application/json"));
}

TEST(Viewer, NothingToShowIsSaid) {
  HtmlPage page("");
  Scene scene;
  scene.notes = {"The result is not shown: it is lost."};
  AddViewer(scene, "", &page);
  EXPECT_TRUE(Has(page.Finish(), "There is nothing to show."));
  EXPECT_TRUE(Has(page.Finish(), "it is lost."));
}

TEST(ComparisonPage, HasTheFiguresAndTheFlagsThatDiffer) {
  std::vector<ComparedRun> runs;
  for (const double weight : {1.0, 20.0}) {
    ordered_json report = {{"verdict", {{"grade", "good"}}}, {"nodes", {{"total", 5}}}};
    report["flags"] = {{"w_reg", weight}, {"rings", 2}};
    runs.push_back(
        {"run <" + std::to_string(int(weight)) + ">", report, MakeFitView(MakeSmallFit().Parts())});
  }
  const Scene scene = SceneOfRuns(runs);
  ASSERT_EQ(scene.panels.size(), 3U) << "two results and the target";
  EXPECT_EQ(scene.surfaces[0].Find("truth")->range.high,
            scene.surfaces[1].Find("truth")->range.high);
  const std::string page = ComparisonPage(runs, scene, "");
  EXPECT_TRUE(Has(page, "<td>--w_reg</td><td>1.0</td><td>20.0</td>"));
  EXPECT_FALSE(Has(page, "--rings"));
  EXPECT_TRUE(Has(page, "run &lt;20&gt;"));
  EXPECT_FALSE(Has(page, "run <20>"));
}

// A script that ends its own element would be cut there.
TEST(Assets, NoScriptEndsItsElement) {
  for (const std::string_view script : {ThreeJs(), OrbitControlsJs(), ReportJs()}) {
    EXPECT_EQ(script.find("</script"), std::string_view::npos);
    EXPECT_EQ(script.find("<!--"), std::string_view::npos);
  }
  EXPECT_EQ(ReportCss().find("</style"), std::string_view::npos);
}

TEST(HtmlPage, SectionsAreListedAtTheTop) {
  HtmlPage page("Title");
  page.Section("One & two");
  const std::string html = page.Finish();
  EXPECT_TRUE(Has(html, "<a href=\"#section1\">One &amp; two</a>"));
  EXPECT_TRUE(Has(html, "<h2 id=\"section1\">"));
}

}  // namespace
}  // namespace ceres_ed
