#include "panel/convergence_plot.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace monarch_flight {
namespace {

constexpr std::size_t kSteps = 100;                // shown
constexpr double kLowest = -10.0, kHighest = 0.0;  // powers of ten of the residual
const QColor kBars(86, 124, 176), kLine(226, 138, 52);

double largest(const CoordinateResiduals& r) {
  return std::max({r.x, r.y, r.z, r.roll, r.pitch, r.yaw, r.theta_right, r.theta_left});
}

double across(std::size_t index, const QRect& area) {
  return area.left() + (static_cast<double>(index) + 0.5) * area.width() / kSteps;
}

}  // namespace

ConvergencePlot::ConvergencePlot(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(
      "Bars: sub-iterations of the last 100 steps. Line: residual of the last sub-iteration");
}

void ConvergencePlot::add(const StepIterations& step) {
  if (!steps_.empty() && step.step <= steps_.back().step) steps_.clear();  // set back
  const double residual = step.rows.empty() ? 0.0 : largest(step.rows.back().residual);
  steps_.push_back({step.step, static_cast<int>(step.rows.size()), residual});
  if (steps_.size() > kSteps) steps_.pop_front();
}

void ConvergencePlot::clear() {
  steps_.clear();
  update();
}

void ConvergencePlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont small = font();
  small.setPointSizeF(0.85 * small.pointSizeF());
  painter.setFont(small);
  const int line = painter.fontMetrics().height();
  const QRect area = rect().adjusted(1, line + 2, -1, -1);
  painter.fillRect(area, palette().base());
  const QRect title(area.left(), 0, area.width(), line);
  painter.setPen(kBars);
  const QString count = steps_.empty() ? "-" : QString::number(steps_.back().sub_iterations);
  painter.drawText(title, Qt::AlignLeft, "sub-iterations " + count);
  painter.setPen(kLine);
  const QString residual = steps_.empty() ? "-" : QString::number(steps_.back().residual, 'e', 0);
  painter.drawText(title, Qt::AlignRight, "residual " + residual);
  if (steps_.empty()) return;
  paintBars(painter, area);
  paintResiduals(painter, area);
}

void ConvergencePlot::paintBars(QPainter& painter, const QRect& area) const {
  const auto most = std::max_element(
      steps_.begin(), steps_.end(),
      [](const Step& a, const Step& b) { return a.sub_iterations < b.sub_iterations; });
  const double unit = area.height() / std::max(most->sub_iterations + 1.0, 4.0);
  const double width = std::max(area.width() / static_cast<double>(kSteps) - 0.5, 1.0);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const double height = unit * steps_[i].sub_iterations;
    painter.fillRect(QRectF(across(i, area) - width / 2, area.bottom() - height, width, height + 1),
                     kBars);
  }
}

void ConvergencePlot::paintResiduals(QPainter& painter, const QRect& area) const {
  QPolygonF line;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const double residual = steps_[i].residual;
    if (!(residual > 0.0)) continue;  // a prescribed step
    const double power = std::clamp(std::log10(residual), kLowest, kHighest);
    const double up = (power - kLowest) / (kHighest - kLowest);
    line << QPointF(across(i, area), area.bottom() - up * area.height());
  }
  painter.setPen(QPen(kLine, 1.5));
  painter.drawPolyline(line);
}

}  // namespace monarch_flight
