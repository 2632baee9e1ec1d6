#include "panel/view_buttons.h"

#include <rviz/view_controller.h>
#include <rviz/view_manager.h>

#include <QHBoxLayout>
#include <QPushButton>

namespace monarch_flight {

ViewButtons::ViewButtons(rviz::ViewManager* views, QWidget* parent)
    : QWidget(parent), views_(views) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(2);
  connect(views_, &rviz::ViewManager::configChanged, this, &ViewButtons::renew);
  renew();
}

void ViewButtons::renew() {
  QStringList names;
  for (int i = 0; i < views_->getNumViews(); ++i) names << views_->getViewAt(i)->getName();
  if (names == names_) return;
  names_ = names;
  for (QPushButton* button : findChildren<QPushButton*>()) button->deleteLater();
  for (int i = 0; i < names.size(); ++i) {
    auto* button = new QPushButton(names[i]);
    button->setObjectName("view_" + names[i]);
    button->setMinimumWidth(10);
    layout()->addWidget(button);
    connect(button, &QPushButton::clicked, this, [this, i] {
      if (i < views_->getNumViews()) views_->setCurrentFrom(views_->getViewAt(i));
    });
  }
}

}  // namespace monarch_flight
