#pragma once
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QWidget>
#include <string>
#include <vector>

#include "panel/service_calls.h"

namespace monarch_flight {

/// Leads a run by its services (docs/protocol.md); of a replay it holds the player.
class RunButtons : public QWidget {
  Q_OBJECT

 public:
  /// What is there to lead.
  enum class Led { kNothing, kRun, kReplay };

  explicit RunButtons(QWidget* parent);
  /// The namespace of the run, absolute; looks what is there from now on.
  void setSpace(const std::string& space);
  Led led() const { return led_; }

 Q_SIGNALS:
  void ledChanged();

 private:
  QPushButton* add(const QString& name, const QString& service, const QString& tip);
  void call(const QString& service);
  ServiceCalls::Call callOf(const std::string& service) const;
  void look();
  void looked(const QString& found);
  void told(const QString& what, bool success, const QString& message);
  void enable();

  std::string space_;
  Led led_ = Led::kNothing;
  ServiceCalls calls_, pauses_, looks_;  // a run that flies many steps can be paused meanwhile
  std::vector<QPushButton*> buttons_;
  QSpinBox* steps_;
  QLabel* message_;
};

}  // namespace monarch_flight
