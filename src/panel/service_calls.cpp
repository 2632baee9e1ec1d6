#include "panel/service_calls.h"

#include <QMetaObject>
#include <exception>
#include <mutex>
#include <thread>

namespace monarch_flight {
namespace {

constexpr int kLimit = 60000;  // of one call [ms]

}  // namespace

/// The way back from a thread; cut when the panel goes.
struct ServiceCalls::Link {
  std::mutex mutex;
  ServiceCalls* calls = nullptr;
};

ServiceCalls::ServiceCalls(QObject* parent) : QObject(parent), link_(std::make_shared<Link>()) {
  link_->calls = this;
  limit_.setSingleShot(true);
  limit_.setInterval(kLimit);
  connect(&limit_, &QTimer::timeout, this, [this] {
    end(number_, {false, "no answer within " + std::to_string(kLimit / 1000) + " s"});
  });
}

ServiceCalls::~ServiceCalls() {
  const std::lock_guard<std::mutex> lock(link_->mutex);
  link_->calls = nullptr;
}

bool ServiceCalls::start(const std::string& what, Call call) {
  if (busy()) return false;
  what_ = what;
  const std::uint64_t number = ++number_;
  limit_.start();
  std::thread([link = link_, call = std::move(call), number] {
    ServiceAnswer answer;
    try {
      answer = call();
    } catch (const std::exception& e) {
      answer.message = e.what();
    }
    const std::lock_guard<std::mutex> lock(link->mutex);
    if (link->calls == nullptr) return;
    ServiceCalls* calls = link->calls;
    QMetaObject::invokeMethod(
        calls, [calls, number, answer] { calls->end(number, answer); }, Qt::QueuedConnection);
  }).detach();
  return true;
}

/// An answer that comes after its limit is nobody's.
void ServiceCalls::end(std::uint64_t number, const ServiceAnswer& answer) {
  if (!busy() || number != number_) return;
  limit_.stop();
  const QString what = QString::fromStdString(what_);
  what_.clear();
  Q_EMIT answered(what, answer.success, QString::fromStdString(answer.message));
}

}  // namespace monarch_flight
