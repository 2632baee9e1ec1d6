#pragma once
#include <QObject>
#include <QTimer>
#include <functional>
#include <memory>
#include <string>

namespace monarch_flight {

/// What became of a service call.
struct ServiceAnswer {
  bool success = false;
  std::string message;
};

/// Calls services without holding up the window: each call waits in a thread of its own, and its
/// answer comes in the window's thread. One call at a time.
class ServiceCalls : public QObject {
  Q_OBJECT

 public:
  using Call = std::function<ServiceAnswer()>;

  explicit ServiceCalls(QObject* parent);
  ~ServiceCalls() override;
  /// False while another call is under way.
  bool start(const std::string& what, Call call);
  bool busy() const { return !what_.empty(); }

 Q_SIGNALS:
  /// `what`: the name given to start().
  void answered(const QString& what, bool success, const QString& message);

 private:
  struct Link;
  void end(std::uint64_t number, const ServiceAnswer& answer);

  std::shared_ptr<Link> link_;  // to threads, which may outlive this
  QTimer limit_;
  std::string what_;  // is called; empty: nothing
  std::uint64_t number_ = 0;
};

}  // namespace monarch_flight
