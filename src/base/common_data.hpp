// SPDX-License-Identifier: MIT
/// Data that all processes of a run receive.
#pragma once

#include "base/bytes.hpp"
#include "base/ranks.hpp"

#include <utility>
#include <vector>

namespace tribo {

/// The values of all ranks, in the order of the ranks, on every rank. All ranks must call it together.
template <class T>
std::vector<T> values_of_all_ranks(const std::vector<T>& mine) {
  if (ranks().count() == 1) return mine;
  ByteWriter own, all;
  own.values(std::span<const T>(mine));
  for (const auto& message : ranks().gather(std::move(own.data))) all.values(std::span<const std::byte>(message));
  ranks().broadcast(all.data);
  std::vector<T> out(all.data.size() / sizeof(T));
  ByteReader(all.data).values(std::span<T>(out));
  return out;
}

/// The value of rank 0, on every rank. All ranks must call it together.
template <class T>
T value_of_first_rank(const T& mine) {
  if (ranks().count() == 1) return mine;
  ByteWriter message;
  message.value(mine);
  ranks().broadcast(message.data);
  return ByteReader(message.data).value<T>();
}

}  // namespace tribo
