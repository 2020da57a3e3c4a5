// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "output/history.hpp"
#include "output/output_queue.hpp"
#include "output/vtk.hpp"
#include "tests/scratch.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <fstream>
#include <future>
#include <new>
#include <thread>
#include <vector>

using namespace tribo;

namespace {

/// A job that waits until it is released.
struct Gate {
  std::promise<void> open;
  std::shared_future<void> opened = open.get_future().share();
  OutputQueue::Job job() const {
    return [opened = opened] { opened.wait(); };
  }
};

void wait_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

}  // namespace

TEST_CASE("jobs are done on another thread, in the order in which they were given", "[output]") {
  std::vector<int> done;
  OutputQueue queue;
  bool elsewhere = false;
  queue.add(1, [&, here = std::this_thread::get_id()] { elsewhere = std::this_thread::get_id() != here; });
  for (int k = 0; k < 1000; ++k) queue.add(8, [&done, k] { done.push_back(k); });
  queue.drain();
  CHECK(elsewhere);
  REQUIRE(done.size() == 1000);
  for (int k = 0; k < 1000; ++k) CHECK(done[static_cast<std::size_t>(k)] == k);
  queue.drain();  // nothing to do
  CHECK(queue.seconds() > 0);
  OutputQueue idle;
  idle.drain();
}

TEST_CASE("a run waits only where the output of another step begins and too much is pending", "[output]") {
  Gate gate;
  OutputQueue queue(100);
  std::atomic<int> done{0};
  queue.begin(1);
  queue.add(1, gate.job());
  for (int k = 0; k < 3; ++k) queue.add(1000, [&] { ++done; });  // of one step: any number
  queue.begin(1);
  CHECK(done == 0);
  CHECK(queue.most_bytes_of_step() == 3001);
  std::atomic<bool> began{false};
  std::thread run([&] { queue.begin(2), began = true; });
  wait_a_little();
  CHECK_FALSE(began);
  gate.open.set_value();
  run.join();
  CHECK(done >= 3);
  queue.add(10, [] {});
  queue.begin(3);
  queue.drain();
  CHECK(queue.most_bytes_of_step() == 3001);
}

TEST_CASE("the error of a job is thrown by every later call, and no later job is done", "[output]") {
  const auto check = [](auto&& error, auto&& type) {
    using Error = std::decay_t<decltype(type)>;
    OutputQueue queue;
    bool later = false;
    Gate gate;
    queue.add(1, gate.job());
    queue.add(1, [&] { throw error; });
    queue.add(1, [&] { later = true; });
    gate.open.set_value();
    CHECK_THROWS_AS(queue.drain(), Error);
    CHECK_THROWS_AS(queue.begin(7), Error);
    CHECK_THROWS_AS(queue.add(1, [&] { later = true; }), Error);
    CHECK_THROWS_AS(queue.drain(), Error);
    CHECK_FALSE(later);
  };
  check(FileError("full"), FileError("full"));
  check(SimulationError("not finite"), SimulationError("not finite"));
  check(std::bad_alloc(), std::bad_alloc());
  OutputQueue ends_with_an_error;
  ends_with_an_error.add(1, [] { throw FileError("full"); });
}

TEST_CASE("what was given is written at the end, also if nothing waits for it", "[output]") {
  int done = 0;
  {
    OutputQueue queue;
    for (int k = 0; k < 50; ++k) queue.add(1, [&] { ++done; });
  }
  CHECK(done == 50);
}

TEST_CASE("checkpoints and versions of a file are left out while newer ones wait", "[output]") {
  std::string done;
  Gate gate;
  OutputQueue queue;
  queue.add(1, gate.job());
  wait_a_little();  // the queue is at work
  const auto write = [&](char what) { return [&done, what] { done += what; }; };
  for (const char k : {'1', '2', '3', '4'}) {
    queue.add(1, write('f'));
    queue.add_version("run.pvd", 1, write('p'));
    queue.add_version("grid.pvd", 1, write('g'));
    queue.add_checkpoint(1, write(k));
  }
  gate.open.set_value();
  queue.drain();
  // the first and the last checkpoint, and before each of them all that is older
  CHECK(done == "fpg1fffpg4");
  done.clear();
  for (const char k : {'5', '6'}) {  // with time, all of them
    queue.add_version("run.pvd", 1, write('p')), queue.drain();
    queue.add_checkpoint(1, write(k)), queue.drain();
  }
  CHECK(done == "p5p6");
}

TEST_CASE("rows of tables and entries of collections keep their order among other jobs", "[output]") {
  const ScratchFolder scratch;
  const auto lines = [&](const char* name) {
    std::ifstream file(scratch.path / name);
    std::vector<std::string> out;
    for (std::string line; std::getline(file, line);) out.push_back(line);
    return out;
  };
  Gate gate;
  OutputQueue queue;
  queue.add(1, gate.job());
  {
    History table(scratch.path / "h.csv", {"time", "x"}, &queue);
    Collection list(scratch.path / "run.pvd");
    for (const double t : {0.0, 0.5}) {
      table.add(std::array{t, 2 * t});
      list.add(t, "p", &queue);
    }
    CHECK(lines("h.csv").size() == 1);
    CHECK_FALSE(std::filesystem::exists(scratch.path / "run.pvd"));
  }  // the queue does not need them any more
  queue.add(1, [&] { CHECK(lines("h.csv") == std::vector<std::string>{"time,x", "0,0", "0.5,1"}); });
  gate.open.set_value();
  queue.drain();
  CHECK(read_collection(scratch.path / "run.pvd").size() == 2);
  CHECK(read_collection(scratch.path / "run.pvd").back().time == 0.5);
}
