// SPDX-License-Identifier: MIT
/// The initial particles of a model in little memory.
#pragma once

#include "particles/seed.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <initializer_list>
#include <iterator>
#include <vector>

namespace tribo {

/// A sequence of values in which successive equal values are stored once.
template <class T>
class Runs {
  struct Run {
    std::size_t begin;
    T value;
  };

 public:
  void push_back(const T& value) {
    if (runs_.empty() || !(runs_.back().value == value)) runs_.push_back({size_, value});
    ++size_;
  }
  /// Whether f(value) is true for a value.
  template <class F>
  bool any_of(F&& f) const {
    return std::any_of(runs_.begin(), runs_.end(), [&](const Run& run) { return f(run.value); });
  }

  /// Reads the values in ascending order.
  class Cursor {
   public:
    Cursor(const Runs& runs, std::size_t i) : runs_(&runs.runs_) {
      const auto after = std::upper_bound(runs_->begin(), runs_->end(), i,
                                          [](std::size_t at, const Run& run) { return at < run.begin; });
      run_ = static_cast<std::size_t>(after - runs_->begin()) - (after == runs_->begin() ? 0 : 1);
    }
    const T& value() const { return (*runs_)[run_].value; }
    /// Moves to position i, which is the present one or the next. Whether the value may be another one there.
    bool move_to(std::size_t i) {
      if (run_ + 1 >= runs_->size() || (*runs_)[run_ + 1].begin > i) return false;
      ++run_;
      return true;
    }

   private:
    const std::vector<Run>* runs_;
    std::size_t run_;
  };

 private:
  std::vector<Run> runs_;
  std::size_t size_ = 0;
};

/// The initial particles, in order. Positions are stored one by one. Velocity, stress, mass with volume, row of a
/// table, and everything else are stored once for successive particles for which they are the same, as most particles
/// of a body differ by their positions only.
class Seeds {
  struct Weight {
    double volume, mass;
    bool operator==(const Weight& other) const { return volume == other.volume && mass == other.mass; }
  };

 public:
  Seeds() = default;
  Seeds(const std::vector<Seed>& list) {  // NOLINT(google-explicit-constructor): a list of particles is a Seeds
    for (const Seed& seed : list) push_back(seed);
  }
  Seeds(std::initializer_list<Seed> list) : Seeds(std::vector<Seed>(list)) {}

  void push_back(const Seed& seed) {
    x_.push_back(seed.x), v_.push_back(seed.v), stress_.push_back(seed.stress);
    weight_.push_back({seed.volume, seed.mass}), row_.push_back(seed.row);
    Seed rest = seed;
    rest.x = rest.v = Vec3::Zero(), rest.stress.setZero(), rest.volume = rest.mass = 0.0;
    rest.row = 0;
    rest_.push_back(rest);
  }
  std::size_t size() const { return x_.size(); }
  bool empty() const { return x_.empty(); }
  Seed operator[](std::size_t i) const { return *Iterator(*this, i); }
  Seed front() const { return (*this)[0]; }
  /// Whether f(seed) is true for a particle, where f depends on the domain, the deformation, the temperature, the angle
  /// and the origin of the particle only. It is called once for successive equal ones.
  template <class F>
  bool any_kind(F&& f) const {
    return rest_.any_of(f);
  }

  /// Reads the particles in order; what it refers to changes when it moves.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Seed;
    using difference_type = std::ptrdiff_t;
    using pointer = const Seed*;
    using reference = const Seed&;

    Iterator(const Seeds& seeds, std::size_t i)
        : seeds_(&seeds),
          i_(i),
          v_(seeds.v_, i),
          stress_(seeds.stress_, i),
          weight_(seeds.weight_, i),
          row_(seeds.row_, i),
          rest_(seeds.rest_, i) {
      if (i_ < seeds_->size()) read();
    }
    const Seed& operator*() const { return seed_; }
    const Seed* operator->() const { return &seed_; }
    Iterator& operator++() {
      if (++i_ == seeds_->size()) return *this;
      const bool other_v = v_.move_to(i_), other_stress = stress_.move_to(i_), other_weight = weight_.move_to(i_),
                 other_row = row_.move_to(i_);
      if (rest_.move_to(i_) || other_v || other_stress || other_weight || other_row)
        read();
      else
        seed_.x = seeds_->x_[i_];
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return i_ == other.i_; }

   private:
    void read() {
      seed_ = rest_.value();
      seed_.x = seeds_->x_[i_], seed_.v = v_.value(), seed_.stress = stress_.value();
      seed_.volume = weight_.value().volume, seed_.mass = weight_.value().mass, seed_.row = row_.value();
    }

    const Seeds* seeds_;
    std::size_t i_;
    Runs<Vec3>::Cursor v_;
    Runs<Mat3>::Cursor stress_;
    Runs<Weight>::Cursor weight_;
    Runs<std::size_t>::Cursor row_;
    Runs<Seed>::Cursor rest_;
    Seed seed_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  std::deque<Vec3> x_;  // a vector would need room for twice as many while it grows
  Runs<Vec3> v_;
  Runs<Mat3> stress_;
  Runs<Weight> weight_;
  Runs<std::size_t> row_;
  Runs<Seed> rest_;
};

}  // namespace tribo
