#include "panel/flight_panel.h"

#include <rviz/visualization_manager.h>

#include <QFrame>
#include <QGridLayout>
#include <QGuiApplication>
#include <QScreen>
#include <QScrollArea>
#include <QTimer>
#include <pluginlib/class_list_macros.hpp>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/guidance_conversions.h"
#include "monarch_flight/run/config_directory.h"
#include "monarch_flight/run/progress.h"
#include "panel/view_buttons.h"

namespace monarch_flight {
namespace {

constexpr int kRefresh = 100;  // [ms]
constexpr std::uint32_t kQueue = 200;
constexpr char kSpaceKey[] = "Namespace";  // of the config
constexpr char kFillKey[] = "Fill Screen";

std::string spaceOf(const QString& typed) {
  std::string space = typed.trimmed().toStdString();
  while (!space.empty() && space.back() == '/') space.pop_back();
  const std::string own = "monarch_flight";
  const bool whole =
      space.size() >= own.size() && space.compare(space.size() - own.size(), own.size(), own) == 0;
  return whole ? space : space + (space.empty() ? "" : "/") + own;
}

QString share(std::optional<double> factor) {
  return factor ? QString::number(*factor, 'g', 2) + " of real time" : QString("-");
}

}  // namespace

FlightPanel::FlightPanel(QWidget* parent)
    : rviz::Panel(parent),
      area_(new QWidget),
      column_(new QVBoxLayout(area_)),
      space_(new QLineEdit),
      place_(new QLabel),
      numbers_(new QLabel),
      bar_(new QProgressBar),
      buttons_(new RunButtons(this)),
      plot_(new ConvergencePlot),
      scales_(new ScaleBars),
      sliders_(new CommandSliders) {
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(area_);
  all->addWidget(scroll);
  column_->setContentsMargins(6, 4, 6, 4);
  column_->setSpacing(3);
  add(makeProgress());
  add(buttons_);
  add(scales_, "Colours");
  add(plot_, "Convergence");
  add(sliders_, "Commands");
  add(space_, "Namespace of the run");
  column_->addStretch(1);
  space_->setPlaceholderText("that of rviz");
  space_->setToolTip("Where the flight was launched, as /a; empty: where rviz was");
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, &FlightPanel::refresh);
  timer->start(kRefresh);
  connect(space_, &QLineEdit::editingFinished, this, [this] {
    listen();
    Q_EMIT configChanged();
  });
  connect(buttons_, &RunButtons::ledChanged, this, [this] {
    sliders_->setListening(buttons_->led() == RunButtons::Led::kRun);
    fresh_ = true;
  });
  connect(sliders_, &CommandSliders::commanded, this,
          [this](const WingbeatChange& wanted, bool at_once) {
            WingbeatCommand command = toMessage(wanted);
            command.at_once = at_once;
            command_.publish(command);
          });
}

void FlightPanel::onInitialize() {
  auto* views = new ViewButtons(vis_manager_->getViewManager(), this);
  auto* title = new QLabel("<b>View</b>");
  column_->insertWidget(2, title);
  column_->insertWidget(3, views);
  listen();
}

void FlightPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  config.mapGetBool(kFillKey, &fill_);
  QString space;
  if (!config.mapGetString(kSpaceKey, &space) || space == space_->text()) return;
  space_->setText(space);
  listen();
}

void FlightPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue(kSpaceKey, space_->text());
}

void FlightPanel::add(QWidget* widget, const QString& title) {
  if (!title.isEmpty()) column_->addWidget(new QLabel("<b>" + title + "</b>"));
  column_->addWidget(widget);
}

QWidget* FlightPanel::makeProgress() {
  auto* progress = new QWidget;
  auto* column = new QVBoxLayout(progress);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  place_->setWordWrap(true);
  place_->setObjectName("place");
  numbers_->setObjectName("numbers");
  bar_->setRange(0, 1000);
  bar_->setTextVisible(false);
  bar_->setMaximumHeight(10);
  column->addWidget(place_);
  column->addWidget(bar_);
  column->addWidget(numbers_);
  return progress;
}

/// To the topics of the namespace; what was known of another one is forgotten.
void FlightPanel::listen() {
  heard_.clear();
  case_.reset();
  case_text_.clear();
  taken_.reset();
  progress_ = RunProgress();
  plot_->clear();
  scales_->show(ColourScales());
  sliders_->setCase(nullptr);
  fresh_ = true;
  try {
    ros::NodeHandle node(spaceOf(space_->text()));
    heard_ = {node.subscribe("case", 1, &FlightPanel::onCase, this),
              node.subscribe("state", kQueue, &FlightPanel::onState, this),
              node.subscribe("iterations", kQueue, &FlightPanel::onIterations, this),
              node.subscribe("colour_scales", 1, &FlightPanel::onScales, this)};
    command_ = node.advertise<WingbeatCommand>("command", 10);
    buttons_->setSpace(node.getNamespace());
    place_->setToolTip(QString::fromStdString(node.getNamespace()));
  } catch (const ros::InvalidNameException& e) {
    place_->setText(QString("no namespace: ") + e.what());
  }
}

void FlightPanel::onCase(const std_msgs::String& text) {
  if (text.data == case_text_) return;  // a bag that is played again
  case_text_ = text.data;
  try {
    case_ = caseFromText(text.data, "case", {}, configDirectory());
    progress_.setTime(case_->time);
  } catch (const InputError& e) {
    ROS_WARN("the panel cannot read this flight's case: %s", e.what());
    case_.reset();
  }
  sliders_->setCase(case_ ? &*case_ : nullptr);
  fresh_ = true;
}

void FlightPanel::onState(const FlightState& state) {
  // Stamps are 1 s + the time since step 0.
  progress_.add(state.step, state.header.stamp.toSec() - 1.0, RunProgress::Clock::now());
  taken_ = state.guidance.command;
  fresh_ = true;
}

void FlightPanel::onIterations(const StepIterations& step) { plot_->add(step); }

void FlightPanel::onScales(const ColourScales& scales) { scales_->show(scales); }

QString FlightPanel::place() const {
  const QString name = case_ ? QString::fromStdString(case_->name) : QString("flight");
  const bool moves = progress_.moves(RunProgress::Clock::now());
  switch (buttons_->led()) {
    case RunButtons::Led::kReplay:
      return name + (moves ? ": replay" : ": replay, held");
    case RunButtons::Led::kRun:
      return name + (progress_.complete() ? ": complete"
                     : moves              ? ": flying"
                                          : ": held or waiting");
    default:
      if (!progress_.known()) return "no flight yet";
      return name + (progress_.complete() ? ": complete" : moves ? ": replay" : ": over");
  }
}

/// The window over all of the screen that no bar of the desktop takes, once it is there. Not saved:
/// what a person saves keeps the size that it has.
void FlightPanel::fillScreen() {
  QWidget* all = window();
  if (!fill_ || !all->isVisible()) return;
  fill_ = false;
  if (all->isFullScreen()) return;
  all->setGeometry(QGuiApplication::primaryScreen()->availableGeometry());
  all->showMaximized();
}

/// Ten times a second, however many steps have come.
void FlightPanel::refresh() {
  fillScreen();
  if (place_->text() != "<b>" + place() + "</b>") place_->setText("<b>" + place() + "</b>");
  if (!fresh_) return;
  fresh_ = false;
  const double steps = std::max(progress_.steps(), 1U);
  bar_->setValue(static_cast<int>(1000.0 * progress_.step() / steps));
  const auto left = progress_.left();
  QString text = QString("step %1 of %2").arg(progress_.step()).arg(progress_.steps());
  if (progress_.flaps() > 0.0)
    text = QString("flap %1 of %2, ")
               .arg(progress_.flap(), 0, 'f', 2)
               .arg(progress_.flaps(), 0, 'g', 4) +
           text;
  text += QString("\ntime %1 s, ").arg(progress_.time(), 0, 'f', 4);
  text += "left " + (left ? QString::fromStdString(clockText(*left)) : QString("-"));
  text += "\nspeed " + share(progress_.realTimeFactor());
  numbers_->setText(text);
  if (taken_) sliders_->follow(fromMessage(*taken_));
  plot_->update();
}

}  // namespace monarch_flight

PLUGINLIB_EXPORT_CLASS(monarch_flight::FlightPanel, rviz::Panel)
