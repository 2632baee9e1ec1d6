#include "panel/scale_bars.h"

#include <QLinearGradient>
#include <QPainter>

namespace monarch_flight {
namespace {

constexpr int kBar = 12;  // height [pixels]

QColor colourOf(const std_msgs::ColorRGBA& c) {
  return QColor::fromRgbF(qBound(0.0, double(c.r), 1.0), qBound(0.0, double(c.g), 1.0),
                          qBound(0.0, double(c.b), 1.0));
}

QString title(const ColourScale& scale) {
  QString text = QString::fromStdString(scale.quantity);
  if (!scale.unit.empty()) text += " [" + QString::fromStdString(scale.unit) + "]";
  return text;
}

}  // namespace

ScaleBars::ScaleBars(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ScaleBars::show(const ColourScales& scales) {
  scales_ = scales;
  updateGeometry();
  update();
}

int ScaleBars::rowHeight() const { return 2 * fontMetrics().height() + kBar + 6; }

QSize ScaleBars::sizeHint() const {
  const int rows = std::max<int>(static_cast<int>(scales_.scales.size()), 1);
  return {200, scales_.scales.empty() ? fontMetrics().height() : rows * rowHeight()};
}

void ScaleBars::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (scales_.scales.empty()) {
    painter.setPen(palette().color(QPalette::Disabled, QPalette::WindowText));
    painter.drawText(rect(), Qt::AlignLeft | Qt::AlignTop, "nothing shown has one");
    return;
  }
  QRect row(0, 0, width(), rowHeight());
  for (const ColourScale& scale : scales_.scales) {
    paintScale(painter, scale, row);
    row.translate(0, rowHeight());
  }
}

void ScaleBars::paintScale(QPainter& painter, const ColourScale& scale, const QRect& row) const {
  const int line = fontMetrics().height();
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(QRect(row.left(), row.top(), row.width(), line), Qt::AlignLeft, title(scale));
  const QRect bar(row.left(), row.top() + line + 1, row.width(), kBar);
  QLinearGradient colours(bar.topLeft(), bar.topRight());
  const std::size_t n = scale.colours.size();
  for (std::size_t i = 0; i < n; ++i)
    colours.setColorAt(n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0.0,
                       colourOf(scale.colours[i]));
  painter.fillRect(bar, colours);
  const QRect numbers(row.left(), bar.bottom() + 1, row.width(), line);
  const QString limit = QString::number(scale.limit, 'g', 4);
  painter.drawText(numbers, Qt::AlignLeft, QChar(0x2212) + limit);
  painter.drawText(numbers, Qt::AlignHCenter, "0");
  painter.drawText(numbers, Qt::AlignRight, limit);
}

}  // namespace monarch_flight
