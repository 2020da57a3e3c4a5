// SPDX-License-Identifier: MIT
/// All particles of a run in one process, or in each of them.

#include "base/common_data.hpp"
#include "solver/distribution/distribution.hpp"
#include "solver/distribution/particle_rows.hpp"

#include <algorithm>

namespace tribo {
namespace {

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

}  // namespace

// All particles of this rank, for place_all().
template <int Dim>
std::vector<std::byte> Distribution<Dim>::own_particles() {
  const auto all = bodies();
  ByteWriter mine;
  for (Body<Dim>* body : all) {
    mine.list(body->bins.contents());
    write_rows(mine, body->particles, body->bins.list());
  }
  for (Body<Dim>* body : all) write_contacts(mine, *body);
  return std::move(mine.data);
}

// Replaces the particles by those of all ranks, which `of_ranks` holds one after the other, in the order of a single
// process.
template <int Dim>
void Distribution<Dim>::place_all(std::span<const std::vector<std::byte>> of_ranks) {
  const auto all = bodies();
  std::vector<ByteReader> readers;
  for (const auto& message : of_ranks) readers.emplace_back(message);
  for (Body<Dim>* body : all) {
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
void Distribution<Dim>::collect() {
  if (!active() || shares_all_) return;
  ByteWriter mine;
  mine.value(counts_);
  const auto counts = ranks().gather(std::move(mine.data));
  const auto messages = ranks().gather(own_particles());
  if (ranks().rank() != 0) return;
  counts_of_ranks_.clear();
  for (const auto& of_rank : counts) counts_of_ranks_.push_back(ByteReader(of_rank).value<Counts>());
  for (Body<Dim>* body : bodies()) kept_.push_back({body->particles, body->bins, body->contacts});
  place_all(messages);
}

template <int Dim>
void Distribution<Dim>::unite() {
  if (!active() || shares_all_) return;
  const auto mine = own_particles();
  const auto sizes = values_of_all_ranks(std::vector<std::size_t>{mine.size()});
  const auto all = values_of_all_ranks(mine);
  std::vector<std::vector<std::byte>> of_ranks;
  auto from = all.begin();
  for (const std::size_t size : sizes) {
    const auto to = from + static_cast<std::ptrdiff_t>(size);
    of_ranks.emplace_back(from, to), from = to;
  }
  place_all(of_ranks);
  shares_all_ = true;
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

template void Distribution<2>::unite();
template void Distribution<3>::unite();
template void Distribution<2>::collect();
template void Distribution<3>::collect();
template void Distribution<2>::release();
template void Distribution<3>::release();

}  // namespace tribo
