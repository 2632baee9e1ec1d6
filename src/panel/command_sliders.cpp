#include "panel/command_sliders.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cmath>

#include "monarch_flight/math/angle.h"

namespace monarch_flight {
namespace {

constexpr int kSliderSteps = 100;  // of a slider, to each side

/// Who leads, in words.
QString leaderText(const Case& c) {
  switch (c.guidance.kind) {
    case GuidanceKind::kCommands:
      return "you lead";
    case GuidanceKind::kController:
      return "the controller leads";
    case GuidanceKind::kNode:
      return "a node leads";
    case GuidanceKind::kReplay:
      return "a recorded flight leads";
    case GuidanceKind::kPlugin:
      return "a plugin leads";
    default:
      return "nobody leads (guidance:=commands)";
  }
}

}  // namespace

CommandSliders::CommandSliders(QWidget* parent)
    : QWidget(parent),
      leader_(new QLabel("no flight yet")),
      at_once_(new QCheckBox("at once")),
      zero_(new QPushButton("All zero")) {
  at_once_->setToolTip("Take a command in the next step; else when the next flap begins");
  zero_->setToolTip("The motion of the case itself");
  zero_->setObjectName("all_zero");
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(2);
  all->addWidget(leader_);
  area_ = new QWidget;
  all->addWidget(area_);
  auto* last = new QHBoxLayout;
  last->addWidget(at_once_);
  last->addWidget(zero_);
  all->addLayout(last);
  connect(zero_, &QPushButton::clicked, this, [this] {
    for (const Row& row : rows_) place(row, 0.0);
    send();
  });
  enable();
}

void CommandSliders::setCase(const Case* c) {
  for (QWidget* widget : widgets_) widget->deleteLater();
  widgets_.clear();
  rows_.clear();
  delete area_->layout();
  auto* grid = new QGridLayout(area_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(4);
  grid->setVerticalSpacing(1);
  grid->setColumnStretch(1, 1);
  leads_ = c != nullptr && c->guidance.kind == GuidanceKind::kCommands;
  leader_->setText(c != nullptr ? leaderText(*c) : "no flight yet");
  if (c != nullptr && c->guidance.kind != GuidanceKind::kMotion &&
      c->guidance.kind != GuidanceKind::kReplay && c->guidance.kind != GuidanceKind::kPlugin) {
    const auto& limits = c->guidance.wingbeat.limits;
    for (std::size_t i = 0; i < kCommands; ++i)
      if (limits[i].low < limits[i].high) addRow(i, limits[i]);
  }
  enable();
}

void CommandSliders::addRow(std::size_t index, const CommandLimits& limits) {
  const CommandInfo& info = kCommandTable[index];
  auto* grid = static_cast<QGridLayout*>(area_->layout());
  const bool angle = std::string(info.unit) == "rad";
  auto* name = new QLabel(QString(info.name).replace('_', ' '));
  name->setText(name->text().replace("differential", "diff."));
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setRange(-kSliderSteps, kSliderSteps);
  slider->setMinimumWidth(60);
  slider->setObjectName(info.name);
  auto* number = new QLabel;
  number->setMinimumWidth(fontMetrics().horizontalAdvance(angle ? "-88.8\u00b0" : "-88 %"));
  number->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  const int at = static_cast<int>(rows_.size());
  grid->addWidget(name, at, 0);
  grid->addWidget(slider, at, 1);
  grid->addWidget(number, at, 2);
  for (QWidget* widget : std::initializer_list<QWidget*>{name, slider, number})
    widgets_.push_back(widget);
  rows_.push_back({static_cast<Command>(index), limits, info.value, angle, slider, number});
  const Row row = rows_.back();
  place(row, 0.0);
  connect(slider, &QSlider::valueChanged, this, [this, row] {
    if (placing_) return;
    showNumber(row, valueOf(row));
    send();
  });
}

/// Zero is in the middle, whatever the bounds are.
double CommandSliders::valueOf(const Row& row) const {
  const double share = static_cast<double>(row.slider->value()) / kSliderSteps;
  return share < 0.0 ? -share * row.limits.low : share * row.limits.high;
}

void CommandSliders::place(const Row& row, double value) {
  const double bound = value < 0.0 ? row.limits.low : row.limits.high;
  const double share = bound != 0.0 ? std::clamp(value / bound, 0.0, 1.0) : 0.0;
  placing_ = true;
  row.slider->setValue(
      static_cast<int>(std::lround((value < 0.0 ? -share : share) * kSliderSteps)));
  placing_ = false;
  showNumber(row, value);
}

void CommandSliders::showNumber(const Row& row, double value) {
  const QString text = row.angle ? QString::number(value / kDegree, 'f', 1) + QChar(0xb0)
                                 : QString::number(100.0 * value, 'f', 0) + " %";
  if (row.number->text() != text) row.number->setText(text);
}

void CommandSliders::follow(const WingbeatChange& taken) {
  if (leads_ && listening_) return;
  for (const Row& row : rows_) place(row, taken.*row.value);
}

void CommandSliders::setListening(bool listens) {
  if (listens == listening_) return;
  listening_ = listens;
  enable();
}

void CommandSliders::send() {
  WingbeatChange wanted;
  for (const Row& row : rows_) wanted.*row.value = valueOf(row);
  Q_EMIT commanded(wanted, at_once_->isChecked());
}

void CommandSliders::enable() {
  const bool active = leads_ && listening_;
  for (const Row& row : rows_) row.slider->setEnabled(active);
  at_once_->setVisible(leads_);
  zero_->setVisible(leads_);
  at_once_->setEnabled(active);
  zero_->setEnabled(active);
}

}  // namespace monarch_flight
