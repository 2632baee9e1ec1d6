#pragma once
#include <monarch_flight/ColourScales.h>
#include <monarch_flight/FlightState.h>
#include <monarch_flight/StepIterations.h>
#include <ros/ros.h>
#include <rviz/panel.h>
#include <std_msgs/String.h>

#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QVBoxLayout>
#include <optional>
#include <vector>

#include "monarch_flight/run/case.h"
#include "panel/command_sliders.h"
#include "panel/convergence_plot.h"
#include "panel/run_buttons.h"
#include "panel/run_progress.h"
#include "panel/scale_bars.h"

namespace monarch_flight {

/// The panel of rviz for a flight or its replay: how far it is, how fast it goes and how it
/// converges; what leads it; the scales of the colours; the saved views (docs/rviz.md).
class FlightPanel : public rviz::Panel {
  Q_OBJECT

 public:
  explicit FlightPanel(QWidget* parent = nullptr);
  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;
  QSize sizeHint() const override { return {270, 600}; }

 private:
  void add(QWidget* widget, const QString& title = "");
  QWidget* makeProgress();
  void listen();
  void onCase(const std_msgs::String& text);
  void onState(const FlightState& state);
  void onIterations(const StepIterations& step);
  void onScales(const ColourScales& scales);
  void fillScreen();
  void refresh();
  QString place() const;

  QWidget* area_;
  QVBoxLayout* column_;
  QLineEdit* space_;
  QLabel *place_, *numbers_;
  QProgressBar* bar_;
  RunButtons* buttons_;
  ConvergencePlot* plot_;
  ScaleBars* scales_;
  CommandSliders* sliders_;
  RunProgress progress_;
  std::optional<Case> case_;
  std::string case_text_;
  std::optional<WingbeatCommand> taken_;  // the newest, of the run
  bool fill_ = false;                     // the screen, as soon as the window is shown
  bool fresh_ = false;                    // something has come since the last refresh
  ros::Publisher command_;
  std::vector<ros::Subscriber> heard_;
};

}  // namespace monarch_flight
