// SPDX-License-Identifier: MIT
/// Brings bodies of a model into contact, to time steps in which contact acts.
#pragma once

#include "model/model.hpp"
#include "solver/state/system.hpp"

namespace tribo {

/// Whether two bodies come within a cell of each other.
template <int Dim>
bool has_neighbours(const Model& model, System<Dim>& system);

/// Moves each body that flies or falls towards another one to where they meet, with the speed that it has there. Bodies
/// that already have a neighbour within a cell stay where they are. Returns the mean fraction of the run during which
/// the bodies that have or meet a neighbour are in contact, if they stay so; 0 if there are none.
///
/// This is for estimates only: directions are straight, a body stops at the first cell that another one occupies.
template <int Dim>
double bring_into_contact(const Model& model, System<Dim>& system);

/// Throws all deformable bodies towards the middle of the model, so that those in contact are pressed together and
/// slide. For estimates only, as the time that contact takes depends on the pressure. `speed` [velocity].
template <int Dim>
void press_bodies(System<Dim>& system, double speed);

}  // namespace tribo
