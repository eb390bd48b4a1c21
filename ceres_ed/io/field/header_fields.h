// The fields of headers that are text.
#ifndef CERES_ED_IO_FIELD_HEADER_FIELDS_H_
#define CERES_ED_IO_FIELD_HEADER_FIELDS_H_

#include <ceres_ed/util/status.h>

#include <map>
#include <string>
#include <vector>

namespace ceres_ed {

// Values by the names of their fields.
using HeaderFields = std::map<std::string, std::string>;

// Returns the header at the start of `path`: lines "NAME<separator>VALUE" up to an empty line, the
// field named `last`, or the end of the file. Other lines are ignored. Blanks around names and
// values are dropped. Names are case-sensitive. The error gives the system's reason.
StatusOr<HeaderFields> ReadHeaderFields(const std::string& path,
                                        char separator,
                                        const std::string& last);

// Returns the numbers in the field `name`, of which there must be `count`. Parentheses and commas
// count as blanks, and the word "none" is left out. The error names the file, the field and what
// was expected.
StatusOr<std::vector<double>> NumbersOf(const std::string& path,
                                        const HeaderFields& fields,
                                        const std::string& name,
                                        std::size_t count);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_HEADER_FIELDS_H_
