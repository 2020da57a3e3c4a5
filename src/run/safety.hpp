// SPDX-License-Identifier: MIT
/// Factor of safety by reduction of strength: the largest number by which all strengths may be divided while the model
/// still holds. Zienkiewicz, Humpheson & Lewis, Geotechnique 25 (1975) 671-689; Griffiths & Lane, Geotechnique 49
/// (1999) 387-403.
#pragma once

#include "model/model.hpp"

#include <functional>
#include <vector>

namespace tribo {

struct SafetyTrial {
  double factor = 0.0;  ///< of all strengths
  double late = 0.0;    ///< largest displacement after three quarters of the run [length]
  double at_end = 0.0;  ///< at its end; 0 if the run failed                  [length]
  bool holds = false;
  std::string failure;  ///< the reason if the run failed: such a model slips
};

struct Safety {
  double holds = 0.0;  ///< the largest factor tried with which the model holds
  double slips = 0.0;  ///< the smallest with which it slips
  std::vector<SafetyTrial> trials;
};

/// The model with all strengths divided by a factor. Throws InputError if no material has a strength.
Model weakened(const Model& model, double factor);

/// Bisects between the bounds of the model's StrengthReduction, widened where they do not enclose the answer. `report`
/// is called after every trial. Throws SimulationError if the model slips even with tenfold strength, or holds with a
/// hundredth.
Safety find_safety(const Model& model, int threads, const std::function<void(const SafetyTrial&)>& report);

/// A sentence if a model that holds has moved more than ten times as far as with the smallest factor, as a tunnel that
/// has closed and come to rest; else empty.
std::string doubt_about(const Safety& safety);

}  // namespace tribo
