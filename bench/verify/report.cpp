#include "verify/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "monarch_flight/math/errors.h"

namespace monarch_flight::verify {

using nlohmann::ordered_json;

void Report::add(Row row) {
  row.subject = subject_;
  const bool bounded = !std::isnan(row.bound);
  char bound[16] = "-";
  if (bounded) std::snprintf(bound, sizeof bound, "%.3g", row.bound);
  std::printf("%-16s %-34s %-26s %12.5g %12.5g %10.2e %10s %s\n", row.subject.c_str(),
              row.quantity.c_str(), row.resolution.c_str(), row.computed, row.reference, row.error,
              bound,
              !bounded   ? ""
              : row.pass ? "pass"
                         : "FAIL");
  std::fflush(stdout);
  rows_.push_back(std::move(row));
}

void Report::near(const std::string& quantity, const std::string& resolution, double computed,
                  double reference, double bound, double scale) {
  const double error =
      std::abs(computed - reference) / (scale == 0 ? std::abs(reference) : std::abs(scale));
  add({"", quantity, resolution, computed, reference, error, bound, error <= bound});
}

void Report::below(const std::string& quantity, const std::string& resolution, double computed,
                   double bound) {
  add({"", quantity, resolution, computed, 0.0, computed, bound, computed <= bound});
}

void Report::order(const std::string& quantity, const std::string& resolution, double computed,
                   double bound) {
  add({"", quantity, resolution, computed, bound, std::max(0.0, bound - computed), bound,
       computed >= bound});
}

void Report::state(const std::string& quantity, const std::string& resolution, double computed,
                   double reference) {
  const double error = reference == 0 ? 0 : std::abs(computed / reference - 1);
  add({"", quantity, resolution, computed, reference, error,
       std::numeric_limits<double>::quiet_NaN(), true});
}

void printHead() {
  std::printf("%-16s %-34s %-26s %12s %12s %10s %10s\n", "case", "quantity", "resolution",
              "computed", "reference", "error", "bound");
}

Request::Request(int argc, char** argv, const std::vector<std::string>& known) {
  std::string list;
  for (const std::string& name : known) list += " " + name;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind("out:=", 0) == 0) {
      out = argument.substr(5);
    } else if (argument == "all" || std::count(known.begin(), known.end(), argument)) {
      names.push_back(argument);
    } else {
      throw InputError("unknown subject \"" + argument + "\": must be all or one of" + list);
    }
  }
}

bool Request::takes(const std::string& name, bool by_default) const {
  if (names.empty()) return by_default;
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& n) { return n == "all" || n == name; });
}

namespace {

/// The list in `path` without the items of `subject`.
ordered_json others(const std::string& path, const std::string& subject) {
  ordered_json kept = ordered_json::array();
  std::ifstream in(path);
  if (!in) return kept;
  for (auto& item : ordered_json::parse(in)) {
    if (item.at("case") != subject) kept.push_back(item);
  }
  return kept;
}

void replace(const std::string& path, const ordered_json& list) {
  std::ofstream out(path + ".new");
  out << list.dump(1) << "\n";
  out.close();
  if (!out) throw InputError("cannot write " + path + "; choose another out:=DIR");
  std::filesystem::rename(path + ".new", path);
}

}  // namespace

void write(const std::string& subject, const Report& report, const std::string& directory) {
  std::filesystem::create_directories(directory);
  const std::string table = directory + "/verification.json", plots = directory + "/curves.json";
  ordered_json rows = others(table, subject), curves = others(plots, subject);
  for (const Row& r : report.rows()) {
    rows.push_back({{"case", r.subject},
                    {"quantity", r.quantity},
                    {"resolution", r.resolution},
                    {"computed", r.computed},
                    {"reference", r.reference},
                    {"error", r.error},
                    {"bound", std::isnan(r.bound) ? ordered_json() : ordered_json(r.bound)},
                    {"pass", r.pass}});
  }
  for (const Curve& c : report.curves()) {
    curves.push_back({{"case", subject},
                      {"plot", c.plot},
                      {"x_label", c.x_label},
                      {"y_label", c.y_label},
                      {"label", c.label},
                      {"logarithmic", c.logarithmic},
                      {"x", c.x},
                      {"y", c.y}});
  }
  replace(table, rows);
  replace(plots, curves);
}

}  // namespace monarch_flight::verify
