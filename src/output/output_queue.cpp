// SPDX-License-Identifier: MIT
#include "output/output_queue.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

namespace tribo {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

}  // namespace

OutputQueue::~OutputQueue() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  given_.notify_one();
  thread_.join();
}

void OutputQueue::begin(std::int64_t step) {
  if (step == step_) return;
  step_ = step, of_step_ = 0;
  wait_until_at_most(limit_);
}

void OutputQueue::add(std::size_t bytes, Job job) {
  of_step_ += bytes, most_ = std::max(most_, of_step_);
  if (!thread_.joinable() && !no_thread_) start();
  std::unique_lock lock(mutex_);
  if (error_) std::rethrow_exception(error_);
  if (no_thread_) {
    const auto begin = Clock::now();
    try {
      job();
      seconds_ += seconds_since(begin);
    } catch (...) {
      error_ = std::current_exception();
      throw;
    }
    return;
  }
  jobs_.push_back({bytes, std::move(job)}), pending_ += bytes;
  lock.unlock();
  given_.notify_one();
}

void OutputQueue::drain() {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return jobs_.empty() && !working_; });
  if (error_) std::rethrow_exception(error_);
}

void OutputQueue::wait_until_at_most(std::size_t bytes) {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return pending_ <= bytes; });
  if (error_) std::rethrow_exception(error_);
}

double OutputQueue::seconds() {
  const std::lock_guard lock(mutex_);
  return seconds_;
}

void OutputQueue::start() {
  try {
    thread_ = std::thread([this] { work(); });
  } catch (const std::system_error&) {
    no_thread_ = true;
  }
}

void OutputQueue::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    given_.wait(lock, [&] { return ends_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    Waiting next = std::move(jobs_.front());
    jobs_.pop_front();
    working_ = true;
    lock.unlock();
    std::exception_ptr error;
    const auto begin = Clock::now();
    try {
      next.job();
    } catch (...) {
      error = std::current_exception();
    }
    next.job = {};  // its memory, before others may use as much
    std::deque<Waiting> dropped;
    lock.lock();
    working_ = false, pending_ -= next.bytes, seconds_ += seconds_since(begin);
    if (error) error_ = error, pending_ = 0, dropped.swap(jobs_);
    done_.notify_all();
  }
}

}  // namespace tribo
