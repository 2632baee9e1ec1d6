#pragma once
#include <string>
#include <vector>

namespace monarch_flight::verify {

/// One line of the table. A bound of NaN marks a value that is only stated.
struct Row {
  std::string subject, quantity, resolution;
  double computed, reference, error, bound;
  bool pass;
};

/// A curve of a plot.
struct Curve {
  std::string plot, x_label, y_label, label;
  std::vector<double> x, y;
  bool logarithmic;
};

/// Collects the results of the subjects, prints each line as it comes.
class Report {
 public:
  explicit Report(std::string subject) : subject_(std::move(subject)) {}
  /// |computed - reference| <= bound * scale; scale 0: |reference|.
  void near(const std::string& quantity, const std::string& resolution, double computed,
            double reference, double bound, double scale = 0);
  /// An error of its own: computed <= bound.
  void below(const std::string& quantity, const std::string& resolution, double computed,
             double bound);
  /// computed >= bound, an observed order.
  void order(const std::string& quantity, const std::string& resolution, double computed,
             double bound);
  /// No bound.
  void state(const std::string& quantity, const std::string& resolution, double computed,
             double reference);
  /// A row whose error was formed elsewhere; its subject is set here.
  void add(Row row);
  void curve(Curve curve) { curves_.push_back(std::move(curve)); }

  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<Curve>& curves() const { return curves_; }

 private:
  std::string subject_;
  std::vector<Row> rows_;
  std::vector<Curve> curves_;
};

/// Prints the head of the table.
void printHead();

/// What a person asked for on the command line.
struct Request {
  std::vector<std::string> names;
  std::string out = "verification";  ///< out:=DIR

  /// Throws InputError when a name is not among `known`.
  Request(int argc, char** argv, const std::vector<std::string>& known);
  /// No names: `by_default`; "all": everything.
  bool takes(const std::string& name, bool by_default = true) const;
};

/// Puts the rows and curves into DIR/verification.json and DIR/curves.json; what these hold of
/// other subjects stays. Throws InputError when they cannot be written.
void write(const std::string& subject, const Report& report, const std::string& directory);

}  // namespace monarch_flight::verify
