// SPDX-License-Identifier: MIT
#include "mpi/mpi.hpp"

#include "base/ranks.hpp"
#include "mpi/block_forest.hpp"

#include <mpi.h>
#include <p4est_base.h>
#include <sc.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace tribo {
namespace {

constexpr int message_tag = 1;
constexpr std::size_t largest_part = std::size_t{1} << 30;  // bytes; a count of MPI is an int

// Sends or receives in parts that MPI can count.
template <class F>
void each_part(std::size_t size, F&& f) {
  for (std::size_t first = 0; first < size; first += largest_part)
    f(first, static_cast<int>(std::min(largest_part, size - first)));
}

void check(int result, const char* what) {
  if (result != MPI_SUCCESS) throw std::runtime_error(std::string("MPI failed to ") + what);
}

}  // namespace

class MpiSession::Processes final : public Ranks {
 public:
  Processes() {
    check(MPI_Comm_rank(MPI_COMM_WORLD, &rank_), "number the processes");
    check(MPI_Comm_size(MPI_COMM_WORLD, &count_), "count the processes");
  }

  int rank() const override { return rank_; }
  int count() const override { return count_; }

  void add(std::span<std::int64_t> values) const override {
    check(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_SUM,
                        MPI_COMM_WORLD),
          "add numbers");
  }
  void largest(std::span<double> values) const override {
    check(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                        MPI_COMM_WORLD),
          "compare numbers");
  }

  std::vector<Message> exchange(std::span<const Message> sent) const override {
    std::vector<unsigned long long> to(static_cast<std::size_t>(count_)), from(to.size());
    for (const Message& message : sent) to[static_cast<std::size_t>(message.rank)] = message.data.size();
    check(MPI_Alltoall(to.data(), 1, MPI_UNSIGNED_LONG_LONG, from.data(), 1, MPI_UNSIGNED_LONG_LONG, MPI_COMM_WORLD),
          "exchange sizes");
    std::vector<Message> received;
    for (int rank = 0; rank < count_; ++rank)
      if (const auto size = from[static_cast<std::size_t>(rank)]; size > 0)
        received.push_back({rank, std::vector<std::byte>(size)});
    exchange(sent, received);
    return received;
  }
  void exchange(std::span<const Message> sent, std::span<Message> received) const override {
    std::vector<MPI_Request> requests;
    for (Message& message : received)
      each_part(message.data.size(), [&](std::size_t first, int size) {
        check(MPI_Irecv(message.data.data() + first, size, MPI_BYTE, message.rank, message_tag, MPI_COMM_WORLD,
                        &requests.emplace_back()),
              "receive a message");
      });
    for (const Message& message : sent)
      each_part(message.data.size(), [&](std::size_t first, int size) {
        check(MPI_Isend(message.data.data() + first, size, MPI_BYTE, message.rank, message_tag, MPI_COMM_WORLD,
                        &requests.emplace_back()),
              "send a message");
      });
    check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "finish messages");
  }

  std::vector<std::vector<std::byte>> gather(std::vector<std::byte> data) const override {
    std::vector<std::vector<std::byte>> out;
    if (rank_ != 0) {
      const Message mine{0, std::move(data)};
      exchange({&mine, 1});
      return out;
    }
    out.resize(static_cast<std::size_t>(count_));
    out[0] = std::move(data);
    for (Message& message : exchange({})) out[static_cast<std::size_t>(message.rank)] = std::move(message.data);
    return out;
  }
  void broadcast(std::vector<std::byte>& data) const override {
    unsigned long long size = data.size();
    check(MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD), "send a size");
    data.resize(size);
    each_part(data.size(), [&](std::size_t first, int count) {
      check(MPI_Bcast(data.data() + first, count, MPI_BYTE, 0, MPI_COMM_WORLD), "send a message to all");
    });
  }

 private:
  int rank_ = 0, count_ = 1;
};

MpiSession::MpiSession() {
  int provided = 0;
  check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "start");
  if (provided < MPI_THREAD_FUNNELED) throw std::runtime_error("this MPI does not work with threads");
  sc_init(MPI_COMM_WORLD, 0, 0, nullptr, SC_LP_ERROR);
  p4est_init(nullptr, SC_LP_ERROR);
  processes_ = std::make_unique<Processes>();
  set_ranks(processes_.get());
  partition_maker<2>() = make_forest_2d;
  partition_maker<3>() = make_forest_3d;
}

MpiSession::~MpiSession() {
  set_ranks(nullptr);
  processes_.reset();
  sc_finalize();
  MPI_Finalize();
}

void MpiSession::abort(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();
}

}  // namespace tribo
