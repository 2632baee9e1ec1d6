#pragma once
#include <monarch_flight/ColourScales.h>

#include <QWidget>

namespace monarch_flight {

/// The colour scales of what is shown, as bars with their numbers.
class ScaleBars : public QWidget {
  Q_OBJECT

 public:
  explicit ScaleBars(QWidget* parent = nullptr);
  void show(const ColourScales& scales);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  int rowHeight() const;
  void paintScale(QPainter& painter, const ColourScale& scale, const QRect& row) const;

  ColourScales scales_;
};

}  // namespace monarch_flight
