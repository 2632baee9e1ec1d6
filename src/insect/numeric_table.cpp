#include "monarch_flight/insect/numeric_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

constexpr std::size_t kMostFaults = 10;
constexpr char kByteOrderMark[] = "\xEF\xBB\xBF";  // as spreadsheets put it before UTF-8

std::string trimmed(const std::string& text) {
  const char* blank = " \t\r";
  const std::size_t from = text.find_first_not_of(blank);
  if (from == std::string::npos) return "";
  return text.substr(from, text.find_last_not_of(blank) - from + 1);
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::size_t from = 0;
  for (std::size_t comma = line.find(','); comma != std::string::npos;
       comma = line.find(',', from)) {
    result.push_back(trimmed(line.substr(from, comma - from)));
    from = comma + 1;
  }
  result.push_back(trimmed(line.substr(from)));
  return result;
}

/// What separates the columns in place of commas, in words; "" where nothing does. Blanks may stand
/// in a name, and tabs beside a comma.
std::string otherSeparator(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    if (text.find(';') != std::string::npos) return "semicolons";
    if (text.find('\t') != std::string::npos) return "tabs";
  }
  return "";
}

std::string separatorFault(const std::string& where, const std::string& text,
                           const std::string& separator) {
  return where + " = '" + text + "': columns must be separated by commas, not " + separator +
         ", and numbers have a decimal point; convert the file";
}

/// The names of a header line, none twice.
std::vector<std::string> header(const std::string& text, const std::string& name,
                                std::vector<std::string>& faults) {
  std::vector<std::string> names = cells(text);
  std::string separator = otherSeparator(names);
  if (separator.empty() && names.size() == 1) {
    if (text.find(' ') != std::string::npos) separator = "blanks";
    if (text.find('|') != std::string::npos) separator = "bars";
  }
  if (!separator.empty()) throw InputError(separatorFault(name + ": header", text, separator));
  for (auto one = names.begin(); one != names.end(); ++one) {
    if (std::find(names.begin(), one, *one) == one) continue;
    faults.push_back(name + ": column '" + *one + "' is given twice; remove or rename one of them");
  }
  return names;
}

/// One row; faults are added to `faults` with `where` in front.
std::vector<double> parseRow(const std::vector<std::string>& texts, const NumericTable& table,
                             const std::string& where, std::vector<std::string>& faults) {
  std::vector<double> row;
  const std::string separator = otherSeparator(texts);
  if (!separator.empty()) {
    faults.push_back(separatorFault(where, texts[0], separator));
    return row;
  }
  if (texts.size() != table.columns.size()) {
    faults.push_back(where + " has " + std::to_string(texts.size()) + " values: must be " +
                     std::to_string(table.columns.size()) + " as in the header; " +
                     (texts.size() < table.columns.size()
                          ? "complete the row"
                          : "commas separate columns, so numbers need a decimal point: correct the "
                            "row"));
    return row;
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    char* end = nullptr;
    const double value = std::strtod(texts[i].c_str(), &end);
    if (texts[i].empty() || *end != '\0' || !std::isfinite(value)) {
      faults.push_back(where + ", column " + table.columns[i] + " = '" + texts[i] +
                       "': must be a finite number; correct the cell");
    }
    row.push_back(value);
  }
  return row;
}

}  // namespace

int NumericTable::find(const std::string& wanted) const {
  const auto at = std::find(columns.begin(), columns.end(), wanted);
  return at == columns.end() ? -1 : static_cast<int>(at - columns.begin());
}

std::vector<double> NumericTable::column(const std::string& wanted) const {
  const int index = find(wanted);
  if (index < 0) throw InputError(name + ": column '" + wanted + "' is missing");
  std::vector<double> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(row[index]);
  return values;
}

NumericTable NumericTable::select(const std::vector<std::string>& wanted) const {
  std::vector<std::string> faults;
  std::vector<int> indices;
  for (const std::string& one : wanted) {
    indices.push_back(find(one));
    if (indices.back() < 0) {
      faults.push_back(name + ": column '" + one + "' is missing; add it to the header line");
    }
  }
  if (!faults.empty()) throw InputError(faults);
  NumericTable result{name, wanted, {}};
  result.rows.reserve(rows.size());
  for (const auto& row : rows) {
    std::vector<double> kept;
    kept.reserve(indices.size());
    for (const int index : indices) kept.push_back(row[index]);
    result.rows.push_back(std::move(kept));
  }
  return result;
}

NumericTable readCsv(std::istream& in, const std::string& name) {
  NumericTable table{name, {}, {}};
  std::vector<std::string> faults;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (number == 1 && line.rfind(kByteOrderMark, 0) == 0) line.erase(0, 3);
    const std::string text = trimmed(line);
    if (text.empty() || text[0] == '#') continue;
    if (table.columns.empty()) {
      table.columns = header(text, name, faults);
      continue;
    }
    const std::string where = name + ": row " + std::to_string(table.rows.size() + 1) + " (line " +
                              std::to_string(number) + ")";
    table.rows.push_back(parseRow(cells(text), table, where, faults));
    if (faults.size() >= kMostFaults) break;
  }
  if (table.rows.empty())
    faults.push_back(name + ": holds no row of numbers; it needs a header line and rows");
  if (!faults.empty()) throw InputError(faults);
  return table;
}

NumericTable readCsv(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path + ": cannot be read; check the path and its permissions");
  return readCsv(in, path);
}

}  // namespace monarch_flight
