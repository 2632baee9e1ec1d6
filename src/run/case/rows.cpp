#include <filesystem>

#include "monarch_flight/math/errors.h"
#include "run/case/parts.h"

namespace monarch_flight::case_file {

NumericTable readRows(Section& section, const std::vector<std::string>& columns) {
  const bool has_file = section.has("file");
  if (has_file == section.has("rows")) {
    section.take("file");
    section.take("rows");
    throw InputError(section.pathOf("file") + ": give either file (a CSV) or rows");
  }
  NumericTable table{section.pathOf("rows"), columns, {}};
  if (has_file) {
    const YAML::Node file = section.take("file");
    if (!file.IsScalar()) throw InputError(section.pathOf("file") + ": must be a path; correct it");
    table = readCsv(file.Scalar()).select(columns);
    section.put("source", section.has("source")
                              ? section.text("source")
                              : std::filesystem::path(file.Scalar()).filename().string());
    section.put("rows", table.rows);
  } else {
    section.put("source", section.has("source") ? section.text("source") : "rows in the case");
    table.rows = section.rows("rows", columns.size());
  }
  return table;
}

}  // namespace monarch_flight::case_file
