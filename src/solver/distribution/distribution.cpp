// SPDX-License-Identifier: MIT
#include "solver/distribution/distribution.hpp"

#include "base/common_data.hpp"
#include "solver/distribution/particle_rows.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <set>
#include <unordered_map>

namespace tribo {
namespace {

constexpr double most_imbalance = 1.10;     // beyond it the blocks are divided anew
constexpr std::int64_t steps_between = 50;  // at least, between two divisions

}  // namespace

template <int Dim>
std::vector<Body<Dim>*> Distribution<Dim>::bodies() {
  std::vector<Body<Dim>*> out;
  for (auto* list : {&system_.bodies, &system_.rigids})
    for (auto& body : *list) out.push_back(&body);
  return out;
}

// Each rank gives the numbers of the particles in its blocks.
template <int Dim>
void Distribution<Dim>::divide() {
  std::unordered_map<std::int64_t, int> count;
  for (const Body<Dim>* body : bodies())
    for (const Bin& bin : body->bins.list()) count[bin.block] += static_cast<int>(bin.end - bin.begin);
  system_.partition->divide([&](const Index<Dim>& block) {
    const auto found = count.find(system_.lattice.block_index(block));
    return found == count.end() ? 0 : found->second;
  });
  divided_at_ = system_.step, ++counts_.divisions;
}

template <int Dim>
void Distribution<Dim>::share_out() {
  if (!active()) return;
  system_.partition = partition_maker<Dim>()(system_.lattice, layers_);
  divide();
  keep_own();
  shares_all_ = false;
  make_ghosts();
}

// Every rank has all particles in bins: it drops those of others.
template <int Dim>
void Distribution<Dim>::keep_own() {
  for (Body<Dim>* body : bodies()) {
    std::vector<BinContent<Dim>> own;
    std::vector<std::uint32_t> order;
    const auto contents = body->bins.contents();
    for (std::size_t k = 0; k < contents.size(); ++k) {
      const Bin& bin = body->bins.list()[k];
      if (!system_.partition->is_own(system_.lattice.block_at(bin.block))) continue;
      own.push_back(contents[k]);
      for (std::uint32_t i = bin.begin; i < bin.end; ++i) order.push_back(i);
    }
    body->particles.reorder(order);
    body->bins.assign(system_.lattice, own, {});
  }
}

template <int Dim>
void Distribution<Dim>::exchange() {
  if (!active()) return;
  if (shares_all_) return share_out();
  double mine = 0.0;
  for (const Body<Dim>* body : bodies()) mine += static_cast<double>(body->particles.size());
  OrderlessSums<1> all;
  all.add(mine);
  const double mean = all.total()[0] / ranks().count();
  imbalance_ = mean > 0 ? largest_of_ranks(mine) / mean : 1.0;
  move_leavers();
  if (imbalance_ > most_imbalance && system_.step >= divided_at_ + steps_between) divide(), move_leavers();
  make_ghosts();
}

// Sends the particles in blocks of other ranks to these.
template <int Dim>
bool Distribution<Dim>::move_leavers() {
  const auto all = bodies();
  std::vector<std::vector<std::vector<Bin>>> leaving(static_cast<std::size_t>(ranks().count()),
                                                     std::vector<std::vector<Bin>>(all.size()));
  std::vector<std::vector<std::uint32_t>> staying(all.size());
  for (std::size_t b = 0; b < all.size(); ++b)
    for (const Bin& bin : all[b]->bins.list()) {
      const int owner = system_.partition->owner(system_.lattice.block_at(bin.block));
      if (owner != ranks().rank()) {
        leaving[static_cast<std::size_t>(owner)][b].push_back(bin);
        continue;
      }
      for (std::uint32_t i = bin.begin; i < bin.end; ++i) staying[b].push_back(i);
    }
  std::vector<Message> sent;
  for (std::size_t rank = 0; rank < leaving.size(); ++rank) {
    const auto is_empty = [](const auto& bins) { return bins.empty(); };
    if (std::all_of(leaving[rank].begin(), leaving[rank].end(), is_empty)) continue;
    ByteWriter message;
    for (std::size_t b = 0; b < all.size(); ++b) {
      std::size_t count = 0;
      for (const Bin& bin : leaving[rank][b]) count += bin.end - bin.begin;
      message.value(count);
      write_rows(message, all[b]->particles, leaving[rank][b]);
    }
    sent.push_back({static_cast<int>(rank), std::move(message.data)});
  }
  const bool any_left = !sent.empty();
  const auto received = ranks().exchange(sent);
  if (!any_rank(any_left)) return false;
  for (std::size_t b = 0; b < all.size(); ++b)
    if (staying[b].size() < all[b]->particles.size()) all[b]->particles.reorder(staying[b]);
  for (const Message& message : received) {
    ByteReader reader(message.data);
    for (Body<Dim>* body : all) {
      const auto count = reader.value<std::size_t>(), before = body->particles.size();
      body->particles.resize(before + count);
      read_rows(reader, body->particles, before, count);
    }
  }
  for (Body<Dim>* body : all) body->bins.sort(system_.lattice, body->particles);
  return true;
}

// The contents of the bins of a body in the blocks that a partner needs.
template <int Dim>
std::vector<BinContent<Dim>> Distribution<Dim>::contents_for(const Partner& partner, const Body<Dim>& body) const {
  std::vector<BinContent<Dim>> out;
  const auto contents = body.bins.contents();
  for (const std::int64_t block : partner.sent) {
    const auto at = std::ranges::lower_bound(contents, block, {}, &BinContent<Dim>::block);
    if (at != contents.end() && at->block == block) out.push_back(*at);
  }
  return out;
}

// The own bins of all bodies, and those in the ghost blocks.
template <int Dim>
std::vector<KnownBins<Dim>> Distribution<Dim>::known_bins() {
  std::vector<KnownBins<Dim>> out;
  for (const Body<Dim>* body : bodies()) out.push_back({body, body->bins.contents()});
  std::vector<Message> sent;
  for (const Partner& partner : partners_) {
    ByteWriter message;
    for (const auto& known : out) message.list(contents_for(partner, *known.body));
    sent.push_back({partner.rank, std::move(message.data)});
  }
  for (const Message& message : ranks().exchange(sent)) {
    ByteReader reader(message.data);
    for (auto& known : out) {
      const auto bins = reader.list<BinContent<Dim>>();
      known.bins.insert(known.bins.end(), bins.begin(), bins.end());
    }
  }
  return out;
}

// The neighbours and the blocks that they need; with common blocks, all ranks need those around them.
template <int Dim>
void Distribution<Dim>::find_partners() {
  partners_.clear(), common_.clear();
  for (const auto& neighbour : system_.partition->neighbours()) {
    partners_.push_back({neighbour.rank, neighbour.sent});
    std::ranges::sort(partners_.back().sent);
  }
  if (!has_common_blocks(model_, system_)) return;
  common_ = find_common_blocks(model_, system_, width_, known_bins());
  std::set<std::int64_t> own;
  for (const std::int64_t number : common_) {
    const Index<Dim> block = system_.lattice.block_at(number);
    Index<Dim> low, high;
    for (std::size_t d = 0; d < Dim; ++d) {
      low[d] = std::max(block[d] - layers_, 0);
      high[d] = std::min(block[d] + layers_, system_.lattice.blocks[d] - 1);
    }
    each_in_box<Dim>(low, high, [&](const Index<Dim>& around) {
      if (system_.partition->is_own(around)) own.insert(system_.lattice.block_index(around));
    });
  }
  std::vector<Partner> all;
  for (int rank = 0; rank < ranks().count(); ++rank) {
    if (rank == ranks().rank()) continue;
    Partner& partner = all.emplace_back(Partner{rank, {}});
    const auto known = std::ranges::find(partners_, rank, &Partner::rank);
    const std::vector<std::int64_t> none;
    std::ranges::set_union(known == partners_.end() ? none : known->sent, own, std::back_inserter(partner.sent));
  }
  partners_ = std::move(all);
}

// What the last division has given to this rank.
template <int Dim>
void Distribution<Dim>::count() {
  counts_.particles = counts_.ghosts = 0;
  for (const Body<Dim>* body : bodies())
    counts_.particles += body->particles.size(), counts_.ghosts += body->particles.ghosts();
  counts_.partners = partners_.size();
}

template <int Dim>
void Distribution<Dim>::make_ghosts() {
  find_partners();
  const auto all = bodies();
  std::vector<Message> sent;
  shared_.assign(partners_.size(), std::vector<Shared>(all.size()));
  for (std::size_t n = 0; n < partners_.size(); ++n) {
    ByteWriter message;
    for (std::size_t b = 0; b < all.size(); ++b) {
      const auto of_sent = contents_for(partners_[n], *all[b]);
      const auto list = all[b]->bins.list();
      for (const auto& bin : of_sent)
        shared_[n][b].sent.push_back(*std::ranges::lower_bound(list, bin.block, {}, &Bin::block));
      message.list(of_sent);
      write_rows(message, all[b]->particles, shared_[n][b].sent);
    }
    sent.push_back({partners_[n].rank, std::move(message.data)});
  }
  const auto messages = ranks().exchange(sent);
  std::vector<ByteReader> readers;
  for (const Partner& partner : partners_)
    readers.emplace_back(std::ranges::find(messages, partner.rank, &Message::rank)->data);
  for (std::size_t b = 0; b < all.size(); ++b) {
    Particles<Dim>& particles = all[b]->particles;
    particles.set_ghosts(0);
    std::vector<BinContent<Dim>> ghosts;
    const auto contents = all[b]->bins.contents();
    for (std::size_t n = 0; n < partners_.size(); ++n) {
      const auto bins = readers[n].list<BinContent<Dim>>();
      const std::size_t before = particles.ghosts(), count = particles_in<Dim>(bins);
      ghosts.insert(ghosts.end(), bins.begin(), bins.end());
      particles.set_ghosts(before + count);
      shared_[n][b].first = particles.size() + before, shared_[n][b].last = shared_[n][b].first + count;
      read_rows(readers[n], particles, shared_[n][b].first, count);
    }
    all[b]->bins.assign(system_.lattice, contents, ghosts);
    all[b]->refresh();
  }
  refreshes_.clear();
  count();
}

// The columns that are sent to refresh ghosts, and messages of the sizes in which they are received.
template <int Dim>
auto Distribution<Dim>::refresh_of(int kind, const ColumnChoice& columns) -> Refresh& {
  const auto [at, is_new] = refreshes_.try_emplace(kind);
  Refresh& refresh = at->second;
  if (!is_new) return refresh;
  const auto all = bodies();
  for (Body<Dim>* body : all) refresh.columns.push_back(columns(*body));
  for (std::size_t n = 0; n < shared_.size(); ++n) {
    std::size_t values = 0;
    for (std::size_t b = 0; b < all.size(); ++b)
      values += (shared_[n][b].last - shared_[n][b].first) * refresh.columns[b].size();
    refresh.received.push_back({partners_[n].rank, std::vector<std::byte>(values * sizeof(double))});
  }
  return refresh;
}

template <int Dim>
void Distribution<Dim>::refresh_ghosts() {
  constexpr int of_all_columns = -1;
  if (active() && !shares_all_) send(refresh_of(of_all_columns, changing_columns<Dim>));
}

template <int Dim>
void Distribution<Dim>::refresh_ghosts(int kind, const ColumnChoice& columns) {
  if (!active() || shares_all_) return;
  reads_whole_ghosts(model_, system_) ? refresh_ghosts() : send(refresh_of(kind, columns));
}

template <int Dim>
void Distribution<Dim>::send(Refresh& refresh) {
  const auto all = bodies();
  std::vector<Message> sent;
  for (std::size_t n = 0; n < shared_.size(); ++n) {
    ByteWriter message;
    for (std::size_t b = 0; b < all.size(); ++b)
      for (const std::size_t c : refresh.columns[b])
        write_column(message, all[b]->particles.column(c), shared_[n][b].sent);
    counts_.bytes += message.data.size();
    sent.push_back({partners_[n].rank, std::move(message.data)});
  }
  ++counts_.refreshes;
  ranks().exchange(sent, refresh.received);
  for (std::size_t n = 0; n < shared_.size(); ++n) {
    ByteReader reader(refresh.received[n].data);
    for (std::size_t b = 0; b < all.size(); ++b)
      for (const std::size_t c : refresh.columns[b])
        reader.values(std::span<double>(all[b]->particles.column(c) + shared_[n][b].first,
                                        shared_[n][b].last - shared_[n][b].first));
  }
}

template class Distribution<2>;
template class Distribution<3>;

}  // namespace tribo
