#pragma once
// Runs a server on its own thread, as the command does, and runs functions on that thread.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <poll.h>
#include <sys/eventfd.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include "base/unique_fd.hpp"
#include "tools/view_server/http_server.hpp"

namespace azimuth::test {

class Served {
 public:
  /// Opens the server and starts its thread.
  Served(const HttpSettings& settings, HttpHandler& handler) : server_(HttpServer::open(settings, handler).value()) {
    port_ = server_->port();
    thread_ = std::thread([this] { run(); });
  }
  ~Served() {
    stop_ = true;
    ring();
    thread_.join();
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  std::uint16_t port() const { return port_; }

  /// Runs `work` on the thread of the server, between two turns, and waits until it has finished.
  void there(const std::function<void(HttpServer&)>& work) {
    std::promise<void> done;
    {
      const std::lock_guard lock(mutex_);
      work_.emplace_back([&] {
        work(*server_);
        done.set_value();
      });
    }
    ring();
    done.get_future().wait();
  }

 private:
  void ring() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = ::write(bell_.get(), &one, sizeof one);
  }

  void run() {
    while (!stop_) {
      pollfd ready[] = {{bell_.get(), POLLIN, 0}, {server_->descriptor(), POLLIN, 0}};
      const auto due = server_->due_in().value_or(std::chrono::milliseconds(100));
      ::poll(ready, 2, static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(due).count()));
      std::uint64_t rung = 0;
      [[maybe_unused]] const ssize_t got = ::read(bell_.get(), &rung, sizeof rung);
      std::vector<std::function<void()>> work;
      {
        const std::lock_guard lock(mutex_);
        work.swap(work_);
      }
      for (const auto& each : work) each();
      server_->turn();
    }
    server_.reset();
  }

  std::unique_ptr<HttpServer> server_;
  std::uint16_t port_ = 0;
  UniqueFd bell_{::eventfd(0, EFD_NONBLOCK)};
  std::mutex mutex_;
  std::vector<std::function<void()>> work_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace azimuth::test
