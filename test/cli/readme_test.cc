// What README.md and the other pages say is what is there.
#include <ceres_ed/energy/energy_listing.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/version.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/cli/run_program.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

std::string ReadSourceFile(const std::string& path) {
  std::ifstream file(std::string(CERES_ED_SOURCE_DIR) + "/" + path, std::ios::binary);
  EXPECT_TRUE(file.is_open()) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The first capture of every match.
std::vector<std::string> FindAll(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

std::string ParameterCell(const EnergyInfo& energy) {
  std::ostringstream cell;
  for (const EnergyParameter& parameter : energy.parameters) {
    cell << (cell.tellp() > 0 ? ", " : "") << "`" << parameter.name << "` (" << parameter.unit
         << ", default " << parameter.default_value << ")";
  }
  return cell.tellp() > 0 ? cell.str() : "-";
}

// The table of energies as the page must have it.
std::string EnergyTable() {
  const EnergyRegistry registry = BuiltinEnergies();
  std::string table =
      "| energy | kind | what it wants | residual | unit | parameters "
      "|\n|---|---|---|---|---|---|\n";
  for (const EnergyInfo* energy : registry.List()) {
    const char* kind = energy->kind == EnergyKind::kObservation ? "observation" : "prior";
    table += "| `" + energy->name + "` | " + kind + " | " + energy->summary + " | `" +
             energy->equation + "` | " + energy->unit + " | " + ParameterCell(*energy) + " |\n";
  }
  return table;
}

TEST(Readme, ShowsTheHelloExampleAsItIsCompiled) {
  const std::string example = ReadSourceFile("apps/examples/01_hello/hello.cc");
  ASSERT_FALSE(example.empty());
  EXPECT_THAT(ReadSourceFile("README.md"), HasSubstr("```cpp\n" + example + "```\n"));
}

TEST(Readme, HasAtMost170Lines) {
  const std::string readme = ReadSourceFile("README.md");
  EXPECT_LE(std::count(readme.begin(), readme.end(), '\n'), 170);
}

TEST(Citation, HasTheVersionOfTheLibrary) {
  EXPECT_THAT(ReadSourceFile("CITATION.cff"),
              HasSubstr(std::string("\nversion: ") + kVersion + "\n"));
}

TEST(EnergyPage, ListsTheEnergiesAsTheRegistryHasThem) {
  const std::string page = ReadSourceFile("ceres_ed/energy/README.md");
  const std::string table = EnergyTable();
  // Not HasSubstr, which would print all of the file: what to paste is the table.
  EXPECT_NE(page.find("\n\n" + table + "\n"), std::string::npos) << "expected:\n" << table;
}

TEST(EnergyPage, HasTheCatalogueOfTheRegistry) {
  const EnergyRegistry registry = BuiltinEnergies();
  EXPECT_THAT(ReadSourceFile("ceres_ed/energy/README.md"),
              HasSubstr("<!-- ed_list_energies: begin -->\n" + ListEnergiesAsMarkdown(registry) +
                        "<!-- ed_list_energies: end -->\n"))
      << "scripts/refresh_pages.sh brings it up to date";
}

TEST(OptionsPages, HaveTheFlagsOfThePrograms) {
  for (const auto& [page, program] : {std::pair("ceres_ed/registration/README.md", "ed_fit"),
                                      std::pair("ceres_ed/io/field/README.md", "ed_apply"),
                                      std::pair("ceres_ed/slam/README.md", "ed_slam")}) {
    const ProgramResult table = RunProgramFile(AppPath(program), {"--help=markdown"});
    ASSERT_EQ(table.exit_code, 0);
    const std::string mark = std::string("<!-- ") + program + " options: ";
    const std::string expected = mark + "begin -->\n" + table.out + mark + "end -->\n";
    EXPECT_NE(ReadSourceFile(page).find(expected), std::string::npos)
        << page << ": scripts/refresh_pages.sh brings it up to date";
  }
}

TEST(Readme, LinksOnlyToWhatIsThere) {
  const std::string readme = ReadSourceFile("README.md");
  const std::vector<std::string> links = FindAll(readme, "\\]\\(([^)]+)\\)");
  ASSERT_GE(links.size(), 10u);
  for (const std::string& link : links) {
    const std::string path = link.substr(0, link.find('#'));
    if (link.rfind("http", 0) == 0 || path.empty()) continue;
    EXPECT_TRUE(std::filesystem::exists(std::string(CERES_ED_SOURCE_DIR) + "/" + path)) << link;
  }
  for (const std::string& script : FindAll(readme, "(scripts/[a-z_]+\\.(?:sh|py))")) {
    EXPECT_TRUE(std::filesystem::exists(std::string(CERES_ED_SOURCE_DIR) + "/" + script)) << script;
  }
}

// Every flag that a page gives to a program, in a line of code or in a piece of code in a line of
// text, is one of the program's; returns how many there are.
int CheckFlags(const std::string& page) {
  const std::string text = ReadSourceFile(page);
  const std::regex command("(?:\n|`)(ed_[a-z_]+) ([^`\n]*)");
  int num_flags = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), command), end; it != end; ++it) {
    const std::string program = (*it)[1];
    const ProgramResult help = RunProgramFile(AppPath(program), {"--help=all"});
    EXPECT_EQ(help.exit_code, 0) << page << ": " << program;
    const std::vector<std::string> known = FindAll(help.out, "\n  --([a-z_]+)");
    for (const std::string& flag : FindAll((*it)[2], "--([a-z_]+)")) {
      EXPECT_THAT(known, Contains(flag)) << page << ": " << program;
      ++num_flags;
    }
  }
  return num_flags;
}

TEST(Pages, GiveProgramsOnlyFlagsThatTheyHave) {
  EXPECT_GE(CheckFlags("README.md"), 8);
  for (const char* page : {"apps/examples/README.md",
                           "ceres_ed/README.md",
                           "ceres_ed/energy/README.md",
                           "ceres_ed/io/results/README.md",
                           "ceres_ed/io/sequence/README.md",
                           "ceres_ed/registration/README.md",
                           "ceres_ed/slam/README.md",
                           "ceres_ed/slam/decoupling.md",
                           "ceres_ed/solver/README.md",
                           "test/benchmark/README.md"}) {
    CheckFlags(page);
  }
}

}  // namespace
}  // namespace ceres_ed
