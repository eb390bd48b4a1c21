#include <algorithm>

#include <apps/support/help/flag_text.h>
#include <apps/support/help/help.h>

namespace ceres_ed {
namespace {

// Returns the names that the value of a flag may have, with blanks between; empty if it is a number
// or another text.
std::string ValueNames(const OptionFlag& flag) {
  if (TypeText(InfoOf(flag)) == "true|false") return "true false";
  std::string names = flag.names;
  names.erase(std::remove(names.begin(), names.end(), ','), names.end());
  for (const SpecialValue& special : flag.option->specials) {
    names += (names.empty() ? "" : " ") + special.word;
  }
  return names;
}

// Returns whether a flag may stand without a value, so that the next word is not its value.
bool StandsAlone(const OptionFlag& flag) {
  return TypeText(InfoOf(flag)) == "true|false" || !flag.option->text_alone.empty();
}

// What stands before and behind the parts that depend on the program. bash makes a word of each
// "=", so the flag of a value is one or two words back.
constexpr char kBegin[] = R"sh(() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} flag="" names=""
  if [[ $word == "=" ]]; then
    flag=$before word=""
  elif [[ $before == "=" ]]; then
    flag=${COMP_WORDS[COMP_CWORD-2]}
  else
    case $before in
)sh";
constexpr char kMiddle[] = R"sh(      -*) flag=$before ;;
    esac
  fi
  COMPREPLY=()
  if [[ -n $flag ]]; then
    case $flag in
)sh";
constexpr char kEnd[] = R"sh(    esac
    [[ -n $names ]] && mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
    return
  fi
  [[ $word == -* ]] || return
)sh";
constexpr char kLast[] =
    R"sh(  [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace
}
complete -o bashdefault -o default -F )sh";

}  // namespace

std::string BashCompletion(const ProgramInfo& info) {
  std::string alone;
  std::string values;
  std::string words = "--help --version --flagfile=";
  for (const OptionFlag* flag : RegisteredOptionFlags()) {
    const Option& option = *flag->option;
    const std::string name = "--" + option.name;
    std::string pattern = name;
    if (option.letter != 0) pattern += std::string("|-") + option.letter;
    const bool stands_alone = StandsAlone(*flag);
    if (stands_alone) alone += "|" + pattern;
    if (const std::string names = ValueNames(*flag); !names.empty()) {
      values += "      " + pattern + ") names='" + names + "' ;;\n";
    }
    words += " " + name;
    if (!stands_alone) words += "=";
  }
  const std::string function = "_" + info.name;
  return "# Completion of " + info.name + " for bash.\n" + function + kBegin +
         "      --help|-h|--version" + alone + ") ;;\n" + kMiddle + "      --help) names=all ;;\n" +
         values + kEnd + "  mapfile -t COMPREPLY < <(compgen -W '" + words + "' -- \"$word\")\n" +
         kLast + function + " " + info.name + "\n";
}

}  // namespace ceres_ed
