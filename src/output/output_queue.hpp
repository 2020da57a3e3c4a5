// SPDX-License-Identifier: MIT
/// Output that the run does not wait for.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace tribo {

/// Does jobs, one after the other in the order in which they were given, on a thread of its own. A job owns what it
/// needs, a copy of the state of the run, so that the files do not depend on when it is done. After a job that throws
/// no further one is done, and the next call throws the same error, as do all calls after it. If no thread can be
/// started, jobs are done when they are given. For use by a single thread.
class OutputQueue {
 public:
  using Job = std::function<void()>;
  static constexpr std::size_t usual_limit = std::size_t{16} << 20;
  static constexpr std::size_t usual_most_copied = std::size_t{256} << 20;
  static constexpr std::size_t most_of_parts = std::size_t{96} << 20;

  /// `limit`: bytes of jobs that may wait when the output of another step begins. `most_copied`: output that needs a
  /// larger copy of the state is to be written by the run itself, from copies of parts that take no more than
  /// most_of_parts together.
  explicit OutputQueue(std::size_t limit = usual_limit, std::size_t most_copied = usual_most_copied)
      : limit_(limit), most_copied_(most_copied) {}
  /// Does the jobs that were given; an error is lost.
  ~OutputQueue();
  OutputQueue(const OutputQueue&) = delete;
  OutputQueue& operator=(const OutputQueue&) = delete;

  std::size_t most_copied() const { return most_copied_; }

  /// Begins the output of a step, if it has not begun yet: waits until former jobs hold no more than the limit.
  void begin(std::int64_t step);
  /// Takes a job that holds `bytes` of memory.
  void add(std::size_t bytes, Job job) { take({Kind::plain, {}, bytes, std::move(job)}); }
  /// A job that writes a file anew. It is left out if another one for the same file follows before a checkpoint.
  void add_version(std::string file, std::size_t bytes, Job job) {
    take({Kind::version, std::move(file), bytes, std::move(job)});
  }
  /// A job that writes a checkpoint. It is left out if another one is waiting before it and one after it: where files
  /// are slower than the run, not all checkpoints are written, but one of them always is the next.
  void add_checkpoint(std::size_t bytes, Job job) { take({Kind::checkpoint, {}, bytes, std::move(job)}); }
  /// Waits until all jobs are done.
  void drain();

  /// Time spent on jobs [s].
  double seconds();
  /// The most memory that the jobs of a step have held so far.
  std::size_t most_bytes_of_step() const { return most_; }

 private:
  enum class Kind { plain, version, checkpoint };
  struct Waiting {
    Kind kind = Kind::plain;
    std::string file;
    std::size_t bytes = 0;
    Job job;
  };
  void take(Waiting waiting);
  void do_at_once(const Job& job);
  void leave_out_checkpoint();
  bool is_replaced(const Waiting& version) const;
  void start();
  void work();
  void wait_until_at_most(std::size_t bytes);

  std::size_t limit_, most_copied_, of_step_ = 0, most_ = 0;
  std::optional<std::int64_t> step_;
  std::thread thread_;
  bool no_thread_ = false;

  std::mutex mutex_;  // of all that follows
  std::condition_variable given_, done_;
  std::deque<Waiting> jobs_;
  bool working_ = false, ends_ = false;
  std::size_t pending_ = 0;  // bytes of jobs not done yet
  std::exception_ptr error_;
  double seconds_ = 0.0;
};

}  // namespace tribo
