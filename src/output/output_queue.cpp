// SPDX-License-Identifier: MIT
#include "output/output_queue.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
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

void OutputQueue::take(Waiting waiting) {
  of_step_ += waiting.bytes, most_ = std::max(most_, of_step_);
  if (!thread_.joinable() && !no_thread_) start();
  {
    const std::lock_guard lock(mutex_);
    if (error_) std::rethrow_exception(error_);
    if (no_thread_) return do_at_once(waiting.job);
    if (waiting.kind == Kind::checkpoint) leave_out_checkpoint();
    pending_ += waiting.bytes;
    jobs_.push_back(std::move(waiting));
  }
  given_.notify_one();
}

void OutputQueue::do_at_once(const Job& job) {
  const auto begin = Clock::now();
  try {
    job();
    seconds_ += seconds_since(begin);
  } catch (...) {
    error_ = std::current_exception();
    throw;
  }
}

// The last one that is waiting, if it is not the only one.
void OutputQueue::leave_out_checkpoint() {
  const auto is_checkpoint = [](const Waiting& w) { return w.kind == Kind::checkpoint; };
  const auto last = std::find_if(jobs_.rbegin(), jobs_.rend(), is_checkpoint);
  if (last == jobs_.rend() || std::none_of(std::next(last), jobs_.rend(), is_checkpoint)) return;
  pending_ -= last->bytes;
  jobs_.erase(std::next(last).base());
}

bool OutputQueue::is_replaced(const Waiting& version) const {
  for (const Waiting& later : jobs_) {
    if (later.kind == Kind::checkpoint) return false;
    if (later.kind == Kind::version && later.file == version.file) return true;
  }
  return false;
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
    if (next.kind == Kind::version && is_replaced(next)) next.job = [] {};
    lock.unlock();
    std::exception_ptr error;
    const auto begin = Clock::now();
    try {
      next.job();
    } catch (...) {
      error = std::current_exception();
    }
    next.job = {};  // its memory, before others may use as much
    lock.lock();
    working_ = false, pending_ -= next.bytes, seconds_ += seconds_since(begin);
    if (error) error_ = error, pending_ = 0, jobs_.clear();  // which, unlike an empty deque, takes no memory
    done_.notify_all();
  }
}

}  // namespace tribo
