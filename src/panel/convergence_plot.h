#pragma once
#include <monarch_flight/StepIterations.h>

#include <QWidget>
#include <deque>

namespace monarch_flight {

/// How the coupling converges: sub-iterations of the last steps as bars, and the residual that each
/// step ended with as a line over powers of ten.
class ConvergencePlot : public QWidget {
  Q_OBJECT

 public:
  explicit ConvergencePlot(QWidget* parent = nullptr);
  /// A step; shown with the next update().
  void add(const StepIterations& step);
  void clear();
  QSize sizeHint() const override { return {200, 84}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Step {
    std::uint32_t step;
    int sub_iterations;
    double residual;  // the largest of all coordinates in the last sub-iteration
  };
  void paintBars(QPainter& painter, const QRect& area) const;
  void paintResiduals(QPainter& painter, const QRect& area) const;

  std::deque<Step> steps_;
};

}  // namespace monarch_flight
