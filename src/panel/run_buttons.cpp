#include "panel/run_buttons.h"

#include <monarch_flight/FlySteps.h>
#include <ros/service.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <QGridLayout>
#include <QVBoxLayout>

namespace monarch_flight {
namespace {

constexpr int kLook = 1000;  // for services [ms]
const char kRun[] = "run", kReplay[] = "replay";

/// The player of replay.launch, beside the namespace of the run.
std::string playerOf(const std::string& space) {
  return space.substr(0, space.rfind('/')) + "/player/pause_playback";
}

template <class Service>
ServiceAnswer answerOf(const std::string& name, Service service) {
  if (!ros::service::exists(name, false)) return {false, "there is no service " + name};
  if (!ros::service::call(name, service)) return {false, name + " gave no answer"};
  return {static_cast<bool>(service.response.success), service.response.message};
}

}  // namespace

RunButtons::RunButtons(QWidget* parent)
    : QWidget(parent),
      calls_(this),
      pauses_(this),
      looks_(this),
      steps_(new QSpinBox),
      message_(new QLabel) {
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(2);
  auto* grid = new QGridLayout;
  grid->setSpacing(2);
  all->addLayout(grid);
  grid->addWidget(add("Pause", "pause", "Hold the run before the next sub-iteration"), 0, 0);
  grid->addWidget(add("Resume", "resume", "Fly on"), 0, 1);
  grid->addWidget(add("Reset", "reset", "Back to the start; everything flown is void"), 0, 2);
  grid->addWidget(add("Step", "step", "Fly so many steps of a held run, then hold it"), 1, 0);
  steps_->setRange(1, 100000);
  steps_->setObjectName("steps");
  steps_->setToolTip("Steps that Step flies");
  grid->addWidget(steps_, 1, 1);
  grid->addWidget(add("Sub-iterate", "sub_iterate", "One sub-iteration of a held run"), 1, 2);
  grid->addWidget(add("Checkpoint", "checkpoint", "Keep the last committed step"), 2, 0, 1, 3);
  message_->setWordWrap(true);
  message_->setObjectName("message");
  message_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  message_->setMinimumHeight(2 * fontMetrics().lineSpacing());  // nothing moves when it comes
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  all->addWidget(message_);
  for (ServiceCalls* calls : {&calls_, &pauses_})
    connect(calls, &ServiceCalls::answered, this, &RunButtons::told);
  connect(&looks_, &ServiceCalls::answered, this,
          [this](const QString&, bool, const QString& found) { looked(found); });
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, &RunButtons::look);
  timer->start(kLook);
  enable();
}

QPushButton* RunButtons::add(const QString& name, const QString& service, const QString& tip) {
  auto* button = new QPushButton(name);
  button->setObjectName(service);
  button->setToolTip(tip);
  button->setMinimumWidth(10);
  connect(button, &QPushButton::clicked, this, [this, service] { call(service); });
  buttons_.push_back(button);
  return button;
}

void RunButtons::setSpace(const std::string& space) {
  space_ = space;
  message_->clear();
  looked("");
  look();
}

void RunButtons::call(const QString& service) {
  ServiceCalls& calls = service == "pause" ? pauses_ : calls_;
  if (calls.start(service.toStdString(), callOf(service.toStdString())))
    message_->setText(service + " ...");
  enable();
}

/// What a thread does: it takes nothing of this with it.
ServiceCalls::Call RunButtons::callOf(const std::string& service) const {
  if (led_ == Led::kReplay) {
    const bool pause = service == "pause";
    return [name = playerOf(space_), pause] {
      std_srvs::SetBool player;
      player.request.data = pause;
      return answerOf(name, player);
    };
  }
  const std::string name = space_ + "/" + service;
  if (service != "step") return [name] { return answerOf(name, std_srvs::Trigger()); };
  return [name, steps = static_cast<std::uint32_t>(steps_->value())] {
    FlySteps fly;
    fly.request.steps = steps;
    return answerOf(name, fly);
  };
}

/// The master may be slow, or gone.
void RunButtons::look() {
  if (space_.empty()) return;
  looks_.start("look", [run = space_ + "/pause", player = playerOf(space_)] {
    if (ros::service::exists(run, false)) return ServiceAnswer{true, kRun};
    return ServiceAnswer{true, ros::service::exists(player, false) ? kReplay : ""};
  });
}

void RunButtons::looked(const QString& found) {
  const Led led = found == kRun ? Led::kRun : found == kReplay ? Led::kReplay : Led::kNothing;
  if (led == led_) return;
  led_ = led;
  enable();
  Q_EMIT ledChanged();
}

void RunButtons::told(const QString& what, bool success, const QString& message) {
  message_->setText(success ? (message.isEmpty() ? what + ": done" : message)
                            : what + " failed: " + message);
  QPalette colours = palette();
  if (!success) colours.setColor(QPalette::WindowText, QColor(200, 60, 50));
  message_->setPalette(colours);
  enable();
}

void RunButtons::enable() {
  for (QPushButton* button : buttons_) {
    const bool of_player = button->objectName() == "pause" || button->objectName() == "resume";
    const bool free = !(button->objectName() == "pause" ? pauses_ : calls_).busy();
    button->setEnabled(free && (led_ == Led::kRun || (led_ == Led::kReplay && of_player)));
  }
  steps_->setEnabled(led_ == Led::kRun);
}

}  // namespace monarch_flight
