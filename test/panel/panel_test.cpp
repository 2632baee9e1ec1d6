// The panel of rviz, loaded as rviz loads it, without a display, beside a flight of real nodes.
#include <monarch_flight/WingbeatCommand.h>
#include <rviz/config.h>
#include <rviz/panel.h>

#include <QApplication>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QSlider>
#include <QSpinBox>
#include <pluginlib/class_loader.hpp>

#include "ros/nodes_fixture.h"

namespace monarch_flight {
namespace {

class Panel : public Nodes {
 protected:
  Panel() : loader_("rviz", "rviz::Panel"), panel_(loader_.createUnmanagedInstance(kClass)) {
    rviz::Config config;
    config.mapSetValue("Namespace", "/monarch_flight");
    panel_->load(config);
    panel_->show();
  }
  ~Panel() override { delete panel_; }

  template <class Widget>
  Widget* find(const char* name) {
    auto* widget = panel_->findChild<Widget*>(name);
    EXPECT_NE(nullptr, widget) << name;
    return widget;
  }
  /// The window lives on until `condition` holds; false: not within the limit.
  template <class Condition>
  bool until(Condition condition, double limit_s = 20.0) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(limit_s);
    while (!condition()) {
      if (ros::WallTime::now() > end) return false;
      ros::spinOnce();
      QApplication::processEvents(QEventLoop::AllEvents, 10);
      ros::WallDuration(0.005).sleep();
    }
    return true;
  }
  QString message() { return find<QLabel>("message")->text(); }
  /// Waits until the button can be pressed, and for the answer.
  void press(const char* name) {
    auto* button = find<QPushButton>(name);
    ASSERT_TRUE(until([&] { return button->isEnabled(); }))
        << name << ": " << message().toStdString();
    button->click();
    ASSERT_TRUE(until([&] { return !message().endsWith("..."); })) << name;
  }

  static constexpr char kClass[] = "monarch_flight/FlightPanel";
  pluginlib::ClassLoader<rviz::Panel> loader_;
  rviz::Panel* panel_;
};

TEST_F(Panel, LeadsAFlight) {
  ros::param::set("/monarch_flight/rate", 0.05);  // else it would be over before it is paused
  startLongFlight();
  press("pause");
  EXPECT_TRUE(message().startsWith("held after step ")) << message().toStdString();
  find<QSpinBox>("steps")->setValue(7);
  const int before = message().section(' ', 3, 3).remove(',').toInt();
  press("step");
  EXPECT_EQ(QString("held after step %1").arg(before + 7), message());
  auto* numbers = find<QLabel>("numbers");
  EXPECT_TRUE(until([&] {
    return numbers->text().contains(QString("step %1 of").arg(before + 7));
  })) << numbers->text().toStdString();
  press("sub_iterate");
  EXPECT_TRUE(message().contains("sub-iteration 0 of step")) << message().toStdString();
  press("checkpoint");
  EXPECT_TRUE(message().startsWith("checkpoint of step ")) << message().toStdString();
  press("reset");
  EXPECT_EQ("held after step 0", message());
  press("resume");
  EXPECT_TRUE(message().startsWith("flying after step ")) << message().toStdString();
  EXPECT_FALSE(find<QPushButton>("all_zero")->isEnabled());  // nobody leads this flight
}

TEST_F(Panel, SlidersCommandWhereAPersonLeads) {
  ros::param::set("/monarch_flight/guidance", "commands");
  ros::param::set("/monarch_flight/rate", 0.05);
  startLongFlight();
  QSlider* slider = nullptr;
  ASSERT_TRUE(
      until([&] { return (slider = panel_->findChild<QSlider*>("amplitude")) != nullptr; }));
  ASSERT_TRUE(until([&] { return slider->isEnabled(); }));
  WingbeatCommandConstPtr heard;
  ros::NodeHandle node;
  const ros::Subscriber listener = node.subscribe<WingbeatCommand>(
      "/monarch_flight/command", 10, [&heard](const WingbeatCommandConstPtr& m) { heard = m; });
  ASSERT_TRUE(until([&] { return listener.getNumPublishers() > 0; }));
  slider->setValue(slider->maximum());
  ASSERT_TRUE(until([&] { return heard != nullptr; }));
  EXPECT_GT(heard->amplitude, 0.0);
  const double most = heard->amplitude;
  slider->setValue(slider->maximum() / 2);
  ASSERT_TRUE(until([&] { return heard->amplitude < most; }));
  EXPECT_NEAR(0.5 * most, heard->amplitude, 0.02 * most);
  press("pause");
}

TEST_F(Panel, MakesTheWindowAsLargeAsTheScreenWhereItsFileSaysSo) {
  const QSize screen = QGuiApplication::primaryScreen()->availableGeometry().size();
  const auto filled = [&] {  // all but the frame of a window
    return panel_->width() > 0.98 * screen.width() && panel_->height() > 0.9 * screen.height();
  };
  EXPECT_FALSE(until(filled, 0.5));
  rviz::Config config;
  config.mapSetValue("Fill Screen", true);
  panel_->load(config);
  EXPECT_TRUE(until(filled, 5.0)) << panel_->width() << " x " << panel_->height();
}

TEST_F(Panel, WithoutARunNothingCanBePressed) {
  ros::NodeHandle node;
  until([] { return false; }, 2.5);  // it has looked for services
  for (const char* name : {"pause", "resume", "step", "sub_iterate", "reset", "checkpoint"})
    EXPECT_FALSE(find<QPushButton>(name)->isEnabled()) << name;
  EXPECT_EQ("<b>no flight yet</b>", find<QLabel>("place")->text());
}

}  // namespace
}  // namespace monarch_flight

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  setenv("QT_QPA_PLATFORM", "offscreen", 1);
  ros::init(argc, argv, "panel_test");
  ros::NodeHandle keep;
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
