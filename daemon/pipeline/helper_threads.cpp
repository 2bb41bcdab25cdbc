#include "daemon/pipeline/helper_threads.hpp"

#include <pthread.h>
#include <utility>

namespace azimuth {

TaskThread::TaskThread() : thread_([this](const std::stop_token& stop) { run(stop); }) {
  pthread_setname_np(thread_.native_handle(), "hindsight");
}

TaskThread::~TaskThread() { finish(); }

void TaskThread::begin(std::function<void()> work) {
  {
    const std::scoped_lock lock(mutex_);
    work_ = std::move(work);
  }
  changed_.notify_all();
}

void TaskThread::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !work_; });
}

void TaskThread::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return static_cast<bool>(work_); })) {
    lock.unlock();
    work_();  // needs no lock: no other work may begin meanwhile
    lock.lock();
    work_ = nullptr;
    changed_.notify_all();
  }
}

WorkerThreads::WorkerThreads(int threads) {
  for (int i = 1; i < threads; ++i) {
    threads_.emplace_back([this](const std::stop_token& stop) { run(stop); });
    pthread_setname_np(threads_.back().native_handle(), "hypotheses");
  }
}

WorkerThreads::~WorkerThreads() {
  for (std::jthread& thread : threads_) thread.request_stop();
}

void WorkerThreads::for_each(std::size_t count, const std::function<void(std::size_t)>& task) {
  {
    const std::scoped_lock lock(mutex_);
    task_ = &task;
    count_ = count;
    next_.store(0, std::memory_order_relaxed);
    at_work_ = threads_.size();
    ++round_;
  }
  changed_.notify_all();
  do_some();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return at_work_ == 0; });
}

void WorkerThreads::do_some() {
  for (std::size_t at = next_++; at < count_; at = next_++) (*task_)(at);
}

void WorkerThreads::run(const std::stop_token& stop) {
  std::size_t done = 0;  // the last round in which this thread took part
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [&] { return round_ != done; })) {
    done = round_;
    lock.unlock();
    do_some();
    lock.lock();
    if (--at_work_ == 0) changed_.notify_all();
  }
}

}  // namespace azimuth
