// SPDX-License-Identifier: MIT
#include "solver/distribution/distribution.hpp"

#include "base/bytes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <string_view>
#include <unordered_map>

namespace tribo {
namespace {

constexpr double most_imbalance = 1.10;     // beyond it the blocks are divided anew
constexpr std::int64_t steps_between = 50;  // at least, between two divisions

// Appends the values of a column in the ranges of some bins.
void write_column(ByteWriter& to, const double* column, std::span<const Bin> bins) {
  for (const Bin& bin : bins) to.values(std::span<const double>(column + bin.begin, bin.end - bin.begin));
}

template <int Dim>
void write_rows(ByteWriter& to, const Particles<Dim>& particles, std::span<const Bin> bins) {
  for (const Bin& bin : bins)
    to.values(std::span<const std::int64_t>(particles.id.data() + bin.begin, bin.end - bin.begin));
  for (const auto& column : particles.columns()) write_column(to, column.data.data(), bins);
}

// Reads rows that were written for `count` particles to the places from `first`.
template <int Dim>
void read_rows(ByteReader& from, Particles<Dim>& particles, std::size_t first, std::size_t count) {
  from.values(std::span<std::int64_t>(particles.id.data() + first, count));
  for (auto& column : particles.columns()) from.values(std::span<double>(column.data.data() + first, count));
}

// Contact at the particles of a body, of which ghosts are left out; a particle is given by its bin and its place there.
template <int Dim>
void write_contacts(ByteWriter& to, const Body<Dim>& body) {
  std::size_t count = 0;
  for (const auto& contact : body.contacts) count += contact.particle < body.particles.size() ? 1 : 0;
  to.value(count);
  for (const auto& contact : body.contacts) {
    if (contact.particle >= body.particles.size()) continue;
    const auto bin = std::ranges::upper_bound(body.bins.list(), contact.particle, {}, &Bin::begin) - 1;
    to.value(bin->block), to.value(contact.particle - bin->begin), to.value(contact.slips);
    for (const Vec<Dim>* vector : {&contact.traction, &contact.normal})
      for (const double component : *vector) to.value(component);
  }
}

template <int Dim>
std::vector<ContactOfParticle<Dim>> read_contacts(ByteReader& from, const Bins<Dim>& bins) {
  std::vector<ContactOfParticle<Dim>> out(from.value<std::size_t>());
  for (auto& contact : out) {
    const auto block = from.value<std::int64_t>();
    contact.particle = std::ranges::lower_bound(bins.list(), block, {}, &Bin::block)->begin;
    contact.particle += from.value<std::uint32_t>(), contact.slips = from.value<bool>();
    for (Vec<Dim>* vector : {&contact.traction, &contact.normal})
      for (double& component : *vector) component = from.value<double>();
  }
  return out;
}

template <int Dim>
std::size_t particles_in(std::span<const BinContent<Dim>> bins) {
  std::size_t count = 0;
  for (const auto& bin : bins) count += bin.count;
  return count;
}

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
  divided_at_ = system_.step;
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

template <int Dim>
void Distribution<Dim>::make_ghosts() {
  const auto all = bodies();
  const auto& neighbours = system_.partition->neighbours();
  std::vector<Message> sent;
  shared_.assign(neighbours.size(), std::vector<Shared>(all.size()));
  std::vector<std::vector<BinContent<Dim>>> contents;
  for (Body<Dim>* body : all) contents.push_back(body->bins.contents());
  for (std::size_t n = 0; n < neighbours.size(); ++n) {
    ByteWriter message;
    for (std::size_t b = 0; b < all.size(); ++b) {
      std::vector<BinContent<Dim>> of_sent;
      const auto list = all[b]->bins.list();
      for (const std::int64_t block : neighbours[n].sent) {
        const auto at = std::ranges::lower_bound(list, block, {}, &Bin::block);
        if (at == list.end() || at->block != block) continue;
        shared_[n][b].sent.push_back(*at);
        of_sent.push_back(contents[b][static_cast<std::size_t>(at - list.begin())]);
      }
      message.list(of_sent);
      for (const auto& column : all[b]->particles.columns())
        write_column(message, column.data.data(), shared_[n][b].sent);
    }
    sent.push_back({neighbours[n].rank, std::move(message.data)});
  }
  const auto messages = ranks().exchange(sent);
  std::vector<ByteReader> readers;
  for (const auto& neighbour : neighbours) {
    const auto from = std::ranges::find(messages, neighbour.rank, &Message::rank);
    readers.emplace_back(from->data);
  }
  for (std::size_t b = 0; b < all.size(); ++b) {
    std::vector<BinContent<Dim>> ghosts;
    Particles<Dim>& particles = all[b]->particles;
    std::vector<std::vector<double>> columns(particles.columns().size());
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      const auto bins = readers[n].list<BinContent<Dim>>();
      const std::size_t count = particles_in<Dim>(bins);
      shared_[n][b].first = particles.size() + columns[0].size();
      shared_[n][b].last = shared_[n][b].first + count;
      ghosts.insert(ghosts.end(), bins.begin(), bins.end());
      for (auto& column : columns) {
        const std::size_t before = column.size();
        column.resize(before + count);
        readers[n].values(std::span<double>(column.data() + before, count));
      }
    }
    particles.set_ghosts(columns[0].size());
    for (std::size_t c = 0; c < columns.size(); ++c)
      std::copy(columns[c].begin(), columns[c].end(),
                particles.columns()[c].data.begin() + static_cast<std::ptrdiff_t>(particles.size()));
    all[b]->bins.assign(system_.lattice, contents[b], ghosts);
    all[b]->refresh();
  }
  find_changing_columns();
}

// Columns that change between sorts, and the sizes of the messages with them.
template <int Dim>
void Distribution<Dim>::find_changing_columns() {
  const auto all = bodies();
  changing_.assign(all.size(), {});
  for (std::size_t b = 0; b < all.size(); ++b) {
    const auto& columns = all[b]->particles.columns();
    const auto stays = [](std::string_view name) {
      return name == "mass" || name == "load_set" || name.starts_with("origin") || name.starts_with("half_");
    };
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (!stays(columns[c].name)) changing_[b].push_back(c);
  }
  received_.clear();
  for (std::size_t n = 0; n < shared_.size(); ++n) {
    std::size_t values = 0;
    for (std::size_t b = 0; b < all.size(); ++b)
      values += (shared_[n][b].last - shared_[n][b].first) * changing_[b].size();
    received_.push_back({system_.partition->neighbours()[n].rank, std::vector<std::byte>(values * sizeof(double))});
  }
}

template <int Dim>
void Distribution<Dim>::refresh_ghosts() {
  if (!active() || shares_all_) return;
  const auto all = bodies();
  std::vector<Message> sent;
  for (std::size_t n = 0; n < shared_.size(); ++n) {
    ByteWriter message;
    for (std::size_t b = 0; b < all.size(); ++b)
      for (const std::size_t c : changing_[b]) write_column(message, all[b]->particles.column(c), shared_[n][b].sent);
    bytes_sent_ += message.data.size();
    sent.push_back({system_.partition->neighbours()[n].rank, std::move(message.data)});
  }
  ++refresh_count_;
  ranks().exchange(sent, received_);
  for (std::size_t n = 0; n < shared_.size(); ++n) {
    ByteReader reader(received_[n].data);
    for (std::size_t b = 0; b < all.size(); ++b)
      for (const std::size_t c : changing_[b])
        reader.values(std::span<double>(all[b]->particles.column(c) + shared_[n][b].first,
                                        shared_[n][b].last - shared_[n][b].first));
  }
}

template <int Dim>
void Distribution<Dim>::collect() {
  if (!active() || shares_all_) return;
  const auto all = bodies();
  ByteWriter mine;
  for (Body<Dim>* body : all) {
    mine.list(body->bins.contents());
    write_rows(mine, body->particles, body->bins.list());
  }
  for (Body<Dim>* body : all) write_contacts(mine, *body);
  const auto messages = ranks().gather(std::move(mine.data));
  if (ranks().rank() != 0) return;
  std::vector<ByteReader> readers;
  for (const auto& message : messages) readers.emplace_back(message);
  for (Body<Dim>* body : all) {
    kept_.push_back({body->particles, body->bins, std::move(body->contacts)});
    body->contacts.clear();
    std::vector<BinContent<Dim>> bins;
    std::vector<Bin> places;  // of the bins in the order in which they were received
    Particles<Dim>& particles = body->particles;
    particles.resize(0);
    for (ByteReader& reader : readers) {
      const auto list = reader.list<BinContent<Dim>>();
      const std::size_t before = particles.size(), count = particles_in<Dim>(list);
      particles.resize(before + count);
      read_rows(reader, particles, before, count);
      auto begin = static_cast<std::uint32_t>(before);
      for (const auto& bin : list) {
        bins.push_back(bin), places.push_back({bin.block, begin, begin + bin.count});
        begin += bin.count;
      }
    }
    std::ranges::sort(bins, {}, &BinContent<Dim>::block);
    std::ranges::sort(places, {}, &Bin::block);
    std::vector<std::uint32_t> order;
    for (const Bin& bin : places)
      for (std::uint32_t i = bin.begin; i < bin.end; ++i) order.push_back(i);
    particles.reorder(order);
    body->bins.assign(system_.lattice, bins, {});
    body->refresh();
  }
  for (Body<Dim>* body : all) {
    for (ByteReader& reader : readers)
      for (const auto& contact : read_contacts(reader, body->bins)) body->contacts.push_back(contact);
    std::ranges::sort(body->contacts, {}, &ContactOfParticle<Dim>::particle);
  }
}

template <int Dim>
void Distribution<Dim>::release() {
  const auto all = bodies();
  for (std::size_t b = 0; b < kept_.size(); ++b) {
    all[b]->particles = std::move(kept_[b].particles);
    all[b]->bins = std::move(kept_[b].bins);
    all[b]->contacts = std::move(kept_[b].contacts);
    all[b]->refresh();
  }
  kept_.clear();
}

template class Distribution<2>;
template class Distribution<3>;

}  // namespace tribo
