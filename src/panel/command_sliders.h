#pragma once
#include <QCheckBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QWidget>
#include <optional>
#include <vector>

#include "monarch_flight/insect/wingbeat.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// The commands of the guidance, a slider each, between the bounds of the case. Where somebody else
/// leads, they show what is commanded.
class CommandSliders : public QWidget {
  Q_OBJECT

 public:
  explicit CommandSliders(QWidget* parent = nullptr);
  /// Sliders for the commands that this case has; none: no case is known.
  void setCase(const Case* c);
  /// What was taken lately; moves the sliders where a person does not lead.
  void follow(const WingbeatChange& taken);
  /// Whether there is a run that hears.
  void setListening(bool listens);
  bool any() const { return !rows_.empty(); }

 Q_SIGNALS:
  /// A person wants this.
  void commanded(const WingbeatChange& wanted, bool at_once);

 private:
  struct Row {
    Command command;
    CommandLimits limits;
    double WingbeatChange::*value;
    bool angle;
    QSlider* slider;
    QLabel* number;
  };
  void addRow(std::size_t index, const CommandLimits& limits);
  double valueOf(const Row& row) const;
  void place(const Row& row, double value);
  void showNumber(const Row& row, double value);
  void send();
  void enable();

  std::vector<Row> rows_;
  std::vector<QWidget*> widgets_;  // of the rows
  QWidget* area_ = nullptr;
  QLabel* leader_;
  QCheckBox* at_once_;
  QPushButton* zero_;
  bool leads_ = false;      // the case lets a person lead
  bool listening_ = false;  // there is a run
  bool placing_ = false;    // a slider is moved by this, not by a person
};

}  // namespace monarch_flight
