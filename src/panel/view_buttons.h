#pragma once
#include <QStringList>
#include <QWidget>

namespace rviz {
class ViewManager;
}

namespace monarch_flight {

/// A button for every saved view of rviz (its panel Views).
class ViewButtons : public QWidget {
  Q_OBJECT

 public:
  ViewButtons(rviz::ViewManager* views, QWidget* parent);

 private:
  void renew();

  rviz::ViewManager* views_;
  QStringList names_;
};

}  // namespace monarch_flight
